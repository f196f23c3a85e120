#include "coupling/behaviours/builtin.h"

#include "cbm/division_ramp.h"
#include "coupling/behaviours/pressure_filter.h"
#include "coupling/model.h"

namespace morula {
namespace {

constexpr const char* kOurs = "choice of this project";

// Fallbacks are those of a default CellType, so that the description and the model cannot drift apart.

LawInfo inhibition_law() {
  const CellType type;
  return {.name = "growth_under_pressure",
          .title = "Growth stops under pressure",
          .equation = "dV/dt = 0 while p̄ > p_stop, dp̄/dt = (p − p̄)/τ",
          .source = "physics/cbm.md §5",
          .parameters = {{"inhibit_pressure", "pressure", "kPa", type.inhibit_pressure, 0.0, kNever, kOurs,
                          "p_stop: growth stops while the averaged pressure is above this."},
                         {"pressure_averaging", "time", "s", kPressureAveraging, kPressureAveraging, kPressureAveraging, kOurs,
                          "τ: time of the exponential average of the pressure; fixed."}}};
}

LawInfo sizer_law(const char* name, const char* title, const char* equation, const char* size) {
  const CellCycle cycle;
  return {.name = name,
          .title = title,
          .equation = equation,
          .source = "Amir 2014, doi:10.1103/PhysRevLett.112.208102; Cadart et al. 2018, doi:10.1038/s41467-018-05393-0",
          .parameters = {{"size", "volume", "µm³", cycle.size, 0.0, 1e12, kOurs, size},
                         {"size_spread", "fraction", "1", cycle.size_spread, 0.0, 0.3, kOurs, "s: relative standard deviation."}}};
}

LawInfo variation_law() {
  const Distribution law;
  return {
      .name = "variation",
      .title = "Cells of a type differ, and daughters take after their mothers",
      .equation =
          "x = μ (1 + s z), z Gaussian, |z| ≤ 3; of a daughter x = μ + ρ (x_m − μ) + √(1 − ρ²) (x′ − μ), x′ drawn anew: mean and spread "
          "stay",
      .source = "choice of this project; what inheritance does to growth: Powell 1956, doi:10.1099/00221287-15-3-492",
      .parameters = {{"spread", "fraction", "1", law.relative_spread, 0.0, 0.3, kOurs, "s: relative standard deviation."},
                     {"correlation", "fraction", "1", law.correlation, -1.0, 1.0, kOurs, "ρ: of a daughter with her mother."}}};
}

LawInfo phases_law() {
  return {.name = "cycle_phases",
          .title = "Phases of the cycle",
          .equation =
              "dτ_p/dt = −g_p, the next phase begins at τ_p = 0 with its own τ, after the last phase of growth not before the cell has its "
              "division volume; the cell divides after the last. Growth of an unlimited "
              "population α: Π_p E[e^(−α T_p)] = ½",
          .source = "Powell 1956, doi:10.1099/00221287-15-3-492; physics/cbm.md §5",
          .parameters = {}};
}

LawInfo quiescence_law() {
  const Quiescence law;
  return {
      .name = "quiescence",
      .title = "Quiescence (G0)",
      .equation = "out of the phase when its factor g < below for `hold`, back when g > above for `hold`; no growth and no phase between",
      .source = kOurs,
      .parameters = {{"below", "fraction", "1", law.enter_below, 0.0, 1.0, kOurs, "Cells leave below this factor."},
                     {"above", "fraction", "1", law.leave_above, 0.0, 1.0, kOurs, "And come back above this one."},
                     {"hold", "time", "s", law.hold, 0.0, kNever, kOurs, "For how long it must hold."}}};
}

LawInfo division_law() {
  return {.name = "instant_division",
          .title = "Division of a sphere at an instant",
          .equation = "V_2 = V_m − V_1, d = 2(R_m − r) = 0.4126 R_m, rest distance grows linearly to R_1 + R_2 − δ_0",
          .source = kOurs,
          .parameters = {{"relaxation", "time", "s", cbm::kSisterRelaxation, cbm::kSisterRelaxation, cbm::kSisterRelaxation, kOurs,
                          "Time over which the overlap of two sisters is released; fixed."}}};
}

LawInfo cut_law() {
  const CellType type;
  return {.name = "shell_division",
          .title = "Division of a shell by a cut",
          .equation =
              "V_1 + V_2 = V_m by a plane across the axis, closed with the same cap on both sides; there sisters adhere by W + n (γ_1 + "
              "γ_2 − W), "
              "n = 1 − t/τ",
          .source = kOurs,
          .parameters = {{"new_surface", "time", "s", type.new_surface, 0.0, 1e6, kOurs,
                          "τ in which the new interface takes its tension; 0: at once."}}};
}

LawInfo dying_law() {
  const CellType type;
  return {.name = "apoptosis",
          .title = "Shrinking and removal of a cell that has begun to die",
          .equation = "V = V_0 e^(−t/τ_a), removed below a fraction of V_0",
          .source = kOurs,
          .parameters = {{"apoptosis_time", "time", "s", type.apoptosis_time, 1.0, 1e9, kOurs, "τ_a of the shrinking volume."},
                         {"removal_fraction", "number", "1", type.removal_fraction, 1e-6, 0.999, kOurs,
                          "A dead cell is removed below this part of its volume at death."}}};
}

LawInfo osmosis_law() {
  const Osmosis law;
  return {
      .name = "osmosis",
      .title = "Osmotic control of the volume",
      .equation =
          "dV/dt = L_p A (RT (n/(V − V_b) − c_e) − Δp), n = c_i (V_t − V_b), V_b = f_b V_t, V_t the target volume; RT = 2.578731 fJ/amol; "
          "V0 of a shell follows with V",
      .source = "Kedem & Katchalsky 1958, doi:10.1016/0006-3002(58)90330-5; rest state: Boyle–van 't Hoff",
      .parameters = {{"permeability", "permeability", "µm/(s·kPa)", law.permeability, 0.0, 1e3, kOurs, "L_p of water; 0: no osmosis."},
                     {"inactive", "fraction", "1", law.inactive, 0.0, 0.9, kOurs, "f_b: part of the target volume that is no solvent."},
                     {"inside", "concentration", "mM", law.inside, 0.0, 1e4, kOurs, "c_i: osmolarity inside at the target volume."},
                     {"outside", "concentration", "mM", law.outside, 0.0, 1e4, kOurs, "c_e of the medium."}}};
}

}  // namespace

std::vector<LawInfo> behaviour_laws() {
  return {inhibition_law(),
          sizer_law("sizer", "Division at a volume that is the same for all cells", "V_d = V_s (1 + s z), |z| ≤ 3",
                    "V_s: mean division volume."),
          sizer_law("adder", "Division at a volume that is the same more than at birth", "V_d = V_b + ΔV (1 + s z), |z| ≤ 3",
                    "ΔV: mean volume that is added."),
          variation_law(),
          phases_law(),
          quiescence_law(),
          division_law(),
          cut_law(),
          dying_law(),
          osmosis_law()};
}

}  // namespace morula
