// Water and solutes: T6.1–T6.6 of dcm.md §6.
#include <cmath>
#include <cstdio>

#include "coupling/behaviours/osmosis.h"
#include "coupling/simulation.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {
namespace {

constexpr const char* kClosedForm = "closed form";
constexpr const char* kBoyle = "Boyle-van 't Hoff";
constexpr double kVolume = ball_volume(kRadius);

CellType permeable(double outside, double inactive) {
  CellType type = lone_cell_model().types[0];
  type.osmosis.permeability = 1e-3;
  type.osmosis.outside = outside;
  type.osmosis.inactive = inactive;
  return type;
}

/// A cell of 6 µm that was at rest in 300 mM, as the law of water sees it.
OsmoticCell cell_in(double outside, double inactive) {
  CellState row;
  row.target_volume = row.birth_volume = kVolume;
  return osmotic_cell(row, permeable(outside, inactive), 0.0, 4.0 * std::numbers::pi * kRadius * kRadius, 0.0);
}

/// V and V0 over the target volume of a cell of 162 nodes that is fluid, 10 min after it came into this medium.
struct Volumes {
  double volume = NAN, reference = NAN;
};
Volumes shell_in(double outside) {
  Model model = lone_cell_model();
  model.types[0] = permeable(outside, 0.3);
  model.types[0].shell.spring_stiffness = model.types[0].shell.hinge_stiffness = 0.0;
  auto simulation = Simulation::create(model, lone_cell(model, 162), Comm(), 1).value();
  while (simulation->tissue().clock.time < 600.0)
    if (!simulation->step(600.0).ok()) return {};
  return {simulation->values().volume[0] / kVolume, simulation->tissue().shells.reference_volume[0] / kVolume};
}

void add_shocks(std::vector<ReferenceNumber>& out) {
  for (const auto& [outside, part] : {std::pair{150.0, 1.7}, std::pair{450.0, 0.766667}, std::pair{600.0, 0.65}}) {
    char what[80];
    std::snprintf(what, sizeof what, "volume at rest in %g mM over that in 300 mM", outside);
    out.push_back(
        {"T6.4", what, part, 1e-6, kBoyle, [outside] { return volume_after_flux(cell_in(outside, 0.3), kVolume, 3600.0) / kVolume; }});
  }
  for (const auto& [time, part] : {std::pair{1.0, 1.16055}, std::pair{2.0, 1.27567}, std::pair{5.0, 1.48143}, std::pair{10.0, 1.62206},
                                   std::pair{20.0, 1.68934}, std::pair{60.0, 1.7}}) {
    char what[80];
    std::snprintf(what, sizeof what, "volume %g s after a shock from 300 to 150 mM, relative", time);
    out.push_back({"T6.5", what, part, 2e-5, "integrated independently",
                   [time] { return volume_after_flux(cell_in(150.0, 0.3), kVolume, time) / kVolume; }});
  }
}

}  // namespace

void add_osmosis_numbers(std::vector<ReferenceNumber>& out) {
  out.push_back({"T6.1", "osmotic pressure of 300 mM [kPa]", 773.62, 5e-3, "van 't Hoff", [] { return kGasEnergy * 300.0; }});
  out.push_back({"T6.2", "solutes that a cell of 6 um holds which is at rest in 300 mM, 30 % inactive [amol]", 190003.5, 0.05, kBoyle,
                 [] { return cell_in(300.0, 0.3).osmolytes; }});
  out.push_back({"T6.2", "the same, nothing inactive [amol]", 271433.6, 0.05, kBoyle, [] { return cell_in(300.0, 0.0).osmolytes; }});
  out.push_back({"T6.3", "time in which water flows, L_p 1e-3 um/(s kPa), 30 % inactive [s]", 1.810, 5e-4, kClosedForm,
                 [] { return osmotic_time(cell_in(300.0, 0.3), kVolume); }});
  out.push_back(
      {"T6.3", "the same, nothing inactive [s]", 2.585, 5e-4, kClosedForm, [] { return osmotic_time(cell_in(300.0, 0.0), kVolume); }});
  add_shocks(out);
  constexpr const char* kCoupled = "computed independently; the shape of a sphere";
  out.push_back({"T6.6", "volume at rest of a shell of tension 0.5 nN/um in 300 mM over its target, 162 nodes", 0.99985, 1e-5, kCoupled,
                 [] { return shell_in(300.0).volume; }});
  out.push_back({"T6.6", "its V0 over the target volume", 1.0688, 2e-3, "computed independently; the mesh needs 1.4 % more pressure",
                 [] { return shell_in(300.0).reference; }});
  out.push_back({"T6.6", "volume of the shell 10 min after a shock to 150 mM over its target", 1.6995, 1e-4, kCoupled,
                 [] { return shell_in(150.0).volume; }});
}

}  // namespace morula::scenarios
