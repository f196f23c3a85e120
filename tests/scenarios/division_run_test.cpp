// Shells that divide in runs of studies.
#include <algorithm>
#include <cmath>
#include <string>

#include "coupling/behaviours/division_axis.h"
#include "results/snapshot_file.h"
#include "tests/scenarios/own_parts.h"
#include "tests/scenarios/simulation_of.h"
#include "tests/scenarios/snapshots_of_run.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class DivisionRun : public OwnParts {
 protected:
  DivisionRun() : OwnParts([](Laws& laws) { laws.division_axes.push_back(diagonal()); }) {}
  /// A rule of our own.
  static std::shared_ptr<const DivisionAxis> diagonal() {
    return std::make_shared<const DivisionAxis>(DivisionAxis{.info = {.name = "diagonal",
                                                                      .title = "Along the diagonal of the laboratory",
                                                                      .equation = "u = (1, 1, 1)/√3",
                                                                      .source = "chosen for a test",
                                                                      .parameters = {}},
                                                             .of = [](const CellAtDivision&, const Vec3d&) {
                                                               return Vec3d{2.0, 2.0, 2.0};
                                                             }});
  }
  Snapshot last_of(const std::string& run) {
    const auto path = folder_.path() / run / "results.h5";
    const auto entries = list_snapshots(path);
    EXPECT_TRUE(entries.ok() && !entries->empty());
    auto out = read_snapshot(path, entries->back().index);
    EXPECT_TRUE(out.ok());
    return std::move(out).value();
  }
};

/// One shell with `cycle`, to `end`.
std::string one_shell(const std::string& cycle, const std::string& end, const std::string& more = "") {
  return R"(schema: 1
study: division
time: {end: )" +
         end + R"(, output: 5 min, checkpoint: 30 min}
domain: {size: [120 um, 120 um, 120 um]}
cell_types:
  egg:
    body: shell
    radius: 6 um
    cycle: {duration: 30 min, )" +
         cycle + R"(}
    adhesion: {egg: 1e-4 J/m^2}
    dcm: {nodes: 162, cortex: {elastic: none, tension: 0.2 mN/m}}
)" + more +
         R"(
initial:
  - {type: egg, at: [[0 um, 0 um, 0 um]], age: birth}
output: {report: false}
)";
}

double egg_volume() { return 4.0 / 3.0 * 3.141592653589793 * 216.0; }

TEST_F(DivisionRun, DoesNotMakeTheTissueWaitForTheDaughters) {
  auto simulation = simulation_of(study(one_shell("growth: linear", "75 min")));
  ASSERT_TRUE(simulation.ok());
  double before = 0.0;  // step before the last
  int divisions = 0, after = 0;
  bool divided = false;
  while ((*simulation)->tissue().clock.time < 4200.0) {
    const auto done = (*simulation)->step(4200.0);
    ASSERT_TRUE(done.ok()) << done.error().message;
    if (divided) {
      ++after;
      // The tension of the new faces grows for ten minutes, which moves a pair or four cells by more than a step of a minute allows.
      EXPECT_GE(done->mechanics.step, 0.24 * before);
    }
    divided = std::ranges::any_of(done->events, [](const Event& event) { return event.kind == EventKind::kDivision; });
    divisions += divided;
    before = done->mechanics.step;
  }
  EXPECT_GE(divisions, 2);
  EXPECT_GE(after, 2);
}

TEST_F(DivisionRun, GoesFromOneToFourAndLosesNoVolume) {
  run_whole(one_shell("growth: linear", "75 min"), "four");
  const auto cells = column("four", "cell_count"), shells = column("four", "shell_count"), volume = column("four", "total_volume");
  EXPECT_EQ(cells.back(), 4.0);
  EXPECT_EQ(shells.back(), 4.0);
  EXPECT_EQ(cells[5], 1.0);
  EXPECT_EQ(cells[6], 2.0) << "at 30 min, on the minute";
  EXPECT_EQ(cells[12], 4.0);
  // A shell's volume is that at which its pressure bears the cortex: its target volume, to the compression of the contacts.
  for (std::size_t k = 0; k < volume.size(); ++k) {
    const double minutes = 5.0 * static_cast<double>(k), cycles = minutes / 30.0;
    const double target = egg_volume() * std::pow(2.0, std::floor(cycles)) * (1.0 + cycles - std::floor(cycles));
    EXPECT_NEAR(volume[k] / target, 1.0, 0.01) << minutes;
  }
  for (const double overlap : column("four", "worst_overlap")) EXPECT_LT(overlap, 0.3);
  EXPECT_EQ(column("four", "divisions").back(), 3.0);
}

/// A row in the moment of a division tells the daughters' energy, as it tells their number. In the second after it the energy only grows, with the
/// cells (0.03 nN µm/s) and with the tension of the new faces (150 µm² of it, 0.15 nN/µm in ten minutes, for each daughter); that of the mother was higher.
TEST_F(DivisionRun, TellsTheEnergyOfTheDaughters) {
  run_whole(one_shell("growth: linear", "1801 s"), "second");
  const auto cells = column("second", "cell_count"), energy = column("second", "energy");
  ASSERT_EQ(energy.size(), 8u);
  EXPECT_EQ(cells[6], 2.0);
  EXPECT_GT(energy[7], energy[6]);
  EXPECT_LT(energy[7], energy[6] + 0.2);
}

TEST_F(DivisionRun, HasTheSameBitsOnTwoThreadsAndAfterARestart) {
  const std::string text = one_shell("share: {mean: 40 %, spread: 10 %}, axis: long, axis_spread: 20 deg", "40 min");
  const RunSummary whole = run_whole(text, "whole");
  EXPECT_FALSE(whole.final_state.state_hash.empty());
  EXPECT_EQ(run_whole(text, "threads", 2).final_state.state_hash, whole.final_state.state_hash);
  EXPECT_EQ(run_split(text, "split", 1860.0).final_state.state_hash, whole.final_state.state_hash) << "in the minute after the division";
  EXPECT_EQ(file("split", "events.jsonl"), file("whole", "events.jsonl"));
}

TEST_F(DivisionRun, CutsAcrossTheAxisAndSharesAsTheStudySays) {
  run_whole(one_shell("axis: fixed, direction: [0, 0, 1], share: 30 %", "31 min"), "fixed");
  const Snapshot end = last_of("fixed");
  ASSERT_EQ(end.cells.size(), 2u);
  EXPECT_GT(end.cells[0].centroid.z - end.cells[1].centroid.z, 4.0) << "the first lies where the axis points";
  EXPECT_LT(std::hypot(end.cells[0].centroid.x - end.cells[1].centroid.x, end.cells[0].centroid.y - end.cells[1].centroid.y), 0.3);
  const double smaller = end.cells[0].volume, larger = end.cells[1].volume;
  EXPECT_NEAR(smaller / (smaller + larger), 0.3, 0.01);
}

TEST_F(DivisionRun, TakesTheAxisOfAProgramsOwnRule) {
  run_whole(one_shell("axis: diagonal", "31 min"), "diagonal");
  const Snapshot end = last_of("diagonal");
  ASSERT_EQ(end.cells.size(), 2u);
  const Vec3d apart = end.cells[0].centroid - end.cells[1].centroid;
  EXPECT_GT(dot(normalized(apart), Vec3d{1.0, 1.0, 1.0} / std::sqrt(3.0)), 0.995);
  EXPECT_GT(norm(apart), 4.0);
}

TEST_F(DivisionRun, FollowsThePolarityOfTheCell) {
  // The daughters lie along it, or side by side across it.
  for (const bool along : {true, false}) {
    const std::string run = along ? "along" : "across";
    run_whole(one_shell(along ? "axis: polarity" : "axis: across_polarity", "31 min", "    polarity: {start: [1, 2, -2]}\n"), run);
    const Snapshot end = last_of(run);
    ASSERT_EQ(end.cells.size(), 2u);
    const double cosine = dot(normalized(end.cells[0].centroid - end.cells[1].centroid), Vec3d{1.0, 2.0, -2.0} / 3.0);
    if (along)
      EXPECT_GT(cosine, 0.99);
    else
      EXPECT_LT(std::abs(cosine), 0.1);
  }
}

TEST_F(DivisionRun, StaysWithinALayer) {
  // Across the normal of a tilted layer, whatever the axis is within it.
  run_whole(one_shell("axis: across_direction, direction: [1, 2, -2]", "31 min"), "layer");
  const Snapshot end = last_of("layer");
  ASSERT_EQ(end.cells.size(), 2u);
  EXPECT_LT(std::abs(dot(normalized(end.cells[0].centroid - end.cells[1].centroid), Vec3d{1.0, 2.0, -2.0} / 3.0)), 0.1);
}

TEST_F(DivisionRun, WaitsWhereTheStudySaysSo) {
  run_whole(one_shell("shells: wait", "40 min"), "waits");
  EXPECT_EQ(column("waits", "cell_count").back(), 1.0);
  EXPECT_THAT(file("waits", "events.jsonl"), HasSubstr("division_waits"));
}

TEST_F(DivisionRun, PutsOffADivisionThatWouldReachTooDeep) {
  // No pair of sisters settles within 0.75 nm of each other: every plane is taken back, and the run goes on.
  run_whole(one_shell("growth: linear", "75 min", "limits: {overlap: 1 nm}\n"), "deep");
  EXPECT_EQ(column("deep", "cell_count").back(), 1.0);
  EXPECT_EQ(column("deep", "divisions").back(), 0.0);
  EXPECT_NEAR(column("deep", "total_volume").back() / egg_volume(), 2.0, 0.01) << "nothing is lost";
  const std::string events = file("deep", "events.jsonl");
  EXPECT_THAT(events, HasSubstr("division_waits"));
  EXPECT_EQ(std::count(events.begin(), events.end(), '\n'), 1) << "said once: " << events;
}

TEST_F(DivisionRun, LeavesNoCellOfASpheroidWaiting) {
  // Cut daughters lie up to half a micrometre deep in their neighbours; they settle before that is judged (decision 0062).
  run_whole(R"(schema: 1
study: spheroid
seed: 1
time: {end: 170 min, output: 10 min, checkpoint: 80 min}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  tumour:
    body: shell
    radius: 6 um
    cycle: {duration: {mean: 6 h, spread: 10 %}, axis: random}
    inhibit_growth: {pressure_above: never}
    adhesion: {tumour: 1e-4 J/m^2}
    dcm: {nodes: 162, cortex: {elastic: none, tension: 0.1 mN/m}, bulk_modulus: 2.5 kPa}
initial: [{type: tumour, count: 8, fill: sphere, radius: 13 um, age: random}]
output: {report: false}
)",
            "spheroid");
  EXPECT_THAT(file("spheroid", "events.jsonl"), Not(HasSubstr("division_waits")));
  EXPECT_GE(column("spheroid", "divisions").back(), 4.0);
  for (const double overlap : column("spheroid", "worst_overlap")) EXPECT_LT(overlap, 0.1);
}

TEST_F(DivisionRun, OfACellThatFollowsItsWaterTellsVolumesOfItsLaw) {
  // Daughters keep the mother's pressure; at their radius a tension of 1 mN/m bears 60 Pa more, which was 2.7 % of the volume and ended the run.
  run_whole(test::changed("tension: 0.2 mN/m", "tension: 1 mN/m", one_shell("growth: linear, share: 40 %", "40 min", "    osmosis: {}\n")),
            "water");
  EXPECT_EQ(column("water", "cell_count").back(), 2.0);
  for (const double error : column("water", "volume_error")) EXPECT_LT(error, 1e-6);
}

TEST_F(DivisionRun, KeepsTheVolumesOfDaughtersThatFollowTheirWaterBesideNuclei) {
  // A nucleus that is a shell takes no part in the pressure of the volume: a daughter who got one lost 3 % of her mother's volume within a minute.
  const std::string types =
      "    osmosis: {outside: 200 mM}\n  plain: {radius: 6 um, body: shell, cycle: {model: none}, osmosis: {outside: 200 mM}}\n  "
      "nucleated: {like: plain, dcm: "
      "{nucleus: {kind: shell, volume_fraction: 20 %, nodes: 42}}}\n";
  for (const auto& [name, nucleus] : {std::pair{"none", ""}, {"tenth", ", nucleus: {kind: shell, volume_fraction: 10 %, nodes: 42}"}}) {
    const std::string study =
        one_shell("growth: linear, share: 40 %, daughters: {fates: [{share: 100 %, types: [plain, nucleated]}]}", "31 min", types);
    run_whole(test::changed("tension: 0.2 mN/m}}", std::string("tension: 0.2 mN/m}") + nucleus + "}", study), name);
    const Snapshot end = last_of(name);
    ASSERT_EQ(end.cells.size(), 2u) << name;
    std::vector<double> volumes{end.cells[0].volume / egg_volume(), end.cells[1].volume / egg_volume()};
    std::ranges::sort(volumes);
    EXPECT_NEAR(volumes[0] / (volumes[0] + volumes[1]), 0.4, 2e-3) << name;
    EXPECT_NEAR(column(name, "total_volume").back() / column(name, "total_volume")[6], 1.0, 0.012)
        << name << ": from just before the cut; their cortices are not hers";
  }
}

TEST_F(DivisionRun, FindsRoomForTheNucleusOfASmallDaughter) {
  // 30 % of a ball is a flat cap, in whose middle a nucleus of 25 % has no room. It ended the run, 0.67 um deep in its cell.
  std::string places;
  for (int i = 0; i < 5; ++i) places += (i > 0 ? ", " : "") + place_text({80.0 * i - 160.0, 0.0, 0.0});
  const std::string rigid = "dcm: {nodes: 162, nucleus: {kind: rigid, volume_fraction: 25 %}, cortex";
  std::string study = test::changed("dcm: {nodes: 162, cortex", rigid, one_shell("share: 30 %", "61 min"));
  study = test::changed("[[0 um, 0 um, 0 um]]", "[" + places + "]",
                        test::changed("[120 um, 120 um, 120 um]", "[900 um, 400 um, 400 um]", study));
  run_whole(study, "caps");
  EXPECT_GE(column("caps", "cell_count").back(), 18.0);
  for (const double overlap : column("caps", "worst_overlap")) EXPECT_LT(overlap, 0.3);
}

/// Energy that the first division of a run brings [nN µm].
double first_rise(const std::string& events) {
  const std::string key = "\"energy_rise_nN_um\":";
  const std::size_t at = events.find(key);
  return at == std::string::npos ? std::nan("") : std::stod(events.substr(at + key.size()));
}

TEST_F(DivisionRun, ANewInterfaceBeginsWithTheTensionThatItsFacesHave) {
  const std::string usual = one_shell("growth: linear, axis: fixed, direction: [1, 0, 0]", "32 min");
  const auto rise = [&](const std::string& cortex, const std::string& name) {
    run_whole(test::changed("tension: 0.2 mN/m", cortex, usual), name);
    return first_rise(file(name, "events.jsonl"));
  };
  const double plain = rise("tension: 0.3 mN/m", "plain");
  // V0 is that of a cell with the type's own tension: a mother with a region is a little smaller. An interface with the wrong tension of 0.1 mN/m brings 36 more.
  EXPECT_NEAR(rise("tension: 0.2 mN/m, regions: {whole: {tension: 0.3 mN/m}}", "whole"), plain, 2.0);
  const std::string course = "{tension: 0.15 mN/m, course: [{time: 0 s, factor: 1}, {time: 20 min, factor: 2}]}";
  EXPECT_NEAR(rise("tension: 0.2 mN/m, regions: {whole: " + course + "}", "course"), plain, 2.0);
}

TEST_F(DivisionRun, GoesOnWhereContactsAreLessTense) {
  // Sisters adhered with twice the free tension while their faces eased to half of it: an interface of negative tension.
  run_whole(test::changed("tension: 0.2 mN/m", "tension: 0.3 mN/m, regions: {lateral: {tension: 0.15 mN/m}}",
                          one_shell("growth: linear, share: 40 %", "45 min")),
            "lateral");
  EXPECT_EQ(column("lateral", "cell_count").back(), 2.0);
  const double rise = first_rise(file("lateral", "events.jsonl"));
  EXPECT_GT(rise, -5.0);
  EXPECT_LT(rise, 10.0);
}

TEST_F(DivisionRun, SaysWhatCannotBe) {
  const auto errors = [&](const std::string& cycle) {
    const auto study = read(one_shell(cycle, "1 h"), options());
    return study.ok() ? std::string() : study.error().text();
  };
  EXPECT_EQ(errors("axis: long"), "");
  EXPECT_THAT(errors("axis: sideways"), HasSubstr("across_polarity"));
  EXPECT_THAT(errors("axis: fixed"), HasSubstr("`fixed` needs `direction`"));
  EXPECT_THAT(errors("axis: fixed, direction: [0, 0, 0]"), HasSubstr("[E302]"));
  EXPECT_THAT(errors("direction: [0, 0, 1]"), HasSubstr("'direction' has no effect here"));
  EXPECT_THAT(errors("axis: polarity"), HasSubstr("[E558]"));
  EXPECT_EQ(errors("axis: along_surface"), "");
  EXPECT_THAT(errors("axis: gradient"), HasSubstr("`gradient` needs `field`"));
  EXPECT_THAT(errors("axis: gradient, field: oxygen"), HasSubstr("there is no field 'oxygen'"));
  EXPECT_THAT(errors("axis: along_geometry"), HasSubstr("`along_geometry` needs `geometry`"));
  EXPECT_THAT(errors("axis: along_geometry, geometry: plate"), HasSubstr("[E401]"));
  EXPECT_THAT(errors("axis: long, field: oxygen"), HasSubstr("[E515]"));
  EXPECT_THAT(errors("axis_spread: 20 deg"), HasSubstr("[E515]"));
  EXPECT_THAT(errors("share: 5 %"), HasSubstr("[E302]"));
  EXPECT_THAT(errors("share: 95 %"), HasSubstr("[E302]"));
  EXPECT_THAT(errors("new_surface: -1 min"), HasSubstr("[E302]"));
  EXPECT_THAT(errors("shells: cocoon"), HasSubstr("cut"));
}

/// Rest lengths that a flat face of a daughter takes from her mother, edge by edge, need not make a triangle: what is elastic by springs does not mind, a sheet
/// has no force then. Daughters of daughters have such faces.
TEST_F(DivisionRun, SheetsOfAnyLawDivideAgainAndAgain) {
  for (const char* law : {"neo_hooke", "skalak", "springs_with_area"}) {
    run_whole(std::string(R"(schema: 1
study: sheets
time: {end: 267 min, output: 2 h}
domain: {size: [100 um, 100 um, 100 um]}
cell_types: {c: {radius: 6 um, body: shell, cycle: {duration: 2 h}, adhesion: {c: 0.05 mJ/m^2}, dcm: {cortex: {elastic: )") +
                  law + R"(}}}}
initial: [{type: c, at: [[0 um, 0 um, 0 um]]}]
output: {report: false}
)",
              law);
    EXPECT_EQ(column(law, "cell_count").back(), 8.0) << law;
  }
}

/// Daughters that are born within a step have grown since, and an output may come at its end: with this cycle by 3 % of their volume.
TEST_F(DivisionRun, HaveTheVolumeOfTheirLawFromTheFirstOutputOn) {
  run_whole(changed("output: 5 min", "output: 1 min", one_shell("growth: linear", "65 min")), "newborn");
  EXPECT_EQ(column("newborn", "cell_count").back(), 4.0);
  for (const double error : column("newborn", "volume_error")) EXPECT_LT(error, 1e-9);
}

}  // namespace
}  // namespace morula::scenarios::test
