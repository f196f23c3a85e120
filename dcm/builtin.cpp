#include "dcm/builtin.h"

#include <string>

namespace morula::dcm {
namespace {

constexpr auto kCortex = "Van Liedekerke et al. 2020, doi:10.1007/s10237-019-01204-7";
constexpr auto kMeasured = "choice of this project: smallest of the tried values without folds up to W/(2γ) = 0.9";

ShellLaw edge_spring() {
  return {.info = {.name = "edge_spring",
                   .title = "Elastic cortex: springs along the edges",
                   .equation = "E = ½ k (l − l0)², k = (√3/2) E_cor h",
                   .source = "Seung & Nelson 1988, doi:10.1103/PhysRevA.38.1005",
                   .parameters = {{"young_modulus", "pressure", "kPa", 1.0, 0.0, 1000.0, kCortex, "Young's modulus of the cortex E_cor."},
                                  {"thickness", "length", "µm", 0.2, 0.0, 5.0, kCortex, "Thickness of the cortex h."}}},
          .stencil = LawStencil::kEdge,
          .strength = &ShellParameters::spring_stiffness};
}

ShellLaw edge_damper() {
  return {.info = {.name = "edge_damper",
                   .title = "Viscous cortex: dampers along the edges",
                   .equation = "F_i = −γ_int t tᵀ (v_i − v_j)",
                   .source = kCortex,
                   .parameters = {{"edge_damping", "friction", "nN·s/µm", 0.1, 0.0, 1e4, kCortex,
                                   "Friction γ_int of every edge along itself; does not depend on the number of nodes."}}},
          .stencil = LawStencil::kEdge,
          .conservative = false,
          .strength = &ShellParameters::edge_damping};
}

ShellLaw hinge_bending() {
  return {.info = {.name = "hinge_bending",
                   .title = "Bending of the cortex",
                   .equation = "E = ½ k_h (θ − θ0)², k_h = (2/√3) E_cor h³ / (12 (1 − ν²))",
                   .source = "Gompper & Kroll 1996, J. Phys. I France 6, 1305",
                   .parameters = {{"young_modulus", "pressure", "kPa", 1.0, 0.0, 1000.0, kCortex, "Young's modulus of the cortex E_cor."},
                                  {"thickness", "length", "µm", 0.2, 0.0, 5.0, kCortex, "Thickness of the cortex h."},
                                  {"poisson_ratio", "number", "1", 0.5, -0.99, 0.5, kCortex,
                                   "Poisson ratio of the cortex ν, for bending only."}}},
          .stencil = LawStencil::kHinge,
          .in_operator = false,
          .strength = &ShellParameters::hinge_stiffness};
}

ShellLaw cortical_tension() {
  return {.info = {.name = "cortical_tension",
                   .title = "Tension of the actomyosin cortex",
                   .equation = "E = γ A",
                   .source = "Fischer-Friedrich et al. 2014, doi:10.1038/srep06213",
                   .parameters = {{"tension", "tension", "nN/µm", 0.5, 0.0, 100.0,
                                   "between interphase 0.2 and metaphase 1.6: " +
                                       std::string("Fischer-Friedrich et al. 2014, doi:10.1038/srep06213"),
                                   "Tension γ of the cortex."}}},
          .stencil = LawStencil::kFace,
          .zero_in_reference = false,
          .strength = &ShellParameters::tension};
}

ShellLaw volume_pressure() {
  return {.info = {.name = "volume_pressure",
                   .title = "Pressure of the cytoplasm",
                   .equation = "E = K_V [V ln(V/V0) − V + V0], p = −K_V ln(V/V0)",
                   .source = kCortex,
                   .parameters = {{"bulk_modulus", "pressure", "kPa", 2.5, 0.0, 1e6, kCortex, "Bulk modulus K_V of the cell."}}},
          .stencil = LawStencil::kCell,
          .strength = &ShellParameters::bulk_modulus};
}

ShellLaw triangle_shape() {
  return {
      .info = {.name = "triangle_shape",
               .title = "Resistance of triangles to collapse",
               .equation = "E = k_s A_ref (1/q − 1)², q = 4√3 A / Σ l²",
               .source = "choice of this project: regularises faces where the cortex has no shear stiffness",
               .parameters = {{"shape_stiffness", "tension", "nN/µm", 0.3, 0.0, 100.0, kMeasured, "Stiffness k_s per reference area."}}},
      .stencil = LawStencil::kFace,
      .zero_in_reference = false,
      .strength = &ShellParameters::shape_stiffness};
}

ShellLaw dihedral_barrier() {
  return {
      .info = {.name = "dihedral_barrier",
               .title = "Barrier against folding",
               .equation = "E = k_d z² / (1 − z²), z = (|θ| − θ_b) / (π − θ_b) for |θ| > θ_b, else 0",
               .source = "choice of this project: keeps the sign of contact gaps defined",
               .parameters = {{"barrier_stiffness", "energy", "nN·µm", 1.0, 0.0, 1000.0, kMeasured, "Energy k_d of the barrier."},
                              {"barrier_angle", "angle", "rad", 1.6, 0.1, 2.8, kMeasured, "Turning angle θ_b where the barrier begins."}}},
      .stencil = LawStencil::kHinge,
      .strength = &ShellParameters::barrier_stiffness};
}

ShellLaw medium_friction() {
  return {.info = {.name = "medium_friction",
                   .title = "Friction against the medium",
                   .equation = "F_i = −γ_med a_i v_i, a_i = ⅓ Σ A_T over the faces around the node",
                   .source = kCortex,
                   .parameters = {{"medium_friction", "friction_per_area", "nN·s/µm³", 0.1, 1e-4, 1e4, kCortex,
                                   "Friction γ_med per area of the surface; not zero, or rigid motion would have no resistance."}}},
          .stencil = LawStencil::kNode,
          .conservative = false,
          .strength = &ShellParameters::medium_friction};
}

}  // namespace

const std::vector<ShellLaw>& shell_laws() {
  static const std::vector<ShellLaw> laws{edge_spring(),     edge_damper(),    hinge_bending(),    cortical_tension(),
                                          volume_pressure(), triangle_shape(), dihedral_barrier(), medium_friction()};
  return laws;
}

}  // namespace morula::dcm
