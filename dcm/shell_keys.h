#pragma once
#include <limits>
#include <utility>
#include <vector>

#include "core/law_info.h"

/// The keys of a shell that more than one law reads, or the study reader beside a law: declared here, named by the laws.
namespace morula::dcm::keys {

inline constexpr const char* kTable1 = "Van Liedekerke et al., Table 1";

inline KeySpec young() {
  return {.name = "young",
          .doc = "Young's modulus E of the layer.",
          .quantity = Quantity::kPressure,
          .fallback = "1 kPa",
          .low = 0.0,
          .high = 1e4,
          .example = "1 kPa",
          .source = kTable1};
}
inline KeySpec thickness() {
  return {.name = "thickness",
          .doc = "Thickness h of the layer.",
          .quantity = Quantity::kLength,
          .fallback = "200 nm",
          .low = 0.0,
          .high = 5.0,
          .low_open = true,
          .example = "200 nm",
          .source = kTable1};
}
inline KeySpec poisson() {
  return {
      .name = "poisson",
      .doc =
          "Poisson ratio of the layer: of its bending stiffness, and of its plane where `elastic` can have it (not in a net of springs).",
      .fallback = "0.5",
      .low = 0.0,
      .high = 0.5,
      .example = "0.5",
      .source = kTable1};
}
inline KeySpec rigidity() {
  return {.name = "rigidity",
          .doc = "Bending rigidity D of the layer; `auto`: E h^3/(12 (1 - poisson^2)).",
          .quantity = Quantity::kEnergy,
          .fallback = "auto",
          .low = 0.0,
          .specials = {{"auto", kAuto}},
          .example = "8.9e-19 J",
          .source = "Kirchhoff plate"};
}
inline KeySpec tension() {
  return {.name = "tension",
          .doc = "Active cortical tension.",
          .quantity = Quantity::kTension,
          .fallback = "0.1 mN/m",
          .low = 0.0,
          .high = 100.0,
          .example = "0.2 mN/m",
          .source = "chosen between 0.03 mN/m (neutrophil, Hochmuth 2000) and 0.4 mN/m (fibroblast, Tinevez et al. 2009)"};
}
inline KeySpec turnover() {
  return {.name = "turnover",
          .doc =
              "Time after which 1/e of the elastic stress in the plane is left at constant shape, because the layer is renewed; steps are "
              "a tenth of it at most; "
              "`never`: it is permanent.",
          .quantity = Quantity::kTime,
          .fallback = "never",
          .low = 0.0,
          .low_open = true,
          .specials = {{"never", std::numeric_limits<double>::infinity()}},
          .example = "10 min",
          .source = "chosen: off"};
}
inline KeySpec damping() {
  return {.name = "damping",
          .doc = "Friction of an edge against its own lengthening.",
          .quantity = Quantity::kFriction,
          .fallback = "1e-4 N s/m",
          .low = 0.0,
          .high = 1e4,
          .example = "1e-4 N s/m",
          .source = kTable1};
}
inline KeySpec isotropic_damping() {
  return {.name = "isotropic_damping",
          .doc = "Friction of an edge against any relative motion of its ends; unlike `damping` it resists rigid rotation of the whole.",
          .quantity = Quantity::kFriction,
          .fallback = "0 N s/m",
          .low = 0.0,
          .high = 1e4,
          .example = "1e-5 N s/m",
          .source = "chosen: off"};
}
inline KeySpec local_area() {
  return {.name = "local",
          .doc = "Modulus of the area of every face.",
          .quantity = Quantity::kTension,
          .fallback = "0 mN/m",
          .low = 0.0,
          .high = 1e6,
          .example = "0.07 mN/m",
          .source = "chosen: off"};
}
inline KeySpec global_area() {
  return {.name = "global",
          .doc = "Modulus of the area of the whole surface.",
          .quantity = Quantity::kTension,
          .fallback = "0 mN/m",
          .low = 0.0,
          .high = 1e6,
          .example = "1 mN/m",
          .source = "chosen: off"};
}
inline KeySpec bulk_modulus() {
  return {.name = "bulk_modulus",
          .doc = "Stiffness K of the volume: p = -K ln(V/V0).",
          .quantity = Quantity::kPressure,
          .fallback = "2.5 kPa",
          .low = 0.0,
          .high = 1e4,
          .example = "2.5 kPa",
          .source = kTable1};
}
inline KeySpec bulk_viscosity() {
  return {.name = "bulk_viscosity",
          .doc = "Viscosity of the volume: adds -eta (dV/dt)/V to the pressure.",
          .quantity = Quantity::kViscosity,
          .fallback = "0 Pa s",
          .low = 0.0,
          .high = 1e9,
          .example = "100 Pa s",
          .source = "chosen: off"};
}
inline KeySpec shape_stiffness() {
  return {.name = "shape_stiffness",
          .doc =
              "Keeps triangles from collapsing; no shear modulus in regular triangles, but it holds a cortex back that should flow. "
              "`auto`: 0.3 times the tension, at least a tenth of the modulus E h of an elastic layer; 0.03 mN/m where there is neither.",
          .quantity = Quantity::kTension,
          .fallback = "auto",
          .low = 0.0,
          .high = 100.0,
          .specials = {{"auto", kAuto}},
          .example = "0.03 mN/m",
          .source = "measured: contact angles within 1 deg, clusters up to W/(2 tension) = 0.9"};
}
inline KeySpec barrier_stiffness() {
  return {.name = "stiffness",
          .doc = "Energy scale of the barrier.",
          .quantity = Quantity::kEnergy,
          .fallback = "1 fJ",
          .low = 0.0,
          .example = "1 fJ",
          .source = "measured: clusters up to W/(2 tension) = 0.9"};
}
/// An edge that is folded beyond 2.9 rad is at fault (ShellLimits::kAngle), so that the barrier must begin well before.
inline KeySpec barrier_angle() {
  return {
      .name = "angle",
      .doc = "Turning angle of an edge from which the barrier acts; at 2.9 rad an edge counts as folded through, and the step is refused.",
      .quantity = Quantity::kAngle,
      .fallback = "1.6 rad",
      .low = 0.2,
      .high = 2.8,
      .example = "1.6 rad",
      .source = "measured"};
}
inline KeySpec medium_friction() {
  return {.name = "medium",
          .doc = "Friction with the medium or matrix per area of surface.",
          .quantity = Quantity::kFrictionPerArea,
          .fallback = "1e8 N s/m^3",
          .low = 0.0,
          .high = 1e6,
          .example = "1e8 N s/m^3",
          .source = kTable1};
}

inline LawKey in_cortex(KeySpec key) { return {"dcm.cortex", std::move(key)}; }
/// Young's modulus, thickness and Poisson ratio of the cortex, and perhaps keys of the law's own in the same section.
inline std::vector<LawKey> layer(std::vector<KeySpec> own = {}) {
  std::vector<LawKey> out{in_cortex(young()), in_cortex(thickness()), in_cortex(poisson())};
  for (KeySpec& key : own) out.push_back(in_cortex(std::move(key)));
  return out;
}

}  // namespace morula::dcm::keys
