#include "study/diagnostics.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace morula::scenarios {
namespace {

constexpr std::size_t kKept = 1000;  // messages of each severity
constexpr std::size_t kShown = 100;  // messages in all
constexpr std::size_t kBlock = 256;  // bytes

bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

int count_characters(std::string_view text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char byte) { return !continues_character(byte); }));
}

/// The part of a long line around the place, and the column in it. Lines of a machine-written file may be megabytes long.
struct Excerpt {
  std::string text;
  int column;
};

Excerpt excerpt_around(const SourceText& source, int number, int column) {
  constexpr int kBefore = 100, kMost = 200;
  const std::string_view line = source.line(number);
  const std::size_t begin = source.line_begin[static_cast<std::size_t>(number) - 1], before = source.characters_before(begin);
  const int count = static_cast<int>(source.characters_before(begin + line.size()) - before);
  const int first = count <= kMost ? 0 : std::clamp(column - 1 - kBefore, 0, count - 1);
  const int last = std::min(count, first + kMost);
  const auto byte_of = [&](int character) { return source.byte_of(before + static_cast<std::size_t>(character)) - begin; };
  const std::size_t from = byte_of(first), to = last < count ? byte_of(last) : line.size();
  std::string text(line.substr(from, to - from));
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
  std::size_t characters = 0;
  for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
    block_characters_.push_back(characters);
    characters += static_cast<std::size_t>(count_characters(std::string_view(bytes).substr(at, kBlock)));
  }
  block_characters_.push_back(characters);
}

std::size_t SourceText::characters_before(std::size_t byte) const {
  const std::size_t block = std::min(byte / kBlock, block_characters_.size() - 1), from = std::min(block * kBlock, bytes.size());
  return block_characters_[block] + static_cast<std::size_t>(count_characters(std::string_view(bytes).substr(from, byte - from)));
}

std::size_t SourceText::byte_of(std::size_t character) const {
  const auto next = std::upper_bound(block_characters_.begin(), block_characters_.end(), character);
  const auto block = static_cast<std::size_t>(next - block_characters_.begin()) - 1;
  std::size_t byte = block * kBlock, passed = block_characters_[block];
  for (; byte < bytes.size(); ++byte)
    if (!continues_character(bytes[byte]) && passed++ == character) break;
  return std::min(byte, bytes.size());
}

std::string_view SourceText::line(int number) const {
  if (number < 1 || static_cast<std::size_t>(number) > line_begin.size()) return {};
  const std::size_t begin = line_begin[static_cast<std::size_t>(number) - 1];
  std::size_t end = static_cast<std::size_t>(number) < line_begin.size() ? line_begin[static_cast<std::size_t>(number)] - 1 : bytes.size();
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
  const int column = 1 + static_cast<int>(source->characters_before(begin + offset) - source->characters_before(begin));
  const int length = count_characters(text.substr(offset, bytes));
  return {std::move(source), line, column, std::max(1, length)};
}

void Diagnostics::add(Diagnostic&& diagnostic) {
  const bool is_error = diagnostic.severity == Severity::kError;
  ++(is_error ? errors_ : warnings_);
  std::size_t& kept = is_error ? kept_errors_ : kept_warnings_;
  if (kept == kKept) return;
  ++kept;
  list_.push_back(std::move(diagnostic));
}

bool Diagnostics::full() const { return kept_errors_ == kKept; }

void Diagnostics::error(int code, Place place, std::string text, std::string help) {
  add({Severity::kError, code, std::move(place), std::move(text), std::move(help)});
}

void Diagnostics::warning(int code, Place place, std::string text, std::string help) {
  add({Severity::kWarning, code, std::move(place), std::move(text), std::move(help)});
}

void Diagnostics::append(Diagnostics other) {
  const std::size_t errors = errors_ + other.errors_, warnings = warnings_ + other.warnings_;
  for (Diagnostic& diagnostic : other.list_) add(std::move(diagnostic));
  errors_ = errors;
  warnings_ = warnings;
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
  const auto same = [](const Diagnostic& a, const Diagnostic& b) {
    return a.place.source && a.place.source == b.place.source && a.place.line == b.place.line && a.place.column == b.place.column &&
           a.severity == b.severity && a.code == b.code && a.text == b.text;
  };
  const auto end = std::unique(list_.begin(), list_.end(), same);
  list_.erase(end, list_.end());
  const auto is_error = [](const Diagnostic& d) { return d.severity == Severity::kError; };
  const auto errors = static_cast<std::size_t>(std::count_if(list_.begin(), list_.end(), is_error));
  errors_ -= std::exchange(kept_errors_, errors) - errors;
  warnings_ -= std::exchange(kept_warnings_, list_.size() - errors) - (list_.size() - errors);
}

void Diagnostics::warnings_to_errors() {
  for (Diagnostic& d : list_) d.severity = Severity::kError;
  errors_ += std::exchange(warnings_, 0);
  kept_errors_ += std::exchange(kept_warnings_, 0);
}

namespace {

void append_message(std::string& out, const Diagnostic& d, bool colour) {
  const auto paint = [colour](const char* code, const std::string& words) {
    return colour ? "\033[" + std::string(code) + "m" + words + "\033[0m" : words;
  };
  const bool is_error = d.severity == Severity::kError;
  const char* shade = is_error ? "1;31" : "1;35";
  if (d.place.source) {
    std::string where = d.place.source->name;
    if (d.place.line > 0) where += ":" + std::to_string(d.place.line) + ":" + std::to_string(d.place.column);
    out += paint("1", visible(where) + ":") + " ";
  }
  out += paint(shade, is_error ? "error:" : "warning:") + " " + visible(d.text) + " [E" + std::to_string(d.code) + "]\n";
  if (d.place.source && !d.place.source->line(d.place.line).empty()) {
    char gutter[16];
    std::snprintf(gutter, sizeof gutter, "%5d", d.place.line);
    const Excerpt excerpt = excerpt_around(*d.place.source, d.place.line, d.place.column);
    const int width = std::max(1, std::min(d.place.length, count_characters(excerpt.text) - excerpt.column + 1));
    out += std::string(gutter) + " | " + excerpt.text + "\n";
    out += "      | " + std::string(static_cast<std::size_t>(std::max(0, excerpt.column - 1)), ' ') +
           paint(shade, "^" + std::string(static_cast<std::size_t>(width - 1), '~')) + "\n";
  }
  if (!d.help.empty()) out += "      = help: " + visible(d.help) + "\n";
}

std::string with_thousands(std::size_t number) {
  std::string out = std::to_string(number);
  for (std::size_t at = out.size(); at > 3;) out.insert(at -= 3, ",");
  return out;
}

}  // namespace

std::string Diagnostics::text(bool colour) const {
  std::string out;
  std::size_t errors_left = kShown, warnings_left = kShown - std::min(kShown, kept_errors_), shown = 0;
  for (const Diagnostic& d : list_) {
    std::size_t& left = d.severity == Severity::kError ? errors_left : warnings_left;
    if (left == 0) continue;
    --left;
    ++shown;
    append_message(out, d, colour);
  }
  if (const std::size_t more = errors_ + warnings_ - shown; more > 0) out += "and " + with_thousands(more) + " more\n";
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
