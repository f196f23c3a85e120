#include "core/shell_word.h"

#include <gtest/gtest.h>

namespace morula {
namespace {

TEST(ShellWord, IsQuotedWhereAShellWouldReadItOtherwise) {
  EXPECT_EQ(shell_word("runs/spheroid-0001"), "runs/spheroid-0001");
  EXPECT_EQ(shell_word("time.end=2h"), "time.end=2h");
  EXPECT_EQ(shell_word("sp ace"), "'sp ace'");
  EXPECT_EQ(shell_word("{left: 1e-4 J/m^2}"), "'{left: 1e-4 J/m^2}'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace morula
