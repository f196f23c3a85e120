#include "coupling/builtin.h"

namespace morula {
namespace {

constexpr const char* kReview = "Van Liedekerke et al. 2020, doi:10.1007/s10237-019-01204-7";

LawInfo tension_law() {
  return {.name = "regional_tension",
          .title = "Cortical tension by region of the surface and in time",
          .equation =
              "E = Σ γ_T A_T; γ_T = (1 − φ) γ_mark(t) + φ γ_lateral(t), γ(t) = γ·course(t)·(1 + a sin(2πt/T + φ_0)), dφ/dt = (contact − "
              "φ)/τ; of "
              "surfaces that bear no difference of tension φ = 0 and W + (γ − γ_lateral)_a + (γ − γ_lateral)_b ≥ 0 in place of W",
          .source = "choice of this project; the area gradient ½ n×e is that of cortical_tension",
          .parameters = {given_by_study("tension", "tension", "nN/µm", "γ of the faces with the region's mark."),
                         given_by_study("amplitude", "number", "1", "a of the modulation."),
                         given_by_study("period", "time", "s", "T of the modulation."),
                         given_by_study("lateral_easing", "time", "s", "τ in which faces in contact take the lateral tension.")}};
}

LawInfo lumen_law() {
  return {.name = "lumen_pressure",
          .title = "Fluid of a cavity between cells",
          .equation =
              "F_c = ⅓ P A_T (⟨n⟩ − n_T) on the faces that look into it, P ∫ n dA over what is seen of a sphere, n out of the cavity; ⟨n⟩ "
              "= (Σ A n − Σ ∫ n dA)/Σ A; P given, or P = R T n/V with the amount n kept",
          .source = "van 't Hoff 1887; faces by sight from a point; zero net force: choice of this project",
          .parameters = {given_by_study("pressure", "pressure", "kPa", "P, or that of the beginning where the solute is kept.")}};
}

LawInfo spring_law() {
  return {.name = "apical_spring",
          .title = "Spring and damper towards the mean sphere of marked faces",
          .equation =
              "F_i = −A_i [µ (v_i − V − Ω × r_i − s r̂_i) + k (|x_i − X| − R) r̂_i − m], r_i = x_i − X, X, R: mean centre and radius now; m: "
              "so that "
              "the sum is zero; V, Ω, s: common motion and mean radial speed, for which Σ A v² of what is left is least",
          .source = kReview,
          .parameters = {given_by_study("stiffness", "pressure per length", "kPa/µm", "k per marked area."),
                         given_by_study("friction", "friction per area", "nN·s/µm³", "µ per marked area.")}};
}

LawInfo fluctuation_law() {
  return {.name = "fluctuations",
          .title = "Fluctuations that belong to the friction",
          .equation =
              "⟨f fᵀ⟩ = (2 k_B T/Δt) Γ, element by element: medium, edges, volume, contacts; a mode of relaxation time τ has the variance "
              "(k_B T/k)/(1 + Δt/(2τ))",
          .source = "Kubo 1966, doi:10.1088/0034-4885/29/1/306",
          .parameters = {given_by_study("energy", "energy", "nN·µm", "k_B T of an effective temperature."),
                         given_by_study("resolve", "time", "s", "Shortest τ whose variance shall be right: Δt ≤ 0.06 τ.")}};
}

LawInfo protrusion_law() {
  return {.name = "protrusion",
          .title = "Protrusion at the leading edge",
          .equation =
              "f_i = F w_i p/Σw at the front, w_i = a_i (cos θ_i − cos α)₊, θ_i from the polarity, on a substrate along it; F = F_p min(1, "
              "A_contact/A_ref); "
              "reaction outside, or on the rear",
          .source = kReview,
          .parameters = {given_by_study("force", "force", "nN", "F_p."), given_by_study("angle", "angle", "rad", "α."),
                         given_by_study("contact_area", "area", "µm²", "A_ref; 0: F = F_p.")}};
}

LawInfo friction_law() {
  return {.name = "directed_medium_friction",
          .title = "Friction with the medium across and along the surface",
          .equation = "F_i = −a_i [γ_n n nᵀ + γ_t (I − n nᵀ)] v_i; a sphere has (γ_n + 2γ_t)/3",
          .source = kReview,
          .parameters = {given_by_study("normal", "friction per area", "nN·s/µm³", "γ_n."),
                         given_by_study("tangential", "friction per area", "nN·s/µm³", "γ_t.")}};
}

}  // namespace

std::vector<LawInfo> active_laws() {
  return {tension_law(), lumen_law(), spring_law(), fluctuation_law(), protrusion_law(), friction_law()};
}

}  // namespace morula
