#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace morula::scenarios {

/// Columns of numbers that lie beside a library study: data or closed forms that its criteria and plots are held against. Read from the files
/// carried inside the program, so that what a user changes in a copy of the study changes no criterion.
class ReferenceTable {
 public:
  /// File `file` of library study `study`. Lines that begin with # are left out; a value that is no number is NaN. A table that is not there
  /// is empty: a test walks all of them.
  ReferenceTable(std::string_view study, std::string_view file);

  [[nodiscard]] std::size_t rows() const { return columns_.empty() ? 0 : columns_.front().size(); }
  /// The column of this name; empty when there is none.
  [[nodiscard]] const std::vector<double>& column(std::string_view name) const;

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<double>> columns_;
  std::vector<double> none_;
};

}  // namespace morula::scenarios
