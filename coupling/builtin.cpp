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

std::vector<LawInfo> load_laws() {
  const LawParameter part = given_by_study("part", "number", "1", "Part of the nodes, at an end of the axis.");
  return {
      {.name = "traction",
       .title = "Stress of two opposed beams (optical stretcher)",
       .equation = "F_T = s0 cos²θ A_T n_T, θ between the axis and the way from the cell's centroid to the face's",
       .source = "Guck et al. 2001, doi:10.1016/S0006-3495(01)75740-2",
       .parameters = {given_by_study("stress", "pressure", "kPa", "Peak stress s0, on the axis.")}},
      {.name = "pull",
       .title = "Pull at both ends of a cell (optical tweezers)",
       .equation = "F_i = ±F a/m on the m nodes of an end of the axis a",
       .source = "Dao, Lim & Suresh 2003, doi:10.1016/j.jmps.2003.09.019",
       .parameters = {given_by_study("force", "force", "nN", "F at each end."), part}},
      {.name = "patch",
       .title = "Force on a part of a surface",
       .equation = "F_i = F/m on the m nodes of a side of the cell (m = 1: a point force), or F_T = F A_T/A on the marked faces",
       .source = kOurs,
       .parameters = {given_by_study("force", "force", "nN", "Size of F."), part}},
      {.name = "pressure",
       .title = "Pressure on a cell, on its ends or on marked faces",
       .equation = "F_T = −p A_T n_T, p = p0 + g·(x_T − x0) at the middle x_T of the face",
       .source = kOurs,
       .parameters = {given_by_study("pressure", "pressure", "kPa", "p0, against the outward normal."),
                      given_by_study("gradient", "pressure per length", "kPa/µm", "Size of the gradient g."), part}},
      {.name = "grip",
       .title = "Springs that hold or move the ends of a cell",
       .equation = "E = ½ K/m Σ |x_i − X_i(t)|² over the m nodes of an end; X_i: where they are on the undeformed cell at the grip's place",
       .source = kOurs,
       .parameters = {given_by_study("stiffness", "tension", "nN/µm", "K of the springs of an end together."), part}},
      {.name = "body_force",
       .title = "Force on whole cells",
       .equation = "F_i = F a_i/A, a_i the area of node i",
       .source = kOurs,
       .parameters = {given_by_study("force", "force", "nN", "Size of F on each cell.")}}};
}

}  // namespace morula
