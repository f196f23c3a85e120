#pragma once
#include <span>
#include <vector>

#include "study/initial/place_cells.h"

namespace morula::scenarios {

struct JudgedPlaces {
  std::vector<PlaceProblem> problems;  ///< at most one for each pair of entries, and for each entry and obstacle
  std::vector<std::string> notes;      ///< what was not judged
};

/// Whether a run could begin with cells at these places.
///
/// E596: cells that no contact would drive out of each other or of an obstacle: a shell's centre nearer than half the larger radius to
/// another's, two cells of any body at the same place, a centre on the wrong side of an obstacle or wall. E597: shells deeper in each other or
/// in a surface than `limits.overlap`, which the run's first row would stop at; not with a capped start. Where balls cannot decide, the
/// surfaces of all shells in question are made and their contact is measured as in the run. E661 (a warning): spheres deep in others.
/// Errors: those of making the shells.
Result<JudgedPlaces> judge_places(const Study& study, std::span<const PlacedCell> cells, const Surroundings& around);

}  // namespace morula::scenarios
