#pragma once
#include <array>

#include "scenarios/calibrate/data.h"
#include "scenarios/calibrate/pair_model.h"

namespace morula::calibrate {

/// Neighbours of a cell at one distance.
struct LatticeShell {
  int neighbours = 0;
  double distance = 0.0;  ///< over the radius of the free cell
};

/// A periodic packing of equal spheres in units of their radius R, at V/V0.
///
/// Face-centred: twelve neighbours at d with d³/√2 = V, six at √2 d. Body-centred: eight at d with 4d³/(3√3) = V, six at 2d/√3. V0 = 4πR³/3.
/// Spheres of the nearest shell are in contact whatever their distance, those of the next from the overlap 0 on (a compression that goes on).
struct LatticeGeometry {
  std::array<LatticeShell, 2> shells{};  ///< of neighbours in contact; 0 neighbours: none
  double room = 0.0;                     ///< V/R³
  double packing = 0.0;                  ///< φ = Σ v_cap/V0
  double press = 0.0;                    ///< p of the lattice for a packing pressure of 1: Σ z d π(R² − d²/4)/(6V)
};
[[nodiscard]] LatticeGeometry lattice_geometry(Lattice lattice, double volume_ratio);

/// Virial pressure of the pair forces alone, p = Σ z d F(2R − d)/(6V); twelve neighbours: 2√2 F/d² (cbm.md §3) [kPa]. radius R [µm].
[[nodiscard]] double pair_pressure(const LatticeGeometry& at, double radius, const PairModel& pair);

}  // namespace morula::calibrate
