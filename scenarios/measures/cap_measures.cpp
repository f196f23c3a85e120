// Cells with a tension are spherical caps where they touch each other or an obstacle.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/ball.h"
#include "scenarios/measures/caps.h"
#include "scenarios/measures/elastic_cap.h"
#include "scenarios/measures/measures.h"

namespace morula::scenarios {
namespace {

/// W/γ: adhesion of the contact over the tension of the first type.
double wetting_of(const Study& study, const Subject& subject, double time) {
  const auto type = static_cast<std::size_t>(subject.type), partner = static_cast<std::size_t>(subject.partner);
  return study.model.pair(type, partner).adhesion / tension_at(study.model.types[type], time);
}

double range_of_contact(const Study& study, const Subject& subject) {
  return range_of(study.model, static_cast<std::size_t>(subject.type), static_cast<std::size_t>(subject.partner));
}

/// How far the nearest node of a shell is beyond a plane, along its normal [µm].
double lowest(const ShellView& shell, const Vec3d& point, const Vec3d& normal) {
  double out = std::numeric_limits<double>::infinity();
  for (const Vec3d& x : shell.nodes) out = std::min(out, dot(x - point, normal));
  return out;
}

std::vector<MeasuredCap> caps_of_pair(const Study& study, const Snapshot& snapshot, const Subject& subject) {
  const auto pair = shells_of_pair(snapshot, subject);
  if (!pair) return {};
  const Snapshot::Cell &a = *pair->first.cell, &b = *pair->second.cell;
  const Vec3d middle = (a.centroid + b.centroid) * 0.5, axis = normalized(b.centroid - a.centroid);
  if (lowest(pair->first, middle, axis * -1.0) + lowest(pair->second, middle, axis) > range_of_contact(study, subject)) return {};
  const auto low = fit_cap(pair->first, middle, axis * -1.0), high = fit_cap(pair->second, middle, axis);
  if (!low || !high) return {};
  const double tension = tension_at(study.model.types[static_cast<std::size_t>(subject.type)], snapshot.time);
  MeasuredCap out;
  out.wetting = wetting_of(study, subject, snapshot.time);
  out.r0 = ball_radius(0.5 * (a.volume + b.volume));
  out.angle = 0.5 * (low->angle + high->angle);
  out.adhesion = 2.0 * (1.0 - std::cos(out.angle));
  out.radius = 0.5 * (low->radius + high->radius) / out.r0;
  out.contact_radius = 0.5 * (low->contact_radius + high->contact_radius) / out.r0;
  out.length = (low->height + high->height) / out.r0;
  out.height = 0.5 * out.length;
  out.pressure = 0.5 * (a.inner_pressure + b.inner_pressure) * out.r0 / tension;
  out.contact_part = 0.5 * (a.contact_area + b.contact_area) / (0.5 * (a.area + b.area));
  return {out};
}

std::vector<MeasuredCap> caps_on_obstacle(const Study& study, const Snapshot& snapshot, const Subject& subject) {
  const Model& model = study.model;
  const CellType& type = model.types[static_cast<std::size_t>(subject.type)];
  double top = -1e300;
  for (const Vec3d& x : model.obstacles[static_cast<std::size_t>(subject.partner) - model.types.size()].position) top = std::max(top, x.z);
  const double tension = tension_at(type, snapshot.time);
  std::vector<MeasuredCap> out;
  for (const ShellView& shell : shells_of(snapshot, static_cast<std::size_t>(subject.type))) {
    if (lowest(shell, {0, 0, top}, {0, 0, 1}) > range_of_contact(study, subject)) continue;
    const auto cap = fit_cap(shell, {0, 0, top}, {0, 0, 1});
    if (!cap) continue;
    MeasuredCap one;
    one.cell = shell.cell->id.text();
    one.wetting = wetting_of(study, subject, snapshot.time);
    one.r0 = ball_radius(shell.cell->volume);
    one.angle = cap->angle;
    one.adhesion = 1.0 - std::cos(one.angle);
    one.radius = cap->radius / one.r0;
    one.contact_radius = cap->contact_radius / one.r0;
    one.height = one.length = cap->height / one.r0;
    one.pressure = shell.cell->inner_pressure * one.r0 / tension;
    one.contact_part = shell.cell->contact_area / shell.cell->area;
    out.push_back(one);
  }
  return out;
}

Measure cap_measure(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity,
                    double MeasuredCap::*value) {
  Measure out{name, title, doc, formula, "physics/dcm.md §8", quantity, MeasureOf::kContact};
  out.fits = &needs_shells;
  out.take = [value](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
    std::vector<Sample> found;
    for (const std::size_t index : moments.among(*times)) {
      MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot(index));
      for (const MeasuredCap& cap : caps_of(run.study(), *snapshot, subject)) found.push_back({snapshot->time, cap.*value, cap.cell});
    }
    return found;
  };
  return out;
}

}  // namespace

std::vector<MeasuredCap> caps_of(const Study& study, const Snapshot& snapshot, const Subject& subject) {
  const bool on_obstacle = subject.partner >= static_cast<int>(study.model.types.size());
  return on_obstacle ? caps_on_obstacle(study, snapshot, subject) : caps_of_pair(study, snapshot, subject);
}

std::vector<Measure> cap_measures() {
  return {
      cap_measure("cap.wetting", "W/tension", "Adhesion of the contact over the cortical tension of the cell, as the study gives them.",
                  "W/T", Quantity::kNumber, &MeasuredCap::wetting),
      cap_measure(
          "cap.angle", "contact angle",
          "Angle between the plane of contact and the free surface: 0 for a sphere that touches, 90 deg for a hemisphere. Spheres through "
          "the nodes of the far halves.",
          "cos(angle) = distance of the sphere's centre from the plane over its radius", Quantity::kAngle, &MeasuredCap::angle),
      cap_measure("cap.adhesion", "adhesion that the angle stands for, over tension",
                  "Adhesion of the contact over the cortical tension of the cell, as the contact angle has it by Young's law.",
                  "1 - cos(angle) on an obstacle, 2 (1 - cos(angle)) of two cells", Quantity::kNumber, &MeasuredCap::adhesion),
      cap_measure("cap.radius", "radius of the free surface",
                  "Radius of the sphere that the free surface is, over R0 of the cell's volume.", "R/R0", Quantity::kNumber,
                  &MeasuredCap::radius),
      cap_measure("cap.contact_radius", "contact radius", "Radius of the disc in which the sphere cuts the plane of contact, over R0.",
                  "R sin(angle)/R0", Quantity::kNumber, &MeasuredCap::contact_radius),
      cap_measure("cap.height", "height", "Height of a cell over the plane of contact, over R0.", "R (1 + cos(angle))/R0",
                  Quantity::kNumber, &MeasuredCap::height),
      cap_measure("cap.length", "length", "Length of both cells of a pair together, over R0; of a cell on an obstacle its height.",
                  "2 R (1 + cos(angle))/R0", Quantity::kNumber, &MeasuredCap::length),
      cap_measure("cap.pressure", "inner pressure", "Inner pressure times R0 over the cortical tension: 2 for a free ball.", "p R0/T",
                  Quantity::kNumber, &MeasuredCap::pressure),
      cap_measure("cap.contact_part", "part of the surface nearer than half the range",
                  "Contact area over the surface, both as they are told: what is nearer than half the range of contact.", "A_contact/A",
                  Quantity::kNumber, &MeasuredCap::contact_part),
  };
}

}  // namespace morula::scenarios
