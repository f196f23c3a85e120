#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"

namespace morula::app {

/// A time typed on the command line, as `48h` or `90 min`, in seconds. kInput, naming `flag`, if it is none, or is not above 0.
Result<double> read_time(const std::string& flag, const std::string& text);

/// A part typed on the command line, as `3%` or `0.03`. kInput likewise.
Result<double> read_part(const std::string& flag, const std::string& text);

/// kFile where a folder that a command is about to make is there already.
Status must_be_new(const std::filesystem::path& folder);

/// Bytes: "812 MB".
[[nodiscard]] std::string bytes_words(double bytes);
/// "1 cell", "3 cells".
[[nodiscard]] std::string count_words(std::uint64_t count, const std::string& singular, const std::string& plural);
/// Columns aligned on their widest entry (in characters, not bytes), two spaces apart.
[[nodiscard]] std::string table_text(const std::vector<std::vector<std::string>>& rows);

}  // namespace morula::app
