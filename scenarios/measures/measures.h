#pragma once
#include <optional>
#include <vector>

#include "scenarios/measures/measure.h"

namespace morula::scenarios {

/// All named measures. To add one: its file, and its line in measures.cpp.
const std::vector<Measure>& measures();

/// The measure of this name: a named one, or a column of series.csv that runs of this model have.
std::optional<Measure> find_measure(const Study& study, const std::string& name);

/// Names of all of them, for suggestions.
std::vector<std::string> measure_names(const Study& study);

/// A column of series.csv as a measure; nothing where runs of this model have no such column.
std::optional<Measure> series_measure(const Study& study, const std::string& column);

/// Measures of cells by themselves.
Measure volume_measure();
Measure area_measure();
Measure radius_measure();
Measure pressure_measure();
Measure inner_pressure_measure();
Measure contact_area_measure();
Measure contact_part_measure();
Measure age_measure();
Measure sphericity_measure();
/// Surface of a ball of a cell's volume over the cell's surface.
double sphericity(const Snapshot::Cell& cell);
Measure elongation_measure();
Measure least_angle_measure();
Measure width_measure(int axis);
Measure displacement_measure();
Measure volume_change_measure();
Measure contact_area_fall_measure();
Measure concentration_measure();
/// Of two cells that touch.
Measure pair_distance_measure();
Measure pair_drift_measure();
Measure pair_pressure_ratio_measure();
Measure pair_bend_measure();
/// Of the spherical caps of two cells, or of a cell on an obstacle.
std::vector<Measure> cap_measures();
/// Of loads and obstacles.
Measure load_way_measure();
Measure load_force_measure();
Measure obstacle_way_measure();
Measure nearest_sphere_measure();
/// Of cells under loads: that grips draw off, that pipettes suck in, that are pulled at two poles, that light stretches, that rub.
std::vector<Measure> pull_off_measures();
std::vector<Measure> aspiration_measures();
std::vector<Measure> pull_measures();
std::vector<Measure> stretch_measures();
std::vector<Measure> rubbing_measures();
/// Of aggregates of shells, and of tissues.
std::vector<Measure> aggregate_measures();
std::vector<Measure> tissue_measures();
std::vector<Measure> spheroid_measures();
std::vector<Measure> body_measures();
/// Of the run as a whole.
Measure mean_contact_part_measure();
Measure mean_step_measure();
Measure shortest_hold_measure();
/// Of a cell between two plates.
std::vector<Measure> plate_measures();

}  // namespace morula::scenarios
