// Membranes and edges: T2.1–T2.4 of dcm.md §2.
#include <cmath>

#include "core/mesh/topology.h"
#include "dcm/builtin.h"
#include "dcm/derived_parameters.h"
#include "dcm/laws/edge_damper.h"
#include "dcm/laws/edge_spring.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {
namespace {

constexpr double kSheet = kYoung * kThickness;
constexpr double kSpring = 0.173205, kDamping = 0.1;  // (√3/2) E h and γ_int of Table 1

dcm::ShellParameters one_law(const dcm::LawStrength& strength, double value) {
  dcm::ShellParameters p = nothing();
  strength.in(p) = value;
  return p;
}

/// T of −x·F = 2 T A on a sphere whose nodes have all moved outward by λ.
double tension_of_inflated_sphere(const dcm::ShellParameters& p, double stretch) {
  const dcm::Shells shells = sphere(162, Size::kNodes);
  const auto x = scaled(shells.position, stretch);
  return -dot_of(x, mechanics(shells, p, x).force) / (2.0 * geometry(shells, x).area[0]);
}

/// p λR/2 with the pressure p that holds it.
double tension_by_pressure(const dcm::ShellParameters& p, double stretch) {
  dcm::Shells shells = sphere(642, Size::kNodes);
  shells.position = scaled(shells.position, stretch);
  const auto push = volume_gradient(shells);
  return -dot_of(mechanics(shells, p).force, push) / dot_of(push, push) * stretch * kRadius / 2.0;
}

/// Six equilateral triangles around a node, once up and once down, sharing their border: a closed mesh that has the edges and faces of a lattice in
/// its proportion, so that its energy per area under a homogeneous strain is the lattice's.
dcm::Shells flat_hexagon() {
  TriangleMesh mesh;
  for (int k = 0; k < 6; ++k) mesh.position.push_back({std::cos(k * std::numbers::pi / 3.0), std::sin(k * std::numbers::pi / 3.0), 0.0});
  mesh.position.push_back({0, 0, 1});  // apart for now: a shape must have a volume
  mesh.position.push_back({0, 0, -1});
  for (std::uint32_t k = 0; k < 6; ++k) {
    mesh.faces.push_back({k, (k + 1) % 6, 6});
    mesh.faces.push_back({(k + 1) % 6, k, 7});
  }
  dcm::Shells out = shell_of(mesh);
  mesh.position[6] = mesh.position[7] = {};
  out.position = mesh.position;
  out.rest_length.assign(out.rest_length.size(), 1.0);
  return out;
}

struct Sheet {
  double young, poisson;
};

/// Tension and lateral strain of a sheet pulled by ±1 % with free sides.
Sheet pulled_sheet(dcm::ShellParameters p) {
  p.barrier_angle = 4.0;  // the border is folded by π
  const dcm::Shells sheet = flat_hexagon();
  const double area = 12.0 * 0.25 * std::numbers::sqrt3;
  const auto stress = [&](double a, double b, double Vec3d::*along, double stretch) {  // (1/A0) ∂E/∂λ
    std::vector<Vec3d> x = sheet.position;
    for (Vec3d& v : x) v = {a * v.x, b * v.y, 0.0};
    const auto force = mechanics(sheet, p, x).force;
    double virial = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) virial -= x[i].*along * force[i].*along;
    return virial / (stretch * area);
  };
  const auto free_side = [&](double a) {  // secant for the λ_y without stress
    double b = 1.0, before = 0.99, at_before = stress(a, before, &Vec3d::y, before);
    for (int k = 0; k < 12; ++k) {
      const double at = stress(a, b, &Vec3d::y, b);
      if (at == at_before) break;
      const double next = b - at * (b - before) / (at - at_before);
      before = b, at_before = at, b = next;
    }
    return b;
  };
  constexpr double strain = 0.01;
  const double narrow = free_side(1.0 + strain), wide = free_side(1.0 - strain);
  return {(stress(1.0 + strain, narrow, &Vec3d::x, 1.0 + strain) - stress(1.0 - strain, wide, &Vec3d::x, 1.0 - strain)) / (2.0 * strain),
          (wide - narrow) / (2.0 * strain)};
}

/// Extension of one edge with its damper after `time` under 0.01 nN, in explicit steps of τ/200 [µm].
double creep_of_an_edge(double times_tau) {
  const dcm::EdgeSpring<double> spring{kSpring};
  const dcm::EdgeDamper<double> damper{kDamping};
  const double force = 0.01, rest = 1.8, dt = kDamping / kSpring / 200.0;
  const Vec3d direction = normalized(Vec3d{1.0, -2.0, 0.5});
  const double friction = dot(direction, damper.friction(direction) * direction);
  double length = rest;
  for (int step = 0; step < std::lround(200.0 * times_tau); ++step) length += dt * (force - spring.slope(length, rest)) / friction;
  return length - rest;
}

/// Largest force that any membrane exerts after a rotation by 1 rad [nN].
double force_after_rotation() {
  const dcm::Shells shells = sphere(162, Size::kVolume);
  const double c = std::cos(1.0), s = std::sin(1.0);
  std::vector<Vec3d> x = shells.position;
  for (Vec3d& v : x) v = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
  double most = 0.0;
  for (const char* law : {"edge_spring", "neo_hooke", "skalak", "st_venant_kirchhoff", "local_area"})
    for (const Vec3d& f : mechanics(shells, one_law(dcm::shell_law(law).strength(), kSheet), x).force) most = larger(most, norm(f));
  return most;
}

void add_inflation(std::vector<ReferenceNumber>& out) {
  struct Law {
    const char* name;
    dcm::LawStrength shear;
    double at_1_1, at_1_3, digits, most;
    const char* source;
  };
  for (const Law& law : {Law{"neo-Hookean", dcm::shell_law("neo_hooke").strength(), 0.029035, 0.052855, 5e-7, 1.3, "closed form, dcm.md 2"},
                         Law{"Skalak", dcm::shell_law("skalak").strength(), 0.051437, 0.255121, 5e-7, 1.3,
                             "Skalak et al. 1973, doi:10.1016/S0006-3495(73)85983-1"},
                         Law{"St Venant-Kirchhoff", dcm::shell_law("st_venant_kirchhoff").strength(), 0.0420, 0.1380, 5e-5, 1.2999999,
                             "closed form, dcm.md 2"}}) {
    const dcm::ShellParameters p = one_law(law.shear, dcm::sheet_shear_modulus(kYoung, kThickness, kPoisson));
    const std::string name = std::string(", ") + law.name + " membrane [nN/um]";
    out.push_back({"T2.1", "tension at a stretch of 1.1 in all directions" + name, law.at_1_1, law.digits, law.source,
                   [p] { return tension_of_inflated_sphere(p, 1.1); }});
    // the St Venant–Kirchhoff membrane is held to stretches up to 1.3
    const double most = law.most;
    out.push_back({"T2.1", "tension at a stretch of 1.3 in all directions" + name, law.at_1_3, law.digits, law.source,
                   [p, most] { return tension_of_inflated_sphere(p, most); }});
    out.push_back({"T2.1", "p R/2 of a sphere of 642 nodes inflated by 1.1" + name, law.at_1_1, 0.0035 * law.at_1_1 + law.digits,
                   "Laplace's law; dcm.md: 0.35 %", [p] { return tension_by_pressure(p, 1.1); }});
  }
}

void add_sheets(std::vector<ReferenceNumber>& out) {
  const auto add = [&](const std::string& name, const dcm::ShellParameters& p, double poisson, const char* source) {
    out.push_back({"T2.2", "tension over strain of a sheet of " + name + ", E h [nN/um]", kSheet, 0.01 * kSheet, source,
                   [p] { return pulled_sheet(p).young; }});
    out.push_back({"T2.2", "Poisson ratio of a sheet of " + name, poisson, 0.01, source, [p] { return pulled_sheet(p).poisson; }});
  };
  add("springs", one_law(&dcm::ShellParameters::spring_stiffness, dcm::spring_stiffness(kYoung, kThickness)), 1.0 / 3.0,
      "Seung & Nelson 1988, doi:10.1103/PhysRevA.38.1005; dcm.md: 1 %");
  add("neo-Hookean membrane", one_law(dcm::shell_law("neo_hooke").strength(), dcm::sheet_shear_modulus(kYoung, kThickness, kPoisson)), 0.5,
      "closed form; dcm.md: 1 %");
  const auto half = dcm::springs_with_area(kYoung, kThickness, kPoisson);
  dcm::ShellParameters both = one_law(&dcm::ShellParameters::spring_stiffness, half.spring_stiffness);
  both.local_area_modulus = half.area_modulus;
  add("springs with area elasticity", both, 0.5, "closed form; dcm.md: 1 %");
}

}  // namespace

void add_membrane_numbers(std::vector<ReferenceNumber>& out) {
  add_inflation(out);
  add_sheets(out);
  for (const double times : {1.0, 3.0}) {
    const double exact = 0.01 / kSpring * (1.0 - std::exp(-times));
    out.push_back({"T2.3",
                   "extension of an edge with its damper under 0.01 nN after " + std::to_string(static_cast<int>(times)) + " tau [um]",
                   exact, 0.01 * exact, "closed form (f/k) (1 - exp(-t/tau)); dcm.md: 1 % at steps of tau/200",
                   [times] { return creep_of_an_edge(times); }});
  }
  out.push_back({"T2.4", "largest force of any membrane after a rotation by 1 rad [nN]", 0.0, 1e-12, "closed form",
                 [] { return force_after_rotation(); }});
}

}  // namespace morula::scenarios
