/// What a cell at rest says of itself, wherever it lies and however its mesh is turned.
#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

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

}  // namespace
}  // namespace morula::scenarios::test
