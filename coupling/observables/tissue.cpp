#include <algorithm>
#include <iterator>

#include "coupling/observables/measures.h"
#include "coupling/observables/observable.h"

namespace morula {
namespace {

double per_step(std::uint64_t count, std::uint64_t steps) {
  return steps > 0 ? static_cast<double>(count) / static_cast<double>(steps) : 0.0;
}

using M = const Moment&;

/// How the run goes, and what it has counted since time 0.
std::vector<Observable> observables_of_the_run() {
  return {
      {"step_count", "1", "Steps since time 0.", [](M m) { return double(m.clock.steps); }},
      {"step_size", "s", "Mean step since the last output.",
       [](M m) { return m.interval.steps > 0 ? m.interval.time / double(m.interval.steps) : m.clock.next_step; }},
      {"newton_iterations", "1", "Newton iterations per step since the last output.",
       [](M m) { return per_step(m.interval.newton, m.interval.steps); }},
      {"linear_iterations", "1", "Iterations of the linear solver per step since the last output.",
       [](M m) { return per_step(m.interval.linear, m.interval.steps); }},
      {"retries", "1", "Steps tried again with a smaller size since the last output.", [](M m) { return double(m.interval.retries); }},
      {"centre_drift", "um",
       "Way of the tissue's centre since time 0, every point weighted by its friction with the medium: what obstacles and forces from "
       "outside have moved; where there are none it is the error of the solver.",
       [](M m) { return norm(m.ledger.drift); }},
      {"rotation", "rad", "Rotation of the tissue about that centre since time 0, weighted alike; 0 in periodic domains.",
       [](M m) { return norm(m.ledger.rotation); }},
      {"mean_way", "um", "Mean length of the way of all points since time 0, weighted alike.", [](M m) { return m.ledger.way; }},
      {"divisions", "1", "Divisions since time 0.", [](M m) { return double(m.ledger.divisions); }},
      {"deaths", "1", "Deaths since time 0.", [](M m) { return double(m.ledger.deaths); }},
      {"promotions", "1", "Spheres that became shells since time 0.", [](M m) { return double(m.ledger.promotions); }},
      {"demotions", "1", "Shells that became spheres since time 0.", [](M m) { return double(m.ledger.demotions); }},
  };
}

}  // namespace

std::vector<Observable> tissue_observables(const Model&) {
  std::vector<Observable> out = {
      {"cell_count", "1", "Number of cells.", [](M m) { return double(m.measures.cells); }},
      {"sphere_count", "1", "Cells whose body is a sphere.", [](M m) { return double(m.measures.spheres); }},
      {"shell_count", "1", "Cells whose body is a deformable shell.", [](M m) { return double(m.measures.shells); }},
      {"shell_fraction", "1", "Part of the cells whose body is a shell.",
       [](M m) { return m.measures.cells > 0 ? double(m.measures.shells) / double(m.measures.cells) : 0.0; }},
      {"spheroid_radius", "um",
       "Radius of the ball with the tissue's radius of gyration, cells weighted by volume. In periodic domains of the images nearest to "
       "where most volume lies.",
       [](M m) { return m.measures.spheroid_radius; }},
      {"largest_extent", "um", "Largest distance of a cell's far side from the tissue's centre.",
       [](M m) { return m.measures.largest_extent; }},
      {"total_volume", "um^3", "Volume of all cells.", [](M m) { return m.measures.total_volume; }},
      {"mean_pressure", "kPa", "Mean pressure that neighbours, obstacles and loads put on a cell.",
       [](M m) { return m.measures.mean_pressure; }},
      {"shell_pressure", "kPa", "Mean pressure that neighbours, obstacles and loads put on a shell.",
       [](M m) { return m.measures.shell_pressure; }},
      {"inner_pressure", "kPa", "Mean pressure inside the shells, -K ln(V/V0), which bears their cortex, too.",
       [](M m) { return m.measures.inner_pressure; }},
      {"max_pressure", "kPa", "Largest pressure of a cell.", [](M m) { return m.measures.pressure.value; }},
      {"mean_contact_area", "um^2",
       "Mean area of a cell that is in contact. Of shells: what is nearer than half the range. Too large at small contact angles, by "
       "c/(2 a tan(angle)) of a contact of radius a; doublets of 162 nodes: 17, 8, 2, -2 % at W/2T = 0.1, 0.3, 0.5, 0.75; far too large "
       "where shells are pressed together and do not adhere. "
       "Of spheres: that of their pairs or, with a fitted law, that of cells among many.",
       [](M m) { return m.measures.mean_contact_area; }},
      {"contacts_beyond_range", "1",
       "Part of the contacts of two spheres whose overlap is outside of what their law was fitted to; of a law that was not fitted, whose "
       "radius is above 0.45 of the smaller sphere's.",
       [](M m) {
         return m.measures.sphere_contacts > 0 ? double(m.measures.contacts_beyond) / double(m.measures.sphere_contacts) : Measures::kNone;
       }},
      {"mean_outside_law", "1",
       "Mean over the spheres of `outside_law`: overlap and packing over what their laws are for, 1 at the end of the range.",
       [](M m) { return m.measures.mean_outside; }},
      {"max_outside_law", "1", "Largest `outside_law` of a sphere.", [](M m) { return m.measures.most_outside; }},
      {"spheres_outside_law", "1", "Part of the spheres that are outside of the range of their laws (`outside_law` above 1).",
       [](M m) { return m.measures.spheres > 0 ? double(m.measures.spheres_outside) / double(m.measures.spheres) : Measures::kNone; }},
      {"overlap", "um", "Deepest penetration of a shell, obstacle or nucleus at this time.", [](M m) { return m.measures.overlap.value; }},
      {"worst_overlap", "um", "Deepest penetration in any step since the last output.",
       [](M m) { return std::max(m.interval.worst_overlap, m.measures.overlap.value); }},
      {"volume_error", "1", "Largest relative difference of a cell's volume from what its row and, of a shell, its inner pressure ask for.",
       [](M m) { return m.measures.volume_error.value; }},
      {"total_volume_error", "1",
       "Relative difference of the volume of all cells together from what their rows and, of shells, inner pressures ask for.",
       [](M m) { return m.measures.total_volume_error; }},
      {"energy", "nN um", "Elastic, surface and contact energy; of a pair of spheres that adheres from where it would break apart.",
       [](M m) { return m.measures.energy; }},
  };
  std::ranges::move(observables_of_the_run(), std::back_inserter(out));
  return out;
}

}  // namespace morula
