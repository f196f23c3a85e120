// Volume and pressure: T5.1–T5.5 of dcm.md §5.
#include <cmath>

#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {
namespace {

constexpr const char* kIndependent = "computed independently on the same mesh";
constexpr const char* kClosedForm = "closed form";

dcm::ShellParameters pressure_alone() {
  dcm::ShellParameters p = nothing();
  p.bulk_modulus = kBulk;
  return p;
}

/// A rough cell of 162 nodes at nine tenths of its V0.
dcm::Shells pressed() {
  dcm::Shells out = rough(sphere(162, Size::kVolume));
  out.reference_volume[0] = geometry(out).volume[0] / 0.9;
  return out;
}

double change_of_volume_far_away() {
  const dcm::Shells shells = pressed();
  const auto far = plus(shells.position, all_alike(162, {1e4, -1e4, 1e4}));
  return mechanics(shells, pressure_alone(), far).volume[0] / mechanics(shells, pressure_alone()).volume[0] - 1.0;
}

/// Largest |−ΔE/Δx − F·d|/|F| of 20 directions d, by central differences of 1e-5 µm.
double error_of_the_gradient() {
  const dcm::Shells shells = pressed();
  const dcm::ShellParameters p = pressure_alone();
  const auto force = mechanics(shells, p).force;
  const double h = 1e-5;
  double most = 0.0;
  for (std::uint64_t k = 0; k < 20; ++k) {
    auto d = random_directions(162, 10 + k);
    d = scaled(d, 1.0 / norm_of(d));
    const double ahead = mechanics(shells, p, plus(shells.position, d, h)).energy[0];
    const double behind = mechanics(shells, p, plus(shells.position, d, -h)).energy[0];
    most = larger(most, std::abs((behind - ahead) / (2.0 * h) - dot_of(force, d)) / norm_of(force));
  }
  return most;
}

double net_force() {
  const auto force = mechanics(pressed(), pressure_alone()).force;
  return norm(sum_of(force)) / size_of(force);
}
double net_torque() {
  const dcm::Shells shells = pressed();
  const auto force = mechanics(shells, pressure_alone()).force;
  return norm(torque_of(shells.position, force)) / (kRadius * size_of(force));
}

double pressure_at_nine_tenths() { return mechanics(pressed(), pressure_alone()).pressure[0]; }

/// (K_V/V) gᵀ Γ⁻¹ g, g = ∂V/∂x: rate of the breathing mode in the medium.
double breathing_rate(std::uint32_t nodes) {
  const dcm::Shells shells = sphere(nodes, Size::kNodes);
  const SurfaceGeometry g = geometry(shells);
  const auto gradient = volume_gradient(shells);
  double rate = 0.0;
  for (std::size_t i = 0; i < gradient.size(); ++i) rate += norm2(gradient[i]) / (kMedium * g.node_area[i]);
  return kBulk / g.volume[0] * rate;
}

}  // namespace

void add_volume_numbers(std::vector<ReferenceNumber>& out) {
  out.push_back({"T5.1", "change of a volume that is 1e4 um away, relative", 0.0, 1e-12, "dcm.md: invariance under translation",
                 [] { return change_of_volume_far_away(); }});
  out.push_back({"T5.2", "difference of the force of a pressure and the slope of its energy, relative", 0.0, 1e-6,
                 "dcm.md 16: central differences of 1e-5 um", [] { return error_of_the_gradient(); }});
  out.push_back({"T5.3", "net force of a pressure over the sum of its forces", 0.0, 1e-12, kClosedForm, [] { return net_force(); }});
  out.push_back(
      {"T5.3", "net torque of a pressure over R times the sum of its forces", 0.0, 1e-12, kClosedForm, [] { return net_torque(); }});
  out.push_back({"T5.4", "pressure of a cell at V/V0 = 0.9, K_V 2.5 kPa [kPa]", 0.263401, 5e-7, kClosedForm,
                 [] { return pressure_at_nine_tenths(); }});
  struct PerMesh {
    std::uint32_t nodes;
    double volume, rate;
  };
  for (const PerMesh& m : {PerMesh{162, 0.96616, 12.31}, PerMesh{642, 0.99139, 12.45}, PerMesh{2562, 0.99784, 12.49}}) {
    const std::string at = ", " + std::to_string(m.nodes) + " nodes";
    const std::uint32_t n = m.nodes;
    out.push_back({"dcm 0", "volume of the mesh over that of its sphere" + at, m.volume, 5e-6, kIndependent,
                   [n] { return geometry(sphere(n, Size::kNodes)).volume[0] / ball_volume(kRadius); }});
    out.push_back({"T5.5", "rate of the breathing mode [1/s]" + at, m.rate, 6e-3, kIndependent, [n] { return breathing_rate(n); }});
  }
}

}  // namespace morula::scenarios
