#include "core/cell_id_text.h"

#include <gtest/gtest.h>

#include <random>

namespace morula {
namespace {

TEST(CellIdText, IsReadAsItIsWritten) {
  std::mt19937 random(7);
  for (int round = 0; round < 2000; ++round) {
    CellId id = CellId::founder(1 + random() % ((1u << CellId::kFounderBits) - 1));
    for (unsigned generations = random() % (CellId::kMaxGenerations + 1); generations > 0; --generations)
      id = id.daughter(static_cast<int>(random() % 2));
    EXPECT_EQ(cell_id_of(id.text()), id) << id.text();
  }
}

TEST(CellIdText, RefusesWhatIsNoName) {
  for (const char* text : {"", "0", "-1", "x", "3.", "3.2", "3.0 ", " 3", "3,4", "3.01.1", "268435456", "99999999999999999999"})
    EXPECT_FALSE(cell_id_of(text)) << text;
  EXPECT_TRUE(cell_id_of("268435455"));
  EXPECT_TRUE(cell_id_of("1." + std::string(CellId::kMaxGenerations, '1')));
  EXPECT_FALSE(cell_id_of("1." + std::string(CellId::kMaxGenerations + 1, '1')));
}

TEST(CellIdText, KnowsWhoComesOfWhom) {
  const auto of = [](const char* text) { return cell_id_of(text).value(); };
  for (const char* text : {"7.01", "7.010", "7.011", "7.01101"}) EXPECT_TRUE(descends_from(of(text), of("7.01"))) << text;
  for (const char* text : {"7", "7.0", "7.00", "7.1", "7.001", "8.01", "8.010"}) EXPECT_FALSE(descends_from(of(text), of("7.01"))) << text;
  EXPECT_TRUE(descends_from(of("7.01"), of("7")));
}

}  // namespace
}  // namespace morula
