// Every key that holds state, one small study each: a run that is stopped halfway and resumed, by one process or by three of which some have no cell,
// ends in the bits of one that is not, and its series and events are the same to the byte.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/runs_on_ranks.h"

namespace morula::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A study in parts; what is not said is a short run of a few cells in an open domain.
struct Feature {
  std::string name;
  std::string cell;     ///< keys of the cell type `cell`
  std::string initial;  ///< list of entries
  std::string rest;     ///< further sections
  std::string end = "10 min", output = "100 s", until = "300 s";
  std::string domain = "open";
  std::string time{};   ///< further keys of `time`
  std::string whole{};  ///< the whole study, instead of the parts
};

std::string study_of(const Feature& f) {
  if (!f.whole.empty()) return f.whole;
  return "schema: 1\nstudy: resumed\nseed: 3\ntime: {end: " + f.end + ", output: " + f.output + ", checkpoint: " + f.output + f.time +
         "}\ndomain: {size: [80 um, 80 um, 80 um], boundary: " + f.domain + "}\ncell_types:\n  cell: " + f.cell +
         "\ninitial: " + f.initial + "\n" + f.rest + "output: {report: false}\n";
}

const std::string kShell = "{radius: 6 um, dcm: {nodes: 42, cortex: {tension: 0.2 mN/m}}}";
const std::string kRange = "contact: {range: 1.2 um}\n";
const std::string kPair = "[{type: cell, at: [[-6 um, 0 um, 0 um], [6 um, 0 um, 1 um]], as: shell}]";
const std::string kAligned = "[{type: cell, at: [[-6 um, 0 um, 0 um], [6 um, 0 um, 1 um]], as: shell, orientation: aligned}]";
const std::string kBall = "[{type: cell, count: 12, fill: sphere, radius: 18 um}]";

/// A cell type with keys of its own.
std::string typed(const std::string& keys) { return "{radius: 6 um, " + keys + "}"; }
std::string shelled(const std::string& keys) { return typed("dcm: {nodes: 42, cortex: {tension: 0.2 mN/m}, " + keys + "}"); }
std::string cortexed(const std::string& keys) { return typed("dcm: {nodes: 42, cortex: {tension: 0.2 mN/m, " + keys + "}}"); }

std::vector<Feature> bodies_and_walls() {
  return {
      {"WallsAndSpheres", typed("cycle: {duration: 90 min}"),
       "[{type: cell, count: 12, fill: sphere, radius: 18 um, center: [0 um, 0 um, -18 um]}]", "", "1 h", "10 min", "30 min", "wall"},
      {"WallsAndShells", kShell, "[{type: cell, at: [[-6 um, 0 um, -34 um], [6 um, 0 um, -34.2 um]], as: shell}]",
       kRange + "loads: {weight: {type: cell, body_force: [0 nN, 0 nN, -0.2 nN]}}\n", "10 min", "100 s", "300 s", "{z: wall}"},
      {"PeriodicDomain", typed("cycle: {duration: 90 min}, migration: {speed: 40 um/h}"), kBall, "", "1 h", "10 min", "30 min", "periodic"},
      {"MovingObstacles", kShell,
       "[{type: cell, at: [[-8 um, 0 um, 0 um]], as: shell}, {type: cell, at: [[8 um, 0 um, 0 um]], as: sphere}]",
       kRange +
           "geometry:\n  piston: {plane: {center: [0 um, 0 um, 6.6 um], normal: [0, 0, -1], size: 70 um}, motion: [0 um/s, 0 um/s, -1e-3 "
           "um/s]}\n"
           "  bar: {box: {center: [-19.2 um, 0 um, 0 um], size: [10 um, 20 um, 20 um]}, motion: {direction: [1, 0, 0], course: [{time: 40 "
           "s, "
           "distance: 0 um}, {time: 450 s, distance: 1 um}]}}\n"},
      {"CappedStart", kShell, "[{type: cell, at: [[-5 um, 0 um, 0 um], [5 um, 0 um, 1 um]], as: shell}]",
       kRange + "numerics: {start_cap: 0.1 um}\nlimits: {overlap: 2 um}\n", "20 s", "2 s", "4 s"},
      {"OwnMeshes", kShell, "[{type: cell, as: shell, meshes: {file: cube.stl, scale: 1 um, nodes: 162}}]", "contact: {range: 0.8 um}\n"},
      {"BiconcaveShells", cortexed("turnover: 5 min"), "[{type: cell, at: [[0 um, 0 um, 0 um]], as: shell, shape: biconcave}]", kRange},
      {"DeepOverlaps", kShell, "[{type: cell, at: [[-4.6 um, 0 um, 0 um], [4.6 um, 0 um, 1 um], [0 um, 8 um, 0 um]], as: shell}]",
       "limits: {overlap: 4 um}\n", "0.02 s", "0.005 s", "0.01 s"},
      {"ExplicitEuler", typed("cycle: {duration: 3 h}"), kBall, "", "10 s", "1 s", "5 s", "open", ", integrator: explicit_euler"},
      {"PackingOfSpheres", typed("cycle: {duration: 2 h}, cbm: {packing: {law: ideal_filled_cell}}"), kBall, "", "2 h", "20 min", "1 h"},
      {"ObjectiveFriction", kShell, kPair, "contact: {range: 1.2 um, friction: objective}\n"},
      {"SelfContact", shelled("self_contact: 200 nm"), kPair, kRange},
  };
}

std::vector<Feature> life() {
  const std::string oxygen =
      "fields: {oxygen: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, boundary: {all: 0.2 mM}, uptake: {cell: 200 amol/s}, voxel: 20 um}}\n";
  return {
      {"GrowthAndDivision", "{radius: {mean: 6 um, spread: 8 %}, cycle: {duration: {mean: 2 h, spread: 20 %}, growth: exponential}}", kBall,
       "", "3 h", "20 min", "80 min"},
      {"InflatingShells", kShell,
       "[{type: cell, at: [[-6 um, 0 um, 0 um], [6 um, 0 um, 1 um]], as: shell, start_volume: 70 %, inflate: 8 min}]", kRange},
      {"DeathByLackOfAField", typed("death: {oxygen_below: 1 mM, rate: 0.7 1/h, shrink_time: 20 min}"), kBall, oxygen, "3 h", "20 min",
       "80 min"},
      {"FieldsWithUptake", typed("cycle: {duration: 3 h}"), kBall, oxygen, "1 h", "10 min", "30 min"},
      {"TriggersByAField", shelled("bulk_modulus: 2.5 kPa"), kBall,
       kRange + oxygen + "coupling: {triggers: [{promote: \"oxygen < 0.1999 mM\", demote: \"oxygen > 0.19995 mM\", hold: 2 min}]}\n",
       "20 min", "100 s", "600 s"},
      {"TriggersByTheRangeOfTheLaws", shelled("bulk_modulus: 2.5 kPa"), kBall,
       kRange + "coupling: {triggers: [{promote: \"outside_law > 0.8\", demote: \"outside_law < 0.7\", hold: 2 min}]}\n", "20 min", "100 s",
       "600 s"},
      {"RegionsThatComeAndGo", shelled("bulk_modulus: 2.5 kPa"), "[{type: cell, count: 12, fill: sphere, radius: 22 um}]",
       kRange +
           "coupling:\n  regions:\n"
           "    - {name: early, shape: sphere, center: [0 um, 0 um, 0 um], radius: 9 um, as: dcm, margin: 3 um, until: 250 s}\n"
           "    - {name: late, shape: half_space, center: [14 um, 0 um, 0 um], normal: [-1, 0, 0], as: dcm, margin: 3 um, from: 400 s}\n",
       "30 min", "100 s", "300 s"},
      {"Osmosis", shelled("bulk_modulus: 2.5 kPa"), kPair, kRange, "10 min", "100 s", "300 s", "open", "",
       "schema: 1\nstudy: resumed\ntime: {end: 10 min, output: 100 s, checkpoint: 100 s}\ndomain: {size: [80 um, 80 um, 80 "
       "um]}\ncell_types:\n"
       "  cell:\n    radius: 6 um\n    osmosis: {permeability: 1e-12 m/s/Pa, course: [{time: 2 min, factor: 1}, {time: 7 min, factor: "
       "0.8}]}\n"
       "    dcm: {nodes: 42, cortex: {tension: 0.2 mN/m}}\ncontact: {range: 1.2 um}\ninitial:\n"
       "  - {type: cell, at: [[-7 um, 0 um, 0 um]], as: shell}\n  - {type: cell, at: [[7 um, 0 um, 0 um]], as: sphere}\noutput: {report: "
       "false}\n"},
      {"MigrationOfAShell", typed("migration: {speed: 20 um/h, persistence: 10 min}, dcm: {nodes: 42, cortex: {tension: 0.2 mN/m}}"),
       "[{type: cell, at: [[0 um, 0 um, 0 um]], as: shell}]", kRange},
      {"MigrationOfSpheres", typed("migration: {speed: 20 um/h, persistence: 10 min}"), kBall, ""},
      {"RunAndTumble", typed("migration: {speed: 20 um/h, law: run_and_tumble, run_time: 5 min}"), kBall, ""},
      {"Chemotaxis", typed("migration: {speed: 20 um/h, law: chemotaxis, field: bait, persistence: 10 min}"), kBall,
       "fields: {bait: {diffusion: 1e-9 m^2/s, initial: 0.2 mM, boundary: {x_low: 0.1 mM, x_high: 0.3 mM}}}\n"},
      {"PolarityAndProtrusion",
       typed("polarity: {turning: 5 1/h, follow_velocity: 5 min}, protrusion: {force: 0.1 nN}, dcm: {nodes: 42, cortex: {tension: 0.2 "
             "mN/m}}"),
       kPair, kRange},
      {"FluctuationsOfSpheres", typed("fluctuations: {energy: 1e-17 J}"), kBall, "numerics: {tolerance: 1e-4}\n"},
      {"FluctuationsOfShells", typed("fluctuations: {energy: 1e-17 J}, dcm: {nodes: 42, cortex: {tension: 0.2 mN/m}}"), kPair,
       kRange + "numerics: {tolerance: 1e-4}\n", "60 s", "10 s", "30 s"},
  };
}

std::vector<Feature> shells_from_inside_and_outside() {
  const std::string marks =
      "marks: {top: {types: [cell], cone: {axis: [0, 0, 1], angle: 50 deg}}, touched: {types: [cell], touched_by: {material: "
      "cell, keep: true}}}\n";
  return {
      {"RigidNucleus", shelled("nucleus: {radius: 2.5 um}"), kPair, kRange},
      {"NucleusThatIsAShell", shelled("nucleus: {kind: shell, radius: 2.5 um, nodes: 42}"), kPair, kRange},
      {"Cytoskeleton",
       shelled(
           "nucleus: {radius: 2 um}, cytoskeleton: {nucleus_links: {number: 20, stiffness: 0.01 nN/um, damping: 1e-5 N s/m}, cortex_links: "
           "{stiffness: 0.005 nN/um, tension_only: true}}"),
       kPair, kRange},
      {"Turnover", cortexed("turnover: 4 min"), kAligned, kRange + "loads: {press: {type: cell, pressure: {value: 20 Pa, part: 20 %}}}\n"},
      {"MarksAndRegionalTension",
       cortexed("lateral_easing: 60 s, regions: {top: {tension: 0.3 mN/m, course: [{time: 100 s, factor: 1}, {time: 400 s, factor: 1.3}]}, "
                "touched: {tension: 0.15 mN/m}, lateral: {tension: 0.1 mN/m}}"),
       kPair, kRange + marks},
      {"TensionThatPulsates", cortexed("regions: {whole: {tension: 0.2 mN/m, amplitude: 30 %, period: 400 s}}"), kPair, kRange},
      {"LoadsOverTime", kShell, kAligned,
       kRange + "loads:\n  beads: {type: cell, pull: {force: 100 pN, part: 10 %}, course: [{time: 50 s, factor: 0}, {time: 450 s, factor: "
                "1}]}\n"},
      {"GripsThatMove", kShell, "[{type: cell, at: [[0 um, 0 um, 0 um]], as: shell, orientation: aligned}]",
       kRange +
           "loads:\n  held: {type: cell, grip: {stiffness: 5 mN/m, center: [0 um, 0 um, 0 um], axis: [0, 0, 1], ends: low, way: [{time: 50 "
           "s, distance: 0 um}, {time: 500 s, distance: -1 um}]}}\n"},
      {"FluidsThatAdhereByTheirTension",
       cortexed("elastic: none, regions: {lateral: {tension: 0.15 mN/m, amplitude: 20 %, period: 150 s, course: [{time: 100 s, factor: 1}, "
                "{time: 400 s, factor: 0.7}]}}"),
       kPair, kRange},
      {"ApicalSprings", kShell, kPair, kRange + marks + "apical: {inside: {mark: top, stiffness: 20 Pa/um, friction: 1e8 N s/m^3}}\n"},
      {"LoadedShellsAndAPlate", "", "", "", "", "", "30 s", "", "", loaded_study()},
      {"NucleiLinksOsmosisAndFields", "", "", "", "", "", "10 min", "", "", interior_study()},
      {"SpheresThatAreMovedInAMould", "", "", "", "", "", "20 min", "", "", moulded_study()},
      {"CavityMarksSpringsAndActiveForces", "", "", "", "", "", "45 s", "", "", active_study()},
  };
}

std::vector<Feature> all_features() {
  std::vector<Feature> out;
  for (auto* part : {bodies_and_walls, life, shells_from_inside_and_outside})
    for (Feature& feature : part()) out.push_back(std::move(feature));
  return out;
}

class Resume : public testing::TestWithParam<Feature> {};

TEST_P(Resume, HalfwayEndsInTheBitsOfAWholeRun) {
  if (!kCanRemesh && GetParam().initial.find("nodes: 162") != std::string::npos)
    GTEST_SKIP() << "the program has no remesher (MORULA_WITH_GPL)";
  const TestFolder folder;
  folder.write("cube.stl", cube_stl(9.0));
  folder.write("study.yaml", study_of(GetParam()));
  const auto hash_of = [&](const std::string& run) { return json::parse(read_text(folder / run / "run.json"))["final"]["state_hash"]; };
  const Outcome whole = run_morula({"run", "study.yaml", "--out", "whole"}, folder.path());
  ASSERT_EQ(whole.exit_code, 0) << whole.all();
  const Outcome half = run_morula({"run", "study.yaml", "--out", "parts", "--until", GetParam().until}, folder.path());
  ASSERT_EQ(half.exit_code, 0) << half.all();
  ASSERT_NE(hash_of("parts"), hash_of("whole")) << "half a run is no whole one";
  fs::copy(folder / "parts", folder / "ranks", fs::copy_options::recursive);
  for (const auto& [run, ranks] : {std::pair{"parts", 0}, std::pair{"ranks", 3}}) {
    const Outcome resumed = run_morula({"resume", run}, folder.path(), on_ranks(ranks));
    ASSERT_EQ(resumed.exit_code, 0) << resumed.all();
    EXPECT_EQ(hash_of(run), hash_of("whole")) << run;
    for (const char* text : {"series.csv", "events.jsonl"})
      EXPECT_EQ(read_text(folder / run / text), read_text(folder / "whole" / text)) << run << ": " << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Resume, testing::ValuesIn(all_features()),
                         [](const testing::TestParamInfo<Feature>& one) { return one.param.name; });

}  // namespace
}  // namespace morula::test
