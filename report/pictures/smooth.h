#pragma once
#include "results/snapshot.h"

namespace morula::scenarios {

/// The snapshot with shells whose faces are cut into `level`² smaller ones on a smooth surface through their nodes, so that a coarse mesh
/// has a round outline and a round section in a picture: curved point-normal triangles (Vlachos et al. 2001, doi:10.1145/364338.364387).
/// Only for the eye: nothing is measured on it. Level 1 gives the snapshot as it is.
Snapshot smoothed(const Snapshot& snapshot, int level);

/// The level at which edges of shells are about six pixels long: 1..8, and so that the picture has at most two million faces.
int smoothing_level(const Snapshot& snapshot, double pixels_per_um);

}  // namespace morula::scenarios
