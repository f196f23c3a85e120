#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "cbm/builtin.h"
#include "cbm/pair_forces.h"
#include "tests/cbm/example_table.h"

namespace morula::cbm {

using SphereLawPointer = std::shared_ptr<const SphereLaw>;

namespace {

/// Two equal spheres of a law.
struct OnePair {
  PairContact contact;
  double reduced;

  [[nodiscard]] ContactResponse<double> respond(double overlap, bool attached) const {
    return contact.law->respond(contact, reduced, overlap, attached).response;
  }
  [[nodiscard]] bool near_jump(double overlap, double margin) const {
    if (contact.law->jumps == nullptr) return false;
    for (const double jump : contact.law->jumps(contact, reduced))
      if (std::abs(overlap - jump) < margin) return true;
    return false;
  }
};

/// Every registered contact law, with the default values of its keys and several adhesions.
class EveryContactLaw : public testing::TestWithParam<SphereLawPointer> {
 protected:
  [[nodiscard]] static std::vector<OnePair> pairs() {
    const UnitSystem units;
    SphereParameters sphere{1.5, 0.4, GetParam()};
    for (const KeySpec& key : GetParam()->own) sphere.own.set(key.name, units.parse(key.fallback, key.quantity).value());
    std::vector<OnePair> out;
    for (const double adhesion : {0.0, 0.001, 0.1})
      for (const double radius : {4.0, 6.0, 9.0})
        out.push_back({{GetParam().get(), GetParam()->couple(sphere, &sphere, adhesion)}, reduced_radius(5.0, radius)});
    return out;
  }
};

TEST_P(EveryContactLaw, ForceIsTheDerivativeOfItsEnergy) {
  for (const OnePair& pair : pairs()) {
    for (const bool attached : {false, true}) {
      for (double overlap = -1.5; overlap < 4.0; overlap += 0.0317) {
        const double h = 1e-4;
        if (pair.near_jump(overlap, 40 * h) || std::abs(overlap) < 40 * h) continue;
        const auto energy = [&](double at) { return pair.respond(at, attached).energy; };
        // Fourth-order difference: the truncation error at the fold's edge stays below the tolerance.
        const double slope =
            (8.0 * (energy(overlap + h) - energy(overlap - h)) - (energy(overlap + 2 * h) - energy(overlap - 2 * h))) / (12 * h);
        EXPECT_NEAR(slope, pair.respond(overlap, attached).force, 1e-7 * (std::abs(slope) + 1e-2)) << overlap << attached;
      }
    }
  }
}

TEST_P(EveryContactLaw, StiffnessIsThePositivePartOfTheSlopeOfTheForce) {
  for (const OnePair& pair : pairs()) {
    for (const bool attached : {false, true}) {
      for (double overlap = -1.5; overlap < 4.0; overlap += 0.0317) {
        const double h = 1e-4;
        if (pair.near_jump(overlap, 100 * h) || std::abs(overlap) < 100 * h) continue;
        const auto force = [&](double at) { return pair.respond(at, attached).force; };
        const double slope =
            (8.0 * (force(overlap + h) - force(overlap - h)) - (force(overlap + 2 * h) - force(overlap - 2 * h))) / (12 * h);
        EXPECT_NEAR(pair.respond(overlap, attached).stiffness, std::max(0.0, slope), 1e-7 * (std::abs(slope) + 1.0)) << overlap;
      }
    }
  }
}

TEST_P(EveryContactLaw, StiffnessAndAreaAreNeverNegativeNorNotANumber) {
  for (const OnePair& pair : pairs()) {
    for (double overlap = -6.0; overlap < 12.0; overlap += 0.01) {
      for (const bool attached : {false, true}) {
        const auto contact = pair.respond(overlap, attached);
        ASSERT_GE(contact.stiffness, 0.0);
        ASSERT_GE(contact.area, 0.0);
        ASSERT_TRUE(std::isfinite(contact.force) && std::isfinite(contact.stiffness) && std::isfinite(contact.energy));
      }
    }
  }
}

TEST_P(EveryContactLaw, ForceGrowsWithOverlapWherePressed) {
  for (const OnePair& pair : pairs()) {
    double last = pair.respond(0.0, true).force;
    for (double overlap = 0.05; overlap < 5.0; overlap += 0.05) {
      const double force = pair.respond(overlap, true).force;
      EXPECT_GT(force, last);
      last = force;
    }
  }
}

TEST_P(EveryContactLaw, HasTheSameBitsInLanesAsAlone) {
  for (const OnePair& pair : pairs()) {
    PairBlock block;
    for (int lane = 0; lane < PairBlock::kWidth; ++lane)
      block.set(lane, {13.0 - 0.7 * lane, 0.0, 0.0}, 6.0, 5.0, pair.contact, lane % 2 == 0, 0.0);
    evaluate(block, PairBlock::kWidth);
    for (int lane = 0; lane < PairBlock::kWidth; ++lane) {
      const PairOutcome alone =
          pair.contact.law->respond(pair.contact, reduced_radius(6.0, 5.0), 11.0 - block.distance[lane], lane % 2 == 0);
      EXPECT_EQ(block.force[lane], alone.response.force);
      EXPECT_EQ(block.stiffness[lane], alone.response.stiffness);
      EXPECT_EQ(block.area[lane], alone.response.area);
      EXPECT_EQ(block.energy[lane], alone.response.energy);
      EXPECT_EQ(block.attached_next[lane], alone.attached_next);
    }
  }
}

TEST_P(EveryContactLaw, IsDescribedInFull) {
  const LawInfo& info = GetParam()->info;
  EXPECT_FALSE(info.name.empty() || info.title.empty() || info.equation.empty() || info.source.empty());
  EXPECT_FALSE(GetParam()->word.empty() || GetParam()->doc.empty());
  std::set<std::string> names;
  for (const auto& parameter : info.parameters) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_FALSE(parameter.quantity.empty() || parameter.unit.empty() || parameter.source.empty() || parameter.doc.empty());
  }
  for (const LawKey& key : info.keys) {
    EXPECT_LT(key.spec.low, key.spec.high);
    EXPECT_FALSE(key.spec.doc.empty());
    EXPECT_NE(*key.spec.source, '\0') << key.spec.name;
  }
  for (const KeySpec& key : GetParam()->own) EXPECT_NE(key.fallback, nullptr) << "other laws of the study do without " << key.name;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryContactLaw, testing::ValuesIn(sphere_laws()),
                         [](const auto& test) { return test.param->info.name; });
// A study gives the table; this one is that of shells under tension, 0.1 nN/µm, that adhere, in round numbers.
INSTANTIATE_TEST_SUITE_P(Table, EveryContactLaw, testing::Values(table_law(example_table())), [](const auto&) { return "table"; });

}  // namespace
}  // namespace morula::cbm
