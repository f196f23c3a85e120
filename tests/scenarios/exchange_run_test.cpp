/// The user's road to an exchange of bodies: a study with default parameters in which a sphere becomes a shell among spheres.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/mesh/topology.h"
#include "coupling/overlap.h"
#include "tests/scenarios/simulation_of.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kStudy = R"(
schema: 1
study: exchange
seed: 1
time: {end: 20 min, output: 10 min}
domain: {size: [200 um, 200 um, 200 um], boundary: open}
cell_types:
  a:
    radius: {mean: 6 um, spread: 0 %}
    cycle: {model: none}
initial:
  - {type: a, count: 13, fill: sphere, radius: 17 um}
coupling:
  hold: 1 min
  regions:
    - {name: core, shape: sphere, center: [0 um, 0 um, 0 um], radius: 8 um, as: shell, margin: 4 um, from: 10 min}
)";

TEST(ExchangeRun, MakesAShellThatFitsAmongSpheresAtDefaultParameters) {
  const auto study = test::read(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  auto made = test::simulation_of(*study);
  ASSERT_TRUE(made.ok()) << made.error().message;
  Simulation& simulation = **made;
  while (simulation.tissue().shells.size() == 0) {
    ASSERT_LT(simulation.tissue().clock.time, 700.0);
    ASSERT_TRUE(simulation.step(1200.0).ok());
  }
  const Tissue& tissue = simulation.tissue();
  const double radius = 6.0, ball = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  for (std::size_t s = 0; s < tissue.shells.size(); ++s) {
    const auto faces = tissue.shells.topology(s).faces();
    const auto nodes = tissue.shells.nodes(s);
    const Vec3d center = volume_centroid(faces, nodes);
    EXPECT_NEAR(enclosed_volume(faces, nodes, center), ball, 1e-10 * ball);
    double least = 1e300, most = 0.0;
    for (const Vec3d& x : nodes) least = std::min(least, norm(x - center)), most = std::max(most, norm(x - center));
    EXPECT_LT(least, 0.97 * radius);  // flat where its neighbours are,
    EXPECT_GT(most, 1.01 * radius);   // and round between them
  }
  EXPECT_FALSE(tissue.clock.capped);
  while (tissue.clock.time < 1200.0) ASSERT_TRUE(simulation.step(1200.0).ok());
  EXPECT_LT(deepest_overlap(simulation).value, 0.1);
}

}  // namespace
}  // namespace morula::scenarios
