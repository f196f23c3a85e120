// Fluctuations: T10.1 and T10.2 of dcm.md §10.
#include <cmath>
#include <memory>
#include <optional>

#include "coupling/simulation.h"
#include "dcm/derived_parameters.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {
namespace {

constexpr double kThermal = 4.2821e-6;  // k_B T at 310.15 K [fJ]

/// Y_20 and its four companions, real, of norm 1 over the sphere.
struct Mode {
  double y[5];
};
Mode second_modes(const Vec3d& n) {
  return {{0.546274 * (n.x * n.x - n.y * n.y), 1.092548 * n.x * n.y, 1.092548 * n.x * n.z, 1.092548 * n.y * n.z,
           0.315392 * (3.0 * n.z * n.z - 1.0)}};
}

/// k_B T over the second derivative of the energy by the amplitude u of r = R (1 + u Y_20) at constant volume, 2562 nodes: equipartition.
double variance_by_stiffness(const dcm::ShellParameters& p) {
  const dcm::Shells shells = sphere(2562, Size::kVolume);
  const auto energy = [&](double amplitude) {
    std::vector<Vec3d> x = shells.position;
    for (Vec3d& v : x) v *= 1.0 + amplitude * second_modes(normalized(v)).y[4];
    const double size = std::cbrt(ball_volume(kRadius) / geometry(shells, x).volume[0]);
    return mechanics(shells, p, scaled(x, size)).energy[0];
  };
  const double h = 1e-3;
  return kThermal * h * h / (energy(h) + energy(-h) - 2.0 * energy(0.0));
}

/// A fluid cell of 162 nodes that fluctuates at ten times the temperature of the body, in 8000 steps of 0.1 s: mean squares per temperature.
class FluctuatingCell {
 public:
  [[nodiscard]] double mode_variance() { return measured().mode; }
  [[nodiscard]] double diffusion() { return measured().diffusion; }

 private:
  struct Measured {
    double mode = NAN, diffusion = NAN;
  };
  static constexpr double kStep = 0.1, kHotter = 10.0;
  static constexpr int kSteps = 8000, kWarmUp = 200;

  static Model model() {
    Model out = lone_cell_model();
    dcm::ShellParameters& shell = out.types[0].shell;
    shell.spring_stiffness = shell.hinge_stiffness = shell.edge_damping = 0.0;
    shell.shape_stiffness = 0.1;  // holds triangles together and has no shear modulus
    shell.bulk_modulus = 50.0;
    out.types[0].fluctuations.energy = kHotter * kThermal;
    out.step.max_step = out.step.initial_step = kStep;
    out.step.max_displacement = 1.0;  // no step is refused for its noise: that would choose the small ones
    out.step.first_tolerance = 1e-4;
    return out;
  }
  /// Σ u_2m² over m, of u = r/R − 1 about the centre of area, by the areas of the nodes. R is their mean: that of the nodes is 1 % above that of the
  /// volume, and would let the areas that nodes gain and lose pass for a shape.
  static double modes_of(const dcm::Shells& shells) {
    const SurfaceGeometry at = geometry(shells);
    Vec3d center{};
    for (std::size_t i = 0; i < shells.position.size(); ++i) center += shells.position[i] * (at.node_area[i] / at.area[0]);
    double radius = 0.0;
    for (std::size_t i = 0; i < shells.position.size(); ++i) radius += norm(shells.position[i] - center) * (at.node_area[i] / at.area[0]);
    double u[5] = {};
    for (std::size_t i = 0; i < shells.position.size(); ++i) {
      const Vec3d r = shells.position[i] - center;
      const Mode mode = second_modes(normalized(r));
      for (int m = 0; m < 5; ++m) u[m] += mode.y[m] * (norm(r) / radius - 1.0) * at.node_area[i] * 4.0 * std::numbers::pi / at.area[0];
    }
    double out = 0.0;
    for (const double each : u) out += each * each;
    return out;
  }
  /// What friction with the medium alone holds: the centre of the nodes by area.
  static Vec3d way_of(const dcm::Shells& before, const dcm::Shells& after) {
    const SurfaceGeometry at = geometry(before);
    Vec3d out{};
    for (std::size_t i = 0; i < before.position.size(); ++i)
      out += (after.position[i] - before.position[i]) * (at.node_area[i] / at.area[0]);
    return out;
  }
  const Measured& measured() {
    if (measured_) return *measured_;
    measured_.emplace();
    auto simulation = Simulation::create(model(), lone_cell(model(), 162), Comm(), 1).value();
    double square = 0.0, way = 0.0;
    int count = 0;
    for (int k = 0; k < kSteps; ++k) {
      const dcm::Shells before = simulation->tissue().shells;
      if (!simulation->step(1e9).ok()) return *measured_;
      way += norm2(way_of(before, simulation->tissue().shells));
      if (k < kWarmUp || k % 4 != 0) continue;
      square += modes_of(simulation->tissue().shells);
      ++count;
    }
    *measured_ = {square / (5.0 * count * kHotter), way / (6.0 * simulation->tissue().clock.time * kHotter)};
    return *measured_;
  }
  std::optional<Measured> measured_;
};

}  // namespace

void add_fluctuation_numbers(std::vector<ReferenceNumber>& out) {
  constexpr const char* kMilner = "Milner & Safran 1987, doi:10.1103/PhysRevA.36.4371";
  dcm::ShellParameters tense = nothing(), stiff = nothing();
  tense.tension = kTension;
  stiff.helfrich_rigidity = dcm::bending_modulus(kYoung, kThickness, kPoisson);
  out.push_back({"T10.1", "variance of the modes l = 2 of a sphere of tension 0.5 nN/um, by their stiffness at 2562 nodes", 5.946e-8,
                 0.01 * 5.946e-8, kMilner, [tense] { return variance_by_stiffness(tense); }});
  out.push_back({"T10.1", "the same without tension, of the bending rigidity of Table 1", 2.007e-4, 0.02 * 2.007e-4,
                 std::string(kMilner) + "; the mesh leaves 1.3 %, four times the 0.33 % that dcm.md has at 10242 nodes",
                 [stiff] { return variance_by_stiffness(stiff); }});
  const auto cell = std::make_shared<FluctuatingCell>();
  out.push_back({"T10.1", "the same of tension 0.5 nN/um, from 800 s of fluctuations of 162 nodes", 5.946e-8, 0.1 * 5.946e-8,
                 std::string(kMilner) + "; dcm.md: 10 % with 400 independent samples, here 1100",
                 [cell] { return cell->mode_variance(); }});
  out.push_back({"T10.2", "diffusion of that cell, k_B T/(gamma A) [um^2/s]", 9.465e-8, 0.032 * 9.465e-8,
                 "Einstein relation; three standard errors of 24,000 steps, and 0.4 % for the mesh", [cell] { return cell->diffusion(); }});
}

}  // namespace morula::scenarios
