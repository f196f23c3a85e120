// Cortical tension: T4.1–T4.3 of dcm.md §4.
#include <cmath>
#include <memory>
#include <optional>

#include "coupling/mechanics/face_tensions.h"
#include "dcm/growth.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {
namespace {

constexpr const char* kIndependent = "computed independently on the same mesh";
constexpr const char* kClosedForm = "closed form";

struct Laplace {
  double pressure, residual;  ///< p, and |γ ∂A − p ∂V|/|γ ∂A|
};
Laplace laplace(std::uint32_t nodes) {
  const dcm::Shells shells = sphere(nodes, Size::kNodes);
  dcm::ShellParameters p = nothing();
  p.tension = kTension;
  const auto push = volume_gradient(shells), pull = mechanics(shells, p).force;
  const double pressure = -dot_of(pull, push) / dot_of(push, push);
  return {pressure, norm_of(plus(pull, push, pressure)) / norm_of(pull)};
}

/// Pressure that bears the tension of a rough surface by the virial of both forces, over 2γA/(3V).
double virial_of_a_rough_cell() {
  const dcm::Shells shells = rough(sphere(162, Size::kVolume));
  dcm::ShellParameters p = nothing();
  p.tension = kTension;
  const auto& x = shells.position;
  const SurfaceGeometry at = geometry(shells);
  const double pressure = -dot_of(x, mechanics(shells, p).force) / dot_of(x, volume_gradient(shells));
  return pressure / (2.0 * kTension * at.area[0] / (3.0 * at.volume[0]));
}

/// −x·F of the extra tension 0.6 on the whole surface, over 2 A: the tension itself.
double tension_of_a_region() {
  Model model = lone_cell_model();
  TensionRegion whole;
  whole.tension = 1.1;
  model.types[0].regional_tension.regions = {whole};
  const Tissue tissue = lone_cell(model, 642, Size::kNodes);
  FaceTensions tensions(model);
  tensions.set(tissue, 0.0);
  std::vector<Vec3d> force(tissue.shells.node_count());
  OrderFreeSum energy;
  tensions.add_forces(tissue.shells, tissue.shells.position, force, energy);
  return kTension - dot_of(force, tissue.shells.position) / (2.0 * geometry(tissue.shells).area[0]);
}

/// A cell of 642 nodes that has only tension and pressure, come to rest from 6 µm with this V0: by ten implicit steps of a minute.
class FluidCell {
 public:
  explicit FluidCell(double reference_volume) : reference_(reference_volume) {}

  /// V/V0
  [[nodiscard]] double volume_ratio() { return at_rest().volume / reference_; }
  [[nodiscard]] double radius() { return std::cbrt(at_rest().volume / ball_volume(1.0)); }
  /// p over 2γA/(3V)
  [[nodiscard]] double virial() { return at_rest().pressure * 3.0 * at_rest().volume / (2.0 * kTension * at_rest().area); }

 private:
  struct AtRest {
    double volume = NAN, pressure = NAN, area = NAN;
  };
  const AtRest& at_rest() {
    if (at_rest_) return *at_rest_;
    at_rest_.emplace();
    Model model = lone_cell_model();
    model.types[0].shell.spring_stiffness = model.types[0].shell.hinge_stiffness = 0.0;
    solve_tightly(model);
    LoneCell cell(model, 642);
    cell.tissue.shells.reference_volume[0] = reference_;
    for (int k = 0; k < 10; ++k)
      if (!cell.step(60.0)) return *at_rest_;
    const BodyValues now = cell.values();
    *at_rest_ = {now.volume[0], now.inner_pressure[0], now.area[0]};
    return *at_rest_;
  }
  double reference_;
  std::optional<AtRest> at_rest_;
};

}  // namespace

void add_tension_numbers(std::vector<ReferenceNumber>& out) {
  struct PerMesh {
    std::uint32_t nodes;
    double laplace, residual;
  };
  for (const PerMesh& m : {PerMesh{162, 0.168954, 0.031}, PerMesh{642, 0.167236, 0.016}, PerMesh{2562, 0.166809, 0.008}}) {
    const std::string at = ", " + std::to_string(m.nodes) + " nodes";
    const std::uint32_t n = m.nodes;
    out.push_back({"T4.1", "pressure that holds a sphere of tension 0.5 nN/um (2 gamma/R = 0.166667) [kPa]" + at, m.laplace, 1e-6,
                   kIndependent, [n] { return laplace(n).pressure; }});
    out.push_back({"T4.1", "part of the tension's force that it does not hold" + at, m.residual, 5.1e-4, kIndependent,
                   [n] { return laplace(n).residual; }});
  }
  out.push_back({"T4.1", "pressure that holds a sphere of tension 0.5 nN/um against Laplace's, 2562 nodes [kPa]", 2.0 * kTension / kRadius,
                 1e-3 * 2.0 * kTension / kRadius, "Laplace's law; dcm.md: 0.086 %", [] { return laplace(2562).pressure; }});
  out.push_back({"T4.2", "pressure over 2 gamma A/(3 V), rough surface of 162 nodes", 1.0, 1e-6, kClosedForm,
                 [] { return virial_of_a_rough_cell(); }});
  const auto shrunk = std::make_shared<FluidCell>(ball_volume(kRadius)),
             held = std::make_shared<FluidCell>(dcm::pressure_free_reference(ball_volume(kRadius), kTension, kBulk));
  out.push_back(
      {"T4.2", "the same of a cell of 642 nodes that has come to rest", 1.0, 1e-6, kClosedForm, [shrunk] { return shrunk->virial(); }});
  out.push_back(
      {"T4.2", "tension of a region by the virial of its forces [nN/um]", 1.1, 1e-9, kClosedForm, [] { return tension_of_a_region(); }});
  // dcm.md gives V/V0 for p = 2γ/R at R = 6 µm, which V0 = V exp(2γ/(R K_V)) leads to. From V0 = 4/3 π (6 µm)³ the cell shrinks and its pressure
  // rises with 1/R: ln x = −2γ/(R0 K_V) x^{−1/3}.
  out.push_back({"T4.3", "volume over V0 of a cell at rest, V0 for a radius of 6 um; 642 nodes", 0.9355, 5e-4,
                 "closed form exp(-2 gamma/(R K_V)); dcm.md: 0.935 to 0.936", [held] { return held->volume_ratio(); }});
  out.push_back({"T4.3", "radius of that cell [um]", kRadius, 1e-3 * kRadius, "closed form; the mesh has 0.1 % more pressure",
                 [held] { return held->radius(); }});
  out.push_back({"T4.3", "volume over V0 of a cell at rest, V0 that of 6 um; 642 nodes", 0.934074, 5e-4,
                 "root of ln x = -2 gamma/(R0 K_V) x^(-1/3)", [shrunk] { return shrunk->volume_ratio(); }});
}

}  // namespace morula::scenarios
