// Runs of studies in which nothing but renewal keeps meshes even.
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
};

/// A strongly adhering pair of fluid cells that spread on each other.
std::string pair(const std::string& dcm, const std::string& more = "") {
  return R"(schema: 1
study: pair
time: {end: 10 min, output: 5 min, checkpoint: 5 min, step: 10 s}
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
  EXPECT_EQ(run_whole(text, "threads", 2).final_state.state_hash, whole.final_state.state_hash);
  EXPECT_EQ(run_split(text, "split", 200.0).final_state.state_hash, whole.final_state.state_hash);
  for (const double done : last("whole", "mesh_renewal/done")) EXPECT_GE(done, 1.0);
  for (const double refused : last("whole", "mesh_renewal/refused")) EXPECT_EQ(refused, 0.0);
  for (const double change : last("whole", "mesh_renewal/area_change")) EXPECT_LT(change, 0.01);
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
}

}  // namespace
}  // namespace morula::scenarios::test
