// The public interface, as a program uses it that knows nothing else of Morula.
#include "morula/morula.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "results/snapshot_file.h"
#include "scenarios/run/driver.h"
#include "tests/study/study_fixture.h"

namespace morula::api {
namespace {

using testing::HasSubstr;

const char* const kStudy = R"(schema: 1
study: embedded
time: {end: 2 min, output: 1 min, checkpoint: 2 min}
domain: {size: [100 um, 100 um, 100 um], boundary: open}
cell_types:
  ball: {radius: 5 um, cycle: {duration: 1 h}, adhesion: {others: 5e-5 J/m^2}}
  bag: {radius: 6 um, body: shell, adhesion: {others: 5e-5 J/m^2}}
initial:
  - {type: ball, at: [[-14 um, 0 um, 0 um], [-4.5 um, 0 um, 0 um]]}
  - {type: bag, at: [[6.2 um, 0 um, 0 um]]}
output: {report: false}
)";

TEST(PublicInterface, TellsItsVersionAndLicence) {
  EXPECT_EQ(version(), kHeaderVersion);
  EXPECT_THAT(licence(), HasSubstr("BSD-3-Clause"));
}

TEST(PublicInterface, GivesAllErrorsOfAStudyAsOneValue) {
  const auto wrong = Study::from_text("schema: 1\nstudy: wrong\ntime: {end: 5}\ncell_type: {}\n");
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ(wrong.error().kind, ErrorKind::kInput);
  EXPECT_THAT(wrong.error().message, testing::AllOf(HasSubstr("cell_type"), HasSubstr("E201")));
  EXPECT_FALSE(Study::read("/nowhere/study.yaml").ok());
}

TEST(PublicInterface, ShowsCellsAndSurfacesAtTimeZero) {
  const auto study = Study::from_text(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().message;
  EXPECT_EQ(study->name(), "embedded");
  EXPECT_EQ(study->end(), 120.0);
  const auto simulation = Simulation::create(*study);
  ASSERT_TRUE(simulation.ok()) << simulation.error().message;
  const auto cells = simulation->cells();
  ASSERT_EQ(cells.size(), 3u);
  EXPECT_EQ(study->type_names()[cells[0].type], "ball");
  EXPECT_EQ(cells[0].body, Body::kSphere);
  EXPECT_EQ(cells[0].centre, (Point{-14.0, 0.0, 0.0}));
  EXPECT_EQ(study->type_names()[cells[2].type], "bag");
  EXPECT_EQ(cells[2].body, Body::kShell);
  EXPECT_NEAR(cells[2].volume, 4.0 / 3.0 * std::numbers::pi * 216.0, 1e-6);

  const auto surfaces = simulation->surfaces();
  ASSERT_EQ(surfaces.size(), 1u);
  EXPECT_EQ(surfaces[0].cell, cells[2].id);
  ASSERT_EQ(surfaces[0].faces.size(), 2 * surfaces[0].nodes.size() - 4);
  double volume = 0.0;  // a sixth of the triple products, about the cell's centre
  for (const Triangle& face : surfaces[0].faces) {
    double d[3][3];
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t m = 0; m < 3; ++m) d[k][m] = surfaces[0].nodes[face[k]][m] - cells[2].centre[m];
    volume += (d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) + d[0][1] * (d[1][2] * d[2][0] - d[1][0] * d[2][2]) +
               d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0])) /
              6.0;
  }
  EXPECT_NEAR(volume, cells[2].volume, 1e-9 * volume);
}

TEST(PublicInterface, StepsToTheBitsOfARun) {
  const auto study = Study::from_text(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().message;
  auto simulation = Simulation::create(*study);
  ASSERT_TRUE(simulation.ok()) << simulation.error().message;
  ASSERT_TRUE(simulation->advance_to(60.0).ok());
  EXPECT_EQ(simulation->time(), 60.0) << "steps land on outputs";
  (void)simulation->cells();  // looking changes nothing
  while (!simulation->done()) {
    const auto step = simulation->step();
    ASSERT_TRUE(step.ok()) << step.error().message;
    EXPECT_GT(step->length, 0.0);
  }
  EXPECT_EQ(simulation->step()->length, 0.0) << "there is nothing after the end";

  const scenarios::test::Folder folder;
  const auto same = scenarios::test::read(kStudy);
  ASSERT_TRUE(same.ok()) << same.error().text();
  scenarios::RunRequest request;
  request.out = folder.path() / "run";
  const auto run = scenarios::run(*same, request, Comm());
  ASSERT_TRUE(run.ok()) << run.error().message;
  EXPECT_EQ(simulation->state_hash(), run->final_state.state_hash);
}

TEST(PublicInterface, WritesSnapshotsThatAreReadAsThoseOfARun) {
  const scenarios::test::Folder folder;
  const std::filesystem::path file = folder.path() / "moments.h5";
  auto simulation = Simulation::create(Study::from_text(kStudy).value());
  ASSERT_TRUE(simulation.ok());
  ASSERT_TRUE(simulation->write_snapshot(file).ok());
  ASSERT_TRUE(simulation->advance_to(60.0).ok());
  ASSERT_TRUE(simulation->write_snapshot(file).ok());
  const auto snapshot = scenarios::read_snapshot(file, 1);
  ASSERT_TRUE(snapshot.ok()) << snapshot.error().message;
  EXPECT_EQ(snapshot->time, 60.0);
  ASSERT_EQ(snapshot->cells.size(), 3u);
  EXPECT_EQ(snapshot->cells[1].centroid.x, simulation->cells()[1].centre[0]);
  EXPECT_FALSE(simulation->write_snapshot("/nowhere/moments.h5").ok());
}

TEST(PublicInterface, DoesNotMixSnapshotsOfTwoStudies) {
  const scenarios::test::Folder folder;
  const std::filesystem::path file = folder.path() / "moments.h5";
  auto one = Simulation::create(Study::from_text(kStudy).value());
  auto other = Simulation::create(Study::from_text(kStudy, ".", {"seed=77"}).value());
  ASSERT_TRUE(one.ok() && other.ok());
  ASSERT_TRUE(one->write_snapshot(file).ok());
  const Status mixed = other->write_snapshot(file);
  ASSERT_FALSE(mixed.ok());
  EXPECT_NE(mixed.error().message.find("has snapshots of another study"), std::string::npos) << mixed.error().message;
  EXPECT_TRUE(one->write_snapshot(file).ok());
}

TEST(PublicInterface, RefusesNumbersThatAreNone) {
  const Study study = Study::from_text(kStudy).value();
  for (const int threads : {0, -5, 100000}) EXPECT_FALSE(Simulation::create(study, threads).ok()) << threads;
  auto simulation = Simulation::create(study);
  ASSERT_TRUE(simulation.ok());
  EXPECT_FALSE(simulation->advance_to(std::nan("")).ok());
}

}  // namespace
}  // namespace morula::api
