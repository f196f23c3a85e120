#include "dcm/builtin.h"

#include <limits>
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

std::vector<LawParameter> sheet_parameters(const char* poisson_doc) {
  return {{"young_modulus", "pressure", "kPa", 1.0, 0.0, 1000.0, kCortex, "Young's modulus of the cortex E_cor."},
          {"thickness", "length", "µm", 0.2, 0.0, 5.0, kCortex, "Thickness of the cortex h."},
          {"poisson_ratio", "number", "1", 0.5, 0.0, 0.5, kCortex, poisson_doc}};
}

ShellLaw neo_hooke() {
  return {
      .info = {.name = "neo_hooke",
               .title = "Elastic cortex: neo-Hookean membrane on constant-strain triangles",
               .equation = "W = ½ G [tr C − 2 + (det C^(−α) − 1)/α], G = E h / (2 (1 + ν)), α = ν/(1 − ν); ν = ½: ½ G (tr C + 1/det C − 3)",
               .source = "Blatz & Ko 1962, doi:10.1122/1.548937, in plane stress; Holzapfel 2000, Nonlinear Solid Mechanics, §6.5",
               .parameters = sheet_parameters("Poisson ratio of the cortex ν.")},
      .stencil = LawStencil::kFace,
      .strength = &ShellParameters::neo_hooke_shear};
}

ShellLaw st_venant_kirchhoff() {
  return {
      .info = {.name = "st_venant_kirchhoff",
               .title = "Elastic cortex: St Venant–Kirchhoff membrane on constant-strain triangles",
               .equation = "W = G [tr E² + α (tr E)²], E = (C − 1)/2, G = E h / (2 (1 + ν)), α = ν/(1 − ν); stretches within 0.8 to 1.3",
               .source = "Holzapfel 2000, Nonlinear Solid Mechanics, §6.5",
               .parameters = sheet_parameters("Poisson ratio of the cortex ν.")},
      .stencil = LawStencil::kFace,
      .strength = &ShellParameters::stvk_shear};
}

ShellLaw skalak() {
  return {.info = {.name = "skalak",
                   .title = "Elastic cortex: Skalak's membrane on constant-strain triangles",
                   .equation = "W = ¼ G (I1² + 2 I1 − 2 I2 + C I2²), I1 = tr C − 2, I2 = det C − 1, G = E h / (2 (1 + ν)), C = ν/(1 − ν)",
                   .source = "Skalak et al. 1973, doi:10.1016/S0006-3495(73)85983-1",
                   .parameters = sheet_parameters("Poisson ratio of the cortex ν; or give G and C themselves.")},
          .stencil = LawStencil::kFace,
          .strength = &ShellParameters::skalak_shear};
}

ShellLaw local_area() {
  return {.info = {.name = "local_area",
                   .title = "Elasticity of the area of every face",
                   .equation = "E = ½ K_a Σ (A − A0)² / A0",
                   .source = "Seifert 1997, doi:10.1080/00018739700101488; with springs: Seung & Nelson 1988",
                   .parameters = {{"local_area_modulus", "tension", "nN/µm", 0.0, 0.0, 1e6, "choice of this project: off",
                                   "Modulus K_a; adds to the area modulus of the membrane."}}},
          .stencil = LawStencil::kFace,
          .strength = &ShellParameters::local_area_modulus};
}

ShellLaw global_area_law() {
  return {.info = {.name = "global_area",
                   .title = "Elasticity of the area of the whole surface",
                   .equation = "E = ½ K_G (A − A0)² / A0, A0 the sum over the faces at rest",
                   .source = "Seifert 1997, doi:10.1080/00018739700101488",
                   .parameters = {{"global_area_modulus", "tension", "nN/µm", 0.0, 0.0, 1e6, "choice of this project: off",
                                   "Modulus K_G of the total area."}}},
          .stencil = LawStencil::kCell,
          .strength = &ShellParameters::global_area_modulus};
}

ShellLaw cortex_turnover() {
  return {.info = {.name = "cortex_turnover",
                   .title = "Turnover of the cortex",
                   .equation = "l0 ← l + (l0 − l) exp(−Δt/τ) for every edge, after every step",
                   .source = "exponential replacement of a stressed network: Salbreux et al. 2012, doi:10.1016/j.tcb.2012.07.001",
                   .parameters = {{"turnover_time", "time", "s", std::numeric_limits<double>::infinity(), 0.0,
                                   std::numeric_limits<double>::infinity(), "choice of this project: off",
                                   "Time τ after which 1/e of the elastic stress is left at constant shape."}}},
          .stencil = LawStencil::kEdge,
          .conservative = false,
          .in_operator = false,
          .strength = &ShellParameters::turnover_rate};
}

ShellLaw isotropic_damper() {
  return {.info = {.name = "isotropic_damper",
                   .title = "Viscous cortex: dampers of edges in all directions",
                   .equation = "F_i = −γ_iso (v_i − v_j); resists rigid rotation",
                   .source = "Van Liedekerke et al. 2015, doi:10.1007/s40571-015-0082-3 (node–node friction)",
                   .parameters = {{"isotropic_damping", "friction", "nN·s/µm", 0.0, 0.0, 1e4, "choice of this project: off",
                                   "Friction γ_iso of every edge in all directions; unlike `damping` it resists rigid rotation."}}},
          .stencil = LawStencil::kEdge,
          .conservative = false,
          .strength = &ShellParameters::isotropic_damping};
}

ShellLaw helfrich() {
  return {.info = {.name = "helfrich",
                   .title = "Bending after Helfrich, with the cotangent formula",
                   .equation = "E = ½ κ Σ a_i |g_i/a_i − c0 n_i|², g_i = ∂A/∂x_i",
                   .source = "Helfrich 1973, doi:10.1515/znc-1973-11-1209; Guckenberger & Gekle 2017, doi:10.1088/1361-648X/aa6313",
                   .parameters = {{"helfrich_rigidity", "energy", "nN·µm", 8.8889e-4, 0.0, 1000.0, kCortex,
                                   "Bending rigidity κ; that of a plate is E h³/(12 (1 − ν²))."},
                                  {"spontaneous_curvature", "curvature", "1/µm", 0.0, -100.0, 100.0, "choice of this project: flat",
                                   "Curvature c0 = 2H of the sheet at rest, > 0 for a sphere seen from outside."}}},
          .stencil = LawStencil::kNode,
          .zero_in_reference = false,
          .strength = &ShellParameters::helfrich_rigidity};
}

ShellLaw bulk_viscosity() {
  return {.info = {.name = "bulk_viscosity",
                   .title = "Viscosity of the cell's volume",
                   .equation = "p = −η_V V̇/V",
                   .source = "Van Liedekerke et al. 2020, doi:10.1007/s10237-019-01204-7, with the rate of the volume",
                   .parameters = {{"bulk_viscosity", "viscosity", "kPa·s", 0.0, 0.0, 1e9, "choice of this project: off",
                                   "Viscosity η_V; with the bulk modulus the volume relaxes with η_V/K_V."}}},
          .stencil = LawStencil::kCell,
          .conservative = false,
          .strength = &ShellParameters::bulk_viscosity};
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
               .parameters = {{"shape_stiffness", "tension", "nN/µm", 0.03, 0.0, 100.0, kMeasured, "Stiffness k_s per reference area."}}},
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
  static const std::vector<ShellLaw> laws{
      edge_spring(),     neo_hooke(),      st_venant_kirchhoff(), skalak(),           local_area(),     global_area_law(),
      cortex_turnover(), edge_damper(),    isotropic_damper(),    hinge_bending(),    helfrich(),       cortical_tension(),
      volume_pressure(), bulk_viscosity(), triangle_shape(),      dihedral_barrier(), medium_friction()};
  return laws;
}

}  // namespace morula::dcm
