#include <gtest/gtest.h>

#include "scenarios/run/driver.h"
#include "tests/results/results_support.h"
#include "tests/scenarios/pressed_cells.h"

namespace morula::scenarios {
namespace {

using testing_support::Folder;
using testing_support::slurp;

RunSummary pressed(const std::filesystem::path& out, const Comm& comm) {
  auto laws = std::make_shared<Laws>(*builtin_laws());
  test::add_pressed_cells(*laws);
  ReadOptions options;
  options.laws = laws;
  const auto study = read_study_text("study.yaml", test::two_types(test::kDeath + ", " + test::kTired), ".", options);
  EXPECT_TRUE(study.ok()) << study.error().text();
  RunRequest request;
  request.out = out;
  auto done = run(*study, request, comm);
  EXPECT_TRUE(done.ok()) << done.error().message;
  return done.ok() ? std::move(done).value() : RunSummary{};
}

TEST(OwnPartsOnRanks, EndInTheBitsOfOneRank) {
  const Comm all(MPI_COMM_WORLD);
  const Folder folder(all);
  RunSummary alone;
  if (all.is_root()) alone = pressed(folder / "alone", Comm(MPI_COMM_SELF));
  all.barrier();
  const RunSummary together = pressed(folder / "together", all);
  all.barrier();
  if (all.is_root()) {
    EXPECT_EQ(together.final_state.state_hash, alone.final_state.state_hash);
    EXPECT_EQ(slurp(folder / "together/series.csv"), slurp(folder / "alone/series.csv"));
    EXPECT_EQ(slurp(folder / "together/events.jsonl"), slurp(folder / "alone/events.jsonl"));
    EXPECT_NE(slurp(folder / "alone/events.jsonl").find("Death under pressure"), std::string::npos);
  }
}

}  // namespace
}  // namespace morula::scenarios
