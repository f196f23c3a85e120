/// How a scene that is built again differs from what it was.
#include <algorithm>
#include <cstring>

#include "coupling/mechanics/scene.h"

namespace morula {
namespace {

/// Bodies that have come or gone in one place of the order, at most.
constexpr std::size_t kFewInPlace = 64;
/// Part of the bodies that may have come or gone; beyond it lists are as well made anew.
constexpr std::size_t kPartOfBodies = 16;

/// Numbers first <= body < last.
struct Range {
  std::size_t first, last;
  [[nodiscard]] std::size_t size() const { return last - first; }
};

/// Calls same(old, new) for the bodies of two sequences with the same id, which come in the same order in both but for a few that are in one of them
/// alone. False where there are too many of these in one place.
template <class Same>
bool match_in_order(std::span<const ContactBody> before, Range old, std::span<const ContactBody> after, Range now, Same&& same) {
  while (old.size() > 0 && now.size() > 0) {
    if (before[old.first].id == after[now.first].id) {
      same(old.first++, now.first++);
      continue;
    }
    bool found = false;  // the nearest place from where both go on together
    for (std::size_t skipped = 1; skipped <= kFewInPlace && !found; ++skipped)
      for (std::size_t of_old = 0; of_old <= skipped && !found; ++of_old) {
        const std::size_t i = old.first + of_old, j = now.first + (skipped - of_old);
        found = i < old.last && j < now.last && before[i].id == after[j].id;
        if (found) old.first = i, now.first = j;
      }
    if (!found) return old.size() + now.size() <= kFewInPlace;
  }
  return true;
}

/// The same where the order may be any.
template <class Same>
void match_by_id(std::span<const ContactBody> before, Range old, std::span<const ContactBody> after, Range now, Same&& same) {
  std::vector<std::pair<CellId, std::size_t>> by_id;
  for (std::size_t i = old.first; i < old.last; ++i) by_id.emplace_back(before[i].id, i);
  std::ranges::sort(by_id);
  for (std::size_t j = now.first; j < now.last; ++j) {
    const auto at = std::ranges::lower_bound(by_id, after[j].id, {}, &std::pair<CellId, std::size_t>::first);
    if (at != by_id.end() && at->first == after[j].id) same(at->second, j);
  }
}

}  // namespace

std::optional<BodyChanges> Scene::renew(const Tissue& tissue, const Space& space, double reach, ShapeLibrary& library, const Comm& comm) {
  BodyChanges out;
  const Counts old = count_;
  const std::vector<std::shared_ptr<const ReferenceShape>> old_shapes = std::move(shapes_);
  const std::vector<Vec3d> old_position = std::move(points_.x);
  out.before = std::move(bodies_);
  out.shells_before = old.shells;
  out.positions_number = points_.number;
  build(tissue, space, reach, library, comm);

  out.now.assign(out.before.size(), BodyChanges::kNone);
  out.was.assign(bodies_.size(), BodyChanges::kNone);
  const auto same = [&](std::size_t i, std::size_t j) {
    const ContactBody &a = out.before[i], &b = bodies_[j];
    if (a.material != b.material || a.point_count != b.point_count || (i < old.shells && old_shapes[i] != shapes_[j])) return;
    const Vec3d *const was = old_position.data() + a.first_point, *const is = points_.x.data() + b.first_point;
    if (std::memcmp(was, is, a.point_count * sizeof(Vec3d)) != 0) return;
    out.now[i] = static_cast<std::uint32_t>(j);
    out.was[j] = static_cast<std::uint32_t>(i);
  };
  const auto match = [&](Range from, Range to) { return match_in_order(out.before, from, bodies_, to, same); };
  const auto ghosts = [&](Range from, Range to) { match_by_id(out.before, from, bodies_, to, same); };
  if (!match({0, old.owned_shells}, {0, count_.owned_shells})) return std::nullopt;
  ghosts({old.owned_shells, old.shells}, {count_.owned_shells, count_.shells});
  const std::size_t old_spheres = old.shells + old.owned_spheres, spheres = count_.shells + count_.owned_spheres;
  if (!match({old.shells, old_spheres}, {count_.shells, spheres})) return std::nullopt;
  ghosts({old_spheres, out.before.size()}, {spheres, bodies_.size()});

  for (std::uint32_t j = 0; j < out.was.size(); ++j)
    if (out.was[j] == BodyChanges::kNone) out.fresh.push_back(j);
  const std::size_t gone = out.before.size() - (bodies_.size() - out.fresh.size());
  if ((out.fresh.size() + gone) * kPartOfBodies > bodies_.size() + kFewInPlace * kPartOfBodies) return std::nullopt;
  return out;
}

}  // namespace morula
