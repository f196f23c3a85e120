#include "scenarios/measures/interface_layers.h"

#include <algorithm>
#include <map>

#include "core/contact/broad_phase.h"
#include "core/numbers/sample.h"

namespace morula::scenarios {
namespace {

using Cell = Snapshot::Cell;
constexpr double kReach = 1.2;

std::vector<std::vector<std::uint32_t>> neighbours_of(const std::vector<Cell>& cells, const Space& space) {
  std::vector<Ball> balls;
  for (const Cell& cell : cells) balls.push_back({cell.centroid, kReach * cell.radius});
  std::vector<std::vector<std::uint32_t>> out(cells.size());
  find_ball_pairs(balls, space, [&out](const BodyPair& pair) { out[pair.a].push_back(pair.b), out[pair.b].push_back(pair.a); });
  return out;
}

/// The layer of each cell, 1 at the other body; 0: no way leads there through cells of its own body.
std::vector<int> layers_of(const std::vector<Cell>& cells, const std::vector<std::vector<std::uint32_t>>& neighbours) {
  std::vector<int> out(cells.size(), 0);
  std::vector<std::uint32_t> front;
  for (std::uint32_t i = 0; i < cells.size(); ++i)
    if (std::ranges::any_of(neighbours[i], [&](std::uint32_t j) { return cells[j].body != cells[i].body; })) out[i] = 1, front.push_back(i);
  for (int layer = 2; !front.empty(); ++layer) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t i : front)
      for (const std::uint32_t j : neighbours[i])
        if (out[j] == 0 && cells[j].body == cells[i].body) out[j] = layer, next.push_back(j);
    front = std::move(next);
  }
  return out;
}

LayerMean mean_of(const std::vector<double>& values) {
  return {mean_of_sample(values), std::sqrt(variance_of_sample(values) / static_cast<double>(values.size()))};
}

std::map<CellId, Vec3d> places_of(const Snapshot& snapshot) {
  std::map<CellId, Vec3d> out;
  for (const Cell& cell : snapshot.cells) out.emplace(cell.id, cell.centroid);
  return out;
}

/// What the cells of a layer are like, cell by cell.
struct Values {
  std::vector<double> pressure, contact_part, volume, way, speed;
};

}  // namespace

std::vector<InterfaceLayer> interface_layers(const Snapshot& start, const Snapshot& before, const Snapshot& now, const Space& space) {
  Space here = space;
  if (!now.box.empty()) here.box = now.box;
  const auto at_start = places_of(start), at_before = places_of(before);
  const std::vector<int> layer = layers_of(now.cells, neighbours_of(now.cells, here));
  std::map<int, Values> values;  // spheres below 0, shells above
  for (std::size_t i = 0; i < now.cells.size(); ++i) {
    if (layer[i] == 0) continue;
    const Cell& cell = now.cells[i];
    Values& of = values[(cell.body == BodyKind::kShell ? 1 : -1) * std::min(layer[i], kInterfaceLayers)];
    of.pressure.push_back(cell.pressure);
    of.contact_part.push_back(cell.contact_area / cell.area);
    of.volume.push_back(cell.volume);
    const auto way_from = [&](const Vec3d& place) { return norm(here.nearest_image(cell.centroid - place)); };
    if (const auto then = at_start.find(cell.id); then != at_start.end()) of.way.push_back(way_from(then->second));
    const double time = now.time - before.time;
    if (const auto then = at_before.find(cell.id); then != at_before.end() && time > 0.0) of.speed.push_back(way_from(then->second) / time);
  }
  std::vector<InterfaceLayer> out;
  for (const auto& [number, of] : values)
    out.push_back({number > 0 ? BodyKind::kShell : BodyKind::kSphere, std::abs(number), std::abs(number) == kInterfaceLayers,
                   of.pressure.size(), mean_of(of.pressure), mean_of(of.contact_part), mean_of(of.volume), mean_of(of.way),
                   mean_of(of.speed)});
  return out;
}

LayerMean jump(const std::vector<InterfaceLayer>& layers, LayerMean InterfaceLayer::*value) {
  const auto at = [&](BodyKind body) {
    return std::ranges::find_if(layers, [body](const InterfaceLayer& one) { return one.body == body && one.number == 1; });
  };
  const auto spheres = at(BodyKind::kSphere), shells = at(BodyKind::kShell);
  if (spheres == layers.end() || shells == layers.end()) return {};
  const LayerMean &a = (*spheres).*value, &b = (*shells).*value;
  return {b.mean - a.mean, std::hypot(a.error, b.error)};
}

}  // namespace morula::scenarios
