#include "scenarios/library/cap_criteria.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numbers/number_text.h"
#include "scenarios/library/single_cell.h"
#include "scenarios/library/verdicts.h"

namespace morula::scenarios {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::uint32_t kMeasuredNodes = 642;  // of dcm.md §8
constexpr double kHemisphere = 90.001 * kDegree;
constexpr ElasticCap kElastic[] = {{0.5, 2.0, 0.839, 1.687}, {1.0, 2.0, 1.104, 1.464}};
constexpr double kRounding = 1.02;  // R0 follows from the volume under pressure, not from the study's radius

}  // namespace

CapTolerance cap_tolerance(const CapTolerance& of_study, double expected, std::uint32_t nodes, double range, double r0) {
  CapTolerance out = of_study;
  const double part = range / (r0 * kRounding);
  if (nodes < kMeasuredNodes || part > 1.0 / 12.0 || expected > kHemisphere) return out;
  const bool fine = part <= 1.0 / 24.0;
  out.angle = std::min(out.angle, fine ? 2.0 : 3.0);
  out.height = std::min(out.height, fine ? 0.005 : 0.015);
  return out;
}

std::string ReachedAngle::text() const { return ", W/T = " + number_text("%g", ratio) + (came_back ? ", back from a larger contact" : ""); }

void judge_ways(const std::vector<ReachedAngle>& angles, std::vector<Verdict>& out) {
  for (const ReachedAngle& a : angles)
    for (const ReachedAngle& b : angles) {
      if (std::abs(a.ratio - b.ratio) > 1e-6 || a.nodes != b.nodes) continue;
      const double difference = std::abs(a.angle - b.angle) / kDegree;
      const std::string at = ", W/T = " + number_text("%g", b.ratio) + ", " + std::to_string(a.nodes) + " nodes";
      if (a.came_back && !b.came_back && a.range == b.range)
        out.push_back(at_most("T8.1", ("angle reached from a larger contact against that from touching" + at).c_str(), difference,
                              tolerance(a.nodes, 2.0, 1.0), "deg"));
      if (!a.came_back && !b.came_back && a.range < 0.6 * b.range)
        out.push_back(
            at_most("S6.4",
                    ("change of the angle from a range of " + number_text("%g", b.range) + " to " + number_text("%g", a.range) + " um" + at)
                        .c_str(),
                    difference, tolerance(a.nodes, 4.0, 2.0), "deg"));
    }
}

const ElasticCap* elastic_cap(double ratio, double modulus, std::uint32_t nodes) {
  for (const ElasticCap& cap : kElastic)
    if (nodes >= kMeasuredNodes && std::abs(cap.ratio - ratio) < 1e-9 && std::abs(cap.modulus - modulus) < 1e-9) return &cap;
  return nullptr;
}

double tension_at(const CellType& type, double time) { return type.regional_tension.of_face(type.shell.tension, {}, 0.0, time); }

double range_of(const Model& model, std::size_t a, std::size_t b) {
  const double own = model.pair(a, b).range;
  return own > 0.0 ? own : model.contact.range;
}

}  // namespace morula::scenarios
