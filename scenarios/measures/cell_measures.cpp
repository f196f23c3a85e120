// What each cell has by itself, at a moment.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/mesh/renewal/own_mesh.h"
#include "scenarios/measures/measures.h"
#include "scenarios/measures/ways_of_cells.h"

namespace morula::scenarios {
namespace {

using Cell = Snapshot::Cell;
constexpr double kPi = std::numbers::pi;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Eigenvalues of a symmetric matrix, smallest first (Smith 1961, doi:10.1145/355578.366316).
std::array<double, 3> eigenvalues(const SymMat3<double>& m) {
  const double off = m.xy * m.xy + m.xz * m.xz + m.yz * m.yz, mean = (m.xx + m.yy + m.zz) / 3.0;
  const double x = m.xx - mean, y = m.yy - mean, z = m.zz - mean;
  const double p = std::sqrt((x * x + y * y + z * z + 2.0 * off) / 6.0);
  if (p == 0.0) return {mean, mean, mean};
  const double det = x * (y * z - m.yz * m.yz) - m.xy * (m.xy * z - m.yz * m.xz) + m.xz * (m.xy * m.yz - y * m.xz);
  const double phi = std::acos(std::clamp(det / (2.0 * p * p * p), -1.0, 1.0)) / 3.0;
  const double high = mean + 2.0 * p * std::cos(phi), low = mean + 2.0 * p * std::cos(phi + 2.0 * kPi / 3.0);
  return {low, 3.0 * mean - high - low, high};
}

/// Longest over shortest half axis of the ellipsoid with the second moments of the surface, each face with its area at its middle.
double elongation(const Snapshot&, const Cell&, const ShellView* shell) {
  if (shell == nullptr) return 1.0;
  const auto found = eigenvalues(second_moments(shell->nodes, shell->faces));
  return found[0] > 0.0 ? std::sqrt(found[2] / found[0]) : kNone;
}

template <int kAxis>
double width(const Snapshot&, const Cell& cell, const ShellView* shell) {
  const Vec3d axis{kAxis == 0 ? 1.0 : 0.0, kAxis == 1 ? 1.0 : 0.0, kAxis == 2 ? 1.0 : 0.0};
  return shell != nullptr ? extent(shell->nodes, axis) : 2.0 * cell.radius;
}

/// A value of each cell that was there at time 0, and of its state then.
Result<std::vector<Sample>> since_start(FinishedRun& run, const Subject& subject, const Moments& moments,
                                        double (*value)(const Cell& now, const Cell& start)) {
  MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
  std::vector<Sample> out;
  std::map<CellId, const Cell*> start;
  MORULA_TRY_ASSIGN(const auto first, run.start());
  if (first == nullptr) return out;
  for (const Cell& cell : first->cells) start.emplace(cell.id, &cell);
  for (const std::size_t index : moments.among(*times)) {
    MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot(index));
    for (const Cell& cell : snapshot->cells)
      if (const auto before = start.find(cell.id); before != start.end() && is_meant(cell, subject))
        out.push_back({snapshot->time, value(cell, *before->second), cell.id.text()});
  }
  return out;
}

/// From each output to the next; the first output after the start has none before it, for the start is no contact.
Result<std::vector<Sample>> take_fall(FinishedRun& run, const Subject& subject, const Moments& moments) {
  MORULA_TRY_ASSIGN(const std::vector<Sample> areas, contact_area_measure().take(run, subject, moments));
  MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
  std::map<std::string, std::pair<double, double>> last;  // by cell: area at the last moment, and before
  std::map<std::string, double> end;
  for (const Sample& one : areas) end[one.cell] = one.value;
  std::vector<Sample> out;
  for (const Sample& one : areas) {
    if (one.time == times->front()) continue;
    const auto [before, fresh] = last.try_emplace(one.cell, one.value, 0.0);
    if (!fresh) out.push_back({one.time, (before->second.first - one.value) / end[one.cell], one.cell});
    before->second.first = one.value;
  }
  return out;
}

}  // namespace

Measure volume_measure() {
  return cell_measure("volume", "volume", "Volume of a cell.", Quantity::kVolume,
                      [](const Snapshot&, const Cell& cell, const ShellView*) { return cell.volume; });
}
Measure area_measure() {
  return cell_measure("area", "surface area", "Area of a cell's surface.", Quantity::kArea,
                      [](const Snapshot&, const Cell& cell, const ShellView*) { return cell.area; });
}
Measure radius_measure() {
  return cell_measure("radius", "radius", "Radius of a sphere; of a shell that of a ball of its volume.", Quantity::kLength,
                      [](const Snapshot&, const Cell& cell, const ShellView*) { return cell.radius; });
}
Measure pressure_measure() {
  return cell_measure(
      "pressure", "pressure", "What neighbours, obstacles and loads put on a cell.", Quantity::kPressure,
      [](const Snapshot&, const Cell& cell, const ShellView*) { return cell.pressure; }, "-tr(stress)/3");
}
Measure inner_pressure_measure() {
  return cell_measure("pressure_inside", "inner pressure",
                      "Pressure inside a shell, which bears its cortex, too; of a sphere its pressure.", Quantity::kPressure,
                      [](const Snapshot&, const Cell& cell, const ShellView*) { return cell.inner_pressure; });
}
Measure contact_area_measure() {
  return cell_measure("contact_area", "contact area",
                      "Area of a cell that is in contact. Of shells: what is nearer than half the range of contact.", Quantity::kArea,
                      [](const Snapshot&, const Cell& cell, const ShellView*) { return cell.contact_area; });
}
Measure contact_part_measure() {
  return cell_measure(
      "contact_part", "part of the surface in contact", "Contact area of a cell over its surface.", Quantity::kFraction,
      [](const Snapshot&, const Cell& cell, const ShellView*) { return cell.contact_area / cell.area; }, "A_contact/A");
}
Measure contact_area_fall_measure() {
  Measure out{"contact_area.fall",
              "fall of the contact area between outputs, relative to the last one",
              "How much the contact area of a cell falls from one output to the next, over that at the last of them.",
              "(A_i - A_j)/A_last",
              "",
              Quantity::kFraction,
              MeasureOf::kCells};
  out.take = &take_fall;
  return out;
}
Measure age_measure() {
  return cell_measure("age", "age", "Time since a cell was born; of cells of time 0 with what the study says of their age.",
                      Quantity::kTime, [](const Snapshot&, const Cell& cell, const ShellView*) { return cell.age; });
}
double sphericity(const Cell& cell) { return std::cbrt(kPi) * std::pow(6.0 * cell.volume, 2.0 / 3.0) / cell.area; }
Measure sphericity_measure() {
  Measure out = cell_measure(
      "sphericity", "sphericity", "Surface of a ball of a cell's volume over the cell's surface: 1 for a ball.", Quantity::kNumber,
      [](const Snapshot&, const Cell& cell, const ShellView*) { return sphericity(cell); }, "pi^(1/3) (6 V)^(2/3)/A");
  out.source = "Wadell 1935, doi:10.1086/624298";
  return out;
}
Measure elongation_measure() {
  return cell_measure("elongation", "elongation",
                      "Longest over shortest axis of the ellipsoid with the second moments of a cell's surface.", Quantity::kNumber,
                      &elongation, "sqrt(largest/smallest eigenvalue of the area-weighted second moments)");
}
Measure least_angle_measure() {
  Measure out = cell_measure("least_angle", "least angle of a face",
                             "Least angle of a triangle of a shell's mesh: 60 deg at best, and near zero where triangles are needles.",
                             Quantity::kAngle, [](const Snapshot&, const Cell&, const ShellView* shell) {
                               return shell != nullptr ? least_angle(shell->faces, shell->nodes) : kNone;
                             });
  out.fits = &needs_shells;
  return out;
}
Measure width_measure(int axis) {
  static constexpr OfCell kWidths[] = {&width<0>, &width<1>, &width<2>};
  const std::string letter(1, "xyz"[axis]);
  return cell_measure("width_" + letter, "width along " + letter,
                      "Largest less smallest coordinate of a cell's surface along " + letter + ".", Quantity::kLength, kWidths[axis]);
}
Measure displacement_measure() {
  Measure out{"displacement",
              "displacement",
              "Distance of a cell's centre from where it was at time 0; across periodic faces along its way from output to output.",
              "|x(t) - x(0)|",
              "",
              Quantity::kLength,
              MeasureOf::kCells};
  out.take = [](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
    MORULA_TRY_ASSIGN(const auto first, run.start());
    std::vector<Sample> found;
    if (first == nullptr) return found;
    MORULA_TRY(for_ways_since(run, 0, moments.among(*times), [&](const Snapshot& snapshot, const Cell& cell, const Vec3d& way) {
      if (is_meant(cell, subject)) found.push_back({snapshot.time, norm(way), cell.id.text()});
    }));
    return found;
  };
  return out;
}
Measure volume_change_measure() {
  Measure out{"volume.change",
              "change of volume since time 0, relative",
              "Volume of a cell over that at time 0, less 1.",
              "V/V(0) - 1",
              "",
              Quantity::kFraction,
              MeasureOf::kCells};
  out.take = [](FinishedRun& run, const Subject& subject, const Moments& moments) {
    return since_start(run, subject, moments, [](const Cell& now, const Cell& start) { return now.volume / start.volume - 1.0; });
  };
  return out;
}
Measure concentration_measure() {
  Measure out{"concentration",          "concentration",  "Concentration of a field that a cell sees.", "", "",
              Quantity::kConcentration, MeasureOf::kField};
  out.take = [](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
    std::vector<Sample> found;
    for (const std::size_t index : moments.among(*times)) {
      MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot(index));
      const std::string name = "concentration/" + run.study().model.fields[static_cast<std::size_t>(subject.field)].name;
      for (const Snapshot::Variable& variable : snapshot->variables)
        for (std::size_t c = 0; variable.name == name && c < snapshot->cells.size(); ++c)
          if (is_meant(snapshot->cells[c], subject)) found.push_back({snapshot->time, variable.values[c], snapshot->cells[c].id.text()});
    }
    return found;
  };
  return out;
}

}  // namespace morula::scenarios
