/// Where a step of a simulation may end.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

TEST(StepEnd, LiesAfterNow) {
  const Model model = test::clusters_model(0.0);
  ShapeLibrary shapes;
  auto simulation = Simulation::create(model, test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kSphere}), Comm(), 1).value();
  while (simulation->tissue().clock.time < 5.0) ASSERT_TRUE(simulation->step(5.0).ok());
  EXPECT_EQ(simulation->tissue().clock.time, 5.0);
  for (const double end : {5.0, 4.0, std::nan("")}) {
    const auto step = simulation->step(end);
    ASSERT_FALSE(step.ok());
    EXPECT_EQ(step.error().kind, ErrorKind::kInput);
    EXPECT_NE(step.error().message.find("it is 5.0"), std::string::npos) << step.error().message;
  }
  EXPECT_EQ(simulation->tissue().clock.time, 5.0);
  EXPECT_TRUE(simulation->step(6.0).ok());
}

}  // namespace
}  // namespace morula
