#include "core/mesh/text_words.h"

#include <charconv>

namespace morula {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

template <class Number>
std::optional<Number> parse_whole_word(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || word.empty()) return std::nullopt;
  return value;
}

}  // namespace

std::string_view TextWords::take_word() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_space(text_[at_]) && text_[at_] != '\n') ++at_;
  return text_.substr(begin, at_ - begin);
}

std::string_view TextWords::next() {
  for (; at_ < text_.size() && (is_space(text_[at_]) || text_[at_] == '\n'); ++at_) line_ += text_[at_] == '\n';
  return take_word();
}

std::string_view TextWords::next_in_line() {
  for (;;) {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    if (at_ >= text_.size() || text_[at_] == '\n') return {};
    const std::string_view word = take_word();
    if (word != "\\" || (at_ < text_.size() && text_[at_] != '\n')) return word;
    if (at_ < text_.size()) ++at_, ++line_;
  }
}

void TextWords::skip_line() {
  while (at_ < text_.size() && text_[at_] != '\n') ++at_;
}

bool TextWords::next_line() {
  if (!begun_) {
    begun_ = true;
    return at_ < text_.size();
  }
  skip_line();
  if (at_ >= text_.size()) return false;
  ++at_;
  ++line_;
  return at_ < text_.size();
}

std::optional<double> parse_number(std::string_view word) { return parse_whole_word<double>(word); }
std::optional<long long> parse_whole(std::string_view word) { return parse_whole_word<long long>(word); }

}  // namespace morula
