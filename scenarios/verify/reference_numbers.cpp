#include "scenarios/verify/reference_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "cbm/laws/jkr.h"
#include "cbm/laws/sphere_caps.h"
#include "cbm/packing.h"
#include "core/mesh/surface_geometry.h"
#include "dcm/blocks.h"
#include "dcm/derived_parameters.h"
#include "dcm/growth.h"
#include "dcm/internal_forces.h"
#include "dcm/laws/volume_pressure.h"

namespace morula::scenarios {
namespace {

constexpr double kRadius = 6.0, kYoung = 1.0, kThickness = 0.2, kPoisson = 0.5, kTension = 0.5, kBulk = 2.5;
constexpr const char* kClosedForm = "closed form";
constexpr const char* kIndependent = "computed independently on the same mesh";
constexpr const char* kJkr = "Johnson, Kendall & Roberts 1971, doi:10.1098/rspa.1971.0141";

double ball(double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

/// One icosphere: nodes on the sphere of radius 6, or the mesh enclosing its volume.
dcm::Shells sphere(std::uint32_t nodes, bool nodes_on_sphere) {
  ShapeLibrary shapes;
  dcm::Shells out;
  const auto shape = shapes.icosphere(nodes).value();
  const double size = std::cbrt(ball(kRadius));
  for (const Vec3d& p : shape->position) out.position.push_back(nodes_on_sphere ? normalized(p) * kRadius : p * size);
  for (const double length : shape->edge_length) out.rest_length.push_back(size * length);
  out.velocity.resize(out.position.size());
  out.first_node.push_back(static_cast<std::uint32_t>(out.position.size()));
  out.first_edge.push_back(static_cast<std::uint32_t>(out.rest_length.size()));
  out.reference_volume.push_back(ball(kRadius));
  out.rest_volume.push_back(ball(kRadius));
  out.type.push_back(0);
  out.shape.push_back(shape);
  return out;
}

dcm::ShellMechanics mechanics(const dcm::Shells& shells, const dcm::ShellParameters& parameters) {
  dcm::ShellMechanics out;
  const std::vector<dcm::ShellParameters> types{parameters};
  dcm::internal_forces(dcm::make_shell_blocks(shells), shells, types, shells.position, out);
  return out;
}

SurfaceGeometry geometry(const dcm::Shells& shells) {
  const std::vector<const Topology*> topology{shells.shape[0]->topology.get()};
  SurfaceGeometry out;
  compute_surface_geometry({topology, shells.first_node, dcm::make_shell_blocks(shells).first_face}, shells.position, out);
  return out;
}

dcm::ShellParameters nothing() {
  dcm::ShellParameters p;
  p.spring_stiffness = p.edge_damping = p.hinge_stiffness = p.tension = p.bulk_modulus = p.shape_stiffness = p.barrier_stiffness =
      p.medium_friction = 0.0;
  return p;
}

/// ∂V/∂x of a mesh: the force of a pressure 1.
std::vector<Vec3d> volume_gradient(dcm::Shells shells) {
  shells.reference_volume[0] = geometry(shells).volume[0] * std::numbers::e;
  dcm::ShellParameters p = nothing();
  p.bulk_modulus = 1.0;
  return mechanics(shells, p).force;
}

double dot_of(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  double out = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) out += dot(a[i], b[i]);
  return out;
}

double hinge_energy_over_helfrich(std::uint32_t nodes) {
  dcm::Shells shells = sphere(nodes, false);
  auto flat = std::make_shared<ReferenceShape>(*shells.shape[0]);
  std::fill(flat->hinge_angle.begin(), flat->hinge_angle.end(), 0.0);
  shells.shape[0] = flat;
  dcm::ShellParameters p = nothing();
  p.hinge_stiffness = dcm::hinge_stiffness(kYoung, kThickness, kPoisson);
  return mechanics(shells, p).energy[0] / (8.0 * std::numbers::pi * dcm::bending_modulus(kYoung, kThickness, kPoisson));
}

double laplace_pressure(std::uint32_t nodes) {
  const dcm::Shells shells = sphere(nodes, true);
  dcm::ShellParameters p = nothing();
  p.tension = kTension;
  const auto push = volume_gradient(shells);
  return -dot_of(mechanics(shells, p).force, push) / dot_of(push, push);
}

/// (K_V/V) gᵀ Γ⁻¹ g, g = ∂V/∂x: rate of the breathing mode in a medium of 0.1 nN·s/µm³.
double breathing_rate(std::uint32_t nodes) {
  const dcm::Shells shells = sphere(nodes, true);
  const SurfaceGeometry g = geometry(shells);
  const auto gradient = volume_gradient(shells);
  double rate = 0.0;
  for (std::size_t i = 0; i < gradient.size(); ++i) rate += norm2(gradient[i]) / (0.1 * g.node_area[i]);
  return kBulk / g.volume[0] * rate;
}

/// Tension of a spring lattice stretched by 2^(1/3): −x·F = 2 τ A.
double tension_of_stretched_springs() {
  dcm::Shells shells = sphere(2562, false);
  dcm::ShellParameters p = nothing();
  p.spring_stiffness = dcm::spring_stiffness(kYoung, kThickness);
  for (Vec3d& x : shells.position) x *= std::cbrt(2.0);
  return -dot_of(mechanics(shells, p).force, shells.position) / (2.0 * geometry(shells).area[0]);
}

cbm::PairLaw<double> reference_pair() { return cbm::make_pair_law(cbm::ContactMaterial::elastic(0.45, 0.4, 0.45, 0.4, 0.1), 5.0, 5.0); }

void add_shells(std::vector<ReferenceNumber>& out) {
  out.push_back({"dcm 0", "stiffness of the springs, E 1 kPa, h 0.2 um [nN/um]", 0.173205, 5e-7,
                 "Seung & Nelson 1988, doi:10.1103/PhysRevA.38.1005", [] { return dcm::spring_stiffness(kYoung, kThickness); }});
  out.push_back({"dcm 0", "bending rigidity of the cortex, Poisson ratio 0.5 [nN um]", 8.8889e-4, 5e-9, kClosedForm,
                 [] { return dcm::bending_modulus(kYoung, kThickness, kPoisson); }});
  out.push_back({"dcm 0", "stiffness of the hinges [nN um]", 1.02640e-3, 5e-9, kClosedForm,
                 [] { return dcm::hinge_stiffness(kYoung, kThickness, kPoisson); }});
  struct PerMesh {
    std::uint32_t nodes;
    double volume, hinge, laplace, rate;
  };
  for (const PerMesh& m : {PerMesh{162, 0.96616, 0.3449, 0.168954, 12.31}, PerMesh{642, 0.99139, 0.3448, 0.167236, 12.45},
                           PerMesh{2562, 0.99784, 0.3452, 0.166809, 12.49}}) {
    const std::string at = ", " + std::to_string(m.nodes) + " nodes";
    const std::uint32_t n = m.nodes;
    out.push_back({"dcm 0", "volume of the mesh over that of its sphere" + at, m.volume, 5e-6, kIndependent,
                   [n] { return geometry(sphere(n, true)).volume[0] / ball(kRadius); }});
    out.push_back({"T3", "hinge energy of a sphere with flat rest angles over 8 pi kappa" + at, m.hinge, 6e-5, kIndependent,
                   [n] { return hinge_energy_over_helfrich(n); }});
    out.push_back({"T4.1", "pressure that holds a sphere of tension 0.5 nN/um (2 gamma/R = 0.166667) [kPa]" + at, m.laplace, 1e-6,
                   kIndependent, [n] { return laplace_pressure(n); }});
    out.push_back({"T5.5", "rate of the breathing mode [1/s]" + at, m.rate, 6e-3, kIndependent, [n] { return breathing_rate(n); }});
  }
  out.push_back({"T4.1", "pressure that holds a sphere of tension 0.5 nN/um against Laplace's, 2562 nodes [kPa]", 2.0 * kTension / kRadius,
                 5e-3 * 2.0 * kTension / kRadius, "Laplace's law; 0.5 %", [] { return laplace_pressure(2562); }});
  out.push_back({"T4.3", "volume of a free tense sphere over its reference volume", 0.9355, 5e-4, kClosedForm,
                 [] { return ball(kRadius) / dcm::pressure_free_reference(ball(kRadius), kTension, kBulk); }});
  out.push_back({"T5.4", "pressure at V/V0 = 0.9, K_V 2.5 kPa [kPa]", 0.263401, 5e-7, kClosedForm,
                 [] { return dcm::VolumePressure{kBulk}.pressure(90.0, 100.0); }});
  out.push_back({"T9.2", "drag of a cell in a medium of 0.1 nN s/um^3, 642 nodes [nN s/um]", 45.023, 5.1e-3, kIndependent,
                 [] { return 0.1 * geometry(sphere(642, true)).area[0]; }});
  out.push_back({"dcm 13", "tension of springs when the volume doubles without them [nN/um]", 0.0619, 0.0619 * 0.015,
                 "closed form of a hexagonal lattice; 1.5 % for the icosphere", [] { return tension_of_stretched_springs(); }});
}

void add_spheres(std::vector<ReferenceNumber>& out) {
  const auto relative = [](double value, double part) { return std::abs(value) * part; };
  out.push_back({"JKR", "reduced modulus of the reference pair [kPa]", 0.267857143, relative(0.267857143, 2e-9), kClosedForm,
                 [] { return reference_pair().modulus; }});
  out.push_back({"JKR", "pull-off force, R 5/5 um, W 0.1 nN/um [nN]", 1.178097, relative(1.178097, 1e-6), kJkr,
                 [] { return cbm::pull_off_force(reference_pair()); }});
  out.push_back({"JKR", "overlap without load [um]", 1.371402, relative(1.371402, 1e-6), kJkr,
                 [] { return cbm::zero_load_overlap(reference_pair()); }});
  out.push_back({"JKR", "slope of the force without load [nN/um]", 1.0308549, relative(1.0308549, 1e-7), kJkr,
                 [] { return cbm::jkr_slope(reference_pair(), cbm::zero_load_overlap(reference_pair())); }});
  struct Point {
    double overlap, radius, force;
  };
  for (const Point& p :
       {Point{-0.360562, 1.040042, -1.5}, Point{0.0, 1.259921, -4.0 / 3.0}, Point{2.0, 2.0, 8.0 / 3.0}, Point{6.550510, 3.0, 21.303062}}) {
    char at[48];
    std::snprintf(at, sizeof at, " at overlap %g (dimensionless)", p.overlap);
    out.push_back({"JKR", std::string("contact radius") + at, p.radius, 4e-6, kJkr, [p] {
                     const auto law = reference_pair();
                     return cbm::jkr_contact(law, p.overlap * law.length).contact_radius / law.radius;
                   }});
    out.push_back({"JKR", std::string("force") + at, p.force, 6e-6, kJkr, [p] {
                     const auto law = reference_pair();
                     return cbm::jkr_contact(law, p.overlap * law.length).force / law.force;
                   }});
  }
}

/// Pressure of face-centred cubic spheres (R 6, E 0.45, ν 0.4) with the packing of an ideal filled cell (K_V 2.5), 2√2 F/d² [kPa].
double packed_pressure(double s) {
  const auto curve = cbm::PackingCurve::through(cbm::ideal_filled_cell(kBulk, 0.45, 0.4).value()).value();
  const double d = 2.0 * kRadius * (1.0 - s);
  const auto hertz =
      cbm::hertz_contact(cbm::make_pair_law(cbm::ContactMaterial::elastic(0.45, 0.4, 0.45, 0.4, 0.0), kRadius, kRadius), 2.0 * kRadius - d);
  const auto caps = cbm::sphere_caps(kRadius, kRadius, d);
  const double pressure = curve.at(12.0 * caps.volume_a / ball(kRadius)).pressure;
  return 2.0 * std::numbers::sqrt2 * (hertz.force + pressure * (caps.slope_a + caps.slope_b)) / (d * d);
}

void add_packing(std::vector<ReferenceNumber>& out) {
  out.push_back({"cbm 3", "cap of a sphere of 6 um behind the plane it shares with one of 5 um at 9.5 um [um^3]", 8.1717292, 5.1e-8,
                 kIndependent, [] { return cbm::sphere_caps(6.0, 5.0, 9.5).volume_a; }});
  out.push_back({"cbm 3", "its change with the distance [um^2]", -10.4861986, 5.1e-8, kIndependent,
                 [] { return -cbm::sphere_caps(6.0, 5.0, 9.5).slope_a; }});
  out.push_back({"cbm 3", "packing at which an ideal filled cell presses, E 450 Pa, K_V 2.5 kPa", 0.0829053, 5.1e-8, kIndependent,
                 [] { return cbm::ideal_filled_cell(kBulk, 0.45, 0.4).value().front().packing; }});
  struct Point {
    double s, pressure;
  };
  for (const Point& p : {Point{0.05, 6.257e-3}, Point{0.115, 165.5e-3}, Point{0.12, 207.61e-3}, Point{0.20, 922.44e-3}}) {
    char what[96];
    std::snprintf(what, sizeof what, "pressure of cubic close packed filled cells at overlap %g of the diameter [kPa]", p.s);
    out.push_back({"cbm 3", what, p.pressure, 0.005 * p.pressure, "computed independently; 0.5 % for eight knots",
                   [p] { return packed_pressure(p.s); }});
  }
}

}  // namespace

std::vector<ReferenceNumber> physics_numbers() {
  std::vector<ReferenceNumber> out;
  add_shells(out);
  add_spheres(out);
  add_packing(out);
  add_interior_numbers(out);
  add_contact_numbers(out);
  add_active_numbers(out);
  return out;
}

}  // namespace morula::scenarios
