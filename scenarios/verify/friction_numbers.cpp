// Friction matrix and explicit steps: T1.1–T1.4 of dcm.md §1.
#include <cmath>

#include "dcm/builtin.h"
#include "dcm/derived_parameters.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {
namespace {

/// Velocities of a cell of 642 nodes without elasticity under 1 nN along x that is spread by area, after one step of 1 s [µm/s].
std::vector<Vec3d> velocities_under_even_force() {
  Model model = lone_cell_model();
  model.types[0].shell = nothing();
  model.types[0].shell.edge_damping = 0.1;
  model.types[0].shell.medium_friction = kMedium;
  solve_tightly(model);
  LoneCell cell(model, 642, Size::kNodes);
  const SurfaceGeometry at = geometry(cell.tissue.shells);
  std::vector<Vec3d> force;
  for (const double area : at.node_area) force.push_back({area / at.area[0], 0.0, 0.0});
  const std::vector<Vec3d> start = cell.tissue.shells.position;
  if (!cell.step(1.0, force)) return all_alike(start.size(), {NAN, NAN, NAN});
  return plus(cell.tissue.shells.position, start, -1.0);
}

double largest_deviation(const std::vector<Vec3d>& v) {
  const Vec3d mean = sum_of(v) * (1.0 / static_cast<double>(v.size()));
  double most = 0.0;
  for (const Vec3d& each : v) most = larger(most, norm(each - mean) / norm(mean));
  return most;
}

LoneFriction damped_sphere(double medium) {
  dcm::ShellParameters p = nothing();
  p.edge_damping = 0.1;
  p.medium_friction = medium;
  return {rough(sphere(162, Size::kNodes)), p};
}

/// |Γ_nn v| of a rigid rotation over |Γ_nn| |v|; |Γ_nn| is at least what a random vector shows of it.
double friction_of_a_rotation() {
  const LoneFriction dampers = damped_sphere(0.0);
  const auto& x = dampers.shells().position;
  const auto rotation = turning(x, {0.3, -0.5, 0.8}), any = random_directions(x.size(), 2);
  return norm_of(dampers.times(rotation)) / norm_of(rotation) / (norm_of(dampers.times(any)) / norm_of(any));
}

double asymmetry_of_friction() {
  const LoneFriction friction = damped_sphere(kMedium);
  const auto a = random_directions(162, 3), b = random_directions(162, 4);
  const auto image = friction.times(a);
  return std::abs(dot_of(b, image) - dot_of(a, friction.times(b))) / (norm_of(b) * norm_of(image));
}

/// Smallest eigenvalue of Γ_med⁻¹ Γ, by power iteration of 5 − Γ_med⁻¹ Γ (the largest is about 4, as cond(Γ) in dcm.md §1): rigid motion feels the
/// medium alone, all else more.
double least_friction_over_the_medium() {
  const LoneFriction friction = damped_sphere(kMedium);
  const auto area = geometry(friction.shells()).node_area;
  std::vector<Vec3d> v = random_directions(162, 5);
  double least = 0.0;
  for (int k = 0; k < 3000; ++k) {
    auto image = friction.times(v);
    double drag = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) drag += kMedium * area[i] * norm2(v[i]);
    least = dot_of(v, image) / drag;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = v[i] * 5.0 - image[i] * (1.0 / (kMedium * area[i]));
    v = scaled(v, 1.0 / norm_of(v));
  }
  return least;
}

/// 2/λ_max(Γ⁻¹ K) in the medium alone, by power iteration with directional derivatives of the force [s].
double largest_explicit_step(std::uint32_t nodes, const dcm::ShellParameters& p) {
  const dcm::Shells shells = sphere(nodes, Size::kNodes);
  const auto area = geometry(shells).node_area;
  const double h = 1e-4;
  auto d = random_directions(shells.position.size(), 6);
  double eigenvalue = 0.0;
  for (int k = 0; k < 150; ++k) {
    d = scaled(d, 1.0 / norm_of(d));
    const auto ahead = mechanics(shells, p, plus(shells.position, d, h)).force;
    const auto behind = mechanics(shells, p, plus(shells.position, d, -h)).force;
    double work = 0.0, drag = 0.0;
    for (std::size_t i = 0; i < d.size(); ++i) {
      const Vec3d stiffness = (behind[i] - ahead[i]) * (0.5 / h);
      work += dot(d[i], stiffness);
      drag += kMedium * area[i] * norm2(d[i]);
      d[i] = stiffness * (1.0 / (kMedium * area[i]));
    }
    eigenvalue = work / drag;
  }
  return 2.0 / eigenvalue;
}

void add_explicit_steps(std::vector<ReferenceNumber>& out) {
  struct Law {
    const char* name;
    dcm::LawStrength strength;
    double value, step_162, step_642;
  };
  const double shear = dcm::sheet_shear_modulus(kYoung, kThickness, kPoisson);
  for (const Law& law : {Law{"springs", &dcm::ShellParameters::spring_stiffness, 0.173205, 0.540, 0.131},
                         Law{"neo-Hookean membrane", dcm::shell_law("neo_hooke").strength(), shear, 0.432, 0.104},
                         Law{"Skalak's membrane", dcm::shell_law("skalak").strength(), shear, 0.432, 0.104},
                         Law{"tension", &dcm::ShellParameters::tension, kTension, 0.191, 0.0449},
                         Law{"pressure", &dcm::ShellParameters::bulk_modulus, kBulk, 0.162, 0.161},
                         Law{"hinges", &dcm::ShellParameters::hinge_stiffness, 1.0264e-3, 42.8, 2.52},
                         Law{"Helfrich bending", &dcm::ShellParameters::helfrich_rigidity, 8.8889e-4, 54.1, 2.87}})
    for (const auto& [nodes, step] : {std::pair{162u, law.step_162}, std::pair{642u, law.step_642}}) {
      dcm::ShellParameters p = nothing();
      law.strength.in(p) = law.value;
      out.push_back({"T1.4", std::string("longest stable explicit step, ") + law.name + " alone, " + std::to_string(nodes) + " nodes [s]",
                     step, 0.05 * step, "computed independently on the same mesh; dcm.md asks for 5 %",
                     [nodes = nodes, p] { return largest_explicit_step(nodes, p); }});
    }
}

}  // namespace

void add_friction_numbers(std::vector<ReferenceNumber>& out) {
  out.push_back({"T1.1", "velocity of a cell under 1 nN spread by area, 642 nodes [um/s]", 1.0 / 45.023, 5e-4 / 45.023,
                 "F/(gamma A); A of the mesh computed independently, five digits",
                 [] { return sum_of(velocities_under_even_force()).x / 642.0; }});
  out.push_back({"T1.1", "largest difference of a node's velocity from the mean, relative", 0.0, 1e-10, "dcm.md: rigid translation",
                 [] { return largest_deviation(velocities_under_even_force()); }});
  out.push_back({"T1.2", "friction of the dampers with a rigid rotation over that with any motion", 0.0, 1e-12,
                 "dcm.md: dampers along the edges", [] { return friction_of_a_rotation(); }});
  out.push_back(
      {"T1.3", "asymmetry of the friction of a shell, relative", 0.0, 1e-12, "dcm.md: symmetric", [] { return asymmetry_of_friction(); }});
  out.push_back({"T1.3", "least friction of any motion over that of the medium alone, which is that of rigid motion", 1.0, 1e-3,
                 "closed form: positive definite", [] { return least_friction_over_the_medium(); }});
  add_explicit_steps(out);
}

}  // namespace morula::scenarios
