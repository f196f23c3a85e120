// The barrier that keeps edges from folding through π (time_stepping.md §9: H).
#include "dcm/laws/dihedral_barrier.h"

#include <gtest/gtest.h>

#include "dcm/stencils/hinge.h"
#include "tests/dcm/shell_fixtures.h"

namespace morula::dcm::testing {
namespace {

constexpr double kPi = std::numbers::pi, kStiffness = 0.7, kOnset = 1.6;
constexpr DihedralBarrier<double> kBarrier{kStiffness, kOnset};

double angle_at(double z) { return kOnset + z * (kPi - kOnset); }

TEST(DihedralBarrier, IsThePublishedFunctionOfTheAngle) {  // k_d z²/(1 − z²): k/3 at z = ½, 16k/9 at z = 0.8
  EXPECT_NEAR(kBarrier.energy(angle_at(0.5)), kStiffness / 3.0, 1e-14);
  EXPECT_NEAR(kBarrier.energy(angle_at(0.8)), kStiffness * 16.0 / 9.0, 1e-13);
  EXPECT_NEAR(kBarrier.energy(-angle_at(0.5)), kStiffness / 3.0, 1e-14) << "valleys as well as ridges";
  for (const double angle : {0.0, 1.0, -1.0, kOnset, -kOnset}) {
    EXPECT_EQ(kBarrier.energy(angle), 0.0) << angle;
    EXPECT_EQ(kBarrier.slope(angle), 0.0) << angle;
    EXPECT_EQ(kBarrier.curvature_psd(angle), 0.0) << angle;
  }
}

TEST(DihedralBarrier, SlopeAndCurvatureAreDerivativesOnBothSidesOfItsOnset) {
  constexpr double h = 1e-6;
  for (double angle = -3.0; angle <= 3.0; angle += 0.0173) {
    EXPECT_NEAR((kBarrier.energy(angle + h) - kBarrier.energy(angle - h)) / (2.0 * h), kBarrier.slope(angle),
                1e-7 * (1.0 + std::abs(kBarrier.slope(angle))))
        << angle;
    if (std::abs(std::abs(angle) - kOnset) < 2.0 * h) continue;  // the curvature begins with a step
    EXPECT_NEAR((kBarrier.slope(angle + h) - kBarrier.slope(angle - h)) / (2.0 * h), kBarrier.curvature_psd(angle),
                1e-6 * (1.0 + kBarrier.curvature_psd(angle)))
        << angle;
  }
}

TEST(DihedralBarrier, GrowsWithoutBoundTowardsPi) {
  double last = 0.0;
  for (const double left : {1e-1, 1e-2, 1e-4, 1e-8}) {
    const double energy = kBarrier.energy(kPi - left), z = 1.0 - left / (kPi - kOnset);
    EXPECT_NEAR(energy / (kStiffness * z * z / ((1.0 - z) * (1.0 + z))), 1.0, 1e-6);
    EXPECT_GT(energy, 5.0 * last);
    last = energy;
  }
  EXPECT_GT(last, 1e7);
}

/// An edge of a shell is lifted to the crest of a steep ridge: the energy of the shell is at least what the angle of that edge says, and the
/// crest is drawn down.
TEST(DihedralBarrier, HoldsAFoldOfAShellOpen) {
  Shells shells = one_shell(42, 3.0);
  ShellParameters p = nothing();
  p.barrier_stiffness = kStiffness;
  p.barrier_angle = kOnset;
  EXPECT_EQ(mechanics(shells, {p}, shells.position).energy[0], 0.0) << "a sphere has no such edge";
  const Edge edge = shells.topology(0).edges()[0];
  const Vec3d middle = 0.5 * (shells.position[edge.i] + shells.position[edge.j]), out = normalized(middle);
  std::vector<Vec3d> x = shells.position;
  double last = 0.0;
  for (const double lift : {2.0, 4.0, 8.0, 16.0}) {  // the edge becomes the crest of a steep ridge
    for (const std::uint32_t i : {edge.i, edge.j}) x[i] = shells.position[i] + lift * out;
    const auto at = mechanics(shells, {p}, x);
    const Vec3d along = x[edge.j] - x[edge.i];
    const double angle = hinge_angle(cross(along, x[edge.k] - x[edge.i]), cross(x[edge.l] - x[edge.i], along), normalized(along));
    ASSERT_GT(angle, kOnset);
    EXPECT_GT(at.energy[0], kBarrier.energy(angle) * (1.0 - 1e-12)) << "at least that of this edge";
    EXPECT_GT(at.energy[0], last);
    EXPECT_LT(morula::dot(at.force[edge.i] + at.force[edge.j], out), 0.0) << "the crest is drawn down";
    last = at.energy[0];
  }
}

}  // namespace
}  // namespace morula::dcm::testing
