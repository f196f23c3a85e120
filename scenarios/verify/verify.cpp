#include "scenarios/verify/verify.h"

#include <algorithm>
#include <cmath>

#include "core/numbers/number_text.h"
#include "results/file_io.h"
#include "scenarios/library/library.h"
#include "scenarios/run/driver.h"

namespace morula::scenarios {
namespace fs = std::filesystem;
namespace {

constexpr const char* kStudies[] = {"cell_shear", "doublet",   "micropipette", "optical_stretcher", "optical_tweezers", "parallel_plates",
                                    "pull_off",   "spreading", "torture"};

/// Two digits of a tolerance, rounded up: what is printed is what a row is judged by.
std::string told_tolerance(double tolerance) {
  std::string text = number_text("%.1e", tolerance);
  if (std::stod(text) < tolerance) text = number_text("%.1e", tolerance + 0.05 * std::pow(10.0, std::floor(std::log10(tolerance))));
  return number_text("%.2g", std::stod(text));
}

/// A number that is not found yet.
VerifiedRow row_of(const ReferenceNumber& number) {
  std::string quantity = number.quantity;
  if (number.aim > 0.0) quantity += "; aim " + number_text("%g", number.aim) + ", not met yet";
  return {number.id, std::move(quantity), number.reference, std::nan(""), told_tolerance(number.tolerance), false, number.source};
}

}  // namespace

std::vector<VerifiedRow> rows_of(const VerifySuite& suite) {
  std::vector<VerifiedRow> out;
  for (const ReferenceNumber& number : suite.numbers()) out.push_back(row_of(number));
  return out;
}

std::vector<VerifiedRow> verify(const VerifySuite& suite, const std::vector<std::string>& only) {
  std::vector<VerifiedRow> out;
  for (const ReferenceNumber& number : suite.numbers()) {
    if (!only.empty() && std::ranges::find(only, number.id) == only.end()) continue;
    VerifiedRow& row = out.emplace_back(row_of(number));
    row.value = number.compute();
    row.passed = std::abs(row.value - number.reference) <= std::stod(row.tolerance);
  }
  return out;
}

Result<std::vector<VerifiedRow>> verify_single_cell_studies(const fs::path& folder, const std::function<void(const std::string&)>& tell) {
  std::vector<VerifiedRow> out;
  for (const char* name : kStudies) {
    tell(name);
    MORULA_TRY(write_files(find_template(name)->files, folder / name));
    ReadOptions options;
    options.overrides = {"output.report=false"};
    const auto study = read_study(folder / name / "study.yaml", options);
    if (!study.ok()) return study.error().as_error();
    RunRequest request;
    request.runs = folder / name / "runs";
    request.command = std::string("morula verify physics: ") + name;
    MORULA_TRY_ASSIGN(const RunSummary run, scenarios::run(*study, request, Comm()));
    for (const Verdict& v : run.verdicts)
      out.push_back({v.id, v.quantity, std::nullopt, v.value, v.limit, v.passed, std::string("study ") + name});
  }
  return out;
}

}  // namespace morula::scenarios
