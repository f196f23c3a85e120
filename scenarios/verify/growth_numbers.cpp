// Growth: T13.1 of dcm.md §13.
#include <cmath>

#include "coupling/simulation.h"
#include "dcm/builtin.h"
#include "dcm/derived_parameters.h"
#include "dcm/growth.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {
namespace {

/// A cell with every elastic law and pressure, and no tension.
dcm::ShellParameters elastic() {
  dcm::ShellParameters p = nothing();
  p.spring_stiffness = dcm::spring_stiffness(kYoung, kThickness);
  p.hinge_stiffness = dcm::hinge_stiffness(kYoung, kThickness, kPoisson);
  for (const char* law : {"neo_hooke", "skalak", "st_venant_kirchhoff"})
    dcm::shell_law(law).strength().in(p) = dcm::sheet_shear_modulus(kYoung, kThickness, kPoisson);
  p.local_area_modulus = p.global_area_modulus = kYoung * kThickness;
  p.bulk_modulus = kBulk;
  return p;
}

/// Energy over E h A of the shape that has doubled its volume with its rest state.
double energy_after_doubling() {
  dcm::Shells shells = sphere(162, Size::kVolume);
  dcm::set_rest_volume(shells, 0, 2.0 * ball_volume(kRadius));
  shells.reference_volume[0] = 2.0 * ball_volume(kRadius);
  shells.position = scaled(shells.position, std::cbrt(2.0));
  return mechanics(shells, elastic()).energy[0] / (kYoung * kThickness * geometry(shells).area[0]);
}

/// Radius over that at the start of a cell that goes to twice its volume by steps.
double radius_after_doubling() {
  Model model = lone_cell_model();
  model.types[0].shell = elastic();
  dcm::shell_law("st_venant_kirchhoff").strength().in(model.types[0].shell) = 0.0;  // it does not stand the way there
  model.types[0].shell.medium_friction = kMedium;
  Tissue tissue = lone_cell(model, 162);
  tissue.cells.rows[0].target_volume *= 2.0;
  auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
  while (simulation->tissue().clock.time < 600.0)
    if (!simulation->step(600.0).ok()) return NAN;
  return std::cbrt(simulation->values().volume[0] / ball_volume(kRadius));
}

/// Tension of a spring lattice stretched by 2^(1/3): −x·F = 2 τ A.
double tension_of_stretched_springs() {
  const dcm::Shells shells = sphere(2562, Size::kVolume);
  dcm::ShellParameters p = nothing();
  p.spring_stiffness = dcm::spring_stiffness(kYoung, kThickness);
  const auto x = scaled(shells.position, std::cbrt(2.0));
  return -dot_of(mechanics(shells, p, x).force, x) / (2.0 * geometry(shells, x).area[0]);
}

}  // namespace

void add_growth_numbers(std::vector<ReferenceNumber>& out) {
  out.push_back({"T13.1", "energy of all elastic laws after the volume doubled with the rest state, over E h A", 0.0, 1e-8, "dcm.md: 1e-8",
                 [] { return energy_after_doubling(); }});
  out.push_back({"T13.1", "radius of a cell that has come to rest at twice its volume, over that before", 1.259921, 1e-6,
                 "closed form 2^(1/3)", [] { return radius_after_doubling(); }});
  out.push_back({"T13.1", "tension of springs when the volume doubles without them [nN/um]", 0.0619, 0.0619 * 0.015,
                 "closed form of a hexagonal lattice; 1.5 % for the icosphere", [] { return tension_of_stretched_springs(); }});
}

}  // namespace morula::scenarios
