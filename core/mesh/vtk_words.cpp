#include "core/mesh/vtk_words.h"

#include <cctype>
#include <cstring>
#include <limits>
#include <type_traits>

#include "core/mesh/text_words.h"

namespace morula {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v' || c == '\n'; }

/// Kinds of numbers in a binary block.
enum class Kind : std::uint8_t { kUnknown, kSigned, kUnsigned, kFloat };
struct NumberType {
  Kind kind = Kind::kUnknown;
  std::size_t bytes = 0;
};

NumberType number_type(std::string_view name) {
  struct Entry {
    std::string_view name;
    NumberType type;
  };
  // vtkIdType is written as 32 bits in these files, whatever it is in memory.
  constexpr Entry kTypes[] = {{"float", {Kind::kFloat, 4}},
                              {"double", {Kind::kFloat, 8}},
                              {"int", {Kind::kSigned, 4}},
                              {"vtkIdType", {Kind::kSigned, 4}},
                              {"vtktypeint64", {Kind::kSigned, 8}},
                              {"vtktypeuint64", {Kind::kUnsigned, 8}},
                              {"long", {Kind::kSigned, 8}},
                              {"unsigned_long", {Kind::kUnsigned, 8}},
                              {"unsigned_int", {Kind::kUnsigned, 4}},
                              {"short", {Kind::kSigned, 2}},
                              {"unsigned_short", {Kind::kUnsigned, 2}},
                              {"char", {Kind::kSigned, 1}},
                              {"signed_char", {Kind::kSigned, 1}},
                              {"unsigned_char", {Kind::kUnsigned, 1}},
                              {"vtktypeint32", {Kind::kSigned, 4}},
                              {"vtktypeuint32", {Kind::kUnsigned, 4}}};
  for (const Entry& entry : kTypes)
    if (entry.name == name) return entry.type;
  return {};
}

template <class To, class From>
To from_bits(std::uint64_t bits) {
  From value{};
  std::make_unsigned_t<
      std::conditional_t<std::is_floating_point_v<From>, std::conditional_t<sizeof(From) == 4, std::int32_t, std::int64_t>, From>>
      narrow = static_cast<decltype(narrow)>(bits);
  std::memcpy(&value, &narrow, sizeof value);
  return static_cast<To>(value);
}

template <class Number>
Number decode(const char* at, NumberType type) {
  std::uint64_t bits = 0;
  for (std::size_t b = 0; b < type.bytes; ++b) bits = bits << 8 | static_cast<unsigned char>(at[b]);
  if (type.kind == Kind::kFloat) {
    if constexpr (std::is_floating_point_v<Number>)
      return type.bytes == 4 ? from_bits<Number, float>(bits) : from_bits<Number, double>(bits);
    return Number{-1};
  }
  if (type.kind == Kind::kUnsigned) return static_cast<Number>(bits);
  switch (type.bytes) {
    case 1:
      return from_bits<Number, std::int8_t>(bits);
    case 2:
      return from_bits<Number, std::int16_t>(bits);
    case 4:
      return from_bits<Number, std::int32_t>(bits);
    default:
      return from_bits<Number, std::int64_t>(bits);
  }
}

}  // namespace

std::string quoted_word(std::string_view word) {
  std::string out = "'";
  for (const char c : word.substr(0, 40)) out += std::isprint(static_cast<unsigned char>(c)) ? c : '?';
  return out + "'";
}

Error VtkWords::error(const std::string& what, std::string help) const {
  return {ErrorKind::kFile, file_.string() + ":" + (binary_ ? "byte " + std::to_string(at_) : std::to_string(line_)) + ": " + what,
          std::move(help)};
}

std::string_view VtkWords::word() {
  for (; at_ < content_.size() && is_space(content_[at_]); ++at_) line_ += content_[at_] == '\n';
  const std::size_t begin = at_;
  while (at_ < content_.size() && !is_space(content_[at_])) ++at_;
  return content_.substr(begin, at_ - begin);
}

std::string_view VtkWords::word_in_line() {
  while (at_ < content_.size() && is_space(content_[at_]) && content_[at_] != '\n') ++at_;
  const std::size_t begin = at_;
  while (at_ < content_.size() && !is_space(content_[at_])) ++at_;
  return content_.substr(begin, at_ - begin);
}

std::string_view VtkWords::peek() const {
  VtkWords copy = *this;
  return copy.word();
}

std::string_view VtkWords::line() {
  const std::size_t begin = at_;
  while (at_ < content_.size() && content_[at_] != '\n') ++at_;
  std::string_view out = content_.substr(begin, at_ - begin);
  if (at_ < content_.size()) {
    ++at_;
    ++line_;
  }
  while (!out.empty() && is_space(out.back())) out.remove_suffix(1);
  return out;
}

void VtkWords::skip_to_empty_line() {
  line();
  while (at_ < content_.size() && !line().empty()) continue;
}

Result<std::size_t> VtkWords::count(const char* what) {
  const std::string_view text = word();
  const auto value = parse_whole(text);
  if (!value || *value < 0)
    return error((text.empty() ? std::string("the file ends where ") + what : quoted_word(text) + " stands where " + what) + " should be",
                 "it is truncated or damaged; write it again");
  return static_cast<std::size_t>(*value);
}

template <class Number>
Result<std::vector<Number>> VtkWords::block(std::size_t n, std::string_view type_name) {
  const NumberType type = number_type(type_name);
  if (type.kind == Kind::kUnknown)
    return error("numbers of the type " + quoted_word(type_name) + " cannot be read", "use float, double or int");
  constexpr bool kWhole = std::is_integral_v<Number>;
  if (kWhole && type.kind == Kind::kFloat) return error("indices of the type " + quoted_word(type_name) + " cannot be read", "use int");
  const std::size_t least = binary_ ? type.bytes : 2;  // a digit and what parts it from the next number
  if (n > (content_.size() - at_ + 1) / least)
    return error("the file ends before the " + std::to_string(n) + " numbers that are announced here", "it is truncated; write it again");
  std::vector<Number> out;
  out.reserve(n);
  if (binary_) {
    line();  // the rest of the line that announces the block
    if (n * type.bytes > content_.size() - at_)
      return error("the file ends before the " + std::to_string(n) + " numbers that are announced here", "it is truncated; write it again");
    for (std::size_t i = 0; i < n; ++i, at_ += type.bytes) out.push_back(decode<Number>(content_.data() + at_, type));
    return out;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::string_view text = word();
    if (text.empty())
      return error("the file ends after " + std::to_string(i) + " of " + std::to_string(n) + " numbers", "it is truncated; write it again");
    if constexpr (kWhole) {
      const auto value = parse_whole(text);
      if (!value)
        return error(quoted_word(text) + " is not a whole number", "fewer numbers follow than are announced, or the file is damaged");
      out.push_back(static_cast<Number>(*value));
    } else {
      const auto value = parse_number(text);
      if (!value) return error(quoted_word(text) + " is not a number", "fewer numbers follow than are announced, or the file is damaged");
      out.push_back(*value);
    }
  }
  return out;
}

Result<std::vector<double>> VtkWords::numbers(std::size_t rows, std::size_t width, std::string_view type) {
  // Their product may be more than a size can be: then it is more than the file holds.
  const bool too_many = width > 0 && rows > std::numeric_limits<std::size_t>::max() / width;
  return block<double>(too_many ? std::numeric_limits<std::size_t>::max() : rows * width, type);
}
Result<std::vector<std::int64_t>> VtkWords::wholes(std::size_t n, std::string_view type) { return block<std::int64_t>(n, type); }

}  // namespace morula
