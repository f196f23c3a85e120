// Ten thousand random sequences of local changes: what local_changes_test.cpp shows of some hundred.
#include <gtest/gtest.h>

#include "tests/core/mesh/renewal/random_changes.h"

namespace morula {
namespace {

TEST(LocalChangesAtLength, KeepClosedSurfacesAndTheirVolumeInTenThousandSequences) { EXPECT_GT(check_random_sequences(10000, 12), 60000u); }

}  // namespace
}  // namespace morula
