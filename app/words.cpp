#include "app/words.h"

#include <algorithm>
#include <cmath>

#include "core/numbers/number_text.h"
#include "core/numbers/unit_conversion.h"
#include "study/key_range.h"

namespace morula::app {

namespace {

Result<double> read_above_zero(const std::string& flag, const std::string& text, Quantity quantity, const std::string& example) {
  const UnitSystem units;
  const auto value = units.parse(text, quantity);
  if (!value.ok()) return Error{ErrorKind::kInput, flag + " " + value.error().message, value.error().help};
  if (!(*value > 0.0))
    return Error{ErrorKind::kInput, flag + " must be above 0, but is '" + text + "'", "for example `" + flag + " " + example + "`"};
  return *value;
}

}  // namespace

Result<double> read_time(const std::string& flag, const std::string& text) {
  const double longest = scenarios::range_of({.name = "", .quantity = Quantity::kTime}).high;
  MORULA_TRY_ASSIGN(const double time, read_above_zero(flag, text, Quantity::kTime, "48h"));
  if (time <= longest) return time;
  return Error{ErrorKind::kInput, flag + " must be at most " + number_text("%.2g", longest) + " s, but is '" + text + "'",
               "for example `" + flag + " 48h`"};
}

Result<double> read_part(const std::string& flag, const std::string& text) {
  MORULA_TRY_ASSIGN(const double part, read_above_zero(flag, text, Quantity::kFraction, "3%"));
  if (part <= 1.0 || text.find('%') != std::string::npos) return part;
  return Error{ErrorKind::kInput, flag + " " + text + " is a part of more than all", "for example `" + flag + " " + text + "%`"};
}

Status must_be_new(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::exists(folder, error)) return {};
  return Error{ErrorKind::kFile, "'" + folder.string() + "' exists already, and nothing is overwritten",
               "name another folder with `--out DIR`"};
}

std::string bytes_words(double bytes) {
  constexpr const char* units[] = {"B", "kB", "MB", "GB", "TB"};
  int unit = 0;
  for (; bytes >= 1000.0 && unit < 4; ++unit) bytes /= 1000.0;
  return number_text(unit == 0 || bytes >= 100.0 ? "%.0f " : "%.1f ", bytes) + units[unit];
}

std::string count_words(std::uint64_t count, const std::string& singular, const std::string& plural) {
  return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

namespace {
/// Characters of a UTF-8 text: all bytes but those that go on with a character.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}
}  // namespace

std::string table_text(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  std::string out;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      out += row[i];
      if (i + 1 < row.size()) out.append(widths[i] - width_of(row[i]) + 2, ' ');
    }
    out += '\n';
  }
  return out;
}

}  // namespace morula::app
