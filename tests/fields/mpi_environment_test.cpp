#include <gtest/gtest.h>
#include <mpi.h>
#include <omp.h>

#include "core/parallel/quiet_mpi.h"

namespace {

/// Starts MPI for the tests of this program; every test works on MPI_COMM_SELF, with one thread unless it says otherwise: tests run
/// side by side, and threads that wait for a busy processor are slow.
class MpiEnvironment : public testing::Environment {
 public:
  void SetUp() override {
    morula::quiet_mpi();
    MPI_Init(nullptr, nullptr);
    omp_set_num_threads(1);
  }
  void TearDown() override { MPI_Finalize(); }
};

[[maybe_unused]] const testing::Environment* const kMpi = testing::AddGlobalTestEnvironment(new MpiEnvironment);

}  // namespace
