#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "results/file_io.h"
#include "results/hdf5_reader.h"
#include "results/series_reader.h"
#include "results/snapshot_file.h"
#include "results/state_hash.h"
#include "scenarios/run/driver.h"
#include "scenarios/run/report_run.h"
#include "scenarios/run/run_loop.h"
#include "study/initial/make_tissue.h"
#include "tests/results/results_support.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

using testing_support::slurp;
using testing_support::spit;
namespace fs = std::filesystem;

const std::string kSpheres = R"(schema: 1
study: growing
seed: 5
time: {end: 2 h, output: 30 min, checkpoint: 1 h}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell:
    radius: {mean: 6 um, spread: 5 %}
    cycle: {model: volume_threshold, duration: {mean: 4 h, spread: 10 %}}
    migration: {speed: 2 um/h, persistence: 30 min}
initial:
  - {type: cell, count: 8, fill: sphere, radius: 25 um}
output: {report: false}
)";

const std::string kShells = R"(schema: 1
study: pair
time: {end: 4 min, output: 1 min}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  cell: {radius: 6 um, dcm: {nodes: 42}}
contact: {range: 1 um}
initial:
  - {type: cell, at: [[-6 um, 0 um, 0 um], [6 um, 0 um, 0 um]], as: shell}
output: {report: false}
)";

const std::string kHybrid = R"(schema: 1
study: hybrid
time: {end: 20 min, output: 5 min}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell:
    radius: 6 um
    cycle: {model: volume_threshold, duration: 6 h}
    dcm: {nodes: 42}
contact: {range: 1 um}
initial:
  - {type: cell, count: 14, fill: sphere, radius: 30 um}
fields:
  oxygen: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, boundary: {all: 0.2 mM}, uptake: {cell: 40 amol/s}, voxel: 20 um}
coupling:
  regions:
    - {name: core, shape: sphere, center: [0 um, 0 um, 0 um], radius: 6 um, as: dcm, margin: 3 um}
output: {report: false, formats: [hdf5, vtk]}
)";

class Runs : public ::testing::Test {
 protected:
  Study study(const std::string& text) {
    auto read = test::read(text, {}, folder_.path());
    EXPECT_TRUE(read.ok()) << read.error().text();
    return std::move(read).value();
  }
  RunRequest request(const std::string& name) {
    RunRequest out;
    out.out = folder_.path() / name;
    out.command = "a test";
    return out;
  }
  RunSummary run_whole(const std::string& text, const std::string& name) {
    auto done = run(study(text), request(name), Comm());
    EXPECT_TRUE(done.ok()) << done.error().message;
    return done.ok() ? std::move(done).value() : RunSummary{};
  }
  ResumeRequest resume_request() { return {}; }

  /// To `until`, then resumed to the end.
  RunSummary run_split(const std::string& text, const std::string& name, double until) {
    RunRequest first = request(name);
    first.until = until;
    const auto half = run(study(text), first, Comm());
    EXPECT_TRUE(half.ok()) << half.error().message;
    auto rest = resume(folder_.path() / name, resume_request(), Comm());
    EXPECT_TRUE(rest.ok()) << rest.error().message;
    return rest.ok() ? std::move(rest).value() : RunSummary{};
  }
  fs::path operator/(const std::string& name) const { return folder_.path() / name; }

  test::Folder folder_;
};

TEST(OutputTimes, AreMultiplesOfTheIntervalAndTheEnd) {
  EXPECT_EQ(next_output(0.0, 1800.0, 7200.0), 1800.0);
  EXPECT_EQ(next_output(1800.0, 1800.0, 7200.0), 3600.0);
  EXPECT_EQ(next_output(7000.0, 1800.0, 7100.0), 7100.0);
  for (int k = 1; k < 1000; ++k) ASSERT_EQ(next_output(k * 0.1, 0.1, 1e9), (k + 1) * 0.1);  // 0.1 is no binary number
  for (int k = 1; k < 1000; ++k) ASSERT_EQ(next_output(std::nextafter(k * 0.1, 0.0), 0.1, 1e9), (k + 1) * 0.1) << "one moment";
  for (const double interval : {0.3, 0.7, 2.3, 1.2})
    for (int n = 1; n < 100; ++n) {  // n × interval as a study writes it: rounded to the nearest number
      const double end = std::round(n * interval * 10.0) / 10.0;
      ASSERT_EQ(next_output((n - 1) * interval, interval, end), end) << n << " × " << interval;
    }
}

TEST(OutputTimes, UntilIsRoundedUp) {
  const TimeSpec time{7200.0, 1800.0, 3600.0};
  EXPECT_EQ(end_of_run(time, {}), 7200.0);
  EXPECT_EQ(end_of_run(time, 3600.0), 3600.0);
  EXPECT_EQ(end_of_run(time, 3601.0), 5400.0);
  EXPECT_EQ(end_of_run(time, 7300.0), 9000.0);
  EXPECT_EQ(end_of_run({7000.0, 1800.0, 3600.0}, 6500.0), 7000.0);
}

TEST_F(Runs, GrowingSpheresLeaveAWholeFolder) {
  const RunSummary summary = run_whole(kSpheres, "a");
  EXPECT_EQ(summary.state, RunState::kDone);
  EXPECT_EQ(summary.final_state.time, 7200.0);
  EXPECT_GE(summary.final_state.cells, 9u);  // of 8 cells with a cycle of 4 h about 3 divide in 2 h
  EXPECT_TRUE(summary.passed);
  for (const char* name : {"study.yaml", "study.resolved.yaml", "run.json", "status.json", "events.jsonl", "series.csv", "verdict.json",
                           "methods.md", "results.h5", "DONE"})
    EXPECT_TRUE(fs::exists((*this / "a") / name)) << name;
  const auto series = read_series(*this / "a/series.csv");
  ASSERT_TRUE(series.ok());
  EXPECT_EQ(series->find("time")->values, (std::vector<double>{0, 1800, 3600, 5400, 7200}));
  EXPECT_EQ(series->find("cell_count")->values.front(), 8.0);
  EXPECT_EQ(series->find("cell_count")->values.back(), static_cast<double>(summary.final_state.cells));
  EXPECT_GT(series->find("total_volume")->values.back(), 1.3 * series->find("total_volume")->values.front());
  const auto snapshots = list_snapshots(*this / "a/results.h5");
  ASSERT_TRUE(snapshots.ok());
  EXPECT_EQ(snapshots->size(), 5u);
  const auto record = read_run_record(*this / "a/run.json");
  ASSERT_TRUE(record.ok());
  EXPECT_EQ(record->state, RunState::kDone);
  EXPECT_EQ(record->final_state->state_hash, summary.final_state.state_hash);
}

TEST_F(Runs, ASplitRunEndsInTheSameBits) {
  const RunSummary whole = run_whole(kSpheres, "whole");
  const RunSummary split = run_split(kSpheres, "split", 3500.0);
  EXPECT_EQ(split.final_state.state_hash, whole.final_state.state_hash);
  EXPECT_EQ(slurp(*this / "split/series.csv"), slurp(*this / "whole/series.csv"));
  EXPECT_EQ(slurp(*this / "split/events.jsonl"), slurp(*this / "whole/events.jsonl"));
}

TEST_F(Runs, TwoShellsAdhereAndASplitRunIsTheSame) {
  const RunSummary whole = run_whole(kShells, "whole");
  EXPECT_TRUE(whole.passed);
  const auto series = read_series(*this / "whole/series.csv");
  ASSERT_TRUE(series.ok());
  const auto& area = series->find("mean_contact_area")->values;
  EXPECT_GT(area.back(), area.front());
  EXPECT_EQ(run_split(kShells, "split", 120.0).final_state.state_hash, whole.final_state.state_hash);
}

TEST_F(Runs, AHybridWithARegionRunsAndSplits) {
  const RunSummary whole = run_whole(kHybrid, "whole");
  EXPECT_GE(whole.final_state.shells, 1u);
  EXPECT_LT(whole.final_state.shells, whole.final_state.cells);
  EXPECT_TRUE(whole.passed);
  EXPECT_TRUE(fs::exists(*this / "whole/vtk/shells.pvd"));
  EXPECT_NE(slurp(*this / "whole/events.jsonl").find("\"kind\":\"promotion\""), std::string::npos);
  EXPECT_EQ(run_split(kHybrid, "split", 600.0).final_state.state_hash, whole.final_state.state_hash);
}

/// Two spheres 11 µm apart take 1.9 % of each other at time 0.
std::string packed_pair(const std::string& knots) {
  return R"(schema: 1
study: packed
time: {end: 4 min, output: 1 min}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  cell: {radius: 6 um, cbm: {packing: {law: knots, knots: [)" +
         knots + R"(]}}}
initial:
  - {type: cell, at: [[-5.5 um, 0 um, 0 um], [5.5 um, 0 um, 0 um]]}
output: {report: false}
)";
}

TEST_F(Runs, WithPackingSplitAsWhole) {
  const std::string text =
      packed_pair("{packing: 0.1 %, pressure: 0 Pa}, {packing: 1 %, pressure: 20 Pa}, {packing: 5 %, pressure: 90 Pa}");
  const RunSummary whole = run_whole(text, "whole");
  EXPECT_TRUE(whole.passed);
  EXPECT_EQ(slurp(*this / "whole/log.txt").find("packed more tightly"), std::string::npos);
  EXPECT_NE(slurp(*this / "whole/methods.md").find("Pressure of packing"), std::string::npos);
  EXPECT_EQ(run_split(text, "split", 120.0).final_state.state_hash, whole.final_state.state_hash);
}

TEST_F(Runs, WarnsBeyondThePackingCurveAndStopsFarBeyond) {
  const double packing = 0.25 * std::pow(1.0 / 12.0, 2) * (3.0 - 1.0 / 12.0);  // ¼ s²(3 − s) of each
  const auto knots = [&](double last) {
    std::string out;
    for (const double part : {0.1, 0.5, 1.0})
      out += "{packing: " + std::to_string(100.0 * part * last) + " %, pressure: " + std::to_string(part - 0.1) + " mPa}, ";
    return out.substr(0, out.size() - 2);
  };
  (void)run_whole(packed_pair(knots(packing / 1.2)), "warned");
  EXPECT_NE(slurp(*this / "warned/log.txt").find("2 of 2 spheres are packed more tightly"), std::string::npos);
  const auto stopped = run(study(packed_pair(knots(packing / 1.6))), request("stopped"), Comm());
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::kPhysics);
  EXPECT_NE(stopped.error().message.find("is packed 1.6 times as tightly as the end of its packing curve"), std::string::npos)
      << stopped.error().message;
}

TEST_F(Runs, AWishToStopIsHonouredBetweenStepsAndCostsNoBit) {
  const RunSummary whole = run_whole(kSpheres, "whole");
  std::atomic<int> stop{kGoOn};
  RunRequest interrupted = request("stopped");
  interrupted.stop = &stop;
  int steps = 0;
  interrupted.on_progress = [&](const Progress&) {
    if (++steps == 25) stop = kInterrupt;
  };
  const auto first = run(study(kSpheres), interrupted, Comm());
  ASSERT_TRUE(first.ok()) << first.error().message;
  EXPECT_EQ(first->state, RunState::kStopped);
  EXPECT_EQ(first->stopped, ErrorKind::kInterrupted);
  EXPECT_EQ(read_run_record(*this / "stopped/run.json")->exit_code, 130);
  EXPECT_FALSE(fs::exists(*this / "stopped/DONE"));
  EXPECT_NE(std::fmod(first->final_state.time, 1800.0), 0.0);  // it did not step to an output time first
  const auto rest = resume(*this / "stopped", {}, Comm());
  ASSERT_TRUE(rest.ok()) << rest.error().message;
  EXPECT_EQ(rest->final_state.state_hash, whole.final_state.state_hash);
}

TEST_F(Runs, MaxWallStopsEarly) {
  RunRequest hurried = request("hurried");
  hurried.max_wall = 0.0;
  const auto stopped = run(study(kSpheres), hurried, Comm());
  ASSERT_TRUE(stopped.ok()) << stopped.error().message;
  EXPECT_EQ(stopped->stopped, ErrorKind::kStoppedEarly);
  EXPECT_EQ(read_run_record(*this / "hurried/run.json")->exit_code, 75);
}

TEST_F(Runs, UntilBeyondTheEndGoesOn) {
  run_whole(kShells, "a");
  ResumeRequest more;
  more.until = 350.0;
  const auto done = resume(*this / "a", more, Comm());
  ASSERT_TRUE(done.ok()) << done.error().message;
  EXPECT_EQ(done->final_state.time, 360.0);
  EXPECT_EQ(read_series(*this / "a/series.csv")->rows(), 7u);
}

TEST_F(Runs, ThatWereToGoBeyondTheEndStillAreWhenResumed) {
  std::atomic<int> stop{kGoOn};
  RunRequest further = request("a");
  further.until = 480.0;
  further.stop = &stop;
  further.on_progress = [&](const Progress& now) {
    if (now.time > 310.0) stop = kInterrupt;
  };
  const auto first = run(study(kShells), further, Comm());
  ASSERT_TRUE(first.ok()) << first.error().message;
  ASSERT_EQ(first->state, RunState::kStopped);
  EXPECT_EQ(read_run_status(*this / "a/status.json")->end, 480.0);
  const auto rest = resume(*this / "a", {}, Comm());
  ASSERT_TRUE(rest.ok()) << rest.error().message;
  EXPECT_EQ(rest->final_state.time, 480.0);
  const auto again = resume(*this / "a", {}, Comm());  // nothing is left to do
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ(again->final_state.time, 480.0);
  EXPECT_EQ(read_run_status(*this / "a/status.json")->end, 480.0);
}

TEST_F(Runs, WhatIsLaterThanTheCheckpointIsTakenAway) {
  const RunSummary whole = run_whole(kSpheres, "whole");
  // As if killed after the output at 1.5 h: the newest checkpoint is that of 1 h.
  run_whole(kSpheres, "killed");
  const auto newest = *this / "killed/checkpoints";
  std::vector<fs::path> files(fs::directory_iterator(newest), {});
  std::sort(files.begin(), files.end());
  fs::remove(files.back());
  const auto done = resume(*this / "killed", {}, Comm());
  ASSERT_TRUE(done.ok()) << done.error().message;
  EXPECT_EQ(done->final_state.state_hash, whole.final_state.state_hash);
  EXPECT_EQ(slurp(*this / "killed/series.csv"), slurp(*this / "whole/series.csv"));
  EXPECT_EQ(list_snapshots(*this / "killed/results.h5")->size(), 5u);
}

TEST_F(Runs, WhatWasToldAfterTheCheckpointIsToldOnce) {
  run_whole(kSpheres, "whole");
  run_whole(kSpheres, "killed");
  // As if killed after the output at 2 h, events and log of 1 h to 2 h written; one event is of a moment before the checkpoint of 1 h.
  std::vector<fs::path> files(fs::directory_iterator(*this / "killed/checkpoints"), {});
  std::sort(files.begin(), files.end());
  fs::remove(files.back());
  const std::string line = R"({"time_s":1.0,"kind":"warning","text":"late"})";
  spit(*this / "killed/events.jsonl", slurp(*this / "killed/events.jsonl") + line + "\n");
  ASSERT_TRUE(resume(*this / "killed", {}, Comm()).ok());
  EXPECT_EQ(slurp(*this / "killed/events.jsonl"), slurp(*this / "whole/events.jsonl"));
  EXPECT_EQ(slurp(*this / "killed/series.csv"), slurp(*this / "whole/series.csv"));
}

TEST_F(Runs, ADamagedResultsFileIsSetAsideAndTheRunGoesOn) {
  const RunSummary whole = run_whole(kHybrid, "whole");
  RunRequest half = request("half");
  half.until = 600.0;
  ASSERT_TRUE(run(study(kHybrid), half, Comm()).ok());
  const std::string results = slurp(*this / "half/results.h5");
  spit(*this / "half/results.h5", results.substr(0, results.size() / 3));
  const auto done = resume(*this / "half", {}, Comm());
  ASSERT_TRUE(done.ok()) << done.error().message;
  EXPECT_EQ(done->final_state.state_hash, whole.final_state.state_hash);
  EXPECT_EQ(slurp(*this / "half/results.damaged-1.h5").size(), results.size() / 3) << "nothing is thrown away";
  EXPECT_EQ(list_snapshots(*this / "half/results.h5")->size(), 2u) << "those of 15 min and 20 min";
  EXPECT_NE(slurp(*this / "half/log.txt").find("results.damaged-1.h5"), std::string::npos);
  EXPECT_NE(slurp(*this / "half/events.jsonl").find("results.damaged-1.h5"), std::string::npos);
}

TEST_F(Runs, AWishToStopBreaksOffTheIntegrationOfAField) {
  const std::string slow = test::changed("voxel: 20 um}", "voxel: 10 um, tolerance: 1e-9}", kHybrid);
  const Study read = study(slow);
  auto made = [&] {
    ShapeLibrary shapes;
    return Simulation::create(read.model, make_tissue(read, shapes, Comm())->tissue, Comm(), 1).value();
  };
  const std::unique_ptr<Simulation> broken = made(), left = made();
  ASSERT_TRUE(broken->first_swaps().ok() && left->first_swaps().ok());
  const std::string before = state_hash(broken->tissue(), Comm()).hex();
  int asked = 0;
  const auto stopped = broken->step(1200.0, [&] { return ++asked == 3; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::kStoppedEarly);
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(state_hash(broken->tissue(), Comm()).hex(), before) << "the state is that before the step";
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(broken->step(1200.0).ok() && left->step(1200.0).ok());
  EXPECT_EQ(state_hash(broken->tissue(), Comm()).hex(), state_hash(left->tissue(), Comm()).hex()) << "and goes on as if nothing had been";
  // The run leaves a checkpoint of that state, and says that it was stopped.
  std::atomic<int> stop{kGoOn};
  RunRequest hurried = request("hurried");
  hurried.stop = &stop;
  hurried.on_progress = [&](const Progress&) { stop = kStopEarly; };
  const auto run_stopped = run(read, hurried, Comm());
  ASSERT_TRUE(run_stopped.ok()) << run_stopped.error().message;
  EXPECT_EQ(run_stopped->stopped, ErrorKind::kStoppedEarly);
}

/// What happened between the last output and the stop belongs to the next row, overlap and steps that were refused too.
TEST_F(Runs, StoppedBetweenOutputsHaveTheSameSeriesAfterAResume) {
  const std::string text = test::changed("output: 1 min", "output: 4 min", kShells);
  (void)run_whole(text, "whole");
  std::atomic<int> stop{kGoOn};
  RunRequest hurried = request("stopped");
  hurried.stop = &stop;
  int calls = 0;
  hurried.on_progress = [&](const Progress& progress) {
    if (++calls >= 4 && progress.time > 0.0) stop = kStopEarly;
  };
  const auto stopped = run(study(text), hurried, Comm());
  ASSERT_TRUE(stopped.ok()) << stopped.error().message;
  ASSERT_EQ(stopped->stopped, ErrorKind::kStoppedEarly);
  const auto rest = resume(folder_.path() / "stopped", resume_request(), Comm());
  ASSERT_TRUE(rest.ok()) << rest.error().message;
  EXPECT_EQ(slurp(*this / "stopped/series.csv"), slurp(*this / "whole/series.csv"));
}

TEST_F(Runs, ATargetThatExistsIsLeftAlone) {
  fs::create_directories(*this / "taken");
  spit(*this / "taken/precious", "data");
  const auto refused = run(study(kSpheres), request("taken"), Comm());
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::kFile);
  EXPECT_EQ(slurp(*this / "taken/precious"), "data");
}

TEST_F(Runs, ACrossedLimitFailsTheRunAndNamesTheCell) {
  std::string text = kShells;
  text = test::changed("[-6 um, 0 um, 0 um], [6 um, 0 um, 0 um]", "[-5.72 um, 0 um, 0 um], [5.72 um, 0 um, 0 um]", text);
  const auto read = test::read(text, {.judge_places = false}, folder_.path());  // whose check would refuse it
  ASSERT_TRUE(read.ok()) << read.error().text();
  const auto failed = run(*read, request("a"), Comm());
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().kind, ErrorKind::kPhysics);
  EXPECT_NE(failed.error().message.find("overlap"), std::string::npos) << failed.error().message;
  EXPECT_NE(failed.error().message.find("cell 1"), std::string::npos) << failed.error().message;
  EXPECT_TRUE(fs::exists(*this / "a/FAILED"));
  EXPECT_EQ(read_run_record(*this / "a/run.json")->exit_code, 4);
  EXPECT_FALSE(fs::is_empty(*this / "a/checkpoints"));
  EXPECT_NE(failed.error().help.find("`morula plot "), std::string::npos) << failed.error().help;
  const auto results = Hdf5Reader::open(*this / "a/results.h5");
  ASSERT_TRUE(results.ok()) << results.error().message;
  EXPECT_EQ(results->read<double>("series/time").value(), std::vector<double>{0.0});
  EXPECT_GE(results->rows("events/time").value(), 1u) << "why it failed";
}

/// Two shells close no cavity between them.
TEST_F(Runs, ACavityThatIsOpenIsTold) {
  (void)run_whole(kShells + "lumens: {gap: {center: [0 um, 14 um, 0 um], pressure: 10 Pa}}\n", "open");
  const std::string log = slurp(*this / "open/log.txt");
  const std::size_t told = log.find("no cavity any more: 'gap'");
  ASSERT_NE(told, std::string::npos) << log;
  EXPECT_NE(log.find("`open_gap`"), std::string::npos);
  EXPECT_EQ(log.find("no cavity any more", told + 1), std::string::npos) << "once";
  EXPECT_NE(slurp(*this / "open/events.jsonl").find("no cavity any more"), std::string::npos);
}

TEST_F(Runs, TheSeriesAskedForComesFirst) {
  run_whole(kSpheres + "", "a");
  std::string text = test::changed("output: {report: false}", "output: {report: false, series: [spheroid_radius]}", kSpheres);
  run_whole(text, "b");
  const std::string header = slurp(*this / "b/series.csv").substr(0, 60);
  EXPECT_EQ(header.substr(0, 32), "time [s],spheroid_radius [um],ce");
}

TEST_F(Runs, PlotsCanBeMadeAgain) {
  std::string text = test::changed("output: {report: false}", "", kShells);
  text = test::changed("end: 4 min", "end: 1 min", text);
  const RunSummary summary = run_whole(text, "a");
  EXPECT_TRUE(fs::exists(*this / "a/plots/overlap.svg"));
  fs::remove(summary.report);
  const auto report = plot_run(*this / "a");
  ASSERT_TRUE(report.ok()) << report.error().message;
  EXPECT_EQ(*report, summary.report);
  EXPECT_NE(slurp(*report).find("Pressure of the cytoplasm"), std::string::npos);
}

}  // namespace
}  // namespace morula::scenarios
