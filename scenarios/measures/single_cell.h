#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "coupling/time_course.h"
#include "results/snapshot.h"
#include "study/study.h"

namespace morula::scenarios {

/// All snapshots of a run. kFile when there is none.
Result<std::vector<Snapshot>> all_snapshots(const std::filesystem::path& run);

/// A time during which a course does not change, and the last snapshot in it.
struct Hold {
  double value = 0.0;  ///< of the course
  double time = 0.0;   ///< of the snapshot [s]
  std::size_t snapshot = 0;
};
/// The holds of a course that a run has a snapshot of, in time order; a course without points is one hold.
std::vector<Hold> holds_of(const TimeCourse& course, const std::vector<Snapshot>& snapshots);
/// The same by the times of the snapshots [s].
std::vector<Hold> holds_of(const TimeCourse& course, const std::vector<double>& times);

/// The tolerance for meshes of fewer than 642 nodes, or that for finer ones.
inline double tolerance(std::uint32_t nodes, double coarse, double fine) { return nodes < 642 ? coarse : fine; }

/// Two-dimensional Young modulus Y = 2k/√3 of the springs of a type [nN/µm], and its Poisson ratio 1/3.
double spring_modulus(const CellType& type);

/// Whether a cortex of elastic modulus Y = `modulus` γ counts as fluid: its shapes are then those of its tension alone (physics/scenarios.md S4:
/// Y = 0.05 γ).
bool is_fluid(double modulus);

}  // namespace morula::scenarios
