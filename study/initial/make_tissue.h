#pragma once
#include <string>
#include <vector>

#include "core/mesh/topology.h"
#include "core/parallel/comm.h"
#include "core/result.h"
#include "coupling/tissue.h"
#include "study/study.h"

namespace morula::scenarios {

struct InitialTissue {
  Tissue tissue;
  std::vector<std::string> notes;  ///< for the log: blocks that do not fit their shape, overlaps that remain
};

/// The tissue at time 0: this rank's share of the cells, by stretches of equal length of the founders' numbers.
///
/// Founders are numbered from 1 over all entries of `initial` in the order of the study, whatever the number of ranks. A cell's place comes
/// from its entry (place_cells.h: packing.h, the given points, the CSV file with coincident cells moved apart, or its surface in a mesh file);
/// its row from make_founder, with the
/// radius and the phase of the CSV row where given; its body from the CSV row, else the entry, else the type. A shell is a sphere of the
/// cell's volume at rest, turned at random (stream kOrientation). With start_volume f < 1 the target volume begins at f V and the rest
/// comes evenly in the inflation time. Fields and obstacles are made by Simulation::create.
/// Errors: kFile/kInput for a CSV that has changed since the check, kInput for cells without room or outside the domain, or unknown node numbers.
Result<InitialTissue> make_tissue(const Study& study, ShapeLibrary& shapes, const Comm& comm, int threads = 1);

}  // namespace morula::scenarios
