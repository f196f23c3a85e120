#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <span>

#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula::test {

constexpr double kRadius = 6.0, kVolume = 904.778684233860;  // of the fixture's cells [µm, µm³]

/// Part of the volume of a cell that a nucleus of this radius [µm] takes.
inline double fraction(double nucleus) { return nucleus * nucleus * nucleus / (kRadius * kRadius * kRadius); }

/// One shell at the origin.
inline std::unique_ptr<Simulation> one_cell(const Model& model) {
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  return std::move(Simulation::create(model, std::move(tissue), Comm(), 1)).value();
}

inline void run(Simulation& simulation, double time) {
  while (simulation.tissue().clock.time < time) {
    const auto step = simulation.step(time);
    ASSERT_TRUE(step.ok()) << step.error().message;
  }
}

inline Vec3d mean(std::span<const Vec3d> nodes) {
  Vec3d out;
  for (const Vec3d& x : nodes) out += x * (1.0 / static_cast<double>(nodes.size()));
  return out;
}

}  // namespace morula::test
