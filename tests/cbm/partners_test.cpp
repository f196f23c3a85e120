#include "cbm/partners.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace morula::cbm {
namespace {

using testing::ElementsAre;

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
  EXPECT_EQ(lists.partner_count(), 3u);
  EXPECT_THAT(lists[0], ElementsAre(cell(2), cell(9)));
  EXPECT_THAT(lists[1], ElementsAre());
  EXPECT_THAT(lists[2], ElementsAre(cell(4)));
  EXPECT_TRUE(adheres(lists[2], cell(4)));
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
