/// What a cell at rest says of itself, wherever it lies and however its mesh is turned.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/ball.h"
#include "results/run_record.h"
#include "results/snapshot_file.h"
#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;

class AtRest : public OwnParts {
 protected:
  AtRest() : OwnParts([](Laws&) {}) {}
};

TEST_F(AtRest, LinksToANucleusThatIsAShellHaveNoForce) {
  const std::string aligned = R"(schema: 1
study: links
time: {end: 1 s, output: 1 s}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  cell:
    body: shell
    dcm: {nucleus: {kind: shell, radius: 2.5 um}, cytoskeleton: {nucleus_links: {stiffness: 0.1 mN/m}}}
initial:
  - {type: cell, at: [[0 um, 0 um, 0 um]], orientation: aligned}
output: {report: false}
)";
  run_whole(aligned, "aligned");
  run_whole(changed(", orientation: aligned", "", aligned), "turned");
  const double energy = column("aligned", "energy").front();
  EXPECT_NEAR(column("turned", "energy").front(), energy, 1e-6 * energy);
  EXPECT_NEAR(column("turned", "energy").back(), column("aligned", "energy").back(), 1e-3 * energy);
}

TEST_F(AtRest, TissueAcrossAPeriodicFaceIsOne) {
  const auto text = [](const char* x) {
    return std::string(
               "schema: 1\nstudy: periodic\ntime: {end: 2 s, output: 1 s}\n"
               "domain: {size: [60 um, 60 um, 60 um], boundary: {x_low: periodic, x_high: periodic}}\n"
               "cell_types: {a: {radius: 5 um}}\ninitial: [{type: a, at: [[") +
           x + "]]}]\noutput: {report: false}\n";
  };
  run_whole(text("-6 um, 0 um, 3 um], [6 um, 0 um, 3 um], [0 um, 11 um, 3 um"), "middle");
  run_whole(text("24 um, 0 um, 3 um], [-24 um, 0 um, 3 um], [30 um, 11 um, 3 um"), "face");
  for (const char* name : {"spheroid_radius", "largest_extent"}) {
    EXPECT_NEAR(column("face", name).front(), column("middle", name).front(), 1e-9) << name;
    EXPECT_LT(column("face", name).back(), 14.0) << name;
  }
}

/// A pressure on all of a cell is borne by its volume alone: its shape and its tension know nothing of it, and it comes to rest as it does without.
/// −K_V ln(V/V0) = P + 2γ/R with V0 of a cell that is at rest at 6 µm (T4.3 of dcm.md).
TEST_F(AtRest, PressureOnAWholeCellIsBorneByItsVolume) {
  const std::string study = R"(schema: 1
study: pressed
time: {end: 10 h, output: 10 min, rest: 1e-5 um/s}
domain: {size: [100 um, 100 um, 100 um]}
cell_types: {cell: {body: shell, cycle: {model: none}, dcm: {cortex: {elastic: none}}}}
initial: [{type: cell, at: [[0 um, 0 um, 0 um]]}]
loads: {all: {type: cell, pressure: {value: -0.3 kPa}}}
output: {report: false}
)";
  constexpr double kModulus = 2.5, kTension = 0.1;  // the defaults [kPa], [nN/µm]
  const double reference = ball_volume(6.0) * std::exp(2.0 * kTension / 6.0 / kModulus);
  for (const double pressure : {-2.0, -0.3, 1.0, 3.0}) {
    const std::string name = std::to_string(pressure);
    EXPECT_TRUE(run_whole(changed("-0.3 kPa", name + " kPa", study), name.c_str()).final_state.at_rest) << name;
    const double volume = column(name.c_str(), "total_volume").back(), radius = std::cbrt(0.75 * volume / std::numbers::pi);
    EXPECT_NEAR(-kModulus * std::log(volume / reference), pressure + 2.0 * kTension / radius, 1e-3) << name;
    EXPECT_NEAR(column(name.c_str(), "shell_pressure").back(), pressure, 1e-6) << name;
    EXPECT_LE(column(name.c_str(), "time").back(), 3600.0) << name << ": it rests";
    EXPECT_THAT(read_file(folder_.path() / name / "log.txt").value(), HasSubstr("no point moves faster than 1e-05 um/s (`time.rest`)"));
    EXPECT_TRUE(read_run_record(folder_.path() / name / "run.json")->final_state->at_rest);
    EXPECT_LT(column(name.c_str(), "mean_way").back(), 3.0) << name << ": nodes go with the surface alone";
  }
}

/// The weight of a medium: a cell in a pressure with a gradient g drifts as by the force −g V (Archimedes), against the friction of its surface.
TEST_F(AtRest, PressureWithAGradientPushesAsBuoyancy) {
  const std::string study = R"(schema: 1
study: buoyant
time: {end: 10 min, output: 5 min}
domain: {size: [100 um, 100 um, 100 um]}
cell_types: {cell: {body: shell, cycle: {model: none}, friction: {medium: 1e8 N s/m^3}}}
initial: [{type: cell, at: [[0 um, 0 um, 0 um]]}]
loads: {weight: {type: cell, pressure: {value: 0.2 kPa, gradient: [0 Pa/um, 0 Pa/um, 0.5 Pa/um]}}}
output: {report: false}
)";
  run_whole(study, "weight");
  const auto drift = column("weight", "centre_drift");
  const double volume = column("weight", "total_volume").back(), radius = std::cbrt(0.75 * volume / std::numbers::pi);
  const double speed = 0.5e-3 * volume / (0.1 * 4.0 * std::numbers::pi * radius * radius);
  EXPECT_NEAR((drift.back() - drift[1]) / (300.0 * speed), 1.0, 0.01);
}

/// A sphere and a shell push along what they lie on with the same force, however their polarity is tilted (dcm.md §11).
TEST_F(AtRest, ProtrusionAlongASubstrateHasOneSizeForBothBodies) {
  run_whole(R"(schema: 1
study: tilted
time: {end: 150 s, output: 50 s}
domain: {size: [100 um, 100 um, 60 um]}
cell_types:
  ball:
    friction: {obstacle: 0 N s/m^3}
    adhesion: {glass: 1e-4 J/m^2}
    polarity: {start: [1, 0, 0]}
    protrusion: {force: 1 nN, substrate: glass}
  ball_tilted: {like: ball, polarity: {start: [1, 0, -1.732]}}
  shell_tilted: {like: ball_tilted, body: shell}
geometry:
  glass: {plane: {center: [0 um, 0 um, -10 um], size: 100 um}}
initial:
  - {type: ball, at: [[-20 um, -30 um, -4.1 um]]}
  - {type: ball_tilted, at: [[-20 um, -10 um, -4.1 um]]}
  - {type: shell_tilted, at: [[-20 um, 30 um, -4.1 um]]}
output: {report: false}
)",
            "tilted");
  const auto path = folder_.path() / "tilted/results.h5";
  const auto entries = list_snapshots(path);
  ASSERT_TRUE(entries.ok() && !entries->empty());
  const auto last = read_snapshot(path, entries->back().index);
  ASSERT_TRUE(last.ok());
  ASSERT_EQ(last->cells.size(), 3u);
  const auto way = [&](std::size_t cell) { return last->cells[cell].centroid.x + 20.0; };
  EXPECT_GT(way(0), 1.0);
  EXPECT_NEAR(way(1), way(0), 1e-3 * way(0));
  EXPECT_NEAR(way(2), way(0), 0.1 * way(0));
}

/// What is pushed through a periodic face is as far from its start as what is pushed in a larger domain, and a pair across it is near.
TEST_F(AtRest, WaysAndDistancesGoAcrossPeriodicFaces) {
  const auto text = [](const char* size, const char* partner) {
    return std::string(R"(schema: 1
study: across
time: {end: 200 s, output: 20 s}
domain: {size: [)") +
           size + R"(, 60 um, 60 um], boundary: periodic}
cell_types: {a: {}, b: {like: a, body: shell}, c: {like: a}}
initial:
  - {type: a, at: [[10 um, 0 um, 0 um]]}
  - {type: b, at: [[10 um, 20 um, 0 um]]}
  - {type: c, at: [[-15 um, -20 um, 0 um], [)" +
           partner + R"(, -20 um, 0 um]]}
loads:
  fa: {type: a, body_force: [10 nN, 0 nN, 0 nN]}
  fb: {type: b, body_force: [10 nN, 0 nN, 0 nN]}
criteria:
  - {id: D, measure: displacement, of: {type: [a, b]}, at: end, between: [0 um, 1 mm]}
  - {id: S, measure: slide.speed, of: {load: fb}, from: 0 s, until: 200 s, between: [0, 10]}
  - {id: F, measure: slide.speed, of: {load: fa}, from: 0 s, until: 200 s, against: 1, within: 1e-3}
  - {id: P, measure: pair.distance, of: {pair: [c, c]}, at: start, between: [0 um, 1 mm]}
output: {report: false}
)";
  };
  const auto small = run_whole(text("40 um", "15 um"), "small").verdicts, large = run_whole(text("200 um", "-5 um"), "large").verdicts;
  ASSERT_EQ(small.size(), large.size());
  int judged = 0;
  for (std::size_t i = 0; i < small.size(); ++i)
    if (small[i].id.size() == 1) {
      EXPECT_NEAR(small[i].value, large[i].value, 1e-4 * large[i].value) << small[i].quantity;
      ++judged;
    }
  EXPECT_EQ(judged, 5);
  const auto sphere = std::ranges::find(small, std::string("F"), &Verdict::id);
  ASSERT_NE(sphere, small.end());
  EXPECT_TRUE(sphere->passed) << "a sphere that nothing but the medium holds";
}

TEST_F(AtRest, ObstaclesAreSeenAcrossPeriodicFaces) {
  // A ball that moves through the face, a plate and a rod that cross it; cells that adhere to them from the other side. The same run in the middle
  // of the domain is the reference.
  const auto text = [](double shift) {
    const auto at = [shift](double x, double y, double z) {  // wrapped into the domain of 60 um
      const auto wrapped = [](double v) { return v - 60.0 * std::floor((v + 30.0) / 60.0); };
      return "[" + std::to_string(wrapped(x + shift)) + " um, " + std::to_string(wrapped(y + shift)) + " um, " + std::to_string(z) + " um]";
    };
    return R"(schema: 1
study: images
time: {end: 300 s, output: 60 s}
domain: {size: [60 um, 60 um, 60 um], boundary: {x: periodic, y: periodic, z: open}}
cell_types:
  a: {adhesion: {others: 1e-4 J/m^2}}
  b: {like: a, body: shell}
geometry:
  ball: {sphere: {center: )" +
           at(0, 0, 0) + R"(, radius: 8 um}, motion: {velocity: [60 um/h, 0 um/h, 0 um/h]}}
  plate: {box: {center: )" +
           at(0, 0, -24) + R"(, size: [20 um, 20 um, 4 um]}}
  rod: {box: {center: )" +
           at(4, 4, 24) + R"(, size: [6 um, 30 um, 6 um]}}
initial:
  - {type: a, at: [)" +
           at(13.8, 0, 0) + R"(], as: sphere}
  - {type: b, at: [)" +
           at(0, 14.1, 0) + R"(]}
  - {type: b, at: [)" +
           at(10, 0, 14) + R"(]}
  - {type: a, at: [)" +
           at(6, 6, -16.2) + R"(], as: sphere}
  - {type: b, at: [)" +
           at(-6, 6, -15.9) + R"(]}
loads: {down: {type: b, body_force: [-1 nN, 0 nN, 0 nN]}}
criteria:
  - {id: A, measure: contact_area, of: {type: a}, over_cells: mean, at: end, between: [1 um^2, 1 mm^2]}
  - {id: B, measure: contact_area, of: {type: b}, over_cells: mean, at: end, between: [1 um^2, 1 mm^2]}
  - {id: C, measure: displacement, of: {type: a}, at: end, between: [0.1 um, 1 mm]}
  - {id: D, measure: displacement, of: {type: b}, at: end, between: [0.2 um, 1 mm]}
output: {report: false}
)";
  };
  const auto across = run_whole(text(29.0), "across").verdicts, within = run_whole(text(0.0), "within").verdicts;
  ASSERT_EQ(across.size(), within.size());
  int judged = 0;
  for (std::size_t i = 0; i < across.size(); ++i)
    if (across[i].id.size() == 1) {
      EXPECT_TRUE(within[i].passed) << within[i].quantity << " " << within[i].value;
      EXPECT_NEAR(across[i].value, within[i].value, 1e-4 * within[i].value) << across[i].quantity;
      ++judged;
    }
  EXPECT_EQ(judged, 4);
}

/// Nodes that rest on the kinks of their contacts go to and fro by a nanometre whatever the step: it stays long (0.3 s a step, and 20 times the computing time, where it did not).
TEST_F(AtRest, StepsStayLongWhereNodesRestOnKinks) {
  run_whole(R"(schema: 1
study: kinks
time: {end: 2.7 h, output: 6 min}
domain: {size: [60 um, 60 um, 60 um]}
cell_types:
  cell: {radius: 3 um, body: shell, adhesion: {cell: 1e-3 J/m^2}, dcm: {cortex: {tension: 1 mN/m}}}
initial:
  - {type: cell, count: 8, fill: sphere, radius: 7 um}
output: {report: false}
)",
            "kinks");
  const std::vector<double> steps = column("kinks", "step_count");
  ASSERT_EQ(steps.size(), 28u);
  EXPECT_LE(steps.back() - steps[20], 80.0) << "42 min of steps of 60 s";
  const std::vector<double> energy = column("kinks", "energy");
  EXPECT_NEAR(energy.back(), energy[20], 1e-4 * energy.back()) << "it was at rest";
}

/// Eight cells that come to rest before the first output, in a medium that resists much: what the energy does later are the tolerances of the steps.
TEST_F(AtRest, EnergyThatHasFallenBeforeTheFirstOutputMayRestWithinTheToleranceOfTheSteps) {
  const std::vector<Verdict> verdicts = run_whole(R"(schema: 1
study: rests
time: {end: 1 h, output: 15 min}
domain: {size: [120 um, 120 um, 120 um]}
cell_types:
  cell: {radius: 6 um, body: shell, adhesion: {cell: 1e-4 J/m^2}, friction: {cell_cell: 0 N s/m^3, medium: 1e6 N s/m^3}}
initial:
  - {type: cell, count: 8, fill: sphere, radius: 15 um}
output: {report: false}
)",
                                                  "rests")
                                            .verdicts;
  const auto energy = std::ranges::find(verdicts, std::string("INV.7"), &Verdict::id);
  ASSERT_NE(energy, verdicts.end());
  EXPECT_TRUE(energy->passed) << energy->value;
}

}  // namespace
}  // namespace morula::scenarios::test
