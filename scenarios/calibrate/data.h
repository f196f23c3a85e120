#pragma once
#include <cmath>
#include <limits>
#include <vector>

#include "scenarios/calibrate/packing_geometry.h"

namespace morula::calibrate {

/// Two cells in contact, at rest: a point of a force–overlap curve of deformable cells, extrapolated to no rate.
struct PairPoint {
  int experiment = 0;    ///< number of the experiment: points of one experiment are drawn together by the bootstrap
  double overlap = 0.0;  ///< δ = R_a + R_b − d with the radii of the free cells [µm]
  double force = 0.0;    ///< > 0 pushes apart [nN]
  double area = std::numeric_limits<double>::quiet_NaN();  ///< of contact [µm²]; not a number: not measured
  double radius_a = 0.0, radius_b = 0.0;                   ///< of the free cells [µm]
  double rate = 0.0;                                       ///< slowest rate that was run: of the force [nN/s] or the distance [µm/s]
  bool held_out = false;                                   ///< judged by, never fitted to

  [[nodiscard]] double reduced_radius() const { return radius_a * radius_b / (radius_a + radius_b); }
  [[nodiscard]] double smaller_radius() const { return std::fmin(radius_a, radius_b); }
};

/// A periodic packing of equal cells at rest.
struct PackingPoint {
  int experiment = 0;
  Arrangement arrangement = Arrangement::kFaceCentred;
  double volume_ratio = 1.0;  ///< V/V0: room of a cell in the box over the volume of the free cell
  double pressure = 0.0;      ///< p, of contact [kPa]
  double radius = 0.0;        ///< of the free cell [µm]
  bool held_out = false;
  /// Where spheres in place of these cells lie, which the law itself decides: of random packings. Lattices stay what they are.
  PackingGeometry random{};
  double contact_area = 0.0;  ///< of a cell with all its neighbours, the mean [µm²]; 0: not measured

  [[nodiscard]] PackingGeometry geometry() const {
    return arrangement == Arrangement::kRandom ? random : lattice_geometry(arrangement, volume_ratio);
  }
};

/// A few equal cells in no box, at rest: nothing presses on them. Where they lie tells how much neighbours that meet each other keep a cell's contacts from growing, at packings that no
/// box at rest has.
struct ClusterPoint {
  int experiment = 0;
  PackingGeometry places{};  ///< of the cells
  double radius = 0.0;       ///< of a free cell [µm]
  bool held_out = false;

  /// Two cells, which touch.
  [[nodiscard]] bool is_pair() const { return places.neighbours.size() == 1 && places.neighbours[0].count == 1.0; }
  /// δ of such a pair [µm].
  [[nodiscard]] double overlap_of_pair() const { return (2.0 - places.neighbours[0].distance) * radius; }
};

/// What the virtual experiments have found.
struct Data {
  std::vector<PairPoint> pairs;
  std::vector<PackingPoint> packings;
  std::vector<ClusterPoint> clusters{};
};

}  // namespace morula::calibrate
