#include "scenarios/library/reference_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numbers/decimal_number.h"
#include "scenarios/library/library.h"

namespace morula::scenarios {
namespace {

/// The fields of a line; commas within quotes belong to the field.
std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      out.emplace_back();
    else if (c != '\r')
      out.back() += c;
  }
  return out;
}

double number(const std::string& field) {
  const DecimalNumber read = read_decimal_number(field);
  return read.length > 0 && read.length == field.size() ? static_cast<double>(read.value) : std::nan("");
}

}  // namespace

ReferenceTable::ReferenceTable(std::string_view study, std::string_view file) {
  const Template* found = find_template(study);
  if (found == nullptr) return;
  std::string_view text;
  for (const TemplateFile& one : found->files)
    if (one.path == file) text = one.content;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    if (line.empty() || line[0] == '#') continue;
    const auto fields = fields_of(line);
    if (names_.empty()) {
      names_ = fields;
      columns_.resize(names_.size());
      continue;
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) columns_[i].push_back(i < fields.size() ? number(fields[i]) : std::nan(""));
  }
}

const std::vector<double>& ReferenceTable::column(std::string_view name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? none_ : columns_[static_cast<std::size_t>(found - names_.begin())];
}

}  // namespace morula::scenarios
