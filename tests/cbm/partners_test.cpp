#include "cbm/partners.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace morula::cbm {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;

CellId cell(std::uint64_t number) { return CellId::founder(number); }

TEST(Partners, AreSortedAndEachOnce) {
  Partners partners;
  for (const std::uint64_t number : {5, 2, 9, 2, 5}) set_adheres(partners, cell(number), true);
  EXPECT_THAT(partners, ElementsAre(cell(2), cell(5), cell(9)));
  EXPECT_TRUE(adheres(partners, cell(5)));
  set_adheres(partners, cell(5), false);
  set_adheres(partners, cell(7), false);
  EXPECT_THAT(partners, ElementsAre(cell(2), cell(9)));
  EXPECT_FALSE(adheres(partners, cell(5)));
}

TEST(PartnerLists, KeepTheListsOfSpheresApart) {
  PartnerLists lists;
  for (const Partners& partners : {Partners{cell(2), cell(9)}, Partners{}, Partners{cell(4)}}) lists.push_back(partners);
  ASSERT_EQ(lists.size(), 3u);
  EXPECT_THAT(lists[0], ElementsAre(cell(2), cell(9)));
  EXPECT_THAT(lists[1], ElementsAre());
  EXPECT_THAT(lists[2], ElementsAre(cell(4)));
  EXPECT_TRUE(adheres(lists[2], cell(4)));
}

TEST(PartnerLists, StayWhatTheyAreHoweverOftenOthersChange) {
  PartnerLists lists;
  std::vector<Partners> expected(40);
  for (const Partners& partners : expected) lists.push_back(partners);
  std::size_t most = 0;
  for (std::uint64_t round = 1; round <= 20000; ++round) {
    const std::size_t sphere = round * 7919 % expected.size();
    expected[sphere].clear();
    for (std::uint64_t k = 0; k < round * 104729 % 23; ++k) expected[sphere].push_back(cell(round + 3 * k));
    lists.set(sphere, expected[sphere]);
    most = std::max(most, lists.memory());
    if (round % 500 != 0) continue;
    for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_THAT(lists[i], ElementsAreArray(expected[i])) << round;
  }
  EXPECT_LT(most, 2 * (40 * 23 + 64) * sizeof(CellId));  // what is left behind is taken back
}

TEST(PartnerLists, LetRowsGoAndComeWhileWhatTheySayStays) {
  PartnerLists lists;
  for (std::uint64_t i = 0; i < 5; ++i) lists.push_back(Partners{cell(2 * i), cell(2 * i + 1)});
  lists.leave(1);
  lists.rows().erase(lists.rows().begin() + 1);
  lists.rows().insert(lists.rows().begin() + 2, lists.store(Partners{cell(77)}));
  for (int round = 0; round < 200; ++round) lists.set(0, Partners(static_cast<std::size_t>(round), cell(1)));
  EXPECT_THAT(lists[1], ElementsAre(cell(4), cell(5)));
  EXPECT_THAT(lists[2], ElementsAre(cell(77)));
  EXPECT_THAT(lists[4], ElementsAre(cell(8), cell(9)));
}

TEST(Partners, PassToBothDaughtersAndTheirNeighbours) {
  const CellId mother = cell(4), first = mother.daughter(0), second = mother.daughter(1);
  EXPECT_THAT(daughter_partners({cell(2), cell(9)}, second), ElementsAre(cell(2), cell(9), second));
  Partners neighbour = {cell(1), mother};
  replace_partner(neighbour, mother, first, second);
  EXPECT_THAT(neighbour, ElementsAre(cell(1), first, second));
  Partners stranger = {cell(1)};
  replace_partner(stranger, mother, first, second);
  EXPECT_THAT(stranger, ElementsAre(cell(1)));
}

}  // namespace
}  // namespace morula::cbm
