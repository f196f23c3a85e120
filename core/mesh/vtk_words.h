#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace morula {

/// Words and numbers of a legacy VTK file, whose blocks of numbers are text or big-endian bytes.
class VtkWords {
 public:
  VtkWords(std::filesystem::path file, std::string_view content) : file_(std::move(file)), content_(content) {}

  void set_binary(bool binary) { binary_ = binary; }
  [[nodiscard]] bool is_binary() const { return binary_; }

  /// The next word, on whatever line; empty at the end.
  std::string_view word();
  /// The next word of the present line; empty at its end.
  std::string_view word_in_line();
  /// The next word, without taking it.
  [[nodiscard]] std::string_view peek() const;
  /// The rest of the present line, without its end.
  std::string_view line();
  /// Pass over lines up to and with the next empty one.
  void skip_to_empty_line();

  /// A whole number ≥ 0; `what` names it in the message.
  Result<std::size_t> count(const char* what);
  /// `rows` × `width` numbers of a type by its VTK name (`float`, `vtktypeint64`, …).
  Result<std::vector<double>> numbers(std::size_t rows, std::size_t width, std::string_view type);
  /// `n` whole numbers of a type.
  Result<std::vector<std::int64_t>> wholes(std::size_t n, std::string_view type);

  /// An error at the present place.
  [[nodiscard]] Error error(const std::string& what, std::string help) const;

 private:
  template <class Number>
  Result<std::vector<Number>> block(std::size_t n, std::string_view type);

  std::filesystem::path file_;
  std::string_view content_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  bool binary_ = false;
};

/// A word of a file as it may stand in a message.
std::string quoted_word(std::string_view word);

}  // namespace morula
