#include "dcm/shell_law.h"

#include <algorithm>

#include "dcm/derived_parameters.h"

namespace morula::dcm {

double LawStrength::of(const ShellParameters& p) const {
  if (member_ != nullptr) return p.*member_;
  double sum = 0.0;
  for (const Sheet& sheet : p.sheets)
    if (sheet.law == sheet_) sum += sheet.coefficient[0];
  return sum;
}

double& LawStrength::in(ShellParameters& p) const {
  if (member_ != nullptr) return p.*member_;
  for (Sheet& sheet : p.sheets)
    if (sheet.law == sheet_) return sheet.coefficient[0];
  p.sheets.push_back({sheet_, {0.0, 1.0, 1.0, 1.0}});
  return p.sheets.back().coefficient[0];
}

std::vector<std::vector<double>> coefficients_of(const ShellLaw& law, const ShellParameters& shell) {
  std::vector<std::vector<double>> out;
  if (!law.sheet) {
    if (law.strength().of(shell) == 0.0) return out;
    out.emplace_back();
    for (const auto member : law.coefficients) out.back().push_back(shell.*member);
    return out;
  }
  for (const Sheet& sheet : shell.sheets)
    if (sheet.law == law.sheet && sheet.coefficient[0] != 0.0)
      out.emplace_back(sheet.coefficient.begin(), sheet.coefficient.begin() + static_cast<std::ptrdiff_t>(law.sheet->coefficient_count));
  return out;
}

void add_sheet(ShellParameters& shell, const std::shared_ptr<const SheetLaw>& law, const SheetCoefficients& coefficients) {
  for (Sheet& sheet : shell.sheets)
    if (sheet.law == law && std::equal(coefficients.begin() + 1, coefficients.end(), sheet.coefficient.begin() + 1)) {
      sheet.coefficient[0] += coefficients[0];
      return;
    }
  shell.sheets.push_back({law, coefficients});
}

SheetModuli SheetModuli::of(const LawValues& v) {
  return {v.has("shear_modulus") ? v("shear_modulus") : sheet_shear_modulus(v("young"), v("thickness"), v("poisson")),
          v.has("area_ratio") ? v("area_ratio") : sheet_area_ratio(v("poisson"))};
}

double sheet_stiffness(const LawValues& v, double, double) {
  const double sheet = v.has("shear_modulus") ? 3.0 * v("shear_modulus") : v("young") * v("thickness");
  return 7.2 * sheet * (v.has("area_ratio") ? std::max(1.0, v("area_ratio")) : 1.0);
}

}  // namespace morula::dcm
