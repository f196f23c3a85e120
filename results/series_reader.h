#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace morula::scenarios {

/// One column of series.csv.
struct SeriesColumn {
  std::string name;            ///< "pressure"
  std::string unit;            ///< "kPa"; "" where the header names none
  std::vector<double> values;  ///< NaN for an empty field
};

/// A table of numbers over time.
struct SeriesTable {
  std::vector<SeriesColumn> columns;  ///< all of the same length

  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : columns[0].values.size(); }
  /// The column with this name, or null.
  [[nodiscard]] const SeriesColumn* find(std::string_view name) const;
};

/// What a last line without its newline is.
enum class LastLine : std::uint8_t {
  kBeingWritten,  ///< of the table of a run: it is left out
  kWhole,         ///< of a file that somebody made
};

/// Read a CSV whose header gives each column as `name [unit]` or `name`.
///
/// Errors name file, line and column: no header, a double
/// name, a row with too few or too many fields, a field that is not a number, a pipe or device; all of them kFile.
Result<SeriesTable> read_series(const std::filesystem::path& path, LastLine last = LastLine::kBeingWritten);

/// The same from text; `origin` is the file's name in messages.
Result<SeriesTable> parse_series(std::string_view text, const std::string& origin, LastLine last = LastLine::kBeingWritten);

/// The numbers of a row, not a number where a field is empty; nothing where a field is none.
std::optional<std::vector<double>> numbers_of_row(std::string_view line);

}  // namespace morula::scenarios
