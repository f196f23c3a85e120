#include "coupling/mechanics/merge_sphere_pairs.h"

#include <algorithm>

#include "core/contact/body_changes.h"
#include "core/parallel/threads.h"

namespace morula {
namespace {

/// What one thread does: a stretch of the old pairs, and of those that were found what comes among and behind them.
struct Stretch {
  std::size_t first = 0, last = 0;  ///< old pairs
  std::size_t kept = 0, found = 0;  ///< how many of them stay; the first of the found that comes in here
  std::vector<std::uint32_t> dropped, of_fresh;
};

struct Merge {
  std::span<const SpherePair> old;
  const SphereRenumbering& number;
  std::span<const SphereNeighbours> found;
  std::span<const ContactBody> spheres;
  std::uint32_t first_sphere;
  std::span<const char> fresh;
  std::span<const std::uint32_t> watched;

  [[nodiscard]] bool stays(const SpherePair& pair) const {
    return number.now[pair.a] != BodyChanges::kNone && number.now[pair.b] != BodyChanges::kNone;
  }
  [[nodiscard]] SpherePair renumbered(SpherePair pair) const {
    pair.a = number.now[pair.a];
    pair.b = number.now[pair.b] & 0x7FFFFFFFu;
    return pair;
  }
  /// Of the found ones the first that does not come before a pair.
  [[nodiscard]] std::size_t first_from(const SpherePair& pair) const {
    const auto at = std::ranges::partition_point(
        found, [&](const SphereNeighbours& n) { return comes_before(spheres, pair_of(n, first_sphere), pair); });
    return static_cast<std::size_t>(at - found.begin());
  }

  void lay_out(Stretch& s) const {
    for (std::size_t k = s.first; k < s.last; ++k)
      if (!stays(old[k])) s.dropped.push_back(static_cast<std::uint32_t>(k));
    s.kept = s.last - s.first - s.dropped.size();
    s.found = found.size();
    if (s.first == 0)
      s.found = 0;
    else if (s.kept > 0)
      s.found = first_from(renumbered(*std::find_if(old.begin() + static_cast<std::ptrdiff_t>(s.first), old.end(),
                                                    [&](const SpherePair& pair) { return stays(pair); })));
  }

  /// Writes what belongs to a stretch, from place `to` on; `last_found`: the first of the found that belongs to the next one.
  void write(Stretch& s, std::size_t to, std::size_t last_found, MergedPairs& out) const {
    const auto add = [&](const SpherePair& pair) {
      if ((fresh[pair.a] | fresh[pair.b]) != 0) s.of_fresh.push_back(static_cast<std::uint32_t>(to));
      out.pairs[to++] = pair;
    };
    std::size_t next = s.found;
    auto watch = static_cast<std::size_t>(std::ranges::lower_bound(watched, s.first) - watched.begin());
    for (std::size_t k = s.first; k < s.last; ++k) {
      const bool is_watched = watch < watched.size() && watched[watch] == k;
      if (is_watched) out.watched[watch] = MergedPairs::kGone;
      if (stays(old[k])) {
        const SpherePair pair = renumbered(old[k]);
        while (next < last_found && comes_before(spheres, pair_of(found[next], first_sphere), pair))
          add(pair_of(found[next++], first_sphere));
        if (is_watched) out.watched[watch] = static_cast<std::uint32_t>(to);
        add(pair);
      }
      watch += is_watched;
    }
    while (next < last_found) add(pair_of(found[next++], first_sphere));
  }
};

}  // namespace

MergedPairs merge_sphere_pairs(std::span<const SpherePair> old, const SphereRenumbering& number, std::span<const SphereNeighbours> found,
                               std::span<const ContactBody> spheres, std::uint32_t first_sphere, std::span<const char> fresh,
                               std::span<const std::uint32_t> watched, int threads) {
  const auto count = static_cast<std::size_t>(std::max(1, threads));
  const Merge merge{old, number, found, spheres, first_sphere, fresh, watched};
  std::vector<Stretch> stretches(count);
  on_each_thread(threads, [&](std::size_t t) {
    stretches[t].first = old.size() * t / count;
    stretches[t].last = old.size() * (t + 1) / count;
    merge.lay_out(stretches[t]);
  });
  MergedPairs out;
  out.watched.resize(watched.size());
  std::vector<std::size_t> kept_before(count, 0), last_found(count, found.size());
  for (std::size_t t = 1; t < count; ++t) kept_before[t] = kept_before[t - 1] + stretches[t - 1].kept;
  for (std::size_t t = count - 1; t-- > 0;) {
    stretches[t].found = std::min(stretches[t].found, stretches[t + 1].found);
    last_found[t] = stretches[t + 1].found;
  }
  out.pairs.resize(kept_before.back() + stretches.back().kept + found.size());
  on_each_thread(threads, [&](std::size_t t) { merge.write(stretches[t], kept_before[t] + stretches[t].found, last_found[t], out); });
  for (const Stretch& s : stretches) {
    out.dropped.insert(out.dropped.end(), s.dropped.begin(), s.dropped.end());
    out.of_fresh.insert(out.of_fresh.end(), s.of_fresh.begin(), s.of_fresh.end());
  }
  return out;
}

}  // namespace morula
