#include "core/mesh/weld_nodes.h"

#include <array>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "core/space/space.h"

namespace morula {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t h = 0;
    for (const std::int64_t v : cell) {
      h = (h ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15u;
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
  }
};

/// Kept nodes in cells as wide as the reach; with no reach, a cell for each position.
class NodeGrid {
 public:
  NodeGrid(double reach, const Vec3d& low) : reach_(reach), low_(low) {}

  /// The lowest kept node in reach of p, or `number`, which is then kept.
  std::uint32_t find_or_keep(const Vec3d& p, std::uint32_t number, const std::vector<Vec3d>& kept) {
    const Cell home = cell_of(p);
    std::uint32_t found = number;
    const std::int64_t around = reach_ > 0.0 ? 1 : 0;
    for (std::int64_t dx = -around; dx <= around; ++dx)
      for (std::int64_t dy = -around; dy <= around; ++dy)
        for (std::int64_t dz = -around; dz <= around; ++dz) {
          const auto there = nodes_.find({home[0] + dx, home[1] + dy, home[2] + dz});
          if (there == nodes_.end()) continue;
          for (const std::uint32_t node : there->second)
            if (node < found && norm2(kept[node] - p) <= reach_ * reach_) found = node;
        }
    if (found == number) nodes_[home].push_back(number);
    return found;
  }

 private:
  [[nodiscard]] Cell cell_of(const Vec3d& p) const {
    Cell cell;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = p[axis] + 0.0;  // −0 becomes 0
      if (reach_ > 0.0)
        cell[axis] = static_cast<std::int64_t>(std::floor((value - low_[axis]) / reach_));
      else
        std::memcpy(&cell[axis], &value, sizeof value);
    }
    return cell;
  }

  double reach_;
  Vec3d low_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> nodes_;
};

}  // namespace

TriangleMesh with_welded_nodes(const TriangleMesh& mesh, double distance) {
  std::vector<char> used(mesh.position.size(), 0);
  for (const Triangle& face : mesh.faces)
    for (const std::uint32_t node : face) used[node] = 1;
  Box box;
  for (const Vec3d& p : mesh.position) box.include(p);
  // Cell numbers must fit in 64 bits.
  const double reach = distance > 1e-15 * norm(box.size()) ? distance : 0.0;

  TriangleMesh out;
  NodeGrid grid(reach, box.low);
  std::vector<std::uint32_t> new_number(mesh.position.size(), 0);
  for (std::size_t node = 0; node < mesh.position.size(); ++node) {
    if (!used[node]) continue;
    const auto fresh = static_cast<std::uint32_t>(out.position.size());
    new_number[node] = grid.find_or_keep(mesh.position[node], fresh, out.position);
    if (new_number[node] == fresh) out.position.push_back(mesh.position[node]);
  }
  out.faces = mesh.faces;
  for (Triangle& face : out.faces)
    for (std::uint32_t& node : face) node = new_number[node];
  return out;
}

}  // namespace morula
