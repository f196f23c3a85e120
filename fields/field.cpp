#include "fields/field.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>

namespace morula::fields {

std::array<std::int32_t, 3> Grid::place(std::int64_t brick) const {
  return {static_cast<std::int32_t>(brick % bricks[0]), static_cast<std::int32_t>((brick / bricks[0]) % bricks[1]),
          static_cast<std::int32_t>(brick / (std::int64_t{bricks[0]} * bricks[1]))};
}

std::int64_t Grid::brick_at(const std::array<std::int32_t, 3>& p) const {
  return p[0] + std::int64_t{bricks[0]} * (p[1] + std::int64_t{bricks[1]} * p[2]);
}

std::array<std::int32_t, 3> Grid::extent(std::int64_t brick) const {
  const auto p = place(brick);
  std::array<std::int32_t, 3> out{};
  for (std::size_t a = 0; a < 3; ++a) out[a] = std::min(kBrick, voxels[a] - kBrick * p[a]);
  return out;
}

Vec3d Grid::voxel_center(const std::array<std::int32_t, 3>& v) const {
  const Vec3d h = spacing();
  return {box.low.x + (v[0] + 0.5) * h.x, box.low.y + (v[1] + 0.5) * h.y, box.low.z + (v[2] + 0.5) * h.z};
}

Result<Grid> grid_for(const FieldSpec& spec, const Space& space) {
  if (!(spec.voxel > 0.0) || !std::isfinite(spec.voxel))
    return Error{ErrorKind::kInput,
                 "field '" + spec.name + "': the voxel size must be positive, it is " + std::to_string(spec.voxel) + " µm",
                 "give a voxel size such as 10 um"};
  Grid grid;
  grid.box = space.box;
  const Vec3d size = space.box.size();
  for (std::size_t a = 0; a < 3; ++a) {
    const double wanted = std::ceil(size[a] / spec.voxel * (1.0 - 1e-12));
    if (!(size[a] > 0.0) || !(wanted < static_cast<double>(std::numeric_limits<std::int32_t>::max())))
      return Error{ErrorKind::kInput,
                   "field '" + spec.name + "': the domain cannot be cut into voxels of " + std::to_string(spec.voxel) + " µm",
                   "make the domain larger than nothing and the voxels larger"};
    grid.voxels[a] = std::max(1, static_cast<std::int32_t>(wanted));
    grid.bricks[a] = (grid.voxels[a] + Grid::kBrick - 1) / Grid::kBrick;
  }
  return grid;
}

namespace {

std::uint64_t z_order(const std::array<std::int32_t, 3>& p) {
  std::uint64_t out = 0;
  for (int bit = 0; bit < 21; ++bit)
    for (std::size_t a = 0; a < 3; ++a) out |= ((static_cast<std::uint64_t>(p[a]) >> bit) & 1u) << (3 * bit + static_cast<int>(a));
  return out;
}

std::size_t voxels_in(const Grid& grid, std::int64_t brick) {
  const auto n = grid.extent(brick);
  return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(n[2]);
}

}  // namespace

std::vector<int> owners_along_curve(const Grid& grid, int ranks) {
  const auto count = static_cast<std::size_t>(grid.brick_count());
  std::vector<std::pair<std::uint64_t, std::int64_t>> along(count);
  for (std::size_t b = 0; b < count; ++b) along[b] = {z_order(grid.place(static_cast<std::int64_t>(b))), static_cast<std::int64_t>(b)};
  std::sort(along.begin(), along.end());
  std::vector<int> owner(count);
  for (std::size_t i = 0; i < count; ++i)
    owner[static_cast<std::size_t>(along[i].second)] = static_cast<int>(i * static_cast<std::size_t>(ranks) / count);
  return owner;
}

Field uniform_field(const Grid& grid, double concentration, std::span<const int> owner_of_brick, int rank) {
  Field field;
  field.grid = grid;
  field.owner.assign(owner_of_brick.begin(), owner_of_brick.end());
  for (std::int64_t b = 0; b < grid.brick_count(); ++b) {
    if (owner_of_brick[static_cast<std::size_t>(b)] != rank) continue;
    field.owned_bricks.push_back(b);
    field.concentration.emplace_back(voxels_in(grid, b), concentration);
  }
  return field;
}

void redistribute(Field& field, std::span<const int> new_owner, const Comm& comm) {
  Mail outgoing;
  const auto append = [](std::vector<std::byte>& to, const void* from, std::size_t bytes) {
    const auto at = to.size();
    to.resize(at + bytes);
    std::memcpy(to.data() + at, from, bytes);
  };
  for (std::size_t i = 0; i < field.owned_bricks.size(); ++i) {
    const std::int64_t brick = field.owned_bricks[i];
    auto& message = outgoing[new_owner[static_cast<std::size_t>(brick)]];
    append(message, &brick, sizeof(brick));
    append(message, field.concentration[i].data(), field.concentration[i].size() * sizeof(double));
  }
  std::vector<std::pair<std::int64_t, std::vector<double>>> mine;
  for (const auto& [rank, message] : comm.exchange(std::move(outgoing))) {
    for (std::size_t at = 0; at < message.size();) {
      std::int64_t brick = 0;
      std::memcpy(&brick, message.data() + at, sizeof(brick));
      at += sizeof(brick);
      std::vector<double> values(voxels_in(field.grid, brick));
      std::memcpy(values.data(), message.data() + at, values.size() * sizeof(double));
      at += values.size() * sizeof(double);
      mine.emplace_back(brick, std::move(values));
    }
  }
  std::sort(mine.begin(), mine.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  field.owner.assign(new_owner.begin(), new_owner.end());
  field.owned_bricks.clear();
  field.concentration.clear();
  for (auto& [brick, values] : mine) {
    field.owned_bricks.push_back(brick);
    field.concentration.push_back(std::move(values));
  }
}

bool owns_its_bricks(const Field& field, int rank) {
  if (field.owner.size() != static_cast<std::size_t>(field.grid.brick_count())) return false;
  const auto mine = std::count(field.owner.begin(), field.owner.end(), rank);
  return mine == static_cast<std::ptrdiff_t>(field.owned_bricks.size()) &&
         std::all_of(field.owned_bricks.begin(), field.owned_bricks.end(),
                     [&](std::int64_t brick) { return field.owner[static_cast<std::size_t>(brick)] == rank; });
}

double total_amount(const Field& field, const Comm& comm) {
  OrderFreeSum sum;
  for (const auto& brick : field.concentration) {
    for (const double c : brick) sum.add(c);
    sum.carry();
  }
  return comm.sum(sum) * field.grid.voxel_volume();
}

}  // namespace morula::fields
