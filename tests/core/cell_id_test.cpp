#include "core/cell_id.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace morula {
namespace {

TEST(CellId, IsWrittenAsFounderAndPath) {
  const CellId founder = CellId::founder(17);
  EXPECT_EQ(founder.text(), "17");
  EXPECT_EQ(founder.daughter(0).text(), "17.0");
  EXPECT_EQ(founder.daughter(0).daughter(1).text(), "17.01");
  EXPECT_EQ(founder.daughter(1).daughter(1).daughter(0).text(), "17.110");
}

TEST(CellId, KnowsItsFounderAndGeneration) {
  CellId id = CellId::founder(123456);
  EXPECT_EQ(id.generation(), 0);
  for (int generation = 1; generation <= CellId::kMaxGenerations; ++generation) {
    ASSERT_TRUE(id.can_divide());
    id = id.daughter(generation % 2);
    EXPECT_EQ(id.generation(), generation);
    EXPECT_EQ(id.founder_number(), 123456u);
  }
  EXPECT_FALSE(id.can_divide());
  EXPECT_EQ(CellId::kMaxGenerations, 35);
  EXPECT_EQ(id.text().size(), std::string("123456.").size() + 35);
}

TEST(CellId, NeverClashesNeitherAsBitsNorAsText) {
  std::set<std::uint64_t> bits;
  std::set<std::string> texts;
  std::size_t count = 0;
  const auto visit = [&](const auto& self, CellId id, int depth) -> void {
    ++count;
    bits.insert(id.bits());
    texts.insert(id.text());
    if (depth == 0) return;
    self(self, id.daughter(0), depth - 1);
    self(self, id.daughter(1), depth - 1);
  };
  for (const std::uint64_t founder : {1ull, 2ull, 3ull, 10ull, 100ull, 101ull, (1ull << 28) - 1}) visit(visit, CellId::founder(founder), 9);
  EXPECT_EQ(count, 7u * 1023u);
  EXPECT_EQ(bits.size(), count);
  EXPECT_EQ(texts.size(), count);
}

TEST(CellId, DeepestDaughtersOfTheLastFounderStillDiffer) {
  CellId id = CellId::founder((1ull << 28) - 1);
  for (int i = 0; i < CellId::kMaxGenerations - 1; ++i) id = id.daughter(1);
  EXPECT_NE(id.daughter(0), id.daughter(1));
  EXPECT_EQ(id.daughter(1).bits(), ~std::uint64_t{0});
}

TEST(CellId, NoIdIsNotValid) {
  EXPECT_FALSE(CellId().valid());
  EXPECT_TRUE(CellId::founder(1).valid());
}

TEST(CellId, OrderIsByGenerationThenPathThenFounder) {
  const CellId a = CellId::founder(1), b = CellId::founder(2);
  EXPECT_LT(a, b);
  EXPECT_LT(b, a.daughter(0));
  EXPECT_LT(b.daughter(0), a.daughter(1));
  EXPECT_LT(b.daughter(1), a.daughter(0).daughter(0));
}

}  // namespace
}  // namespace morula
