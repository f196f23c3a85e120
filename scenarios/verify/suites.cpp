#include "scenarios/verify/suites.h"

#include <algorithm>

#include "scenarios/verify/study_numbers.h"

namespace morula::scenarios {
namespace {

std::vector<ReferenceNumber> life_numbers() {
  std::vector<ReferenceNumber> out;
  add_cycle_study_numbers(out);
  add_arrest_study_numbers(out);
  add_division_study_numbers(out);
  return out;
}

std::vector<ReferenceNumber> hybrid_numbers() {
  std::vector<ReferenceNumber> out;
  add_interface_study_numbers(out);
  add_exchange_study_numbers(out);
  add_hybrid_tissue_numbers(out);
  return out;
}

constexpr VerifySuite kSuites[] = {
    {"physics", "reference numbers of the laws; with --studies the single-cell experiments of the library", &physics_numbers},
    {"life", "cycles, growth, arrest and divisions as runs of studies have them (a minute)", &life_numbers},
    {"hybrid", "what spheres and shells of one tissue share: pressure, exchanges of bodies, growth (five minutes)", &hybrid_numbers, true},
};

}  // namespace

std::span<const VerifySuite> verify_suites() { return kSuites; }

const VerifySuite* find_suite(std::string_view name) {
  const auto* found = std::ranges::find(kSuites, name, &VerifySuite::name);
  return found == std::end(kSuites) ? nullptr : found;
}

}  // namespace morula::scenarios
