#pragma once
#include <limits>
#include <string>

#include "core/cell_id.h"
#include "core/parallel/comm.h"
#include "core/vec3.h"

namespace morula {

/// Why a step could not be done as asked.
struct StepFault {
  static constexpr double kNoShape = std::numeric_limits<double>::infinity();

  std::string what;
  CellId cell;  ///< where, if known
  bool smaller_step_may_help = true;
  double badness = 0.0;  ///< of faults of one kind the worst is told; kNoShape: the cell cannot have the shape that it has
};

/// Of what each rank has found the worst, and of equals that of the first cell: what all of them tell. Collective.
StepFault worst_of_all_ranks(StepFault here, const Comm& comm);

/// How a tissue moved as a whole in a step, every point weighted by its friction with the medium. Forces between cells leave drift and
/// rotation as they are, but for friction between cells, which turns them where it feels common rotations (core/contact/objective_friction.h).
struct TissueMotion {
  Vec3d drift;     ///< Σ γ d/Σ γ [µm]
  Vec3d rotation;  ///< θ with (Σ γ (|r|² I − r rᵀ)) θ = Σ r × γ d, r from the centre Σ γ x/Σ γ [rad]; 0 in periodic domains
  double way = 0.0;  ///< Σ γ |d|/Σ γ [µm]
};

struct StepReport {
  double step = 0.0;  ///< done [s]
  int newton = 0;     ///< iterations
  int linear_iterations = 0;
  int halvings = 0;           ///< of the way that a search took, at most
  double displacement = 0.0;  ///< largest of any point; a sphere counts half (AllowedWays) [µm]
  double way = 0.0;           ///< largest of a body, or what that of a point counts as (AllowedWays): the next step is found from it [µm]
  double energy = 0.0;        ///< at the end [nN·µm]
  double allowed_rise = 0.0;  ///< rise of Φ that the freeze rule let pass [nN·µm]
  double overlap = 0.0;       ///< deepest penetration of a surface [µm]
  int crossings = 0;          ///< searches cut short because a surface of this rank would have passed through another
  TissueMotion motion;
};

}  // namespace morula
