/// What runs must get right with the numerics that a study has when it says nothing about them.
#include <cmath>
#include <numbers>

#include "scenarios/measures/holds.h"
#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

class DefaultNumerics : public OwnParts {
 protected:
  DefaultNumerics() : OwnParts([](Laws&) {}) {}
};

/// A couple of two patches turns a ball against the drag of the medium, 8πγR⁴/3. The area of a cap of 5 % has its middle at 0.95 R.
TEST_F(DefaultNumerics, AShellTurnsAsFastAsItsTorqueAsks) {
  for (const double force : {0.01, 0.05}) {
    const std::string name = "turn" + std::to_string(force);
    run_whole(R"(schema: 1
study: couple
time: {end: 5 min, output: 1 min}
domain: {size: [60 um, 60 um, 60 um]}
cell_types:
  c: {radius: 6 um, body: shell, adhesion: {others: 0 mN/m}, dcm: {nodes: 642, cortex: {young: 10 kPa}}, friction: {medium: 1e8 N s/m^3}}
initial: [{type: c, at: [0 um, 0 um, 0 um], orientation: aligned}]
loads:
  r: {type: c, patch: {force: [0 nN, )" +
                  std::to_string(force) + R"( nN, 0 nN], toward: [1, 0, 0], part: 5 %}}
  l: {type: c, patch: {force: [0 nN, -)" +
                  std::to_string(force) + R"( nN, 0 nN], toward: [-1, 0, 0], part: 5 %}}
output: {report: false}
)",
              name);
    const double drag = 8.0 * std::numbers::pi / 3.0 * 0.1 * std::pow(6.0, 4), torque = 2.0 * force * 0.95 * 6.0;
    EXPECT_NEAR(column(name, "rotation").back(), torque / drag * 300.0, 0.03 * torque / drag * 300.0) << force;
  }
}

/// Cells of high tension that adhere strongly come together without surfaces deep in each other.
TEST_F(DefaultNumerics, StrongAdhesionDrawsNoCellIntoAnother) {
  run_whole(R"(schema: 1
study: strong
time: {end: 20 min, output: 10 min}
domain: {size: [60 um, 60 um, 60 um]}
cell_types:
  a: {radius: 6 um, body: shell, adhesion: {a: 1.4 mJ/m^2}, dcm: {nodes: 162, cortex: {elastic: none, tension: 1 mN/m}}}
initial: [{type: a, count: 8, fill: sphere, radius: 13 um}]
output: {report: false}
)",
            "strong");
  const auto overlap = column("strong", "worst_overlap");
  EXPECT_EQ(overlap.size(), 3u);  // ended at 0.32 um after a quarter of an hour
  for (const double here : overlap) EXPECT_LT(here, 0.15);
  EXPECT_GT(column("strong", "mean_contact_area").back(), 250.0);
}

/// Two shells that hold on to each other turn together as with a strict solver and small steps, with friction of both forms.
TEST_F(DefaultNumerics, ADoubletTurnsAsAStrictSolverHasIt) {
  for (const std::string friction : {"simple", "objective"}) {
    const auto rotation = [&](const std::string& numerics, const std::string& name) {
      run_whole(R"(schema: 1
study: doublet
time: {end: 20 min, output: 10 min}
domain: {size: [100 um, 100 um, 60 um]}
cell_types:
  a: {radius: 6 um, body: shell, adhesion: {others: 5e-5 J/m^2}}
  b: {like: a}
initial:
  - {type: a, at: [-6 um, 0 um, 0 um], orientation: aligned}
  - {type: b, at: [6 um, 0 um, 0 um], orientation: aligned}
loads:
  a: {type: a, body_force: [0 nN, 0.02 nN, 0 nN], course: [{time: 5 min, factor: 0}, {time: 6 min, factor: 1}]}
  b: {type: b, body_force: [0 nN, -0.02 nN, 0 nN], course: [{time: 5 min, factor: 0}, {time: 6 min, factor: 1}]}
contact: {friction: )" +
                    friction + R"(}
numerics: {)" + numerics +
                    R"(}
output: {report: false}
)",
                friction + name);
      return column(friction + name, "rotation").back();
    };
    const double usual = rotation("", "usual"), strict = rotation("newton_stop: 0.001, newton: 30", "strict");
    EXPECT_GT(strict, 0.005) << friction;
    EXPECT_NEAR(usual, strict, 0.08 * strict) << friction;
  }
}

/// A shell that is dragged along a plate that rubs rolls: as far as with a strict solver and steps of 10 s. (It was 11 % short.)
TEST_F(DefaultNumerics, AShellRollsAsAStrictSolverHasIt) {
  const auto way = [&](const std::string& time, const std::string& numerics, const std::string& name) {
    run_whole(R"(schema: 1
study: roll
time: {end: 2 h, output: 1 h)" +
                  time + R"(}
domain: {size: [200 um, 100 um, 60 um]}
geometry: {floor: {plane: {center: [0 um, 0 um, -6.1 um], size: 190 um}}}
cell_types:
  a: {radius: 6 um, body: shell, adhesion: {others: 0 mN/m}, friction: {obstacle: 1e9 N s/m^3}, cycle: {model: none}}
initial: [{type: a, at: [-30 um, 0 um, 0 um]}]
loads: {drag: {type: a, body_force: [0.2 nN, 0 nN, -3 nN]}}
numerics: {)" + numerics +
                  R"(}
output: {report: false}
)",
              name);
    return column(name, "centre_drift").back();
  };
  const double strict = way(", step: 10 s", "newton_stop: 0.001, newton: 30", "strict");
  EXPECT_GT(strict, 15.0);
  EXPECT_NEAR(way("", "", "usual"), strict, 0.04 * strict);
}

/// What a plate bears while it moves is what it bears with small steps: pressed down, and drawn off a cell that adheres, which had told a push of ten times the pull.
TEST_F(DefaultNumerics, APlateThatMovesBearsWhatSmallStepsHave) {
  const auto force = [&](const std::string& adhesion, const std::string& course, const std::string& step, const std::string& name) {
    run_whole(R"(schema: 1
study: plates
time: {end: 30 min, output: 5 min)" +
                  step + R"(}
domain: {size: [100 um, 100 um, 60 um]}
geometry:
  floor: {plane: {center: [0 um, 0 um, -6 um], size: 90 um}}
  lid: {plane: {center: [0 um, 0 um, 6 um], normal: [0, 0, -1], size: 90 um}, motion: {direction: [0, 0, -1], course: [)" +
                  course + R"(]}}
cell_types:
  a: {radius: 6 um, body: shell, adhesion: {others: )" +
                  adhesion + R"(}, friction: {obstacle: 1e9 N s/m^3}}
initial: [{type: a, at: [0 um, 0 um, 0 um]}]
output: {report: false}
)",
              name);
    return column(name, "force_z_lid");
  };
  const std::string down = "{time: 0 s, distance: 0 um}, {time: 30 min, distance: 4.5 um}";
  const auto pressed = force("0 mN/m", down, "", "pressed"), with_small = force("0 mN/m", down, ", step: 2 s", "with_small");
  const std::string up = "{time: 0 s, distance: 0 um}, {time: 10 min, distance: 2 um}, {time: 30 min, distance: 0 um}";
  const auto drawn = force("0.1 mN/m", up, "", "drawn"), drawn_small = force("0.1 mN/m", up, ", step: 2 s", "drawn_small");
  for (std::size_t i = 2; i < pressed.size(); ++i) {
    EXPECT_GT(with_small[i], 0.1);
    EXPECT_NEAR(pressed[i], with_small[i], 0.05 * with_small[i]) << "output " << i;
    if (i == 2) continue;  // it goes back from here on
    EXPECT_LT(drawn_small[i], -1.0);
    EXPECT_NEAR(drawn[i], drawn_small[i], 0.1 * std::abs(drawn_small[i])) << "output " << i;
  }
}

/// A lid that has pressed a shell goes back by 50 nm: the shell follows, and the force falls by little. (It was lost for an hour: nodes that would have met the
/// Springs that hold marked faces near their mean sphere go with the cell, whatever a step is long.
TEST_F(DefaultNumerics, SpringsOfMarkedFacesHoldNoCellInItsPlace) {
  const auto way = [&](const std::string& springs, const std::string& step, const std::string& name) {
    run_whole(R"(schema: 1
study: apical
time: {end: 10 min, output: 2 min)" +
                  step +
                  R"(}
domain: {size: [60 um, 60 um, 60 um]}
cell_types:
  c: {radius: 6 um, body: shell}
marks: {apical: {types: [c], cone: {toward: [0 um, 0 um, 90 um], angle: 60 deg}}}
loads:
  p: {type: c, patch: {force: [0.28 nN, 0 nN, 0 nN], toward: [1, 0, 0], part: 10 %}}
initial: [{type: c, at: [0 um, 0 um, 0 um], orientation: aligned}]
output: {report: false}
)" + springs,
              name);
    return column(name, "centre_drift").back();
  };
  const std::string springs = "apical: {s: {mark: apical, stiffness: 0.05 kPa/um}}\n";
  const double usual = way(springs, "", "usual");
  EXPECT_NEAR(usual, way(springs, ", step: 2 s", "short"), 0.002 * usual);
  const double free = way("", "", "free");
  EXPECT_NEAR(usual, free, 0.02 * usual);  // the marked faces bulge, and 1 % more surface rubs
  EXPECT_NEAR(way("apical: {s: {mark: apical, stiffness: 0 kPa/um, friction: 1e10 N s/m^3}}\n", "", "dampers"), free, 0.002 * free);
}

/// Nobody looks at the step of a run over night: one that hardly moves on says so, once.
TEST_F(DefaultNumerics, ARunThatCreepsSaysSo) {
  const auto log = [&](const std::string& numerics, const std::string& name) {
    run_whole(R"(schema: 1
study: creep
time: {end: 1 s, output: 500 ms}
domain: {size: [60 um, 60 um, 60 um]}
numerics: {)" + numerics +
                  R"(}
cell_types: {a: {radius: 6 um, body: shell, dcm: {nodes: 42}}}
initial: [{type: a, at: [0 um, 0 um, 0 um]}]
loads: {p: {type: a, body_force: [2 nN, 0 nN, 0 nN]}}
output: {report: false}
)",
              name);
    return file(name, "log.txt");
  };
  const std::string creeps = log("initial_step: 1 min, max_displacement: 0.0001", "creeps");
  EXPECT_THAT(creeps, testing::HasSubstr("the last 500 steps had"));
  EXPECT_EQ(creeps.find("the last 500 steps"), creeps.rfind("the last 500 steps"));
  EXPECT_THAT(log("max_displacement: 0.0001", "short"), testing::Not(testing::HasSubstr("the last 500 steps"))) << "as short as it began";
}

/// A sphere does not turn, whatever way it goes.
TEST_F(DefaultNumerics, ASphereAloneDoesNotTurn) {
  run_whole(R"(schema: 1
study: ball
time: {end: 10 min, output: 2 min}
domain: {size: [60 um, 60 um, 60 um]}
cell_types:
  c: {radius: 6 um}
loads:
  p: {type: c, body_force: [0.2 nN, 0.1 nN, 0 nN]}
initial: [{type: c, at: [3 um, 0 um, 7 um]}]
output: {report: false}
)",
            "ball");
  EXPECT_GT(column("ball", "centre_drift").back(), 0.5);
  EXPECT_EQ(column("ball", "rotation").back(), 0.0);
}

/// lid a little later were held where they were.)
TEST_F(DefaultNumerics, AShellFollowsAPlateThatGoesBack) {
  run_whole(R"(schema: 1
study: plates
time: {end: 70 min, output: 10 min}
domain: {size: [100 um, 100 um, 60 um]}
geometry:
  floor: {plane: {center: [0 um, 0 um, -6 um], size: 90 um}}
  lid: {plane: {center: [0 um, 0 um, 6 um], normal: [0, 0, -1], size: 90 um}, motion: {direction: [0, 0, -1], course: [{time: 0 s, distance: 0 um}, {time: 20 min, distance: 2.05 um}, {time: 40 min, distance: 2.05 um}, {time: 41 min, distance: 2 um}]}}
cell_types:
  a: {radius: 6 um, body: shell, adhesion: {others: 0 mN/m}, friction: {obstacle: 1e9 N s/m^3}}
initial:
  - {type: a, at: [0 um, 0 um, 0 um]}
output: {report: false}
)",
            "plates");
  const auto lid = column("plates", "force_z_lid"), floor = column("plates", "force_z_floor");
  for (const std::size_t i : {3u, 4u, 5u, 6u, 7u}) EXPECT_NEAR(-floor[i], lid[i], 0.01 * lid[i]) << "at rest, output " << i;
  // The force rose from 0 to this over 2.05 µm, and ever faster: 50 nm are less than a tenth of it, and more than their even share.
  for (const std::size_t i : {5u, 6u, 7u}) {
    EXPECT_LT(lid[i], lid[4] * (1.0 - 0.05 / 2.05)) << i;
    EXPECT_GT(lid[i], 0.9 * lid[4]) << i;
  }
}

/// Forces that fall below what a float holds end nothing.
TEST_F(DefaultNumerics, ASphereComesToRestInATrap) {
  for (const double stiffness : {1.0, 30.0, 1000.0}) {
    const std::string name = "trap" + std::to_string(stiffness);
    run_whole(R"(schema: 1
study: trap
time: {end: 5 h, output: 1 h}
domain: {size: [100 um, 100 um, 100 um]}
cell_types: {a: {cycle: {model: none}}}
initial: [{type: a, at: [0.7 um, 0 um, 0 um], as: sphere}]
loads: {t: {type: a, trap: {stiffness: )" +
                  std::to_string(stiffness) + R"( mN/m, center: [0 um, 0 um, 0 um]}}}
output: {report: false}
)",
              name);
    EXPECT_EQ(column(name, "cell_count").size(), 6u) << stiffness;
  }
}

/// methods.md names the laws of the bodies that there are: a sphere meets a plate by its own law, and rubs in the medium.
TEST_F(DefaultNumerics, MethodsNameTheLawsThatAct) {
  run_whole(R"(schema: 1
study: laws
time: {end: 1 min, output: 1 min}
domain: {size: [100 um, 100 um, 60 um]}
geometry: {floor: {plane: {center: [0 um, 0 um, -6 um], size: 90 um}}}
cell_types: {ball: {cycle: {model: none}}, skin: {like: ball, body: shell}}
initial:
  - {type: ball, at: [-20 um, 0 um, 0 um]}
  - {type: skin, at: [20 um, 0 um, 0 um]}
output: {report: false}
)",
            "laws");
  const std::string methods = file("laws", "methods.md");
  const auto section = [&](const std::string& title) {
    const std::size_t at = methods.find("## " + title + "\n");
    return at == std::string::npos ? std::string() : methods.substr(at, methods.find("\n## ", at) - at);
  };
  EXPECT_NE(section("spheres of ball").find("`medium_friction`"), std::string::npos);
  EXPECT_EQ(section("shell of ball") + section("spheres of skin"), "");
  EXPECT_NE(section("contact of ball with floor"), "");
  EXPECT_EQ(section("contact of ball with floor").find("`traction`"), std::string::npos);
  EXPECT_NE(section("contact of skin with floor").find("`traction`"), std::string::npos);
}

/// A course has its first value before its first point: that is a hold, too.
TEST(Holds, BeginBeforeTheFirstPointOfACourse) {
  const std::vector<double> times{0.0, 30.0, 60.0, 90.0, 120.0, 150.0};
  const auto values = [&](const TimeCourse& course) {
    std::vector<std::pair<double, std::size_t>> out;
    for (const Hold& hold : holds_of(course, times)) out.emplace_back(hold.value, hold.output);
    return out;
  };
  using Found = std::vector<std::pair<double, std::size_t>>;
  EXPECT_EQ(values({{60.0, 90.0, 120.0}, {0.5, 1.0, 1.0}}), (Found{{0.5, 2}, {1.0, 5}}));
  EXPECT_EQ(values({{60.0, 90.0, 120.0}, {0.5, 0.5, 1.0}}), (Found{{0.5, 3}, {1.0, 5}}));
  EXPECT_EQ(values({{0.0, 90.0}, {0.5, 1.0}}), (Found{{1.0, 5}}));
}

}  // namespace
}  // namespace morula::scenarios::test
