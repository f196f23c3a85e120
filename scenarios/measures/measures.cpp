#include "scenarios/measures/measures.h"

#include <algorithm>

#include "coupling/observables/observable.h"

namespace morula::scenarios {

const std::vector<Measure>& measures() {
  static const std::vector<Measure> all = [] {
    std::vector<Measure> out{
        volume_measure(),
        area_measure(),
        radius_measure(),
        pressure_measure(),
        inner_pressure_measure(),
        contact_area_measure(),
        contact_part_measure(),
        contact_area_fall_measure(),
        age_measure(),
        sphericity_measure(),
        elongation_measure(),
        least_angle_measure(),
        width_measure(0),
        width_measure(1),
        width_measure(2),
        displacement_measure(),
        volume_change_measure(),
        concentration_measure(),
        pair_distance_measure(),
        pair_drift_measure(),
        pair_pressure_ratio_measure(),
        pair_bend_measure(),
        load_way_measure(),
        load_force_measure(),
        obstacle_way_measure(),
        nearest_sphere_measure(),
        mean_contact_part_measure(),
        mean_step_measure(),
        shortest_hold_measure(),
    };
    for (auto* family : {&cap_measures, &pull_off_measures, &aspiration_measures, &pull_measures, &stretch_measures, &rubbing_measures,
                         &aggregate_measures, &tissue_measures, &spheroid_measures, &body_measures, &plate_measures})
      for (Measure& one : family()) out.push_back(std::move(one));
    return out;
  }();
  return all;
}

std::optional<Measure> find_measure(const Study& study, const std::string& name) {
  const auto found = std::find_if(measures().begin(), measures().end(), [&](const Measure& m) { return m.name == name; });
  return found != measures().end() ? std::optional(*found) : series_measure(study, name);
}

std::vector<std::string> measure_names(const Study& study) {
  std::vector<std::string> out;
  for (const Measure& measure : measures()) out.push_back(measure.name);
  for (const Observable& column : observables(study.model, *study.laws)) out.push_back(column.name);
  return out;
}

}  // namespace morula::scenarios
