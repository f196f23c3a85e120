#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/random/philox.h"
#include "study/csv.h"

namespace morula::scenarios {
namespace {

struct Binned {
  std::array<std::int64_t, 3> bin;
  std::size_t cell;
};

bool earlier(const Binned& a, const Binned& b) { return a.bin != b.bin ? a.bin < b.bin : a.cell < b.cell; }

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

std::vector<std::vector<std::size_t>> coincident_groups(const std::vector<Vec3d>& positions, double below) {
  // Bins a little wider than `below`: partners lie in the same or a neighbouring bin. Coordinates are clamped so that bins fit 64 bits.
  const double width = std::max(below, 1e-9) * 1.0001;
  const auto bin = [width](double x) { return static_cast<std::int64_t>(std::floor(std::clamp(x / width, -4e18, 4e18))); };
  std::vector<std::size_t> parent(positions.size()), order(positions.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Vec3d &p = positions[a], &q = positions[b];
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  });
  std::vector<Binned> bins;  // of places, not of cells: many cells at one place must not make the search quadratic
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Vec3d& p = positions[order[k]];
    if (k > 0 && p == positions[order[k - 1]])
      parent[order[k]] = parent[order[k - 1]];
    else
      bins.push_back({{bin(p.x), bin(p.y), bin(p.z)}, order[k]});
  }
  std::sort(bins.begin(), bins.end(), earlier);
  const double limit = below * below;
  for (const Binned& a : bins) {
    for (int n = 0; n < 27; ++n) {
      const std::array<std::int64_t, 3> other{a.bin[0] + n / 9 - 1, a.bin[1] + n / 3 % 3 - 1, a.bin[2] + n % 3 - 1};
      auto b = std::lower_bound(bins.begin(), bins.end(), Binned{other, 0}, earlier);
      for (; b != bins.end() && b->bin == other; ++b)
        if (b->cell > a.cell && norm2(positions[a.cell] - positions[b->cell]) <= limit) {
          const std::size_t r = root_of(parent, a.cell), s = root_of(parent, b->cell);
          parent[std::max(r, s)] = std::min(r, s);
        }
    }
  }
  std::vector<std::vector<std::size_t>> by_root(positions.size()), groups;
  for (std::size_t i = 0; i < positions.size(); ++i) by_root[root_of(parent, i)].push_back(i);
  for (auto& group : by_root)
    if (group.size() > 1) groups.push_back(std::move(group));
  return groups;
}

void move_apart(std::vector<Vec3d>& positions, const std::vector<std::vector<std::size_t>>& groups, double shift,
                std::uint64_t first_number, std::uint32_t seed) {
  const Random random(seed, RandomStream::kSeparation);
  for (const auto& group : groups)
    for (std::size_t k = 1; k < group.size(); ++k)
      positions[group[k]] += random.direction(CellId::founder(first_number + group[k]), 0) * shift;
}

}  // namespace morula::scenarios
