#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random/philox.h"
#include "coupling/tissue.h"

namespace morula::test {

/// `force`, of the owned points and then of the nodes of nuclei that are shells, or of the first of them, is −∂E/∂x of `energy`, a function of a tissue: along random directions, by central differences, to `tolerance` of
/// the length of all forces.
template <class Energy>
void expect_minus_gradient(const Tissue& tissue, const std::vector<Vec3d>& force, int directions, double tolerance, Energy&& energy) {
  double square = 0.0;
  for (const Vec3d& f : force) square += norm2(f);
  const Random random(11, RandomStream::kInitialPosition);
  std::uint64_t draw = 0;
  for (int direction = 0; direction < directions; ++direction) {
    std::vector<Vec3d> along(force.size());
    double predicted = 0.0;
    for (std::size_t i = 0; i < along.size(); ++i) {
      along[i] = random.direction(CellId(2), draw++);
      predicted -= dot(along[i], force[i]);
    }
    const double h = 1e-5;
    const auto energy_at = [&](double s) {
      Tissue moved = tissue;
      for (std::size_t i = 0; i < along.size(); ++i) {
        const std::size_t shells = moved.shells.position.size(), bodies = shells + moved.spheres.size();
        Vec3d& p = i < shells   ? moved.shells.position[i]
                   : i < bodies ? moved.spheres.position[i - shells]
                                : moved.nuclei.shells.position[i - bodies];
        p += along[i] * s;
      }
      return energy(moved);
    };
    EXPECT_NEAR((energy_at(h) - energy_at(-h)) / (2.0 * h), predicted, tolerance * std::sqrt(square)) << "direction " << direction;
  }
}

}  // namespace morula::test
