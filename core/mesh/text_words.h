#pragma once
#include <optional>
#include <string_view>

namespace morula {

/// Words of a text, with the line each one stands in.
class TextWords {
 public:
  explicit TextWords(std::string_view text) : text_(text) {}

  /// The next word; empty at the end of the text.
  std::string_view next();
  /// The next word of the present line; empty at its end. A backslash before the end of a line joins it with the next one.
  std::string_view next_in_line();
  /// Go to the beginning of the next line; false at the end of the text.
  bool next_line();
  /// Pass over the rest of the present line.
  void skip_line();
  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  [[nodiscard]] std::string_view take_word();

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  bool begun_ = false;
};

/// The whole word as a number (a leading + is fine); nothing when it is none. May be NaN or infinite.
std::optional<double> parse_number(std::string_view word);
/// The whole word as a whole number.
std::optional<long long> parse_whole(std::string_view word);

}  // namespace morula
