#include "coupling/behaviours/builtin.h"

#include "cbm/division_ramp.h"
#include "coupling/behaviours/pressure_filter.h"
#include "coupling/model.h"

namespace morula {
namespace {

constexpr const char* kOurs = "choice of this project";

// Fallbacks are those of a default CellType, so that the description and the model cannot drift apart.

LawInfo growth_law(const char* name, const char* title, const char* equation) {
  const CellType type;
  return {
      .name = name,
      .title = title,
      .equation = equation,
      .source = "choice of this project; ages of a balanced population: Powell 1956, doi:10.1099/00221287-15-3-492",
      .parameters = {{"cycle_duration", "time", "s", type.cycle_duration.mean, 1.0, 1e9, kOurs, "From birth to twice the birth volume."},
                     {"inhibit_pressure", "pressure", "kPa", type.inhibit_pressure, 0.0, kNever, kOurs,
                      "Growth stops while the averaged pressure is above this."},
                     {"pressure_averaging", "time", "s", kPressureAveraging, kPressureAveraging, kPressureAveraging, kOurs,
                      "Time of the exponential average of the pressure; fixed."}}};
}

LawInfo division_law() {
  return {.name = "instant_division",
          .title = "Division of a sphere at an instant",
          .equation = "V_2 = V_m − V_1, d = 2(R_m − r) = 0.4126 R_m, rest distance grows linearly to R_1 + R_2 − δ_0",
          .source = kOurs,
          .parameters = {{"relaxation", "time", "s", cbm::kSisterRelaxation, cbm::kSisterRelaxation, cbm::kSisterRelaxation, kOurs,
                          "Time over which the overlap of two sisters is released; fixed."}}};
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

LawInfo migration_law() {
  const CellType type;
  return {.name = "persistent_walk",
          .title = "Persistent random migration",
          .equation =
              "F = Γ w on every point, Γ its friction with the medium and with obstacles; w = u in the open, √(3/2) u∥ on an obstacle; "
              "du = −u dt/P + (S/√3)√(2/P) dB per component; MSD = 2S²P[t − P(1 − e^(−t/P))] in the open",
          .source = "Uhlenbeck & Ornstein 1930, doi:10.1103/PhysRev.36.823",
          .parameters = {{"migration_speed", "velocity", "µm/s", type.migration_speed, 0.0, 10.0, kOurs,
                          "S: root mean square of the wanted velocity in three dimensions."},
                         {"migration_persistence", "time", "s", type.migration_persistence, 1.0, 1e9, kOurs,
                          "P: time over which direction is kept."}}};
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
  return {growth_law("linear_growth", "Linear growth over the cycle", "V = V_b (1 + t/T)"),
          growth_law("exponential_growth", "Exponential growth over the cycle", "V = V_b 2^(t/T)"),
          division_law(),
          dying_law(),
          migration_law(),
          osmosis_law()};
}

}  // namespace morula
