#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "core/result.h"
#include "core/vec3.h"
#include "scenarios/calibrate/pressed_cluster.h"
#include "scenarios/calibrate/relaxation.h"
#include "scenarios/experiments/experiment.h"

namespace morula::scenarios {

/// A pair at one moment.
struct FoundPair {
  double time = 0.0;     ///< [s]
  double overlap = 0.0;  ///< δ = R_a + R_b − d, d between the centres of volume [µm]
  double force = 0.0;    ///< that the traps bear, > 0 pushes the cells apart [nN]
  double area = 0.0;     ///< of contact [µm²]
  bool touching = false;
};

/// A packing at one moment.
struct FoundPacking {
  double volume_ratio = 1.0;     ///< V/V0: room of a cell over the volume of a free one
  double pressure = 0.0;         ///< of the box, p = −tr σ/3 [kPa]
  double contact_area = 0.0;     ///< of a cell, the mean [µm²]
  std::vector<Vec3d> centers{};  ///< of volume of its cells, of a random packing [µm]
  double edge = 0.0;             ///< of its box [µm]
};

/// Cells that have come together by themselves.
struct FoundCluster {
  double radius = 0.0;  ///< of the free cells [µm]
  bool held_out = false;
  std::vector<Vec3d> centers;  ///< of volume, at the end [µm]
  double still = 0.0;          ///< way of the one that moved most between the last two outputs [µm]

  /// Mean distance of these centres [µm] over the pairs of cells that overlap at the end as balls.
  [[nodiscard]] double distance(std::span<const Vec3d> of) const;
};

/// Errors (kFile): files of the run that are missing or damaged.
Result<FoundCluster> cluster_of_run(const Experiment& experiment, const std::filesystem::path& run);
/// Two cells that come together by themselves, over time: δ between centres of volume.
Result<calibrate::Relaxation> relaxation_of_run(const Experiment& experiment, const std::filesystem::path& run);
/// A ball of cells that plates press flat: their work.
Result<calibrate::PressedCluster> pressed_of_run(const Experiment& experiment, const std::filesystem::path& run);
/// Errors (kFile): files of the run that are missing or damaged.
Result<std::vector<FoundPair>> pair_of_run(const Experiment& experiment, const std::filesystem::path& run);
Result<std::vector<FoundPacking>> packing_of_run(const Experiment& experiment, const std::filesystem::path& run);

}  // namespace morula::scenarios
