#include "scenarios/measures/ways_of_cells.h"

#include <algorithm>
#include <map>

namespace morula::scenarios {

Status for_ways_since(FinishedRun& run, std::size_t from, const std::vector<std::size_t>& wanted,
                      const std::function<void(const Snapshot&, const Snapshot::Cell&, const Vec3d&)>& visit) {
  if (wanted.empty()) return {};
  struct Walk {
    Vec3d last, way;
  };
  const Space& space = run.study().model.space;
  std::map<CellId, Walk> walks;
  MORULA_TRY_ASSIGN(const auto first, run.snapshot(from));
  for (const Snapshot::Cell& cell : first->cells) walks.emplace(cell.id, Walk{cell.centroid, {}});
  for (std::size_t index = from; index <= wanted.back(); ++index) {
    const bool asked = std::ranges::binary_search(wanted, index);
    if (!asked && !space.any_periodic()) continue;
    MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot(index));
    for (const Snapshot::Cell& cell : snapshot->cells) {
      const auto walk = walks.find(cell.id);
      if (walk == walks.end()) continue;
      auto& [last, way] = walk->second;
      way += space.nearest_image(cell.centroid - last);
      last = cell.centroid;
      if (asked) visit(*snapshot, cell, way);
    }
  }
  return {};
}

}  // namespace morula::scenarios
