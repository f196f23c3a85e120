#include "study/csv.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numbers/decimal_number.h"

namespace morula::scenarios {
namespace {

constexpr std::size_t kMaxErrors = 50;  ///< of one file: a broken export would show the same error a million times

struct Field {
  std::string_view text;
  std::size_t byte;  ///< where it begins in the file
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

void split(const SourceText& source, std::size_t line, std::vector<Field>& fields) {
  fields.clear();
  const std::string_view text = source.line(static_cast<int>(line) + 1);
  const std::size_t begin = source.line_begin[line];
  for (std::size_t at = 0;;) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    std::string_view field = trimmed(text.substr(at, comma - at));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
    const std::size_t offset = field.empty() ? at : static_cast<std::size_t>(field.data() - text.data());
    fields.push_back({field, begin + offset});
    if (comma == text.size()) break;
    at = comma + 1;
  }
}

enum Column { kX, kY, kZ, kType, kRadius, kPhase, kModel, kColumns };
constexpr std::array<const char*, kColumns> kNames{"x", "y", "z", "type", "radius", "phase", "model"};

class CsvReader {
 public:
  CsvReader(std::shared_ptr<const SourceText> source, const std::vector<std::string>& types, const UnitSystem& units,
            Diagnostics& diagnostics, std::string unit)
      : source_(std::move(source)), types_(types), units_(units), diagnostics_(diagnostics), unit_(std::move(unit)) {
    cells_.source = source_;
    at_.fill(-1);
    factor_.fill(1.0);
  }

  std::optional<CsvCells> read() {
    std::size_t line = 0;
    while (line < source_->line_begin.size() && skipped(line)) ++line;
    if (line == source_->line_begin.size()) {
      error(613, {"", 0}, "the file holds no cells", "the first line names the columns: x [um],y [um],z [um],type");
      return std::nullopt;
    }
    read_header(line);
    if (errors_ > 0) return std::nullopt;
    for (++line; line < source_->line_begin.size() && errors_ < kMaxErrors; ++line)
      if (!skipped(line)) read_row(line);
    if (errors_ >= kMaxErrors) diagnostics_.error(612, {source_, 0, 0, 1}, "too many errors in this file: the rest is not looked at", "");
    if (errors_ == 0 && cells_.cells.empty()) error(613, {"", 0}, "the file has a header but no cells", "write one row for each cell");
    if (errors_ > 0) return std::nullopt;
    return std::move(cells_);
  }

 private:
  void error(int code, Field at, const std::string& text, const std::string& help) {
    ++errors_;
    diagnostics_.error(code, place_at(source_, at.byte, at.text.size()), text, help);
  }
  [[nodiscard]] bool skipped(std::size_t line) const {
    const std::string_view text = trimmed(source_->line(static_cast<int>(line) + 1));
    return text.empty() || text.front() == '#';
  }

  void read_header(std::size_t line) {
    split(*source_, line, fields_);
    columns_ = fields_.size();
    for (std::size_t i = 0; i < fields_.size(); ++i) read_column_name(i);
    std::string missing;
    for (const Column c : {kX, kY, kZ, kType})
      if (at_[c] < 0) missing += (missing.empty() ? "" : ", ") + std::string(kNames[c]);
    if (!missing.empty())
      error(610, {source_->line(static_cast<int>(line) + 1), source_->line_begin[line]}, "the header lacks the columns " + missing,
            "columns: x,y,z,type[,radius,phase,model], separated by commas, with units as `x [um]`");
  }

  void read_column_name(std::size_t i) {
    const Field field = fields_[i];
    const std::size_t bracket = field.text.find('[');
    const std::string name(trimmed(field.text.substr(0, bracket)));
    const auto known = std::find(kNames.begin(), kNames.end(), name);
    if (known == kNames.end()) {
      cells_.ignored_columns.emplace_back(field.text);
      return;
    }
    const auto column = static_cast<std::size_t>(known - kNames.begin());
    if (at_[column] >= 0) error(610, field, "column '" + name + "' stands twice in the header", "keep one of them");
    at_[column] = static_cast<int>(i);
    if (bracket == std::string_view::npos) return take_common_unit(column, field);
    const std::size_t close = field.text.find(']', bracket);
    if (close == std::string_view::npos || column == kType || column == kModel) {
      error(610, field, "column '" + std::string(field.text) + "' cannot be read",
            "units are written as `x [um]`; type and model have none");
      return;
    }
    const std::string unit(trimmed(field.text.substr(bracket + 1, close - bracket - 1)));
    const auto factor = units_.factor(unit, column == kPhase ? Quantity::kFraction : Quantity::kLength);
    if (factor.ok())
      factor_[column] = *factor;
    else
      error(factor.error().kind == UnitError::Kind::kWrongDimension ? 203 : 202, field, "'" + name + "' " + factor.error().message,
            "for example `x [um]`");
  }

  void take_common_unit(std::size_t column, Field field) {
    if (column == kType || column == kModel || column == kPhase) return;
    const auto factor = units_.factor(unit_, Quantity::kLength);  // that of the entry has been checked
    cells_.common_unit_used = true;
    if (factor.ok())
      factor_[column] = *factor;
    else
      error(655, field, "column '" + std::string(kNames[column]) + "' has no unit",
            "write `" + std::string(kNames[column]) + " [um]` in the header, or `units: um` beside `csv` in the study");
  }

  std::optional<double> number(Column column) {
    const Field field = fields_[static_cast<std::size_t>(at_[column])];
    const DecimalNumber parsed = read_decimal_number(field.text);
    const double value = static_cast<double>(parsed.value) * factor_[column];
    const std::string name = "'" + std::string(kNames[column]) + "'", shown = "'" + std::string(field.text) + "'";
    if (field.text.empty()) {
      error(612, field, name + " is empty", "every cell needs a number here");
    } else if (is_not_finite_word(field.text)) {
      error(612, field, name + " is not a finite number: " + shown, "leave such rows out of the file");
    } else if (parsed.length != field.text.size() || parsed.length == 0) {
      error(612, field, name + " is not a number: " + shown, "write numbers as 12.5, units in the header as `x [um]`");
    } else if (!std::isfinite(value)) {
      error(612, field, name + " is too large for a number: " + shown, "");
    } else {
      return value;
    }
    return std::nullopt;
  }

  void read_row(std::size_t line) {
    split(*source_, line, fields_);
    if (fields_.size() != columns_) {
      const std::string_view text = source_->line(static_cast<int>(line) + 1);
      error(611, {text, source_->line_begin[line]},
            "row has " + std::to_string(fields_.size()) + " values, but the header names " + std::to_string(columns_),
            "a value or a comma is missing or too many");
      return;
    }
    CsvCell cell;
    cell.line = static_cast<int>(line) + 1;
    const std::size_t errors_before = errors_;
    for (const Column c : {kX, kY, kZ})
      if (const auto x = number(c)) cell.position[c] = *x;
    read_type(cell);
    if (at_[kRadius] >= 0)
      if (const auto r = number(kRadius)) {
        cell.radius = *r;
        if (*r <= 0.0 || *r > 100.0)
          error(302, fields_[static_cast<std::size_t>(at_[kRadius])], "'radius' must be above 0 and at most 100 um", "");
      }
    if (at_[kPhase] >= 0)
      if (const auto p = number(kPhase)) {
        cell.phase = *p;
        if (*p < 0.0 || *p >= 1.0)
          error(302, fields_[static_cast<std::size_t>(at_[kPhase])], "'phase' must be at least 0 and below 1", "0 is birth, 1 is division");
      }
    if (at_[kModel] >= 0) read_model(cell);
    if (errors_ == errors_before) cells_.cells.push_back(cell);
  }

  void read_type(CsvCell& cell) {
    const Field field = fields_[static_cast<std::size_t>(at_[kType])];
    const auto found = std::find(types_.begin(), types_.end(), field.text);
    if (found == types_.end())
      error(401, field, "there is no cell type '" + std::string(field.text) + "'", suggest(field.text, types_));
    else
      cell.type = static_cast<std::uint16_t>(found - types_.begin());
  }

  void read_model(CsvCell& cell) {
    const Field field = fields_[static_cast<std::size_t>(at_[kModel])];
    if (field.text == "sphere" || field.text == "cbm")
      cell.body = BodyKind::kSphere;
    else if (field.text == "shell" || field.text == "dcm")
      cell.body = BodyKind::kShell;
    else if (!field.text.empty())
      error(108, field, "'model' cannot be '" + std::string(field.text) + "'", "allowed: sphere, shell, cbm, dcm, or nothing");
  }

  std::shared_ptr<const SourceText> source_;
  const std::vector<std::string>& types_;
  const UnitSystem& units_;
  Diagnostics& diagnostics_;
  std::string unit_;  ///< of lengths without one of their own; empty: they must have one
  CsvCells cells_;
  std::vector<Field> fields_;
  std::array<int, kColumns> at_;
  std::array<double, kColumns> factor_;
  std::size_t columns_ = 0;
  std::size_t errors_ = 0;
};

}  // namespace

std::optional<CsvCells> read_cells_csv(const std::filesystem::path& path, const std::string& shown_name,
                                       const std::vector<std::string>& type_names, const Place& referred_from, const UnitSystem& units,
                                       Diagnostics& diagnostics, const std::string& unit) {
  auto source = read_text_file(path, shown_name, kMaxCsvBytes, referred_from, diagnostics);
  if (!source) return std::nullopt;
  return CsvReader(std::move(source), type_names, units, diagnostics, unit).read();
}

}  // namespace morula::scenarios
