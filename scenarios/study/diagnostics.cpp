#include "scenarios/study/diagnostics.h"

#include <algorithm>
#include <cstdio>

namespace morula::scenarios {
namespace {

bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

int count_characters(std::string_view text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char byte) { return !continues_character(byte); }));
}

/// The part of a long line around the place, and the column in it. Lines of a machine-written file may be megabytes long.
struct Excerpt {
  std::string text;
  int column;
};

Excerpt excerpt_around(std::string_view line, int column) {
  constexpr int kBefore = 100, kShown = 200;
  std::vector<std::size_t> begin;  // byte of each character
  for (std::size_t i = 0; i < line.size(); ++i)
    if (!continues_character(line[i])) begin.push_back(i);
  begin.push_back(line.size());
  const int count = static_cast<int>(begin.size()) - 1;
  const int first = count <= kShown ? 0 : std::clamp(column - 1 - kBefore, 0, count - 1);
  const int last = std::min(count, first + kShown);
  std::string text(line.substr(begin[first], begin[last] - begin[first]));
  for (char& c : text)
    if (c == '\t' || static_cast<unsigned char>(c) < 0x20) c = ' ';  // one cell wide, and no escape sequences reach the terminal
  if (first > 0) text = "…" + text;
  if (last < count) text += "…";
  return {text, column - first + (first > 0 ? 1 : 0)};
}

std::string visible(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  return text;
}

}  // namespace

SourceText::SourceText(std::string name_, std::string bytes_) : name(std::move(name_)), bytes(std::move(bytes_)), line_begin{0} {
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (bytes[i] == '\n') line_begin.push_back(i + 1);
}

std::string_view SourceText::line(int number) const {
  if (number < 1 || static_cast<std::size_t>(number) > line_begin.size()) return {};
  const std::size_t begin = line_begin[static_cast<std::size_t>(number) - 1];
  std::size_t end = bytes.find('\n', begin);
  if (end == std::string::npos) end = bytes.size();
  if (end > begin && bytes[end - 1] == '\r') --end;
  return std::string_view(bytes).substr(begin, end - begin);
}

Place place_at(std::shared_ptr<const SourceText> source, std::size_t byte, std::size_t bytes) {
  byte = std::min(byte, source->bytes.size());
  const auto next = std::upper_bound(source->line_begin.begin(), source->line_begin.end(), byte);
  const int line = static_cast<int>(next - source->line_begin.begin());
  const std::size_t begin = source->line_begin[static_cast<std::size_t>(line) - 1];
  const std::string_view text = source->line(line);
  const std::size_t offset = std::min(byte - begin, text.size());
  const int column = 1 + count_characters(text.substr(0, offset));
  const int length = count_characters(text.substr(offset, bytes));
  return {std::move(source), line, column, std::max(1, length)};
}

void Diagnostics::error(int code, Place place, std::string text, std::string help) {
  list_.push_back({Severity::kError, code, std::move(place), std::move(text), std::move(help)});
}

void Diagnostics::warning(int code, Place place, std::string text, std::string help) {
  list_.push_back({Severity::kWarning, code, std::move(place), std::move(text), std::move(help)});
}

void Diagnostics::append(Diagnostics other) {
  list_.insert(list_.end(), std::make_move_iterator(other.list_.begin()), std::make_move_iterator(other.list_.end()));
}

std::size_t Diagnostics::error_count() const {
  return static_cast<std::size_t>(
      std::count_if(list_.begin(), list_.end(), [](const Diagnostic& d) { return d.severity == Severity::kError; }));
}

void Diagnostics::sort() {
  std::vector<const SourceText*> order;  // sources in the order they were first named; the study comes first because it is read first
  const auto rank = [&order](const Diagnostic& d) { return std::find(order.begin(), order.end(), d.place.source.get()) - order.begin(); };
  for (const Diagnostic& d : list_)
    if (std::find(order.begin(), order.end(), d.place.source.get()) == order.end()) order.push_back(d.place.source.get());
  std::stable_sort(list_.begin(), list_.end(), [&](const Diagnostic& a, const Diagnostic& b) {
    if (a.place.source != b.place.source) return rank(a) < rank(b);
    if (a.place.line != b.place.line) return a.place.line < b.place.line;
    return a.place.column < b.place.column;
  });
}

void Diagnostics::warnings_to_errors() {
  for (Diagnostic& d : list_) d.severity = Severity::kError;
}

std::string Diagnostics::text(bool colour) const {
  const auto paint = [colour](const char* code, const std::string& words) {
    return colour ? "\033[" + std::string(code) + "m" + words + "\033[0m" : words;
  };
  std::string out;
  for (const Diagnostic& d : list_) {
    const bool is_error = d.severity == Severity::kError;
    const char* shade = is_error ? "1;31" : "1;35";
    if (d.place.source) {
      std::string where = d.place.source->name;
      if (d.place.line > 0) where += ":" + std::to_string(d.place.line) + ":" + std::to_string(d.place.column);
      out += paint("1", visible(where) + ":") + " ";
    }
    out += paint(shade, is_error ? "error:" : "warning:") + " " + visible(d.text) + " [E" + std::to_string(d.code) + "]\n";
    const std::string_view line = d.place.source ? d.place.source->line(d.place.line) : std::string_view{};
    if (!line.empty()) {
      char gutter[16];
      std::snprintf(gutter, sizeof gutter, "%5d", d.place.line);
      const Excerpt excerpt = excerpt_around(line, d.place.column);
      const int width = std::max(1, std::min(d.place.length, count_characters(excerpt.text) - excerpt.column + 1));
      out += std::string(gutter) + " | " + excerpt.text + "\n";
      out += "      | " + std::string(static_cast<std::size_t>(std::max(0, excerpt.column - 1)), ' ') +
             paint(shade, "^" + std::string(static_cast<std::size_t>(width - 1), '~')) + "\n";
    }
    if (!d.help.empty()) out += "      = help: " + visible(d.help) + "\n";
  }
  return out;
}

ErrorKind Diagnostics::kind() const {
  bool any = false;
  for (const Diagnostic& d : list_) {
    if (d.severity != Severity::kError) continue;
    if (d.code != 601) return ErrorKind::kInput;
    any = true;
  }
  return any ? ErrorKind::kFile : ErrorKind::kInput;
}

Error Diagnostics::as_error() const {
  std::string all = text();
  while (!all.empty() && all.back() == '\n') all.pop_back();
  return {kind(), std::move(all), {}};
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before_last[j - 2] + 1);
    }
    before_last.swap(last);
    last.swap(now);
  }
  return last[b.size()];
}

std::string suggest(std::string_view word, const std::vector<std::string>& allowed) {
  std::string best;
  std::size_t best_distance = 3;
  if (word.size() <= 64) {
    for (const std::string& candidate : allowed) {
      const std::size_t distance = edit_distance(word, candidate);
      if (distance < best_distance && distance < std::max(candidate.size(), word.size())) best_distance = distance, best = candidate;
    }
  }
  if (!best.empty()) return "did you mean `" + best + "`?";
  if (allowed.empty()) return {};
  std::string list = "allowed: ";
  for (std::size_t i = 0; i < allowed.size(); ++i) list += (i ? ", " : "") + allowed[i];
  return list;
}

}  // namespace morula::scenarios
