// Reference numbers of water, nucleus and cytoskeleton: T6.1–T6.5 and T12.1 of the physics pages.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "coupling/behaviours/osmosis.h"
#include "dcm/interior.h"
#include "dcm/laws/nucleus_repulsion.h"
#include "dcm/nuclear_shell.h"
#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {
namespace {

constexpr double kRadius = 6.0, kVolume = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;
constexpr const char* kClosedForm = "closed form";
constexpr const char* kBoyle = "Boyle-van 't Hoff";

OsmoticCell cell_in(double outside, double inactive) {
  return {1e-3, 300.0 * (1.0 - inactive) * kVolume, inactive * kVolume, outside, 0.0, 4.0 * std::numbers::pi * kRadius * kRadius};
}

/// Force per displacement of a nucleus on links from all nodes of 162, 0.01 nN/um each.
double hold_of_links() {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(162).value();
  dcm::InteriorParameters p;
  p.nucleus_fraction = 0.0723;
  p.nucleus_links = {dcm::LinkParameters::kAll, 0.01, 0.0, false};
  const dcm::InteriorLinks links = dcm::choose_links(*shape, p);
  const Vec3d nucleus{1e-5, 0, 0};
  dcm::InteriorView cell;
  cell.parameters = &p;
  cell.links = &links;
  cell.topology = shape->topology.get();
  cell.node = shape->position;
  cell.nucleus = &nucleus;
  cell.rest_volume = 1.0;
  std::vector<Vec3d> force(162);
  Vec3d pull;
  dcm::add_interior_forces(cell, force, &pull);
  return -pull.x / nucleus.x;
}

/// A nucleus of 162 nodes and 2.5 um radius in a cell of 6 um with as many, links from all nodes.
struct NucleusAtRest {
  ShapeLibrary shapes;
  std::shared_ptr<const ReferenceShape> shape = shapes.icosphere(162).value();
  dcm::InteriorParameters parameters;
  std::vector<dcm::InteriorLink> links;
  std::vector<Vec3d> cell, nucleus;

  NucleusAtRest() {
    parameters.nucleus_fraction = 2.5 * 2.5 * 2.5 / (kRadius * kRadius * kRadius);
    parameters.nucleus_links = {dcm::LinkParameters::kAll, 0.01, 0.0, false};
    links = dcm::choose_nuclear_links(*shape, *shape, parameters);
    for (const Vec3d& x : shape->position) {
      cell.push_back(x * std::cbrt(kVolume));
      nucleus.push_back(x * std::cbrt(kVolume * parameters.nucleus_fraction));
    }
  }
  [[nodiscard]] dcm::NucleusView view() const {
    return {&parameters, links, shape->topology.get(), shape->topology.get(), cell, nucleus, kVolume};
  }
};

/// Force per displacement of the nucleus as a whole.
double hold_of_links_to_a_shell() {
  NucleusAtRest rest;
  constexpr double shift = 1e-5;
  for (Vec3d& x : rest.nucleus) x.x += shift;
  std::vector<Vec3d> on_cell(162), on_nucleus(162);
  (void)dcm::add_nuclear_link_forces(rest.view(), {on_cell, on_nucleus});
  double sum = 0.0;
  for (const Vec3d& f : on_nucleus) sum += f.x;
  return -sum / shift;
}

/// Force per velocity of the nucleus as a whole, without its links.
double drag_of_a_shell() {
  NucleusAtRest rest;
  rest.links.clear();
  dcm::NuclearFriction friction;
  const std::vector<double> areas(162, 1.0);  // what counts is how they compare
  dcm::find_nuclear_friction(rest.view(), areas, areas, friction);
  std::vector<Vec3d> still(162), way(162, Vec3d{1, 0, 0}), on_cell(162), on_nucleus(162);
  (void)dcm::add_nuclear_friction(rest.view(), friction, {still, way}, {on_cell, on_nucleus});
  double sum = 0.0;
  for (const Vec3d& f : on_nucleus) sum += f.x;
  return sum;
}

}  // namespace

void add_interior_numbers(std::vector<ReferenceNumber>& out) {
  out.push_back({"T6.1", "osmotic pressure of 300 mM [kPa]", 773.62, 5e-3, "van 't Hoff", [] { return kGasEnergy * 300.0; }});
  out.push_back({"T6.2", "solutes of a cell of radius 6 um at 300 mM, 30 % inactive [amol]", 190003.5, 0.1, kBoyle,
                 [] { return cell_in(300.0, 0.3).osmolytes; }});
  out.push_back({"T6.3", "time in which water flows, L_p 1e-3 um/(s kPa), 30 % inactive [s]", 1.810, 5e-4, kClosedForm,
                 [] { return osmotic_time(cell_in(300.0, 0.3), kVolume); }});
  out.push_back(
      {"T6.3", "the same, nothing inactive [s]", 2.585, 6e-4, kClosedForm, [] { return osmotic_time(cell_in(300.0, 0.0), kVolume); }});
  for (const auto& [outside, part] : {std::pair{150.0, 1.7}, std::pair{450.0, 0.766667}, std::pair{600.0, 0.65}}) {
    char what[80];
    std::snprintf(what, sizeof what, "volume at rest in %g mM over that in 300 mM", outside);
    out.push_back(
        {"T6.4", what, part, 1e-6, kBoyle, [outside] { return volume_after_flux(cell_in(outside, 0.3), kVolume, 3600.0) / kVolume; }});
  }
  for (const auto& [time, part] : {std::pair{1.0, 1.16055}, std::pair{5.0, 1.48143}, std::pair{20.0, 1.68934}}) {
    char what[80];
    std::snprintf(what, sizeof what, "volume %g s after a shock from 300 to 150 mM, relative", time);
    out.push_back({"T6.5", what, part, 2e-5, "integrated independently",
                   [time] { return volume_after_flux(cell_in(150.0, 0.3), kVolume, time) / kVolume; }});
  }
  out.push_back({"T12", "drag of a nucleus of 2.5 um in 1 Pa s [nN s/um]", 0.04712, 5e-6, "Stokes",
                 [] { return dcm::CytoplasmDrag{1e-3}.coefficient(2.5); }});
  out.push_back({"T12.1", "stiffness that 162 links of 0.01 nN/um give a nucleus: N k/3 [nN/um]", 0.540, 1e-5, kClosedForm,
                 [] { return hold_of_links(); }});
  out.push_back({"T12", "drag of a nucleus of 2.5 um that is a shell, in 1 Pa s [nN s/um]", 0.04712, 5e-6, "Stokes",
                 [] { return drag_of_a_shell(); }});
  out.push_back({"T12.1", "stiffness that 162 links of 0.01 nN/um give a nucleus that is a shell: N k/3 [nN/um]", 0.540, 1e-5, kClosedForm,
                 [] { return hold_of_links_to_a_shell(); }});
}

}  // namespace morula::scenarios
