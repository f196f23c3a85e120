#include "dcm/builtin.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "dcm/derived_parameters.h"
#include "dcm/laws/neo_hooke.h"
#include "dcm/laws/skalak.h"
#include "dcm/laws/st_venant_kirchhoff.h"
#include "dcm/shell_keys.h"

namespace morula::dcm {
namespace {

using P = ShellParameters;

constexpr auto kCortex = "Van Liedekerke et al. 2020, doi:10.1007/s10237-019-01204-7";

/// k = (√3/2) E h, or 4 G/√3 of a layer that says its shear modulus.
double spring_of(const LawValues& v) {
  return v.has("shear_modulus") ? 4.0 / std::numbers::sqrt3 * v("shear_modulus") : spring_stiffness(v("young"), v("thickness"));
}
double six_springs(const LawValues& v, double, double) { return 6.0 * spring_of(v); }

std::optional<LawProblem> judge_springs_with_area(const LawValues& v, const P&) {
  if (!(v("poisson") < 1.0 / 3.0 - 1e-12)) return std::nullopt;
  return LawProblem{514, "poisson", "a net of springs with an area modulus cannot have a Poisson ratio of {}",
                    "`poisson` between 0.3334 and 0.5, or `elastic: neo_hooke`, which takes 0 to 0.5"};
}

ShellLaw edge_spring() {
  return {.info = {.name = "edge_spring",
                   .title = "Elastic cortex: springs along the edges",
                   .equation = "E = ½ k (l − l0)², k = (√3/2) E_cor h",
                   .source = "Seung & Nelson 1988, doi:10.1103/PhysRevA.38.1005",
                   .parameters = {given_by_study("spring_stiffness", "tension", "nN/µm",
                                                 "Stiffness k of every edge, from Young's modulus and thickness.")},
                   .keys = {keys::in_cortex(keys::young()), keys::in_cortex(keys::thickness())}},
          .stencil = LawStencil::kEdge,
          .coefficients = {&P::spring_stiffness},
          .words = {{.word = "springs",
                     .doc = "a net of springs, Poisson ratio 1/3 whatever `poisson` says",
                     .build = [](const LawValues& v, P& p) { p.spring_stiffness += spring_of(v); },
                     .stiffness = &six_springs},
                    {.word = "springs_with_area",
                     .doc = "springs and the area of every face, Poisson ratio 1/3 to 1/2",
                     .in_membrane = false,
                     .resists_area = true,
                     .build =
                         [](const LawValues& v, P& p) {
                           const auto both = springs_with_area(v("young"), v("thickness"), v("poisson"));
                           p.spring_stiffness += both.spring_stiffness;
                           p.local_area_modulus += std::max(0.0, both.area_modulus);
                         },
                     .judge = &judge_springs_with_area,
                     .stiffness = &six_springs}}};
}

ShellLaw local_area() {
  return {.info = {.name = "local_area",
                   .title = "Elasticity of the area of every face",
                   .equation = "E = ½ K_a Σ (A − A0)² / A0",
                   .source = "Seifert 1997, doi:10.1080/00018739700101488; with springs: Seung & Nelson 1988",
                   .parameters = {given_by_study("local_area_modulus", "tension", "nN/µm",
                                                 "Modulus K_a; adds to the area modulus of the membrane.")},
                   .keys = {{"dcm.area", keys::local_area()}}},
          .stencil = LawStencil::kFace,
          .coefficients = {&P::local_area_modulus},
          .build = [](const LawValues& v, P& p) { p.local_area_modulus += v("local"); }};
}

ShellLaw global_area_law() {
  return {.info = {.name = "global_area",
                   .title = "Elasticity of the area of the whole surface",
                   .equation = "E = ½ K_G (A − A0)² / A0, A0 the sum over the faces at rest",
                   .source = "Seifert 1997, doi:10.1080/00018739700101488",
                   .parameters = {given_by_study("global_area_modulus", "tension", "nN/µm", "Modulus K_G of the total area.")},
                   .keys = {{"dcm.area", keys::global_area()}}},
          .stencil = LawStencil::kCell,
          .coefficients = {&P::global_area_modulus},
          .build = [](const LawValues& v, P& p) { p.global_area_modulus = v("global"); }};
}

ShellLaw cortex_turnover() {
  return {.info = {.name = "cortex_turnover",
                   .title = "Turnover of the cortex",
                   .equation = "l0 ← l + (l0 − l) exp(−Δt/τ) for every edge, after every step",
                   .source = "exponential replacement of a stressed network: Salbreux et al. 2012, doi:10.1016/j.tcb.2012.07.001",
                   .parameters = {given_by_study("turnover_rate", "rate", "1/s",
                                                 "1/τ; after τ 1/e of the elastic stress is left at constant shape.")},
                   .keys = {keys::in_cortex(keys::turnover())}},
          .stencil = LawStencil::kEdge,
          .conservative = false,
          .in_operator = false,
          .coefficients = {&P::turnover_rate},
          .build = [](const LawValues& v, P& p) { p.turnover_rate = 1.0 / v("turnover"); }};
}

ShellLaw edge_damper() {
  return {.info = {.name = "edge_damper",
                   .title = "Viscous cortex: dampers along the edges",
                   .equation = "F_i = −γ_int t tᵀ (v_i − v_j)",
                   .source = kCortex,
                   .parameters = {given_by_study("edge_damping", "friction", "nN·s/µm",
                                                 "Friction γ_int of every edge along itself; does not depend on the number of nodes.")},
                   .keys = {keys::in_cortex(keys::damping())}},
          .stencil = LawStencil::kEdge,
          .conservative = false,
          .coefficients = {&P::edge_damping},
          .build = [](const LawValues& v, P& p) { p.edge_damping = v("damping"); }};
}

ShellLaw isotropic_damper() {
  return {.info = {.name = "isotropic_damper",
                   .title = "Viscous cortex: dampers of edges in all directions",
                   .equation = "F_i = −γ_iso (v_i − v_j); resists rigid rotation",
                   .source = "Van Liedekerke et al. 2015, doi:10.1007/s40571-015-0082-3 (node–node friction)",
                   .parameters = {given_by_study(
                       "isotropic_damping", "friction", "nN·s/µm",
                       "Friction γ_iso of every edge in all directions; unlike `damping` it resists rigid rotation.")},
                   .keys = {keys::in_cortex(keys::isotropic_damping())}},
          .stencil = LawStencil::kEdge,
          .conservative = false,
          .coefficients = {&P::isotropic_damping},
          .build = [](const LawValues& v, P& p) { p.isotropic_damping = v("isotropic_damping"); }};
}

/// κ as given, or that of a plate.
double rigidity_of(const LawValues& v) {
  return v.has("rigidity") ? v("rigidity") : bending_modulus(v("young"), v("thickness"), v("poisson"));
}

std::vector<LawKey> bending_keys(std::vector<KeySpec> own = {}) {
  std::vector<LawKey> out = keys::layer();
  out.push_back({"dcm.bending", keys::rigidity()});
  for (KeySpec& key : own) out.push_back({"dcm.bending", std::move(key)});
  return out;
}

ShellLaw hinge_bending() {
  return {.info = {.name = "hinge_bending",
                   .title = "Bending of the cortex",
                   .equation = "E = ½ k_h (θ − θ0)², k_h = (2/√3) E_cor h³ / (12 (1 − ν²))",
                   .source = "Gompper & Kroll 1996, J. Phys. I France 6, 1305",
                   .parameters = {given_by_study("hinge_stiffness", "energy", "nN·µm",
                                                 "Stiffness k_h of every hinge, from Young's modulus, thickness and Poisson ratio.")},
                   .keys = bending_keys()},
          .stencil = LawStencil::kHinge,
          .coefficients = {&P::hinge_stiffness},
          .words = {{.of = LayerWord::Of::kBending,
                     .word = "hinge",
                     .doc = "springs at the edges with the angles of the sphere at rest",
                     .build = [](const LawValues& v, P& p) { p.hinge_stiffness += hinge_stiffness(rigidity_of(v)); },
                     .stiffness = [](const LawValues& v, double node_area,
                                     double edge_square) { return 46.0 * hinge_stiffness(rigidity_of(v)) / (node_area * edge_square); }}}};
}

std::vector<KeySpec> helfrich_keys() {
  return {
      {.name = "spontaneous_radius",
       .doc = "Of helfrich: the radius of the sphere that has no bending moment (c0 = 2/R; negative: bent inwards); `flat`: no spontaneous "
              "curvature.",
       .quantity = Quantity::kLength,
       .fallback = "flat",
       .low = -1e6,
       .high = 1e6,
       .specials = {{"flat", std::numeric_limits<double>::infinity()}},
       .example = "3 um",
       .source = "Helfrich 1973, doi:10.1515/znc-1973-11-1209"}};
}

std::optional<LawProblem> judge_helfrich(const LawValues& v, const P& p) {
  const double radius = v("spontaneous_radius");
  if (std::abs(radius) < 0.02)
    return LawProblem{302, "spontaneous_radius", "'spontaneous_radius' is {}, too small a sphere", "at least 0.02 um, or `flat`"};
  if (p.helfrich_rigidity > 0.0 && 2.0 / radius != p.spontaneous_curvature)
    return LawProblem{595, "spontaneous_radius", "the spontaneous curvature of the membrane is not that of the layer below",
                      "make them equal, or let the layer below have `law: hinge`"};
  return std::nullopt;
}

ShellLaw helfrich() {
  return {.info = {.name = "helfrich",
                   .title = "Bending after Helfrich, with the cotangent formula",
                   .equation = "E = ½ κ Σ a_i |g_i/a_i − c0 n_i|², g_i = ∂A/∂x_i",
                   .source = "Helfrich 1973, doi:10.1515/znc-1973-11-1209; Guckenberger & Gekle 2017, doi:10.1088/1361-648X/aa6313",
                   .parameters = {given_by_study("helfrich_rigidity", "energy", "nN·µm",
                                                 "Bending rigidity κ; that of a plate is E h³/(12 (1 − ν²))."),
                                  given_by_study("spontaneous_curvature", "curvature", "1/µm",
                                                 "Curvature c0 = 2H of the sheet at rest, > 0 for a sphere seen from outside.")},
                   .keys = bending_keys(helfrich_keys())},
          .stencil = LawStencil::kNode,
          .zero_in_reference = false,
          .coefficients = {&P::helfrich_rigidity, &P::spontaneous_curvature},
          .words = {{.of = LayerWord::Of::kBending,
                     .word = "helfrich",
                     .doc = "mean curvature by the cotangent formula, flat at rest or of `spontaneous_radius`",
                     .keys = helfrich_keys(),
                     .build =
                         [](const LawValues& v, P& p) {
                           p.helfrich_rigidity += rigidity_of(v);
                           p.spontaneous_curvature = 2.0 / v("spontaneous_radius");
                         },
                     .judge = &judge_helfrich,
                     .stiffness = [](const LawValues& v, double,
                                     double edge_square) { return 56.0 * rigidity_of(v) / (edge_square * edge_square); }}}};
}

ShellLaw cortical_tension() {
  return {.info = {.name = "cortical_tension",
                   .title = "Tension of the actomyosin cortex",
                   .equation = "E = γ A",
                   .source = "Fischer-Friedrich et al. 2014, doi:10.1038/srep06213",
                   .parameters = {given_by_study("tension", "tension", "nN/µm", "Tension γ of the cortex.")},
                   .keys = {keys::in_cortex(keys::tension())}},
          .stencil = LawStencil::kFace,
          .zero_in_reference = false,
          .coefficients = {&P::tension},
          .build = [](const LawValues& v, P& p) { p.tension = v("tension"); }};
}

ShellLaw volume_pressure() {
  return {.info = {.name = "volume_pressure",
                   .title = "Pressure of the cytoplasm",
                   .equation = "E = K_V [V ln(V/V0) − V + V0], p = −K_V ln(V/V0)",
                   .source = kCortex,
                   .parameters = {given_by_study("bulk_modulus", "pressure", "kPa", "Bulk modulus K_V of the cell.")},
                   .keys = {{"dcm", keys::bulk_modulus()}}},
          .stencil = LawStencil::kCell,
          .coefficients = {&P::bulk_modulus},
          .build = [](const LawValues& v, P& p) { p.bulk_modulus = v("bulk_modulus"); }};
}

ShellLaw bulk_viscosity() {
  return {.info = {.name = "bulk_viscosity",
                   .title = "Viscosity of the cell's volume",
                   .equation = "p = −η_V V̇/V",
                   .source = "Van Liedekerke et al. 2020, doi:10.1007/s10237-019-01204-7, with the rate of the volume",
                   .parameters = {given_by_study("bulk_viscosity", "viscosity", "kPa·s",
                                                 "Viscosity η_V; with the bulk modulus the volume relaxes with η_V/K_V.")},
                   .keys = {{"dcm", keys::bulk_viscosity()}}},
          .stencil = LawStencil::kCell,
          .conservative = false,
          .coefficients = {&P::bulk_viscosity},
          .build = [](const LawValues& v, P& p) { p.bulk_viscosity = v("bulk_viscosity"); }};
}

ShellLaw triangle_shape() {
  return {.info = {.name = "triangle_shape",
                   .title = "Resistance of triangles to collapse",
                   .equation = "E = k_s A_ref (1/q − 1)², q = 4√3 A / Σ l²",
                   .source = "choice of this project: regularises faces where the cortex has no shear stiffness",
                   .parameters = {given_by_study("shape_stiffness", "tension", "nN/µm", "Stiffness k_s per reference area.")},
                   .keys = {{"dcm", keys::shape_stiffness()}}},
          .stencil = LawStencil::kFace,
          .zero_in_reference = false,
          .coefficients = {&P::shape_stiffness},
          .build = [](const LawValues& v, P& p) {
            p.shape_stiffness = v.has("shape_stiffness") ? v("shape_stiffness") : shape_stiffness(v("tension"), v("sheet_modulus"));
          }};
}

ShellLaw dihedral_barrier() {
  return {.info = {.name = "dihedral_barrier",
                   .title = "Barrier against folding",
                   .equation = "E = k_d z² / (1 − z²), z = (|θ| − θ_b) / (π − θ_b) for |θ| > θ_b, else 0",
                   .source = "choice of this project: keeps the sign of contact gaps defined",
                   .parameters = {given_by_study("barrier_stiffness", "energy", "nN·µm", "Energy k_d of the barrier."),
                                  given_by_study("barrier_angle", "angle", "rad", "Turning angle θ_b where the barrier begins.")},
                   .keys = {{"dcm.fold_barrier", keys::barrier_stiffness()}, {"dcm.fold_barrier", keys::barrier_angle()}}},
          .stencil = LawStencil::kHinge,
          .coefficients = {&P::barrier_stiffness, &P::barrier_angle},
          .build = [](const LawValues& v, P& p) { p.barrier_stiffness = v("stiffness"), p.barrier_angle = v("angle"); }};
}

ShellLaw medium_friction() {
  return {.info = {.name = "medium_friction",
                   .title = "Friction against the medium",
                   .equation = "F_i = −γ_med a_i v_i, a_i = ⅓ Σ A_T over the faces around the node",
                   .source = kCortex,
                   .parameters = {given_by_study(
                       "medium_friction", "friction_per_area", "nN·s/µm³",
                       "Friction γ_med per area of the surface; not zero, or rigid motion would have no resistance.")},
                   .keys = {{"friction", keys::medium_friction()}}},
          .stencil = LawStencil::kNode,
          .conservative = false,
          .coefficients = {&P::medium_friction},
          .build = [](const LawValues& v, P& p) { p.medium_friction = v("medium"); }};
}

}  // namespace

const std::vector<ShellLaw>& shell_laws() {
  static const std::vector<ShellLaw> laws{
      edge_spring(),     neo_hooke(),      st_venant_kirchhoff(), skalak(),           local_area(),     global_area_law(),
      cortex_turnover(), edge_damper(),    isotropic_damper(),    hinge_bending(),    helfrich(),       cortical_tension(),
      volume_pressure(), bulk_viscosity(), triangle_shape(),      dihedral_barrier(), medium_friction()};
  return laws;
}

const ShellLaw& shell_law(std::string_view name) {
  const auto& laws = shell_laws();
  const auto at = std::find_if(laws.begin(), laws.end(), [&](const ShellLaw& law) { return law.info.name == name; });
  assert(at != laws.end());
  return *at;
}

}  // namespace morula::dcm
