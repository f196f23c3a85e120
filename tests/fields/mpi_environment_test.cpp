#include <gtest/gtest.h>
#include <mpi.h>

namespace {

/// Starts MPI for the tests of this program; every test works on MPI_COMM_SELF.
class MpiEnvironment : public testing::Environment {
 public:
  void SetUp() override { MPI_Init(nullptr, nullptr); }
  void TearDown() override { MPI_Finalize(); }
};

[[maybe_unused]] const testing::Environment* const kMpi = testing::AddGlobalTestEnvironment(new MpiEnvironment);

}  // namespace
