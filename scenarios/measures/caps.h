#pragma once
#include <string>
#include <vector>

#include "scenarios/measures/measure.h"

namespace morula::scenarios {

/// The spherical cap that a cell is, on the plane half way to its partner or on an obstacle.
struct MeasuredCap {
  std::string cell;                           ///< id; empty: the mean of both cells of a pair
  double wetting = 0.0;                       ///< W/γ of the contact
  double r0 = 0.0;                            ///< radius of a ball of the cell's volume [µm]
  double angle = 0.0;                         ///< of contact, 0 for a sphere that touches [rad]
  double adhesion = 0.0;                      ///< W/γ that this angle stands for
  double radius = 0.0, contact_radius = 0.0;  ///< over R0
  double height = 0.0, length = 0.0;          ///< of one cell, and of both or one, over R0
  double pressure = 0.0;                      ///< p R0/γ; not a number without a tension
  double contact_part = 0.0;                  ///< of the surface, by the contact area that is told
};

/// The caps of a subject of kContact in a snapshot: one for the two cells of a pair, one for each cell of a type on an obstacle, whose
/// plane is its top, seen along z. None where there are not exactly two
/// cells, of cells further apart than the range of contact, and where no sphere goes through the nodes.
std::vector<MeasuredCap> caps_of(const Study& study, const Snapshot& snapshot, const Subject& subject);

}  // namespace morula::scenarios
