// Reactions of fields that a program adds: in the volume, of first order and not, and by cells; each against its closed form.
#include <cmath>

#include "fields/reaction_loop.h"
#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

using fields::Reaction;
using fields::ReactionCoefficients;
using testing::HasSubstr;
using Kind = OwnKey::Kind;

KeySpec key(const char* name, const char* doc, Quantity quantity, const char* example) {
  return {.name = name, .doc = doc, .quantity = quantity, .required = true, .low = 0.0, .low_open = true, .example = example};
}

struct Washout {
  double rate;  // [1/s]
  double taken(double c) const noexcept { return rate * c; }
  double slope(double /*c*/) const noexcept { return rate; }
  double steepest(double /*highest*/) const noexcept { return rate; }
};

/// A medium that is exchanged; of first order, so that it is part of the operator.
std::shared_ptr<const Reaction> washout() {
  KeySpec rate = key("washout", "Rate at which the medium is exchanged.", Quantity::kRate, "1 1/h");
  rate.required = false, rate.low_open = false, rate.fallback = "0 1/s", rate.source = "a test";
  return fields::make_reaction<Washout>({.info = {.name = "washout",
                                                  .title = "Exchange of the medium",
                                                  .equation = "r = λ c",
                                                  .source = "a test",
                                                  .parameters = {given_by_study("washout", "rate", "1/s", "λ.")}},
                                         .section = {.name = "washout", .doc = "Exchange of the medium.", .example = "1 1/h"},
                                         .keys = {{Kind::kQuantity, rate}},
                                         .bare = true,
                                         .first_order = true,
                                         .coefficients = [](const LawValues& v) { return ReactionCoefficients{v("washout")}; },
                                         .never_acts = [](const LawValues& v) { return v("washout") == 0.0; }});
}

struct PairwiseDecay {
  double rate, at;  // [1/s], [mM]
  double taken(double c) const noexcept { return rate * c * std::fabs(c) / at; }
  double slope(double c) const noexcept { return 2.0 * rate * std::fabs(c) / at; }
  double steepest(double highest) const noexcept { return 2.0 * rate * highest / at; }
};

/// Molecules that meet are lost: r = λ c²/c₁.
std::shared_ptr<const Reaction> pairwise_decay() {
  return fields::make_reaction<PairwiseDecay>(
      {.info = {.name = "pairwise_decay",
                .title = "Decay in pairs",
                .equation = "r = λ c²/c₁",
                .source = "a test",
                .parameters = {given_by_study("rate", "rate", "1/s", "λ."), given_by_study("at", "concentration", "mM", "c₁.")}},
       .section = {.name = "pairwise_decay", .doc = "Decay in pairs.", .example = "{rate: 1 1/h, at: 0.1 mM}"},
       .keys = {{Kind::kQuantity, key("rate", "Rate of decay at this concentration.", Quantity::kRate, "1 1/h")},
                {Kind::kQuantity, key("at", "Where it is that.", Quantity::kConcentration, "0.1 mM")}},
       .coefficients =
           [](const LawValues& v) {
             return ReactionCoefficients{v("rate"), v("at")};
           },
       .judge = [](const LawValues& v) -> std::optional<LawProblem> {
         if (v("at") < 100.0) return std::nullopt;
         return LawProblem{510, "at", "nothing dissolves at {}", "less"};
       }});
}

/// V c²/(K² + c²) (Hill 1910); odd below 0, where it goes on with V c|c|/K².
struct Hill {
  double rate, half;
  double taken(double c) const noexcept { return c >= 0.0 ? rate * c * c / (half * half + c * c) : -rate * c * c / (half * half); }
  double slope(double c) const noexcept {
    const double k = half * half, sum = k + c * c;
    return c >= 0.0 ? 2.0 * rate * c * k / (sum * sum) : -2.0 * rate * c / k;
  }
  double steepest(double /*highest*/) const noexcept { return 0.65 * rate / half; }  // 3√3/8 at c = K/√3
};

std::shared_ptr<const Reaction> hill_uptake() {
  return fields::make_reaction<Hill>(
      {.info = {.name = "hill_uptake",
                .title = "Uptake of second order by Hill",
                .equation = "V c²/(K² + c²)",
                .source = "Hill 1910",
                .parameters = {given_by_study("rate", "amount rate", "amol/s", "V."), given_by_study("half", "concentration", "mM", "K.")}},
       .section = {.name = "hill_uptake", .doc = "Uptake in pairs, by cell type.", .shorthand = "rate", .example = "{ball: 40 amol/s}"},
       .keys = {{Kind::kQuantity, key("rate", "Uptake of one cell at plenty.", Quantity::kAmountRate, "40 amol/s")},
                {Kind::kQuantity,
                 {.name = "half",
                  .doc = "Concentration at which it is half of that.",
                  .quantity = Quantity::kConcentration,
                  .fallback = "0.05 mM",
                  .low = 0.0,
                  .low_open = true,
                  .example = "0.05 mM",
                  .source = "a test"}}},
       .where = Reaction::Where::kCells,
       .coefficients = [](const LawValues& v) {
         return ReactionCoefficients{v("rate"), v("half")};
       }});
}

class OwnReactions : public OwnParts {
 protected:
  OwnReactions()
      : OwnParts([](Laws& laws) {
          for (const auto& one : {washout(), pairwise_decay(), hill_uptake()}) laws.reactions.push_back(one);
        }) {}
};

/// One cell in a domain of one voxel of 8000 µm³: fields stay uniform, so that what they hold is that of an ordinary differential equation.
const std::string kStudy = R"(schema: 1
study: reactions
time: {end: 10 min, output: 2 min, checkpoint: 2 min}
domain: {size: [20 um, 20 um, 20 um]}
cell_types:
  idle: {radius: 6 um}
  ball: {radius: 6 um}
fields:
  dye: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, voxel: 20 um, tolerance: 1e-8, washout: 12 1/h}
  foam: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, voxel: 20 um, tolerance: 1e-8, pairwise_decay: {rate: 24 1/h, at: 0.1 mM}}
  food: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, voxel: 20 um, tolerance: 1e-8, hill_uptake: {ball: 4 amol/s}}
initial: [{type: ball, at: [[0 um, 0 um, 0 um]]}]
output: {report: false}
)";

TEST_F(OwnReactions, FollowTheirClosedForms) {
  run_whole(kStudy, "all");
  const auto time = column("all", "time"), dye = column("all", "mean_dye"), foam = column("all", "mean_foam"),
             food = column("all", "mean_food");
  ASSERT_EQ(time.size(), 6u);
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double t = time[i];
    EXPECT_NEAR(dye[i], 0.2 * std::exp(-12.0 / 3600.0 * t), 1e-6) << t;
    EXPECT_NEAR(foam[i], 0.2 / (1.0 + 24.0 / 3600.0 * 0.2 / 0.1 * t), 1e-6) << t;
    // c − K²/c falls at the rate V/volume: the positive root of c² − b c − K² = 0.
    const double b = 0.2 - 0.05 * 0.05 / 0.2 - 4.0 / 8000.0 * t;
    EXPECT_NEAR(food[i], 0.5 * (b + std::sqrt(b * b + 4.0 * 0.05 * 0.05)), 1e-6) << t;
  }
  for (const char* one : {"balance_dye", "balance_foam", "balance_food"}) EXPECT_LT(column("all", one).back(), 1e-12) << one;
  const std::string methods = file("all", "methods.md");
  for (const char* one : {"Exchange of the medium", "Decay in pairs", "Uptake of second order by Hill"})
    EXPECT_THAT(methods, HasSubstr(one));
  EXPECT_THAT(methods, testing::Not(HasSubstr("Decay in the whole volume"))) << "none of them has it";
}

TEST_F(OwnReactions, HaveTheSameBitsOnTwoThreadsAndAfterARestart) {
  const RunSummary whole = run_whole(kStudy, "whole");
  EXPECT_FALSE(whole.final_state.state_hash.empty());
  EXPECT_EQ(run_whole(kStudy, "threads", 2).final_state.state_hash, whole.final_state.state_hash);
  EXPECT_EQ(run_split(kStudy, "split", 360.0).final_state.state_hash, whole.final_state.state_hash);
  EXPECT_EQ(file("split", "series.csv"), file("whole", "series.csv"));
  run_whole(file("whole", "study.resolved.yaml"), "again");
  EXPECT_EQ(file("again", "series.csv"), file("whole", "series.csv")) << "the resolved study says the same";
}

TEST_F(OwnReactions, AreCheckedAndExplained) {
  const auto errors = [&](const std::string& from, const std::string& to) {
    const auto found = read(changed(from, to, kStudy), options());
    return found.ok() ? std::string() : found.error().text();
  };
  EXPECT_THAT(errors("washout: 12 1/h", "washout: 12 s"), HasSubstr("[E203]"));
  EXPECT_THAT(errors("washout: 12 1/h", "washout: -1 1/h"), HasSubstr("[E302]"));
  EXPECT_THAT(errors(", at: 0.1 mM", ""), HasSubstr("key 'at' is missing"));
  EXPECT_THAT(errors("at: 0.1 mM", "at: 200 mM"), HasSubstr("nothing dissolves at 200 mM [E510]"));
  EXPECT_THAT(errors("{ball: 4 amol/s}", "{bal: 4 amol/s}"), HasSubstr("[E401]"));
  EXPECT_THAT(errors("{ball: 4 amol/s}", "{ball: 4 mM}"), HasSubstr("[E203]"));
  EXPECT_FALSE(read(kStudy).ok()) << "the program that has them not does not know them";
  EXPECT_THAT(explain("hill_uptake.half"), HasSubstr("default:  0.05 mM"));
  EXPECT_THAT(explain("pairwise_decay.at"), HasSubstr("Where it is that."));
}

}  // namespace
}  // namespace morula::scenarios::test
