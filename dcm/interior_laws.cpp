#include "dcm/interior_laws.h"

#include "dcm/interior.h"

namespace morula::dcm {
namespace {

constexpr auto kOurs = "choice of this project";
constexpr auto kNucleus = "Van Liedekerke et al. 2020, doi:10.1007/s10237-019-01204-7";

LawInfo repulsion() {
  return {.name = "nucleus_contact",
          .title = "A rigid nucleus meets the cortex from inside",
          .equation = "U(g) per area of the cortex: ½ k_r g² (g < 0), g = |x − X| − R_n, 4π R_n³/3 = f V_target; k_r as between surfaces",
          .source = kNucleus,
          .parameters = {{"nucleus_fraction", "fraction", "1", 0.0, 0.0, 0.512, kNucleus,
                          "Volume f of the nucleus in parts of the cell's; 0: no nucleus."}}};
}

LawInfo shell_contact() {
  return {
      .name = "nuclear_shell_contact",
      .title = "A nucleus that is a shell meets the cortex from inside",
      .equation = "U(g) per area of either surface, half of each: ½ k_r g² (g < 0), g the distance of the surfaces; V_rest = f V_target",
      .source = kNucleus,
      .parameters = {{"nucleus_fraction", "fraction", "1", 0.0, 0.0, 0.512, kNucleus, "Volume f of the nucleus in parts of the cell's."}}};
}

LawInfo cytosol() {
  return {
      .name = "cytosol_pressure",
      .title = "The pressure of a cell is that of its cytosol, which presses on the nucleus, too",
      .equation = "p = −K_V ln((V − V_n)/((1 − f) V0)); force p ∂V/∂x on the cortex, −p ∂V_n/∂x on a nucleus that is a shell",
      .source = kOurs,
      .parameters = {{"nucleus_fraction", "fraction", "1", 0.0, 0.0, 0.512, kNucleus, "Volume f of the nucleus in parts of the cell's."}}};
}

LawInfo drag() {
  return {.name = "cytoplasm_drag",
          .title = "The cytoplasm drags on the nucleus",
          .equation = "F = −6π η R_n (V_n − v̄), v̄ = Σ a_i v_i/A of the cortex, which feels the opposite, spread by area",
          .source = "Stokes 1851, Trans. Camb. Phil. Soc. 9, 8",
          .parameters = {{"cytoplasm_viscosity", "viscosity", "kPa·s", InteriorParameters{}.cytoplasm_viscosity, 0.0, 1e6, kOurs,
                          "Viscosity η of the cytoplasm."}}};
}

LawInfo links(const char* name, const char* title, const char* doc) {
  return {
      .name = name,
      .title = title,
      .equation = "F = [k_l (ℓ − ℓ0) + c_l dℓ/dt] t; ℓ0 of the undeformed cell, growing as V_target^(1/3); tension_only: none for ℓ < ℓ0",
      .source = kNucleus,
      .parameters = {{"number", "number", "1", std::nullopt, 1.0, 2562.0, kOurs, doc},
                     {"stiffness", "tension", "nN/µm", std::nullopt, 0.0, 1e4, kOurs, "Spring constant k_l of a link."},
                     {"damping", "friction", "nN·s/µm", 0.0, 0.0, 1e4, kOurs, "Friction c_l of a link, along itself."}}};
}

}  // namespace

std::vector<LawInfo> interior_laws() {
  return {
      repulsion(),
      shell_contact(),
      cytosol(),
      drag(),
      links("nucleus_links", "Cytoskeleton: links from the cortex to the nucleus: to its centre, or to the nodes of one that is a shell",
            "How many nodes have a link."),
      links("cortex_links", "Cytoskeleton: links across the cell", "How many pairs of opposite nodes have a link.")};
}

}  // namespace morula::dcm
