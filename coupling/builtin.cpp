#include "coupling/builtin.h"

#include "coupling/model.h"

namespace morula {
namespace {

constexpr const char* kOurs = "choice of this project";

}  // namespace

std::vector<LawInfo> surface_contact_terms() {
  return {
      {.name = "contact_pair",
       .title = "Adhesion and friction of a pair",
       .equation = "F_friction = −(γ_n n nᵀ + γ_t (1 − n nᵀ)) A (v_i − v_j)",
       .source = "Van Liedekerke et al. 2020, doi:10.1007/s10237-019-01204-7",
       .parameters = {given_by_study("adhesion", "tension", "nN/µm", "Adhesion energy W per contact area of the pair."),
                      given_by_study("normal_friction", "friction per area", "nN·s/µm³", "γ_n per contact area."),
                      given_by_study("tangential_friction", "friction per area", "nN·s/µm³", "γ_t per contact area.")}},
      {.name = "sphere_foundation",
       .title = "A sphere against a shell",
       .equation =
           "t = k_w g at depth g, k_w = s 4E′/(3π a_ref), E′ = E/(1 − ν²), a_ref = a_0/3 with a_0³ = 9πWR²/(4E′), and from a_0 < 0.3 R on "
           "0.3 R − 2a_0/3; adhesion w W",
       .source = "foundation: the share of one body in the approach of JKR (decision 0009); s and w: fitted to pairs of both bodies "
                 "(decision 0066), or 1",
       .parameters = {given_by_study("young", "pressure", "kPa", "Young's modulus of the sphere."),
                      given_by_study("poisson", "number", "1", "Poisson's ratio of the sphere."),
                      given_by_study("stiffness", "number", "1", "Factor s on the stiffness of the foundation."),
                      given_by_study("adhesion_factor", "number", "1", "Factor w on W.")}},
      {.name = "regional_adhesion",
       .title = "Adhesion by part of the surface",
       .equation =
           "W(T, y) = Σ_j μ_j ⟨W(marks of T, marks of T')⟩_j over the faces T' around the corners j of the nearest face; U_a goes with W",
       .source = "choice of this project: no jump where the nearest point crosses the border of a region",
       .parameters = {given_by_study("adhesion", "tension", "nN/µm", "W of faces with these marks.")}},
      {.name = "objective_friction",
       .title = "Contact friction without common rotations",
       .equation = "u = v_x − v_y − ½ g (ṅ_y − ṅ_x), ṅ = −Σ_c (n×e_c)(n·v_c)/(2A); Γ = Σ Jᵀ D J with u = J v",
       .source = "choice of this project: exact for opposed parallel faces",
       .parameters = {}},
      {.name = "self_contact",
       .title = "A surface against itself",
       .equation = "U_r(|g| − d) ½ by both sides, faces apart by more than the range along the surface; the sign of g never changes",
       .source = "choice of this project",
       .parameters = {given_by_study("self_contact", "length", "µm", "Distance d at which two parts of a surface touch.")}}};
}

}  // namespace morula
