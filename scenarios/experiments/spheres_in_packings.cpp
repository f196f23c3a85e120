#include "scenarios/experiments/spheres_in_packings.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/parallel/threads.h"

namespace morula::scenarios {
namespace {

using calibrate::Arrangement;
using calibrate::PackingPoint;

constexpr int kMostTurns = 8, kPatience = 2;
constexpr int kMostSteps = 20000;
constexpr double kGain = 0.02;  // part of the sum of squares by which a turn must be better than all before
constexpr double kAtRest = 1e-4,
                 kAtRestStep = 10.0;  // spheres that move less than this part of R in steps that are so long [s] are at rest

double pressure_by(const TrialLaw& law, const PackingPoint& point) {
  const calibrate::PackingGeometry at = point.geometry();
  return calibrate::pair_pressure(at, point.radius, law.pair) + calibrate::curve_pressure(at, law.sphere.packing);
}

/// What the spheres bear, −tr σ/3 [kPa], where they are, and the mean contact area of one [µm²].
struct Rest {
  double pressure = 0.0, contact_area = 0.0;
  std::vector<Vec3d> centers;
};

/// Lets spheres in a cube of this edge [µm] come to rest until `end` [s].
Result<Rest> rest_of_spheres(std::unique_ptr<Simulation> simulation, double edge, double radius, double end) {
  MORULA_TRY(simulation->first_swaps());
  const auto steps_on = [&]() -> Result<bool> {  // whether they are not at rest yet
    const std::vector<Vec3d> before = simulation->centers();
    const double time = simulation->tissue().clock.time;
    MORULA_TRY(simulation->step(end));
    const std::vector<Vec3d> now = simulation->centers();
    double way = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) way = std::max(way, norm(now[i] - before[i]));
    return way > kAtRest * radius || simulation->tissue().clock.time - time < kAtRestStep;
  };
  int steps = 0;
  for (bool goes_on = true; goes_on && simulation->tissue().clock.time < end; ++steps) {
    if (steps == kMostSteps) return Error{ErrorKind::kPhysics, "spheres in a random packing find no rest", "calibrate with `--pairs-only`"};
    MORULA_TRY_ASSIGN(goes_on, steps_on());
  }
  Rest out{.pressure = 0.0, .contact_area = 0.0, .centers = simulation->centers()};
  const BodyValues values = simulation->values();
  for (std::size_t i = 0; i < values.pressure.size(); ++i) {
    out.pressure += values.stressed_volume[i] * values.pressure[i];
    out.contact_area += values.contact_area[i] / static_cast<double>(values.contact_area.size());
  }
  out.pressure /= std::pow(edge, 3.0);
  return out;
}

}  // namespace

Result<SpheresInPackings> SpheresInPackings::read(const CellMaterial& material, std::span<const FoundPacking> packings, int threads) {
  SpheresInPackings out;
  out.threads_ = threads;
  out.adhesion_ = material.adhesion;
  for (const FoundPacking& packing : packings) {
    std::optional<Start>& start = out.starts_.emplace_back();
    if (packing.centers.empty()) continue;
    auto study = read_study_text("spheres", study_of_spheres(material, packing.centers, packing.edge), {});
    if (!study.ok()) return Error{ErrorKind::kInternal, "the study of spheres in a packing is refused: " + study.error().text(), ""};
    start = Start{std::move(study).value(), packing.edge};
  }
  return out;
}

Status SpheresInPackings::place_one(const TrialLaw& law, const Start& start, PackingPoint& point) const {
  const auto& [study, edge] = start;
  MORULA_TRY_ASSIGN(auto spheres, spheres_on_trial(study, law, adhesion_));
  MORULA_TRY_ASSIGN(const Rest rest, rest_of_spheres(std::move(spheres), edge, point.radius, study.time.end));
  point.random = calibrate::geometry_of_places(rest.centers, edge, point.radius);
  point.random.contact_area = rest.contact_area;
  point.random.extra = rest.pressure - pressure_by(law, point);
  return {};
}

Status SpheresInPackings::place(const TrialLaw& law, bool held_out, calibrate::Data& data) const {
  std::vector<Status> placed(starts_.size());
  one_by_one(threads_, starts_.size(), [&](std::size_t k) {
    if (starts_[k] && data.packings[k].held_out == held_out) placed[k] = place_one(law, *starts_[k], data.packings[k]);
  });
  for (Status& one : placed) MORULA_TRY(std::move(one));
  return {};
}

Status fit_in_turns(calibrate::Data& data, const calibrate::LossWeights& weights,
                    const std::function<Result<TrialLaw>(const calibrate::Data&)>& make, const SpheresInPackings& places) {
  const auto is_placed = [](const PackingPoint& p) { return p.arrangement == Arrangement::kRandom && !p.held_out; };
  if (std::ranges::none_of(data.packings, is_placed)) return {};
  for (PackingPoint& point : data.packings)  // order is stiffer than disorder, and balls that are too soft would find an order of their own
    if (is_placed(point)) point.random = lattice_geometry(Arrangement::kFaceCentred, point.volume_ratio);
  calibrate::Data now = data;
  double least = 0.0;
  int since = 0;
  for (int turn = 1; turn <= kMostTurns && since < kPatience; ++turn, ++since) {
    MORULA_TRY_ASSIGN(const TrialLaw law, make(now));
    if (law.sphere.packing.empty()) return {};  // pairs bear all: there is nothing to find in turns
    const calibrate::Data told = now;
    MORULA_TRY(places.place(law, false, now));
    double sum = 0.0;
    for (const PackingPoint& point : now.packings)
      if (is_placed(point)) {
        const double noise = weights.pressure_floor + weights.pressure_relative * std::abs(point.pressure);
        sum += std::pow((pressure_by(law, point) - point.pressure) / noise, 2);
      }
    if (turn > 1 && !(sum < (1.0 - kGain) * least)) continue;
    data = told;
    least = sum, since = -1;
  }
  return {};
}

}  // namespace morula::scenarios
