#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "study/input_file.h"

namespace morula::scenarios {
namespace {

/// Length of the UTF-8 character at `at` (RFC 3629: no overlong forms, no surrogates, at most U+10FFFF), or 0.
std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u; };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0) == 0x80; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    if ((first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) > 0x9F)) return 0;
    return follows(1) && follows(2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    if ((first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) > 0x8F)) return 0;
    return follows(1) && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

std::size_t first_bad_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    if (length == 0) return at;
    at += length;
  }
  return std::string_view::npos;
}

std::string readable_size(std::uintmax_t bytes) {
  return bytes >= (1u << 20) ? std::to_string(bytes >> 20) + " MiB" : std::to_string(bytes) + " bytes";
}

}  // namespace

bool check_input_file(const std::filesystem::path& path, const std::string& shown_name, std::uintmax_t max_bytes, const Place& place,
                      Diagnostics& diagnostics) {
  namespace fs = std::filesystem;
  const auto fail = [&](int code, const std::string& what, const std::string& help) {
    diagnostics.error(code, place, what, help);
    return false;
  };
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::not_found)
    return fail(601, "file '" + shown_name + "' does not exist", "paths are relative to the folder of the study");
  if (code) return fail(602, "file '" + shown_name + "' cannot be looked at: " + code.message(), "");
  if (fs::is_directory(status)) return fail(602, "'" + shown_name + "' is a folder, not a file", "name the file in it");
  if (!fs::is_regular_file(status)) return fail(602, "'" + shown_name + "' is a pipe or device, not a regular file", "name a file");
  const std::uintmax_t size = fs::file_size(path, code);
  if (code) return fail(602, "file '" + shown_name + "' cannot be read: " + code.message(), "");
  if (size > max_bytes)
    return fail(603, "file '" + shown_name + "' is too large: " + readable_size(size) + ", at most " + readable_size(max_bytes),
                "many cells belong into a CSV file, surfaces into STL or OBJ");
  return true;
}

std::shared_ptr<const SourceText> read_text_file(const std::filesystem::path& path, const std::string& shown_name, std::uintmax_t max_bytes,
                                                 const Place& referred_from, Diagnostics& diagnostics) {
  Place at = referred_from;
  if (!at.source) at.source = std::make_shared<SourceText>(shown_name, "");
  const auto fail = [&](int code, const std::string& what, const std::string& help) {
    diagnostics.error(code, at, what, help);
    return nullptr;
  };
  if (!check_input_file(path, shown_name, max_bytes, at, diagnostics)) return nullptr;
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code) return fail(602, "file '" + shown_name + "' cannot be read: " + code.message(), "");

  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) return fail(602, "file '" + shown_name + "' cannot be opened: " + std::strerror(errno), "check its permissions");
  std::string bytes(size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  if (in.bad()) return fail(602, "file '" + shown_name + "' cannot be read to its end", "");
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  auto source = std::make_shared<const SourceText>(shown_name, std::move(bytes));
  if (const auto nul = source->bytes.find('\0'); nul != std::string::npos) {
    at = Place{std::make_shared<SourceText>(shown_name, ""), 0, 0, 1};
    return fail(604, "file '" + shown_name + "' is binary: byte " + std::to_string(nul + 1) + " is zero",
                "a text file in UTF-8 is expected");
  }
  if (const auto bad = first_bad_utf8(source->bytes); bad != std::string::npos) {
    const Place in_file = place_at(source, bad, 1);
    at = Place{std::make_shared<SourceText>(shown_name, ""), in_file.line, in_file.column, 1};  // the line itself cannot be shown
    return fail(605, "file '" + shown_name + "' is not UTF-8 text: byte " + std::to_string(bad + 1), "save the file as UTF-8");
  }
  return source;
}

}  // namespace morula::scenarios
