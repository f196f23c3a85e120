#include <gtest/gtest.h>
#include <mpi.h>

#include "core/parallel/comm.h"

/// Runs the tests on all ranks; only rank 0 prints, and the program fails on every rank when a test failed on any.
int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  int status = 1;
  {
    const morula::Comm world(MPI_COMM_WORLD);
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    if (!world.is_root()) {
      struct OnlyFailures : testing::EmptyTestEventListener {
        void OnTestPartResult(const testing::TestPartResult& result) override {
          if (result.failed()) std::fprintf(stderr, "%s:%d: %s\n", result.file_name(), result.line_number(), result.message());
        }
      };
      delete listeners.Release(listeners.default_result_printer());
      listeners.Append(new OnlyFailures);
    }
    status = world.any(RUN_ALL_TESTS() != 0) ? 1 : 0;
  }
  MPI_Finalize();
  return status;
}
