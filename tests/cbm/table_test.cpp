#include "cbm/laws/table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cbm/pair_forces.h"
#include "tests/cbm/example_table.h"

namespace morula::cbm {
namespace {

TEST(PairTable, HasItsKnotsAndGrowsBetweenThem) {
  const PairTable table = example_table();
  for (const PairTableKnot& knot : table.knots()) {
    const auto at = table.respond(2.5, 2.5 * knot.overlap, true);
    EXPECT_NEAR(at.force, 2.5 * knot.force, 1e-12);
    EXPECT_NEAR(at.area, 6.25 * knot.area, 1e-12);
  }
  double force = -1.0, area = 0.0;
  for (double overlap = -0.5; overlap < 5.0; overlap += 1e-3) {
    const auto at = table.respond(2.5, overlap, true);
    EXPECT_GT(at.force, force);
    EXPECT_GE(at.area, area);
    force = at.force, area = at.area;
  }
}

// F/R*, A/R*² and U/R*² depend on δ/R* alone.
TEST(PairTable, IsScaledWithTheEffectiveRadius) {
  const PairTable table = example_table();
  for (const double ratio : {-0.15, 0.1, 0.9, 1.3}) {
    const auto small = table.respond(1.0, ratio, true), large = table.respond(4.0, 4.0 * ratio, true);
    EXPECT_NEAR(large.force, 4.0 * small.force, 1e-12);
    EXPECT_NEAR(large.stiffness, small.stiffness, 1e-12);
    EXPECT_NEAR(large.area, 16.0 * small.area, 1e-12);
    EXPECT_NEAR(large.energy, 16.0 * small.energy, 1e-12);
  }
}

TEST(PairTable, TouchesAndBreaksWhereItSays) {
  const PairTable table = example_table();
  EXPECT_FALSE(table.attached_next(2.5, -1e-9, false));
  EXPECT_TRUE(table.attached_next(2.5, 0.0, false));
  EXPECT_TRUE(table.attached_next(2.5, -0.499, true));
  EXPECT_FALSE(table.attached_next(2.5, -0.501, true));
  EXPECT_EQ(table.respond(2.5, -0.501, true).force, 0.0);
  EXPECT_EQ(table.respond(2.5, 0.5, false).force, 0.0) << "what is not attached is not pulled";
  EXPECT_NEAR(table.respond(2.5, 2.5 * table.rest_overlap(), true).force, 0.0, 1e-12);
  EXPECT_GT(table.respond(2.5, 1.5, false).force, 0.0);
}

TEST(PairTable, SaysWhatKnotsItCannotTake) {
  const auto message = [](std::vector<PairTableKnot> knots, double touch) {
    const auto table = PairTable::through(knots, touch);
    return table.ok() ? std::string() : table.error().message;
  };
  EXPECT_NE(message({{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}, 0.0).find("three knots"), std::string::npos);
  EXPECT_NE(message({{0.0, -1.0, 0.0}, {1.0, -2.0, 1.0}, {2.0, 1.0, 1.0}}, 0.0).find("knot 2"), std::string::npos);
  EXPECT_NE(message({{0.0, -1.0, 0.0}, {1.0, 1.0, 1.0}, {1.0, 2.0, 1.0}}, 0.0).find("knot 3"), std::string::npos);
  EXPECT_NE(message({{0.0, -1.0, 2.0}, {1.0, 1.0, 1.0}, {2.0, 2.0, 1.0}}, 0.0).find("area"), std::string::npos);
  EXPECT_NE(message({{0.0, -3.0, 0.0}, {1.0, -2.0, 1.0}, {2.0, -1.0, 1.0}}, 0.0).find("-3 to -1"), std::string::npos);
  EXPECT_NE(message({{0.0, -1.0, 0.0}, {1.0, 1.0, 1.0}, {2.0, 2.0, 1.0}}, -0.1).find("attached at"), std::string::npos);
}

// The table is of spheres of one kind: obstacles and others are met by JKR, and springs, which JKR does not stand in for, by Hertz.
TEST(PairTable, IsStoodInForByJkrElsewhere) {
  const PairTable all = example_table();
  const auto mine = table_law(all),
             other = table_law(PairTable::through(all.knots().first(all.knots().size() - 1), all.touch_overlap()).value());
  const std::vector<SphereParameters> types = {{1.0, 0.4, mine}, {1.0, 0.4, other}, {1.0, 0.4, jkr_law()}, {1.0, 0.4, hertz_law()}};
  const std::vector<SurfacePair> surfaces(4 * 5, SurfacePair{0.05, 0.0, 0.0});
  const ContactTable table(types, surfaces);
  EXPECT_EQ(table.entry(0, 0).contact.law, mine.get());
  EXPECT_EQ(table.entry(0, 1).contact.law, jkr_law().get());
  EXPECT_EQ(table.entry(0, 2).contact.law, jkr_law().get());
  EXPECT_EQ(table.entry(2, 0).contact.law, jkr_law().get());
  EXPECT_EQ(table.entry(0, 3).contact.law, hertz_law().get());
  EXPECT_EQ(table.entry(0, 4).contact.law, jkr_law().get());
  EXPECT_EQ(table.entry(0, 2).contact.coefficient[1], 0.05);
}

// Two types of one material, as of labelled cells in a mixture, with one file: what they are among each other they are with the others. A table has its adhesion in it.
TEST(PairTable, IsThatOfTypesWhichHaveItBothAndAdhereAlike) {
  const auto mine = table_law(example_table()), copy = table_law(example_table());
  const std::vector<SphereParameters> types = {{1.0, 0.4, mine}, {1.0, 0.4, copy}};
  std::vector<SurfacePair> surfaces(2 * 3, SurfacePair{0.05, 0.0, 0.0});
  EXPECT_EQ(ContactTable(types, surfaces).entry(0, 1).contact.law, mine.get());
  EXPECT_EQ(ContactTable(types, surfaces).entry(1, 0).contact.law, mine.get());
  surfaces[1].adhesion = surfaces[3].adhesion = 0.02;
  EXPECT_EQ(ContactTable(types, surfaces).entry(0, 1).contact.law, jkr_law().get());
  EXPECT_EQ(ContactTable(types, surfaces).entry(1, 1).contact.law, copy.get());
}

// A block whose pairs have different tables: each by its own.
TEST(PairTable, OfEachPairInABlockOfSeveralLaws) {
  const auto mine = table_law(example_table());
  const PairTable table = example_table();
  std::vector<PairTableKnot> knots(table.knots().begin(), table.knots().end());
  for (PairTableKnot& knot : knots) knot.force *= 2.0;
  const auto twice = table_law(PairTable::through(knots, 0.0).value());
  const PairContact a{mine.get(), {}}, b{twice.get(), {}};
  PairBlock block;
  for (int lane = 0; lane < PairBlock::kWidth; ++lane) block.set(lane, {9.0, 0.0, 0.0}, 5.0, 5.0, lane % 2 == 0 ? a : b, true, 0.0);
  evaluate(block, PairBlock::kWidth);
  for (int lane = 0; lane < PairBlock::kWidth; lane += 2) EXPECT_NEAR(2.0 * block.force[lane], block.force[lane + 1], 1e-12);
  EXPECT_NE(block.force[0], 0.0);
}

}  // namespace
}  // namespace morula::cbm
