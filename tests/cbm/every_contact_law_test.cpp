#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "cbm/builtin.h"

namespace morula::cbm {

void PrintTo(const ContactLawEntry& law, std::ostream* out) { *out << law.info.name; }

namespace {

/// Every registered contact law, with its fallback parameters and, where it adheres, with adhesion too.
class EveryContactLaw : public testing::TestWithParam<ContactLawEntry> {
 protected:
  [[nodiscard]] std::vector<PairLaw<double>> laws() const {
    std::vector<double> values;
    for (const auto& parameter : GetParam().info.parameters) values.push_back(parameter.fallback.value_or(1.0));
    std::vector<PairLaw<double>> out;
    for (const double adhesion : {0.0, 0.001, 0.1}) {
      for (std::size_t k = 0; k < values.size(); ++k) {
        if (GetParam().info.parameters[k].name == "adhesion") values[k] = adhesion;
      }
      for (const double radius : {4.0, 6.0, 9.0}) out.push_back(make_pair_law(GetParam().build(values), 5.0, radius));
    }
    return out;
  }
  [[nodiscard]] bool near_jump(const PairLaw<double>& law, double overlap, double margin) const {
    for (const double jump : GetParam().jumps(law)) {
      if (std::abs(overlap - jump) < margin) return true;
    }
    return false;
  }
};

TEST_P(EveryContactLaw, ForceIsTheDerivativeOfItsEnergy) {
  for (const auto& law : laws()) {
    for (const bool attached : {false, true}) {
      for (double overlap = -1.5; overlap < 4.0; overlap += 0.0317) {
        const double h = 1e-4;
        if (near_jump(law, overlap, 40 * h) || std::abs(overlap) < 40 * h) continue;
        const auto energy = [&](double at) { return GetParam().respond(law, at, attached).energy; };
        // Fourth-order difference: the truncation error at the fold's edge stays below the tolerance.
        const double slope =
            (8.0 * (energy(overlap + h) - energy(overlap - h)) - (energy(overlap + 2 * h) - energy(overlap - 2 * h))) / (12 * h);
        EXPECT_NEAR(slope, GetParam().respond(law, overlap, attached).force, 1e-7 * (std::abs(slope) + 1e-2)) << overlap << attached;
      }
    }
  }
}

TEST_P(EveryContactLaw, StiffnessIsThePositivePartOfTheSlopeOfTheForce) {
  for (const auto& law : laws()) {
    for (const bool attached : {false, true}) {
      for (double overlap = -1.5; overlap < 4.0; overlap += 0.0317) {
        const double h = 1e-4;
        if (near_jump(law, overlap, 100 * h) || std::abs(overlap) < 100 * h) continue;
        const auto force = [&](double at) { return GetParam().respond(law, at, attached).force; };
        const double slope =
            (8.0 * (force(overlap + h) - force(overlap - h)) - (force(overlap + 2 * h) - force(overlap - 2 * h))) / (12 * h);
        EXPECT_NEAR(GetParam().respond(law, overlap, attached).stiffness, std::max(0.0, slope), 1e-7 * (std::abs(slope) + 1.0)) << overlap;
      }
    }
  }
}

TEST_P(EveryContactLaw, StiffnessAndAreaAreNeverNegativeNorNotANumber) {
  for (const auto& law : laws()) {
    for (double overlap = -6.0; overlap < 12.0; overlap += 0.01) {
      for (const bool attached : {false, true}) {
        const auto contact = GetParam().respond(law, overlap, attached);
        ASSERT_GE(contact.stiffness, 0.0);
        ASSERT_GE(contact.area, 0.0);
        ASSERT_TRUE(std::isfinite(contact.force) && std::isfinite(contact.stiffness) && std::isfinite(contact.energy));
      }
    }
  }
}

TEST_P(EveryContactLaw, ForceGrowsWithOverlapWherePressed) {
  for (const auto& law : laws()) {
    double last = GetParam().respond(law, 0.0, true).force;
    for (double overlap = 0.05; overlap < 5.0; overlap += 0.05) {
      const double force = GetParam().respond(law, overlap, true).force;
      EXPECT_GT(force, last);
      last = force;
    }
  }
}

TEST_P(EveryContactLaw, IsDescribedInFull) {
  const LawInfo& info = GetParam().info;
  EXPECT_FALSE(info.name.empty() || info.title.empty() || info.equation.empty());
  EXPECT_NE(info.source.find("doi:"), std::string::npos);
  std::set<std::string> names;
  for (const auto& parameter : info.parameters) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_FALSE(parameter.quantity.empty() || parameter.unit.empty() || parameter.source.empty() || parameter.doc.empty());
    EXPECT_LT(parameter.minimum, parameter.maximum);
    if (parameter.fallback) {
      EXPECT_GE(*parameter.fallback, parameter.minimum);
      EXPECT_LE(*parameter.fallback, parameter.maximum);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryContactLaw, testing::ValuesIn(contact_laws()),
                         [](const auto& test) { return test.param.info.name; });

}  // namespace
}  // namespace morula::cbm
