// Spheres of a fitted law beside shells of the same type: cells of the library's calibrated type, from a study to its results.
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string>

#include "core/close_packing.h"
#include "results/snapshot_file.h"
#include "scenarios/library/library.h"
#include "scenarios/verify/run_study.h"
#include "tests/scenarios/run_into.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

/// Snapshots of a study of the library's tumour cells.
std::vector<Snapshot> snapshots_of(const std::string& time, const std::string& initial, const std::string& coupling) {
  const test::Folder folder;
  for (const TemplateFile& file : find_template("hybrid_spheroid")->files) folder.write(std::string(file.path), std::string(file.content));
  ReadOptions options;
  options.overrides = {"time=" + time,
                       "initial=" + initial,
                       "coupling=" + coupling,
                       "fields={}",
                       "criteria=[]",
                       "plots=[]",
                       "cell_types.tumour.radius.spread=0 %",
                       "cell_types.tumour.cycle={model: none}",
                       "output.report=false"};
  options.scenario_names = template_names();
  const auto study = read_study(folder.path() / "study.yaml", options);
  if (!study.ok()) return ADD_FAILURE() << study.error().text(), std::vector<Snapshot>{};
  if (!test::run_into(folder.path() / "run", *study)) return {};
  const auto path = folder.path() / "run" / "results.h5";
  auto all = read_snapshots(path);
  if (!all.ok()) return ADD_FAILURE() << all.error().message, std::vector<Snapshot>{};
  return std::move(all).value();
}

/// fields_and_coupling.md D (c): 64 cells at rest, the one in the middle becomes a shell, and no other moves by 0.02 R.
TEST(MixedContact, OfFittedSpheresKeepsNeighboursWhereACellChangesItsBody) {
  constexpr double kRadius = 5.0, kDistance = 8.9;
  const std::vector<Vec3d> places = close_packed_places(4, kDistance);
  const std::string at = list_of_places(std::span(places).first(64));
  const auto found =
      snapshots_of("{end: 23 h, output: 1 h, checkpoint: 23 h}", "[{type: tumour, as: sphere, at: [" + at + "]}]",
                   "{regions: [{name: middle, shape: sphere, center: [0 um, 0 um, 0 um], radius: 1 um, margin: 20 um, as: shell, "
                   "from: 72060 s}]}");
  ASSERT_EQ(found.size(), 24u);
  const Snapshot &before = found[20], &end = found.back();
  ASSERT_TRUE(before.shells.empty());
  ASSERT_EQ(end.shells.size(), 1u);
  double most = 0.0, rest = 0.0;
  for (std::size_t i = 0; i < end.cells.size(); ++i) {
    rest = std::max(rest, norm(before.cells[i].centroid - found[19].cells[i].centroid) / kRadius);
    most = std::max(most, norm(end.cells[i].centroid - before.cells[i].centroid) / kRadius);
  }
  EXPECT_LT(rest, 0.001) << "they did not rest before";
  EXPECT_GT(most, 1e-4) << "nothing happened";
  EXPECT_LT(most, 0.02);
}

/// A sphere and a shell rest between two spheres and two shells, within 0.05 R.
TEST(MixedContact, OfFittedSpheresRestsBetweenThePairsOfEachBody) {
  const auto distance = [](const char* one, const char* other) {
    const std::string pair = std::string("[{type: tumour, as: ") + one + ", at: [[0 um, 0 um, -5.05 um]]}, {type: tumour, as: " + other +
                             ", at: [[0 um, 0 um, 5.05 um]]}]";
    const auto found = snapshots_of("{end: 40 h, output: 20 h, checkpoint: 40 h}", pair, "{}");
    if (found.size() != 3) return ADD_FAILURE() << one << " " << other, 0.0;
    const auto apart = [](const Snapshot& s) { return norm(s.cells[1].centroid - s.cells[0].centroid); };
    EXPECT_NEAR(apart(found[1]), apart(found[2]), 0.02) << "not at rest: " << one << " " << other;
    return apart(found[2]);
  };
  const double spheres = distance("sphere", "sphere"), shells = distance("shell", "shell"), mixed = distance("sphere", "shell");
  EXPECT_GT(mixed, std::min(spheres, shells) - 0.25) << spheres << " " << shells;
  EXPECT_LT(mixed, std::max(spheres, shells) + 0.25) << spheres << " " << shells;
}

/// A sphere and a shell that touch come together as fast as two shells: half of their way, within a factor of 3 (decision 0072). With the friction of the study it takes them three
/// times as long.
TEST(MixedContact, OfFittedSpheresComesTogetherAsFastAsShells) {
  constexpr double kOutput = 10.0;
  const auto half_time = [](const char* one, const char* other) {
    const std::string pair = std::string("[{type: tumour, as: ") + one + ", at: [[0 um, 0 um, -4.98 um]]}, {type: tumour, as: " + other +
                             ", at: [[0 um, 0 um, 4.98 um]]}]";
    const auto found = snapshots_of("{end: 1 h, output: 10 s, checkpoint: 1 h}", pair, "{}");
    if (found.size() != 361) return ADD_FAILURE() << one << " " << other, 0.0;
    const auto apart = [&](std::size_t i) { return norm(found[i].cells[1].centroid - found[i].cells[0].centroid); };
    const double middle = 0.5 * (apart(0) + apart(360));
    std::size_t i = 0;
    while (i < 360 && apart(i) > middle) ++i;
    return kOutput * static_cast<double>(i);
  };
  const double shells = half_time("shell", "shell"), mixed = half_time("sphere", "shell");
  EXPECT_GT(shells, 5 * kOutput);
  EXPECT_LT(mixed, 1.5 * shells);
  EXPECT_GT(mixed, shells / 3.0);
}

/// Two cells that traps hold together or apart: whatever their bodies and their adhesion, their stresses are together that of one force along the line between
/// their centres (decision 0054).
TEST(MixedContact, OfAdheringBodiesHasTheStressOfTheForceBetweenThem) {
  for (const char* adhesion : {"0", "0.03", "0.1"}) {  // [mN/m]
    const test::Folder folder;
    const auto study = test::read(std::string(R"(schema: 1
study: held
time: {end: 90 min, output: 90 min}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  a: {body: sphere, adhesion: {others: )") +
                                  adhesion + R"( mN/m}}
  b: {like: a, body: shell}
loads:
  one: {type: a, trap: {stiffness: 5 mN/m, center: [0 um, 0 um, 0 um]}}
  other: {type: b, trap: {stiffness: 5 mN/m, center: [11.9 um, 0 um, 0 um], direction: [-1, 0, 0], way: [{time: 0 s, distance: 0 um}, {time: 30 min, distance: 2.3 um}]}}
initial: [{type: a, at: [0 um, 0 um, 0 um]}, {type: b, at: [11.9 um, 0 um, 0 um]}]
output: {report: false}
)");
    ASSERT_TRUE(study.ok()) << study.error().text();
    ASSERT_TRUE(test::run_into(folder.path() / "run", *study));
    const auto end = read_snapshot(folder.path() / "run/results.h5", 1);
    ASSERT_TRUE(end.ok());
    const Snapshot::Cell &sphere = end->cells[0], &shell = end->cells[1];
    const double of_traps = 5.0 * norm(sphere.centroid);  // the force that holds the sphere [nN]
    const double work = of_traps * norm(shell.centroid - sphere.centroid);
    const double virials = 3.0 * (sphere.pressure * sphere.volume + shell.pressure * shell.volume);
    EXPECT_GT(work, 1.0) << adhesion;
    EXPECT_NEAR(virials, work, 0.08 * work) << adhesion << " mN/m; with its adhesion the shell had 0.5 W A too much";
  }
}

}  // namespace
}  // namespace morula::scenarios
