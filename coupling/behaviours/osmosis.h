#pragma once
#include "coupling/cells.h"
#include "coupling/model.h"

namespace morula {

/// RT of the van 't Hoff law Π = RT c at 310.15 K: 8.314462618 J/(mol K) × 310.15 K [fJ/amol = kPa/mM].
inline constexpr double kGasEnergy = 2.578731;

/// A cell between two solutions: what the flux of water depends on.
///
/// dV/dt = L_p A (ΔΠ − Δp), ΔΠ = RT (n/(V − V_b) − c_e)  (Kedem & Katchalsky 1958, doi:10.1016/0006-3002(58)90330-5; Boyle–van 't Hoff).
struct OsmoticCell {
  double permeability = 0.0;  ///< L_p [µm/(s kPa)]
  double osmolytes = 0.0;     ///< n, solutes that cannot leave [amol]
  double inactive = 0.0;      ///< V_b, volume that is no solvent [µm³]
  double outside = 0.0;       ///< c_e [mM]
  double pressure = 0.0;      ///< Δp, inside minus outside, of the cortex and of what presses on the cell [kPa]
  double area = 0.0;          ///< A at the volume of the step's start; goes with V^{2/3} [µm²]
};

/// The volume at which no water flows: V_b + n/(c_e + Δp/RT) [µm³].
double osmotic_volume(const OsmoticCell& cell);

/// Relaxation time (V − V_b)/(L_p A Π) at the volume V, Π = RT n/(V − V_b) [s].
double osmotic_time(const OsmoticCell& cell, double volume);

/// Volume after dt [s], from `volume`, at constant n, V_b, c_e and Δp.
///
/// Singly diagonally implicit, second order and L-stable (Alexander 1977, doi:10.1137/0714068), in substeps of a small part of the relaxation
/// time that lengthen towards rest: an error of 1e-5 on the way (some 200 substeps of a shock, one at rest), and the rest state for long dt.
double volume_after_flux(const OsmoticCell& cell, double volume, double dt);

/// What a cell of this type holds and what is around it at `time` [s]: n = c_i (V_t − V_b), V_b = f_b V_t, with V_t the target volume that
/// growth drives, so that growth, division and death act on n and V_b, and the free volume at c_e = c_i is V_t.
/// `area` [µm²] and `pressure` [kPa] are those of its body.
OsmoticCell osmotic_cell(const CellState& row, const CellType& type, double time, double area, double pressure);

/// Let water flow for dt [s]: the row's reference_excess moves by ln(V'/V), where V' is the volume after the flux; V0 of a shell (or the
/// volume of a sphere) is what it would be without osmosis times e^excess.
///
/// For a shell this is the law dV0/dt = L_p A (ΔΠ − Δp) with ΔΠ at the present volume V, made implicit: while the load on the cell stays,
/// V = V0 e^{−Δp/K_V} follows V0 in proportion, beside a nucleus that is a shell. `volume` is the body's present volume [µm³].
void exchange_water(CellState& row, const CellType& type, double time, double dt, double volume, double area, double pressure);

}  // namespace morula
