// Runs of studies in which nothing but renewal keeps meshes even.
#include <cmath>
#include <numbers>

#include "results/snapshot_file.h"
#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;

class MeshRenewalRun : public OwnParts {
 protected:
  MeshRenewalRun() : OwnParts([](Laws&) {}) {}
  /// A variable of every cell at the end.
  std::vector<double> last(const std::string& run, const std::string& name) {
    const auto path = folder_.path() / run / "results.h5";
    const auto entries = list_snapshots(path);
    EXPECT_TRUE(entries.ok() && !entries->empty());
    const auto snapshot = read_snapshot(path, entries->back().index);
    EXPECT_TRUE(snapshot.ok());
    for (std::size_t v = 0; v < snapshot->variables.size(); ++v)
      if (snapshot->variables[v].name == name) return snapshot->variables[v].values;
    ADD_FAILURE() << name;
    return {};
  }
  Snapshot at_minute(const std::string& run, int minute) {
    const auto path = folder_.path() / run / "results.h5";
    const auto entries = list_snapshots(path);
    EXPECT_TRUE(entries.ok());
    for (const auto& entry : *entries)
      if (std::abs(entry.time - 60.0 * minute) < 1e-6) return read_snapshot(path, entry.index).value();
    ADD_FAILURE() << "no snapshot at " << minute << " min";
    return {};
  }
  std::vector<Vec3d> nodes_at_minute(const std::string& run, int minute) {
    std::vector<Vec3d> nodes = at_minute(run, minute).nodes;
    EXPECT_FALSE(nodes.empty());
    return nodes;
  }
};

/// A strongly adhering pair of fluid cells that spread on each other.
std::string pair(const std::string& dcm, const std::string& more = "") {
  return R"(schema: 1
study: pair
time: {end: 6 min, output: 3 min, checkpoint: 3 min, step: 10 s}
numerics: {initial_step: 0.1 s, max_displacement: 2, tolerance: 1e-3}
contact: {range: 0.25 um, repulsion: 40 kPa/um, points: 3}
domain: {size: [120 um, 120 um, 120 um]}
cell_types:
  cell:
    body: shell
    radius: 6 um
    adhesion: {cell: 0.18 mJ/m^2}
    friction: {medium: 1e8 N s/m^3, cell_cell: 1e8 N s/m^3}
    dcm: {nodes: 162, cortex: {elastic: none, tension: 0.1 mN/m}, )" +
         dcm + R"(}
initial:
  - {type: cell, at: [[0 um, 0 um, -6 um], [0 um, 0 um, 6 um]]}
output: {report: false}
)" + more;
}

TEST_F(MeshRenewalRun, KeepsAFluidPairEvenWithTheSameBitsOnTwoThreadsAndAfterARestart) {
  const std::string text = pair("shape_stiffness: 0.01 mN/m, renew_mesh_below: 0.6");
  const RunSummary whole = run_whole(text, "whole");
  const RunSummary half = run_whole(text, "split", 1, 180.0);
  EXPECT_EQ(run_whole(text, "threads", 2, 180.0).final_state.state_hash, half.final_state.state_hash);
  EXPECT_EQ(go_on("split").final_state.state_hash, whole.final_state.state_hash);
  for (const char* run : {"threads", "whole"})
    for (const double done : last(run, "mesh_renewal/done")) EXPECT_GE(done, 1.0) << run;
  for (const double refused : last("whole", "mesh_renewal/refused")) EXPECT_EQ(refused, 0.0);
  for (const double change : last("whole", "mesh_renewal/area_change")) EXPECT_LT(change, 0.01);
}

/// Far from a fluid cell whose nodes are spread again and again there may be one with a law of the strain of its faces: the lanes of both go through one
/// loop, on one rank and not on two.
TEST_F(MeshRenewalRun, OfAFluidCellIsNothingToThoseThatShareItsLanes) {
  const auto fluid = [](const std::string& area, const std::string& elastic) {
    return R"(schema: 1
study: lanes
time: {end: 100 s, output: 50 s}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  fluid:
    body: shell
    radius: 6 um
    dcm: {nodes: 162, cortex: {elastic: none, tension: 0.2 mN/m, regions: {top: {tension: 0.3 mN/m}}}, renew_mesh_below: 0.6)" +
           area + R"(}
  elastic: {body: shell, radius: 6 um, dcm: {nodes: 162, cortex: {elastic: )" +
           elastic + R"(, young: 1 kPa}}}
marks:
  top: {types: [fluid], cone: {axis: [0, 0, 1], angle: 60 deg}, when: always}
initial:
  - {type: fluid, at: [[-30 um, 0 um, 0 um]]}
  - {type: elastic, at: [[30 um, 0 um, 0 um]]}
output: {report: false}
)";
  };
  int number = 0;
  for (const std::string& text : {fluid("", "neo_hooke"), fluid("", "springs"), fluid(", area: {global: 0.1 mN/m}", "springs")}) {
    const std::string run = "lanes" + std::to_string(++number);
    EXPECT_EQ(run_whole(text, run).final_state.cells, 2u);  // "forces are not numbers at 85 s" with the first and the last
    EXPECT_GE(last(run, "mesh_renewal/done").at(0), 2.0) << run;
  }
}

TEST_F(MeshRenewalRun, SaysWhatWouldNotSlide) {
  const auto errors = [&](const std::string& dcm) {
    const auto study = read(pair(dcm), options());
    return study.ok() ? std::string() : study.error().text();
  };
  EXPECT_EQ(errors("renew_mesh_below: 0.4"), "");
  EXPECT_EQ(errors("renew_mesh_below: never, area: {local: 1 mN/m}"), "");
  EXPECT_THAT(errors("renew_mesh_below: 0.4, area: {local: 1 mN/m}"), HasSubstr("[E584]"));
  EXPECT_THAT(errors("renew_mesh_below: 0.4, cytoskeleton: {cortex_links: {stiffness: 1 nN/um}}"), HasSubstr("links"));
  EXPECT_THAT(errors("renew_mesh_below: 0.9"), HasSubstr("[E302]"));
  EXPECT_THAT(errors("renew_mesh_below: often"), HasSubstr("[E204]"));
  EXPECT_EQ(errors("renew_mesh_below: 0.4, own_mesh: true"), "");
  EXPECT_THAT(errors("own_mesh: true"), HasSubstr("[E515]"));
  EXPECT_THAT(errors("renew_mesh_below: 0.4, own_mesh: true, self_contact: 0.8 um"), HasSubstr("[E582]")) << "it is finer at tips";
  EXPECT_EQ(errors("renew_mesh_below: 0.4, self_contact: 0.8 um"), "");
}

/// Two fluid cells in a channel whose walls come in until both are drawn out to three times their length and touch, and go back.
std::string channel(const std::string& dcm) {
  std::string walls;
  const char* const axes[] = {"0 um, -6.3 um, 0 um", "0 um, 6.3 um, 0 um", "0 um, 0 um, -6.3 um", "0 um, 0 um, 6.3 um"};
  const char* const normals[] = {"[0, 1, 0]", "[0, -1, 0]", "[0, 0, 1]", "[0, 0, -1]"};
  for (int k = 0; k < 4; ++k)
    walls += "  wall_" + std::to_string(k + 1) + ":\n    plane: {center: [" + axes[k] + "], normal: " + normals[k] +
             ", size: 120 um}\n    motion: {direction: " + normals[k] +
             ", course: [{time: 0 s, distance: 0 um}, {time: 240 s, distance: 3.8 um}, {time: 300 s, distance: 3.8 um},"
             " {time: 420 s, distance: 0 um}]}\n";
  return R"(schema: 1
study: channel
time: {end: 10 min, output: 1 min, checkpoint: 5 min, step: 5 s}
numerics: {max_displacement: 1}
domain: {size: [140 um, 140 um, 140 um], boundary: open}
cell_types:
  cell:
    body: shell
    radius: 6 um
    friction: {medium: 1e8 N s/m^3, obstacle: 0 N s/m^3}
    adhesion: {cell: 0 J/m^2, wall_1: 0 J/m^2, wall_2: 0 J/m^2, wall_3: 0 J/m^2, wall_4: 0 J/m^2}
    dcm: {nodes: 162, cortex: {elastic: none, tension: 0.4 mN/m}, shape_stiffness: 0.04 mN/m, renew_mesh_below: 0.5)" +
         dcm + R"(}
geometry:
)" + walls +
         R"(initial:
  - {type: cell, at: [[-18 um, 0 um, 0 um], [18 um, 0 um, 0 um]]}
output: {report: false}
)";
}

/// Of all shells of a snapshot: the least angle of a face [deg], the length along x of the longest [um], and the most nodes.
struct Meshes {
  double least_angle = 180.0, length = 0.0;
  std::size_t nodes = 0;
};

Meshes meshes_of(const Snapshot& snapshot) {
  Meshes out;
  for (const Snapshot::Shell& shell : snapshot.shells) {
    const auto x = std::span(snapshot.nodes).subspan(shell.first_node, shell.node_count);
    double low = 1e9, high = -1e9;
    for (const Vec3d& p : x) low = std::min(low, p.x), high = std::max(high, p.x);
    out.length = std::max(out.length, high - low);
    out.nodes = std::max<std::size_t>(out.nodes, x.size());
    for (const auto& face : snapshot.topologies[shell.topology])
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3d a = x[face[(c + 1) % 3]] - x[face[c]], b = x[face[(c + 2) % 3]] - x[face[c]];
        out.least_angle = std::min(out.least_angle, std::acos(dot(a, b) / std::sqrt(norm2(a) * norm2(b))) * 180.0 / std::numbers::pi);
      }
  }
  return out;
}

TEST_F(MeshRenewalRun, CellsInANarrowChannelGetMeshesOfTheirOwnAndGoBack) {
  run_whole(channel(", own_mesh: true"), "own");
  (void)run_whole(channel(""), "library", 1, 300.0);
  run_whole(channel(", own_mesh: true"), "split", 1, 270.0);
  go_on("split", 360.0);
  EXPECT_EQ(nodes_at_minute("split", 6), nodes_at_minute("own", 6)) << "a checkpoint has them";
  const Meshes own = meshes_of(at_minute("own", 5)), library = meshes_of(at_minute("library", 5)), back = meshes_of(at_minute("own", 10));
  EXPECT_GT(own.length, 3.0 * 12.0);
  EXPECT_GT(own.least_angle, 15.0);
  EXPECT_LT(library.least_angle, 15.0) << "or the channel asks nothing";
  EXPECT_NE(own.nodes, 162u);
  EXPECT_EQ(back.nodes, 162u);
  EXPECT_GT(back.least_angle, 30.0);
  for (const double passes : last("own", "own_mesh/passes")) EXPECT_GE(passes, 1.0);
  for (const double returns : last("own", "own_mesh/returns")) EXPECT_GE(returns, 1.0);
  for (const double change : last("own", "own_mesh/area_change")) EXPECT_LE(change, 1.01e-4) << "the energy of the tension, of a pass";
  for (const double change : last("own", "own_mesh/volume_change")) EXPECT_LE(change, 1e-12);
  for (const double off : last("own", "own_mesh/off_surface")) EXPECT_LE(off, 0.2);
  for (const double refused : last("own", "mesh_renewal/refused")) EXPECT_EQ(refused, 0.0);
}

/// A fluid cell that is sucked into a pipette of half its width, at half as much again as the tongue needs to flow in.
std::string sucked_in(const std::string& dcm) {
  return R"(schema: 1
study: sucked_in
time: {end: 40 s, step: 2 s, output: 10 s, checkpoint: 40 s}
numerics: {newton: 8, newton_stop: 0.1, initial_step: 0.05 s, max_displacement: 0.6}
domain: {size: [66 um, 40 um, 60 um], boundary: open}
cell_types:
  cell:
    body: shell
    radius: 6 um
    friction: {medium: 1e7 N s/m^3, obstacle: 0 N s/m^3}
    adhesion: {cell: 0 J/m^2, pipette: 0 J/m^2}
    dcm: {nodes: 642, cortex: {elastic: none, tension: 0.1 mN/m, damping: 1e-5 N s/m}, shape_stiffness: 0.01 mN/m, renew_mesh_below: 0.4)" +
         dcm + R"(}
contact: {range: 0.3 um, repulsion: 40 kPa/um, points: 3}
geometry:
  pipette: {pipette: {from: [11 um, 0 um, 0 um], to: [11 um, 0 um, 15 um], radius: 3 um}}
initial:
  - {type: cell, at: [[11 um, 0 um, -4.997 um]], as: shell, orientation: aligned}
loads:
  suction:
    type: cell
    pressure: {value: -1 Pa, within: {from: [11 um, 0 um, 0 um], to: [11 um, 0 um, 15 um], radius: 3.25 um}}
    course: [{time: 0 s, factor: 0}, {time: 2 s, factor: 0}, {time: 6 s, factor: 50}]
output: {report: false}
)";
}

TEST_F(MeshRenewalRun, ATongueInAPipetteStaysEvenOnAMeshOfItsOwn) {
  run_whole(sucked_in(", own_mesh: true"), "own");
  run_whole(sucked_in(""), "library");
  const auto end = [&](const std::string& run) { return meshes_of(read_snapshot(folder_.path() / run / "results.h5", 4).value()); };
  EXPECT_GT(end("own").least_angle, 20.0);
  EXPECT_LT(end("library").least_angle, 15.0);
  EXPECT_NE(end("own").nodes, 642u);
  for (const double change : last("own", "own_mesh/area_change")) EXPECT_LE(change, 1.01e-4);
  for (const double change : last("own", "own_mesh/volume_change")) EXPECT_LE(change, 1e-12);
}

}  // namespace
}  // namespace morula::scenarios::test
