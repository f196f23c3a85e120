#include "coupling/mechanics/merge_sphere_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>

#include "core/contact/body_changes.h"
#include "core/contact/contact_layer.h"

namespace morula {
namespace {

constexpr std::uint32_t kNone = BodyChanges::kNone, kFirst = 3;  // three shells stand before the spheres

/// A list of pairs of `before` spheres, of which some go, some stay and others come: the places of old ones are their numbers times ten and five.
struct Change {
  std::vector<ContactBody> spheres;
  std::vector<SpherePair> old;
  SphereRenumbering number;
  std::vector<SphereNeighbours> found;
  std::vector<char> fresh;
  std::vector<std::uint32_t> watched;

  explicit Change(unsigned seed, std::uint32_t before, std::size_t pairs) {
    std::mt19937 random(seed);
    const auto one_of = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    std::set<std::pair<std::uint32_t, std::uint32_t>> those;
    while (those.size() < pairs) {
      const std::uint32_t a = one_of(before), b = one_of(before);
      if (a < b) those.insert({a, b});
    }
    for (const auto& [a, b] : those) old.push_back({a, b, one_of(2)});
    std::vector<std::uint32_t> place;
    for (std::uint32_t i = 0; i < before; ++i)
      if (const std::uint32_t what = one_of(12); what > 0) {
        if (what == 1) place.push_back(10 * i), fresh.push_back(1);  // another comes beside it
        number.place.push_back(static_cast<std::uint32_t>(place.size()));
        const bool strays = what == 2;
        number.now.push_back(strays ? kNone : number.place.back());
        place.push_back(10 * i + 5), fresh.push_back(strays);
      } else {
        number.place.push_back(kNone), number.now.push_back(kNone);
      }
    spheres.resize(place.size());
    for (std::size_t i = 0; i < place.size(); ++i) spheres[i].place = place[i];
    those.clear();
    const auto now = static_cast<std::uint32_t>(place.size());
    for (std::uint32_t i = 0; i < now; ++i)
      for (int k = 0; fresh[i] && k < 5; ++k)
        if (const std::uint32_t other = one_of(now); other != i) those.insert({std::min(i, other), std::max(i, other)});
    for (const auto& [a, b] : those) found.push_back({a + kFirst, b + kFirst});
    for (std::uint32_t k = 0; k < old.size(); ++k)
      if (one_of(9) == 0) watched.push_back(k);
  }
  /// The new list, and what else has changed.
  [[nodiscard]] std::pair<std::vector<SpherePair>, MergedPairs> merged(int threads) const {
    std::vector<ContactBody> bodies(kFirst);
    bodies.insert(bodies.end(), spheres.begin(), spheres.end());
    std::vector<SpherePair> pairs = old;
    MergedPairs out = merge_sphere_pairs(pairs, number, found, std::span(bodies).subspan(kFirst), kFirst, fresh, watched, threads);
    return {std::move(pairs), std::move(out)};
  }
};

std::pair<std::uint32_t, std::uint32_t> ends(const SpherePair& pair) { return {pair.a, pair.b}; }

void expect_equal(const std::vector<SpherePair>& a, const std::vector<SpherePair>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(ends(a[k]), ends(b[k]));
    EXPECT_EQ(a[k].attached, b[k].attached);
  }
}

void expect_equal(const MergedPairs& a, const MergedPairs& b) {
  expect_equal(a.dropped, b.dropped);
  EXPECT_EQ(a.of_fresh, b.of_fresh);
  EXPECT_EQ(a.watched, b.watched);
}

class MergeSpherePairs : public testing::TestWithParam<std::pair<std::uint32_t, std::size_t>> {};

TEST_P(MergeSpherePairs, GivesThoseThatStayAndThoseThatCameInCanonicalOrder) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Change change(seed, GetParam().first, GetParam().second);
    const auto [pairs, merged] = change.merged(1);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;
    std::vector<SpherePair> dropped;
    for (std::uint32_t k = 0; k < change.old.size(); ++k) {
      const std::uint32_t a = change.number.now[change.old[k].a], b = change.number.now[change.old[k].b];
      if (a == kNone || b == kNone)
        dropped.push_back(change.old[k]);
      else
        expected.emplace_back(a, b);
    }
    for (const SphereNeighbours& n : change.found) expected.emplace_back(n.a - kFirst, n.b - kFirst);
    std::ranges::sort(expected);  // numbers follow places
    ASSERT_EQ(pairs.size(), expected.size());
    std::vector<std::uint32_t> of_fresh;
    for (std::uint32_t k = 0; k < expected.size(); ++k) {
      EXPECT_EQ(ends(pairs[k]), expected[k]);
      if (change.fresh[expected[k].first] || change.fresh[expected[k].second]) of_fresh.push_back(k);
    }
    EXPECT_EQ(merged.of_fresh, of_fresh);
    expect_equal(merged.dropped, dropped);
    ASSERT_EQ(merged.watched.size(), change.watched.size());
    for (std::size_t w = 0; w < change.watched.size(); ++w) {
      const SpherePair& old = change.old[change.watched[w]];
      const std::uint32_t a = change.number.now[old.a], b = change.number.now[old.b];
      if (a == kNone || b == kNone) {
        EXPECT_EQ(merged.watched[w], MergedPairs::kGone);
        continue;
      }
      ASSERT_LT(merged.watched[w], pairs.size());
      EXPECT_EQ(ends(pairs[merged.watched[w]]), std::pair(a, b));
      EXPECT_EQ(pairs[merged.watched[w]].attached, old.attached);
    }
    for (const int threads : {2, 3, 8}) {
      const auto [same_pairs, same] = change.merged(threads);
      expect_equal(pairs, same_pairs);
      expect_equal(merged, same);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, MergeSpherePairs,
                         testing::Values(std::pair(300u, std::size_t{1500}), std::pair(12u, std::size_t{5}), std::pair(4u, std::size_t{1}),
                                         std::pair(40u, std::size_t{0})));

}  // namespace
}  // namespace morula
