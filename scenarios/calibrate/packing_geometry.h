#pragma once
#include <span>
#include <vector>

#include "cbm/packing.h"
#include "core/vec3.h"
#include "scenarios/calibrate/pair_model.h"

namespace morula::calibrate {

/// How the cells of a periodic packing lie.
enum class Arrangement { kFaceCentred, kBodyCentred, kRandom };

/// Neighbours of a cell of a packing, on average over its cells, at one distance or at about one.
struct Neighbours {
  double count = 0.0;
  double distance = 0.0;  ///< over the radius of the free cell
};

/// Some of the cells of a packing, of about the same φ.
struct PackedPart {
  double packing = 0.0;  ///< φ = Σ v_cap/V0
  double press = 0.0;    ///< their share in the pressure of the box for a packing pressure of 1
};

/// Where equal spheres lie in a periodic packing, in units of their radius R: what a law needs to know of it to say the pressure of the box.
struct PackingGeometry {
  std::vector<Neighbours> neighbours;  ///< in contact
  std::vector<PackedPart> parts;
  double room = 0.0;          ///< V/R³ of a cell
  double packing = 0.0;       ///< mean of φ over the parts, weighted by press
  double press = 0.0;         ///< sum over the parts: Σ z d π(R² − d²/4)/(6V) of a lattice
  double contact_area = 0.0;  ///< of a sphere with spheres by the law of two, the mean of a run [µm²]; 0: not known
  double extra = 0.0;  ///< pressure of pairs beyond that of `neighbours`, as a run has it: attached pairs with a gap between them [kPa]
};

/// A cubic packing at V/V0, V0 = 4πR³/3, face-centred or body-centred.
///
/// Face-centred: twelve neighbours at d with d³/√2 = V, six at √2 d. Body-centred: eight at d with 4d³/(3√3) = V, six at 2d/√3. Spheres of the
/// nearest shell are in contact whatever their distance, those of the next from the overlap 0 on (a compression that goes on).
[[nodiscard]] PackingGeometry lattice_geometry(Arrangement lattice, double volume_ratio);

/// Spheres of one radius at these centres [µm] in a periodic cube of this edge [µm]; those that overlap are neighbours. Neighbours of about the same
/// distance, and cells of about the same φ, are taken together, so that a law is quickly asked.
[[nodiscard]] PackingGeometry geometry_of_places(std::span<const Vec3d> centers, double edge, double radius);

/// The same of spheres in no box, each in a room as large as itself: at rest they bear no pressure.
[[nodiscard]] PackingGeometry geometry_of_cluster(std::span<const Vec3d> centers, double radius);

/// φ of one of two equal spheres that overlap by this part of their radius.
[[nodiscard]] double packing_of_pair(double overlap);

/// What a curve of packing adds to the force of two spheres [nN] whose radii and overlap are these [µm], when nobody else touches them.
[[nodiscard]] double packing_force_of_pair(const cbm::PackingCurve& curve, double radius_a, double radius_b, double overlap);

/// A law of pairs with what a curve of packing adds to two equal spheres that nobody else touches.
[[nodiscard]] PairModel with_packing(PairModel pair, cbm::PackingCurve curve);

/// Virial pressure of the pair forces alone, p = Σ z d F(2R − d)/(6V) + extra; twelve neighbours: 2√2 F/d² (cbm.md §3) [kPa]. radius R [µm].
[[nodiscard]] double pair_pressure(const PackingGeometry& at, double radius, const PairModel& pair);

/// What a curve of packing adds to it [kPa].
[[nodiscard]] double curve_pressure(const PackingGeometry& at, const cbm::PackingCurve& curve);

}  // namespace morula::calibrate
