#include "results/series_reader.h"

#include <charconv>
#include <limits>

#include "results/file_io.h"

namespace morula::scenarios {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return fields;
}

Error wrong(const std::string& origin, std::size_t line, const std::string& text, const std::string& help) {
  return {ErrorKind::kFile, origin + ":" + std::to_string(line) + ": " + text, help};
}

SeriesColumn column_of(std::string_view header) {
  SeriesColumn column;
  const std::size_t open = header.rfind('[');
  if (open != std::string_view::npos && header.back() == ']') {
    column.unit = trimmed(header.substr(open + 1, header.size() - open - 2));
    header = trimmed(header.substr(0, open));
  }
  column.name = header;
  return column;
}

bool number_of(std::string_view field, double& value) {
  if (field.empty()) return value = std::numeric_limits<double>::quiet_NaN(), true;
  if (field.front() == '+') field.remove_prefix(1);
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc() && end == field.data() + field.size();
}

Status read_header(std::string_view line, const std::string& origin, SeriesTable& table) {
  for (const std::string_view field : fields_of(line)) {
    SeriesColumn column = column_of(field);
    if (column.name.empty()) return wrong(origin, 1, "a column has no name", "the header gives each column as `name [unit]`");
    if (table.find(column.name)) return wrong(origin, 1, "two columns are called '" + column.name + "'", "give each column its own name");
    table.columns.push_back(std::move(column));
  }
  return {};
}

Status read_row(std::string_view line, std::size_t number, const std::string& origin, SeriesTable& table) {
  const auto fields = fields_of(line);
  if (fields.size() != table.columns.size())
    return wrong(origin, number,
                 "this row has " + std::to_string(fields.size()) + " fields, the header names " + std::to_string(table.columns.size()), "");
  for (std::size_t c = 0; c < fields.size(); ++c) {
    double value = 0.0;
    if (!number_of(fields[c], value))
      return wrong(origin, number, "not a number in column '" + table.columns[c].name + "': " + std::string(fields[c]),
                   "columns are parted by commas, and numbers written as 12.5, without quotes");
    table.columns[c].values.push_back(value);
  }
  return {};
}

}  // namespace

std::optional<std::vector<double>> numbers_of_row(std::string_view line) {
  std::vector<double> out;
  for (const std::string_view field : fields_of(line))
    if (!number_of(field, out.emplace_back())) return std::nullopt;
  return out;
}

const SeriesColumn* SeriesTable::find(std::string_view name) const {
  for (const SeriesColumn& column : columns)
    if (column.name == name) return &column;
  return nullptr;
}

Result<SeriesTable> parse_series(std::string_view text, const std::string& origin, LastLine last) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  SeriesTable table;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos && number > 0 && last == LastLine::kBeingWritten) break;
    const std::string_view line = trimmed(text.substr(begin, end == std::string_view::npos ? end : end - begin));
    begin = end == std::string_view::npos ? text.size() : end + 1;
    ++number;
    if (number == 1)
      MORULA_TRY(read_header(line, origin, table));
    else if (!line.empty())
      MORULA_TRY(read_row(line, number, origin, table));
  }
  if (table.columns.empty()) return wrong(origin, 1, "the file is empty", "the first line names the columns");
  return table;
}

Result<SeriesTable> read_series(const std::filesystem::path& path, LastLine last) {
  MORULA_TRY_ASSIGN(const std::string text, read_file(path));
  return parse_series(text, path.string(), last);
}

}  // namespace morula::scenarios
