#include "coupling/mechanics/merge_sphere_pairs.h"

#include <algorithm>

#include "core/contact/body_changes.h"
#include "core/parallel/threads.h"

namespace morula {
namespace {

/// New numbers of spheres, by old one, with a bit that says to look closer: the sphere is fresh, or gone.
class Codes {
 public:
  Codes(const SphereRenumbering& number, std::span<const char> fresh) : code_(number.now) {
    for (std::uint32_t& code : code_)
      if (code != BodyChanges::kNone && fresh[code] != 0) code |= kLookCloser;
  }
  [[nodiscard]] std::uint32_t of(std::uint32_t old) const { return code_[old]; }
  static bool is_plain(std::uint32_t a, std::uint32_t b) { return ((a | b) & kLookCloser) == 0; }
  static std::uint32_t number(std::uint32_t code) { return code & ~kLookCloser; }

 private:
  static constexpr std::uint32_t kLookCloser = 0x80000000u;
  std::vector<std::uint32_t> code_;
};

std::ptrdiff_t at(std::size_t k) { return static_cast<std::ptrdiff_t>(k); }

/// What one thread does: a stretch of the old pairs.
struct Stretch {
  std::size_t first = 0, last = 0, end = 0;  ///< old pairs; where those that stay end, beginning with `first`
  std::vector<SpherePair> dropped;
  std::vector<std::uint32_t> of_fresh;  ///< of those that stay, counted from `first`
};

/// Renumbers the pairs of a stretch where they are, closing the gaps; `watched_now`: where those of `watched` that lie in it are then, counted from its first.
void renumber(std::vector<SpherePair>& pairs, const Codes& codes, std::span<const std::uint32_t> watched,
              std::span<std::uint32_t> watched_now, Stretch& s) {
  auto watch = static_cast<std::size_t>(std::ranges::lower_bound(watched, s.first) - watched.begin());
  std::size_t to = s.first;
  for (std::size_t k = s.first; k < s.last; ++k) {
    const SpherePair old = pairs[k];
    const std::uint32_t a = codes.of(old.a), b = codes.of(old.b);
    bool stays = true;
    if (!Codes::is_plain(a, b)) {
      stays = a != BodyChanges::kNone && b != BodyChanges::kNone;
      if (stays)
        s.of_fresh.push_back(static_cast<std::uint32_t>(to - s.first));
      else
        s.dropped.push_back(old);
    }
    if (watch < watched.size() && watched[watch] == k)
      watched_now[watch++] = stays ? static_cast<std::uint32_t>(to - s.first) : MergedPairs::kGone;
    pairs[to] = {Codes::number(a), Codes::number(b) & 0x7FFFFFFFu, old.attached};
    to += stays;
  }
  s.end = to;
}

/// Moves the stretches up to each other; what they have told counts from the first pair on then.
void close_up(std::vector<SpherePair>& pairs, std::span<const Stretch> stretches, std::span<const std::uint32_t> watched,
              MergedPairs& out) {
  std::size_t kept = 0, watch = 0;
  for (const Stretch& s : stretches) {
    for (; watch < watched.size() && watched[watch] < s.last; ++watch)
      if (out.watched[watch] != MergedPairs::kGone) out.watched[watch] += static_cast<std::uint32_t>(kept);
    for (const std::uint32_t k : s.of_fresh) out.of_fresh.push_back(static_cast<std::uint32_t>(kept + k));
    out.dropped.insert(out.dropped.end(), s.dropped.begin(), s.dropped.end());
    if (kept != s.first) std::copy(pairs.begin() + at(s.first), pairs.begin() + at(s.end), pairs.begin() + at(kept));
    kept += s.end - s.first;
  }
  pairs.resize(kept);
}

/// Puts pairs among those that stay, from behind. Gives how many of these come before each of them.
template <class Before>
std::vector<std::size_t> put_among(std::vector<SpherePair>& pairs, std::span<const SpherePair> found, Before&& comes_before) {
  std::vector<std::size_t> before;
  for (const SpherePair& pair : found)
    before.push_back(static_cast<std::size_t>(std::lower_bound(pairs.begin(), pairs.end(), pair, comes_before) - pairs.begin()));
  std::size_t end = pairs.size();
  const std::size_t all = end + found.size();
  if (all > pairs.capacity()) pairs.reserve(all + all / 64);  // no growth by doubling
  pairs.resize(all);
  for (std::size_t f = found.size(); f-- > 0; end = before[f]) {
    std::move_backward(pairs.begin() + at(before[f]), pairs.begin() + at(end), pairs.begin() + at(end + f + 1));
    pairs[before[f] + f] = found[f];
  }
  return before;
}

}  // namespace

MergedPairs merge_sphere_pairs(std::vector<SpherePair>& pairs, const SphereRenumbering& number, std::span<const SphereNeighbours> found,
                               std::span<const ContactBody> spheres, std::uint32_t first_sphere, std::span<const char> fresh,
                               std::span<const std::uint32_t> watched, int threads) {
  const auto count = static_cast<std::size_t>(std::max(1, threads));
  const Codes codes(number, fresh);
  MergedPairs out;
  out.watched.resize(watched.size());
  std::vector<Stretch> stretches(count);
  on_each_thread(threads, [&](std::size_t t) {
    stretches[t].first = pairs.size() * t / count;
    stretches[t].last = pairs.size() * (t + 1) / count;
    renumber(pairs, codes, watched, out.watched, stretches[t]);
  });
  close_up(pairs, stretches, watched, out);
  std::vector<SpherePair> come;
  for (const SphereNeighbours& one : found) come.push_back(pair_of(one, first_sphere));
  const std::vector<std::size_t> before =
      put_among(pairs, come, [&](const SpherePair& p, const SpherePair& q) { return comes_before(spheres, p, q); });
  const auto shift = [&](std::uint32_t& k) {  // by those that came in before it
    k += static_cast<std::uint32_t>(std::ranges::upper_bound(before, k) - before.begin());
  };
  for (std::uint32_t& k : out.watched)
    if (k != MergedPairs::kGone) shift(k);
  for (std::uint32_t& k : out.of_fresh) shift(k);
  for (std::size_t f = 0; f < come.size(); ++f)
    if ((fresh[come[f].a] | fresh[come[f].b]) != 0) out.of_fresh.push_back(static_cast<std::uint32_t>(before[f] + f));
  std::ranges::sort(out.of_fresh);
  return out;
}

}  // namespace morula
