// Reactions: what holds for all of the registry, and the loops over voxels and cells with laws that are not in it.
#include "fields/field_reactions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fields/builtin.h"
#include "fields/reactions/secretion.h"
#include "tests/fields/helpers.h"

namespace morula::fields::test {
namespace {

/// Keys of numbers that all have this value.
LawValues all_keys(const Reaction& reaction, double value) {
  LawValues out;
  for (const OwnKey& key : reaction.keys)
    if (key.kind == OwnKey::Kind::kQuantity) out.set(key.spec.name, value);
  return out;
}

TEST(EveryReaction, HasTheSlopeOfWhatItTakesAndABoundOfIt) {
  for (const auto& reaction : builtin_reactions()) {
    const ReactionCoefficients k = reaction->coefficients(all_keys(*reaction, 0.02));
    const double steepest = reaction->steepest(k, 0.5), d = 1e-7;
    EXPECT_GT(steepest, 0.0) << reaction->info.name;
    for (const double c : {-0.01, 0.001, 0.02, 0.3}) {
      const double slope = (reaction->taken(k, c + d) - reaction->taken(k, c - d)) / (2.0 * d);
      EXPECT_NEAR(reaction->slope(k, c), slope, 1e-6 * steepest) << reaction->info.name << " at " << c;
      if (c >= 0.0) {
        EXPECT_LE(std::fabs(reaction->slope(k, c)), steepest * (1.0 + 1e-12)) << reaction->info.name << " at " << c;
      }
      if (reaction->first_order) {
        EXPECT_NEAR(reaction->taken(k, c), steepest * c, 1e-15) << reaction->info.name;
      }
    }
  }
}

TEST(EveryReaction, DrawsBackToZeroWhatTheIntegrationBroughtBelow) {
  for (const auto& reaction : builtin_reactions())
    EXPECT_LE(reaction->taken(reaction->coefficients(all_keys(*reaction, 0.02)), -0.01), 0.0) << reaction->info.name;
}

KeySpec number(const char* name) { return {.name = name, .required = true, .example = "1"}; }

/// k c², k = 0.5/(mM s).
struct SecondOrder {
  double rate;
  double taken(double c) const noexcept { return rate * c * std::fabs(c); }
  double slope(double c) const noexcept { return 2.0 * rate * std::fabs(c); }
  double steepest(double highest) const noexcept { return 2.0 * rate * highest; }
};

struct Proportional {
  double rate;
  double taken(double c) const noexcept { return rate * c; }
  double slope(double /*c*/) const noexcept { return rate; }
  double steepest(double /*highest*/) const noexcept { return rate; }
};

/// What a cell makes, at a constant rate.
struct Source {
  double rate;
  double taken(double /*c*/) const noexcept { return -rate; }
  double slope(double /*c*/) const noexcept { return 0.0; }
  double steepest(double /*highest*/) const noexcept { return 0.0; }
};

template <class Law>
FieldReaction reaction_of(double rate, Reaction::Where where = Reaction::Where::kVolume, bool first_order = false) {
  FieldReaction out{
      make_reaction<Law>({.info = {.name = "of_a_test", .title = "Of a test", .equation = "r(c)", .source = "a test", .parameters = {}},
                          .section = {.name = "of_a_test"},
                          .keys = {{OwnKey::Kind::kQuantity, number("k")}},
                          .where = where,
                          .first_order = first_order,
                          .coefficients = [](const LawValues& values) { return ReactionCoefficients{values("k")}; }}),
      {}};
  out.values.set("k", rate);
  return out;
}

TEST(Reactions, OfSecondOrderFollowTheHyperbola) {
  // dc/dt = −k c²: c = c0/(1 + k c0 t); by both methods (a short interval is explicit, a long one implicit), and amounts are kept.
  const Space space = cube(40.0);
  FieldSpec spec = spec_of(0.0, 10.0, 2.0);
  spec.reactions = {reaction_of<SecondOrder>(0.5)};
  spec.relative_tolerance = 1e-8;
  Field field = field_of(spec, space);
  double time = 0.0, decayed = 0.0;
  for (const double interval : {0.1, 0.9, 9.0}) {
    const auto report = advance(field, spec, space, interval);
    time += interval, decayed += report.decayed;
    EXPECT_NEAR(value_at(field, 1, 2, 3), 2.0 / (1.0 + 0.5 * 2.0 * time), 1e-6) << time;
    EXPECT_LT(report.balance_error(), 1e-13);
  }
  EXPECT_NEAR(decayed, 64000.0 * (2.0 - 2.0 / 11.0), 64000.0 * 1e-6);
}

TEST(Reactions, OfSecondOrderInAStiffFieldKeepAmounts) {
  // Diffusion makes the interval implicit; the volume's slope is then part of the matrix. Between a face of 1 mM and one without flux the steady
  // profile of D c″ = k c² has the first integral D c′² = (2/3) k (c³ − m³), m = c(L): the flux through the face is D c′(0).
  Space space;
  space.box = {{0, 0, 0}, {100, 5, 5}};
  const double diffusion = 50.0, k = 0.02;
  FieldSpec spec = spec_of(diffusion, 2.5, 1.0);
  spec.boundary[0][0] = {FaceCondition::Kind::kValue, 1.0};
  spec.reactions = {reaction_of<SecondOrder>(k)};
  spec.relative_tolerance = 1e-6;
  Field field = field_of(spec, space);
  advance(field, spec, space, 1000.0);
  const auto steady = advance(field, spec, space, 100.0);
  EXPECT_EQ(steady.work.method, Method::kImplicit);
  EXPECT_GT(steady.work.linear_iterations, 0);
  EXPECT_LT(steady.balance_error(), 1e-12);
  const double last = value_at(field, 39, 0, 0);
  const double flux = diffusion * std::sqrt(2.0 / 3.0 * k / diffusion * (1.0 - last * last * last));
  EXPECT_NEAR(steady.inflow[0][0] / (100.0 * 25.0), flux, 3e-3 * flux);  // second order in 2.5 µm against √(D/kc) = 50 µm
  EXPECT_NEAR(steady.decayed / steady.inflow[0][0], 1.0, 1e-4);
}

TEST(Reactions, OfFirstOrderAreTheSameInTheOperatorAndInTheLoop) {
  const auto value = [](bool in_operator) {
    const Space box = cube(80.0);
    FieldSpec spec = spec_of(200.0, 10.0, 1.0);
    hold_all_faces(spec, 1.0);
    spec.reactions = {reaction_of<Proportional>(0.05, Reaction::Where::kVolume, in_operator)};
    spec.relative_tolerance = 1e-8;
    Field field = field_of(spec, box);
    const auto report = advance(field, spec, box, 5.0);
    EXPECT_LT(report.balance_error(), 1e-12);
    EXPECT_GT(report.decayed, 0.0);
    return std::pair(value_at(field, 3, 4, 2), report.decayed);
  };
  const auto fused = value(true), looped = value(false);
  EXPECT_LT(fused.first, 0.95);
  EXPECT_NEAR(fused.first, looped.first, 1e-6);
  EXPECT_NEAR(fused.second / looped.second, 1.0, 1e-6);
}

TEST(Reactions, OfCellsAddUpOnOneCell) {
  // One voxel of 1000 µm³: a cell takes up by Michaelis and Menten and makes 20 amol/s; at rest V c/(K + c) = 20: c = K with V = 40.
  const Space space = cube(10.0);
  FieldSpec spec = spec_of(2000.0, 10.0, 0.2);
  spec.relative_tolerance = 1e-8;
  spec.reactions = {uptake_of(40.0, 0.01), reaction_of<Source>(20.0, Reaction::Where::kCells)};
  const std::vector<CellSource> cells{{CellId::founder(1), 0, {5, 5, 5}, 3.0}};
  Field field = field_of(spec, space);
  std::vector<double> taken(1, 0.0);
  for (int i = 0; i < 4; ++i) EXPECT_LT(advance(field, spec, space, 10.0, cells, &taken).balance_error(), 1e-12);
  EXPECT_NEAR(value_at(field, 0, 0, 0), 0.01, 1e-6);
  EXPECT_NEAR(taken[0], 1000.0 * (0.2 - value_at(field, 0, 0, 0)), 1e-9);
}

TEST(Reactions, ThatMakeSubstanceSlowDownWhereThereIsMuch) {
  // One voxel of 1000 µm³ from which nothing leaves: dc/dt = S/V K/(K + c), K c + c²/2 = K S t/V. S t/V = 0.3 mM with K = 0.1 mM: c = (√7 − 1)/10.
  const Space space = cube(10.0);
  FieldSpec spec = spec_of(2000.0, 10.0, 0.0);
  spec.relative_tolerance = 1e-8;
  FieldReaction& made = spec.reactions.emplace_back(FieldReaction{secretion(), {}});
  made.values.set("rate", 30.0), made.values.set("half_inhibition", 0.1);
  const std::vector<CellSource> cells{{CellId::founder(1), 0, {5, 5, 5}, 3.0}};
  Field field = field_of(spec, space);
  std::vector<double> taken(1, 0.0);
  EXPECT_LT(advance(field, spec, space, 10.0, cells, &taken).balance_error(), 1e-12);
  EXPECT_NEAR(value_at(field, 0, 0, 0), 0.1645751, 1e-6);
  EXPECT_NEAR(taken[0], -1000.0 * value_at(field, 0, 0, 0), 1e-9) << "what the field has is what the cell has given";
}

TEST(Reactions, ThatMakeSubstanceWhereThereIsNoneTakeAFewSteps) {
  // With nothing in the field and on its faces an error relative to what is there would be none.
  const Space space = cube(80.0);
  FieldSpec spec = spec_of(100.0, 10.0, 0.0);
  hold_all_faces(spec, 0.0);
  FieldReaction& made = spec.reactions.emplace_back(FieldReaction{secretion(), {}});
  made.values.set("rate", 30.0), made.values.set("half_inhibition", 0.1);
  const std::vector<CellSource> cells{{CellId::founder(1), 0, {40, 40, 40}, 6.0}};
  Field field = field_of(spec, space);
  const auto first = advance(field, spec, space, 20.0, cells), second = advance(field, spec, space, 20.0, cells);
  EXPECT_LT(first.work.steps, 100);
  EXPECT_LT(second.work.steps, 100);
  EXPECT_GT(second.maximum, 0.0);
}

TEST(Reactions, OfOneLawMayStandTwiceOnAType) {
  FieldSpec spec = spec_of(2000.0, 10.0, 0.2);
  spec.reactions = {uptake_of(40.0, 0.01), uptake_of(10.0, 0.01), uptake_of(5.0, 0.01, 2)};
  const FieldReactions reactions(spec);
  EXPECT_EQ(reactions.types_that_act(), (std::vector<bool>{true, false, true}));
  EXPECT_DOUBLE_EQ(reactions.steepest_of_sink({0, 0, 0, 1.0}, 1.0), 5000.0);
  EXPECT_DOUBLE_EQ(reactions.steepest_of_sink({0, 0, 2, 2.0}, 1.0), 1000.0);
  const std::vector<Sink> sinks{{0, 0, 0, 1.0}, {0, 1, 2, 0.5}};
  const std::vector<double> c{0.01, 0.03};
  std::vector<double> rate(2, 0.0), taken(2, 7.0);
  EXPECT_EQ(reactions.add_rates(sinks, c, 1000.0, rate.data(), taken.data()), 0.0);
  EXPECT_DOUBLE_EQ(taken[0], 25.0);
  EXPECT_DOUBLE_EQ(taken[1], 0.5 * 5.0 * 0.75);
  EXPECT_DOUBLE_EQ(rate[0], -0.025);
}

}  // namespace
}  // namespace morula::fields::test
