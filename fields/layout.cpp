#include "fields/layout.h"

#include <algorithm>

namespace morula::fields {

Layout layout_of(const Field& field, std::vector<Sink> sinks) {
  Layout out;
  out.global_voxels = field.grid.voxel_count();
  out.offset.push_back(0);
  for (std::size_t b = 0; b < field.owned_bricks.size(); ++b) {
    out.extent.push_back(field.grid.extent(field.owned_bricks[b]));
    out.offset.push_back(out.offset.back() + field.concentration[b].size());
  }
  out.sinks = std::move(sinks);
  out.first_sink.resize(out.bricks() + 1);
  for (std::size_t b = 0; b <= out.bricks(); ++b) {
    const auto it =
        std::partition_point(out.sinks.begin(), out.sinks.end(), [b](const Sink& s) { return static_cast<std::size_t>(s.brick) < b; });
    out.first_sink[b] = static_cast<std::size_t>(it - out.sinks.begin());
  }
  return out;
}

}  // namespace morula::fields
