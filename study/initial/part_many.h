#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/space/space.h"
#include "study/initial/surroundings.h"
#include "study/study.h"

namespace morula::scenarios {

/// From this number of cells on, places are found for many at once: part_many() instead of one pass after the other over a new grid.
inline constexpr std::size_t kMany = 5000;

/// How many balls come apart.
struct PartMany {
  double touch = 1.0;                    ///< of r_i + r_j
  double slack = 0.0;                    ///< overlap that may remain [µm]
  int most_passes = 400;                 ///< then it ends with what is left
  const InitialCells* within = nullptr;  ///< balls are kept in this entry's shape; null: they may leave it
  const Surroundings* around = nullptr;  ///< prepared; pushes and is not pushed
  const LayerPlane* plane = nullptr;     ///< each ball stays its radius above it
  int threads = 1;                       ///< change the time that it takes and nothing else
};

/// What is left when balls have come apart.
struct Parted {
  double overlap = -1e300;    ///< largest of touch·(r_i + r_j) − distance; ≤ 0: none overlap [µm]
  double intrusion = -1e300;  ///< how deep the deepest lies in what is around [µm]
  double beyond = 0.0;        ///< how far the outermost reaches out of the shape that keeps them [µm]
  int passes = 0;
};

/// Moves balls in place until none overlap by more than the slack: motion with inertia (each pass takes 0.3 of the overlaps and 0.9 of the
/// last way, but no more than a tenth of a radius; what overlaps nothing stops), which settles waves of density in as many passes as the tissue is wide, where motion
/// without inertia takes the square of that. Neighbours come from lists that hold as long as nothing has moved further than half their margin. A sum over a ball's neighbours runs in the order of its list,
/// so that the result has the same bits on any number of threads.
Parted part_many(std::vector<Vec3d>& center, std::span<const double> radius, const PartMany& how, const Space& space);

}  // namespace morula::scenarios
