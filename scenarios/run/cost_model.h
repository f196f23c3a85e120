#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"
#include "coupling/model.h"
#include "scenarios/run/growth_forecast.h"
#include "scenarios/run/tried_steps.h"
#include "study/study.h"

namespace morula::scenarios {

/// A range of wall times [s]; negative: not known.
struct WallRange {
  double low = -1.0, high = -1.0;
};

/// Shells for which the regions of a model have room when there are so many cells; infinite where shells are not bound to regions: then they multiply as all
/// cells do. How many triggers will make is not foreseen.
double most_shells(const Model& model, double cells);

/// The longest step that a run may take: `numerics.max_step`, and steps land on outputs [s].
double longest_step(const Study& study);

/// Wall time left, from what the run has cost so far for its load and from how the load will grow (elapsed/fraction is wrong when cells
/// multiply): ∫ κ (3 N_nodes + N_spheres) dt, all cells ∝ e^{g t}, those that regions have no room for as shells being spheres, κ the wall time per simulated second and unit of load of the last steps.
/// The first steps are short, and say nothing of those that follow but by how they grow (tried_steps.h): nothing is told before the eighth.
/// The range: half of the free growth and 15 % less per load, to the whole of it and 25 % more.
class CostModel {
 public:
  /// `most`: the longest step that the run may take [s].
  explicit CostModel(double most) : most_(most) {}
  /// One step: simulated [s], wall [s], the load it had. What takes ten times as long as the steps before it counts as ten of them: hundreds of shells that
  /// find their shapes together say nothing of what is to come.
  void observe(double simulated, double wall, const Load& load);
  [[nodiscard]] WallRange left(double simulated, const Load& load, double growth_rate) const;
  /// κ [wall s / (simulated s · load)]; 0: nothing observed.
  [[nodiscard]] double cost() const { return weight_ > 0.0 ? wall_ / weight_ : 0.0; }

 private:
  double wall_ = 0.0, weight_ = 0.0;  ///< fading sums
  double step_ = 0.0;                 ///< fading mean of a step [s]
  double most_;
  std::vector<TriedStep> first_;  ///< the first steps that were observed
};

/// What a study will need, before it is run.
struct Estimate {
  std::int64_t cells = 0, shells = 0, nodes = 0, voxels = 0;  ///< at time 0; nodes of nuclei that are shells, too
  double cells_at_end = 0.0;                                  ///< if nothing inhibits growth
  double memory = 0.0;                                        ///< at the end [bytes]
  WallRange wall;                                             ///< of one core [s]
};

/// Up to 20,000 cells: places the cells of time 0, counts them and tries the first steps for three seconds, up to ten where fewer than 16 fit; the rest is told by how these steps grow
/// (tried_steps.h) and by the load, as cells multiply and regions, which may move, exchange bodies of cells that are where they were at first or where a tissue that swells has brought them, with what outputs and report cost. The range: 1.6 times each way.
/// Larger tissues are counted by the numbers of the study alone, at once, at a cost per cell and step measured on a 2020s core, in steps as large as they may be;
/// the range: 3 times each way. A run that comes to rest (`time.rest`) ends earlier, and what begins later than the steps that are tried is not foreseen.
Result<Estimate> estimate(const Study& study);

/// Memory that a run needs from its start, by the numbers of the study alone [bytes]; at once, whatever the study.
double memory_at_start(const Study& study);

/// "9 min", "1 h 21 min", "35–50 min" for people.
std::string duration_text(double seconds);
std::string duration_text(const WallRange& range);

}  // namespace morula::scenarios
