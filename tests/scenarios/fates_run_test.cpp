/// The user's road to daughters that are not as their mothers: other types, mirrored polarity.
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <string>

#include "results/lineage.h"
#include "tests/scenarios/snapshots_of_run.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;

/// Stem cells, 60 µm apart, that divide along x after half an hour; what becomes transit divides no more.
std::string stem(const std::string& daughters, const std::string& body = "sphere", int n = 20, const std::string& more = "") {
  std::string places;
  for (int i = 0; i < n * n; ++i) places += (i > 0 ? ", " : "") + place_text({60.0 * (i % n), 60.0 * (i / n), 0.0});
  return R"(
schema: 1
study: fates
time: {end: 40 min, output: 40 min}
domain: {size: [1300 um, 1300 um, 100 um], center: [570 um, 570 um, 0 um]}
cell_types:
  transit:
    radius: 5 um
    body: sphere
    adhesion: {transit: 5e-5 J/m^2, stem: 5e-5 J/m^2}
    polarity: {start: [0, 1, 0], turning: 0 1/h}
    dcm: {nodes: 42, cortex: {elastic: none, tension: 0.4 mN/m}}
  stem:
    radius: 4 um
    body: )" +
         body + R"(
    polarity: {start: [0, 0, 1], turning: 0 1/h}
    cycle: {duration: 30 min, axis: fixed, direction: [1, 0, 0], daughters: )" +
         daughters + R"(}
    dcm: {nodes: 42, cortex: {elastic: none, tension: 0.2 mN/m}}
)" + more +
         "initial: [{type: stem, at: [" + places + "], age: birth}]\noutput: {report: false}\n";
}

struct Daughter {
  std::uint16_t type;
  double x, z, volume, pressure;
};

/// Both daughters by mother at the end: first, second.
std::map<CellId, std::array<Daughter, 2>> daughters_of(const std::string& text) {
  std::map<CellId, std::array<Daughter, 2>> out;
  const auto all = snapshots_of_run(text);
  if (all.empty()) return out;
  for (const Snapshot::Cell& cell : all.back().snapshot.cells)
    if (cell.parent.valid())
      out[cell.parent][cell.id == cell.parent.daughter(0) ? 0 : 1] = {cell.type, cell.centroid.x, cell.centroid.z, cell.volume,
                                                                      cell.inner_pressure};
  return out;
}

constexpr std::uint16_t kTransit = 0, kStem = 1;

TEST(Fates, OfAnAsymmetricDivisionLieWhereTheAxisPoints) {
  for (const char* body : {"sphere", "shell"}) {
    const auto found = daughters_of(stem("{fates: [{share: 100 %, types: [stem, transit]}]}", body, 2));
    ASSERT_EQ(found.size(), 4u) << body;
    for (const auto& [mother, pair] : found) {
      EXPECT_EQ(pair[0].type, kStem) << body;
      EXPECT_EQ(pair[1].type, kTransit) << body;
      EXPECT_GT(pair[0].x - pair[1].x, 3.0) << body;
    }
  }
}

TEST(Fates, AreAsFrequentAsTheStudySays) {
  const auto found = daughters_of(stem("{fates: [{share: 60 %, types: [stem, transit]}, {share: 25 %, types: [transit, transit]}]}"));
  ASSERT_EQ(found.size(), 400u);
  int one = 0, none = 0, both = 0;
  for (const auto& [mother, pair] : found) {
    one += pair[0].type == kStem && pair[1].type == kTransit;
    none += pair[0].type == kTransit && pair[1].type == kTransit;
    both += pair[0].type == kStem && pair[1].type == kStem;
  }
  EXPECT_EQ(one + none + both, 400);
  const auto spread = [](double p) { return 4.0 * std::sqrt(400.0 * p * (1.0 - p)); };
  EXPECT_NEAR(one, 240.0, spread(0.6));
  EXPECT_NEAR(none, 100.0, spread(0.25));
  EXPECT_NEAR(both, 60.0, spread(0.15)) << "what is left keeps the mother's type";
}

TEST(Fates, OfShellsHaveTheTensionOfTheirOwnType) {
  // A minute after the new interface has taken its tension, sisters of one type are pressed alike, and transit cells, of twice the tension, more.
  const auto found = daughters_of(
      changed("40 min, output: 40 min", "50 min, output: 50 min", stem("{fates: [{share: 100 %, types: [stem, transit]}]}", "shell", 2)));
  ASSERT_EQ(found.size(), 4u);
  for (const auto& [mother, pair] : found) {
    const double stems = pair[0].pressure * std::cbrt(pair[0].volume), others = pair[1].pressure * std::cbrt(pair[1].volume);
    EXPECT_NEAR(others / stems, 2.0, 0.25) << mother.text();
  }
}

TEST(Fates, HaveTheBodyOfTheirTypeOnceSistersHaveParted) {
  // First divisions at half an hour, second ones of the stem cells at an hour.
  for (const bool become_shells : {true, false}) {
    const std::string study = changed("40 min, output: 40 min", "70 min, output: 5 min",
                                      stem("{fates: [{share: 100 %, types: [stem, transit]}]}", become_shells ? "sphere" : "shell", 2));
    const std::string text = become_shells ? changed("body: sphere\n    adhesion", "body: shell\n    adhesion", study) : study;
    const auto all = snapshots_of_run(text);
    ASSERT_FALSE(all.empty());
    const BodyKind mothers = become_shells ? BodyKind::kSphere : BodyKind::kShell;
    int transit = 0;
    for (const Snapshot::Cell& cell : all.back().snapshot.cells) {
      if (cell.type == kStem || cell.age < 1800.0) {
        EXPECT_EQ(cell.body, mothers) << cell.id.text();
        continue;
      }
      ++transit;
      EXPECT_NE(cell.body, mothers) << cell.id.text();
    }
    EXPECT_EQ(transit, 4);
  }
}

TEST(Fates, StandInTheLineage) {
  const Folder folder;
  const auto study = read(stem("{fates: [{share: 100 %, types: [stem, transit]}]}", "sphere", 2));
  ASSERT_TRUE(study.ok()) << study.error().text();
  ASSERT_TRUE(run_into(folder.path() / "run", *study));
  const auto lives = read_lineage(folder.path() / "run/results.h5", folder.path() / "run/events.jsonl");
  ASSERT_TRUE(lives.ok()) << lives.error().message;
  ASSERT_EQ(lives->size(), 12u);
  for (const CellLife& life : *lives) EXPECT_EQ(life.type, !life.parent.empty() && life.id.back() == '1' ? "transit" : "stem") << life.id;
}

TEST(Fates, GoOnAsTheirTypesSay) {
  // After another half hour the stem cells of the first divisions have divided again, transit cells have not.
  const auto found = daughters_of(
      changed("40 min, output: 40 min", "70 min, output: 70 min", stem("{fates: [{share: 100 %, types: [stem, transit]}]}", "sphere", 5)));
  int founders = 0, second = 0;
  for (const auto& [mother, pair] : found) {
    founders += mother.generation() == 0;  // of these only the transit daughter is left
    second += mother.generation() == 1;
  }
  EXPECT_EQ(founders, 25);
  EXPECT_EQ(second, 25);
}

TEST(Fates, SurviveTheResolvedStudy) {
  const auto study =
      read(stem("{fates: [{share: 60 %, types: [stem, transit]}, {share: 25 %, types: [transit, transit]}], polarity: mirrored}"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto again = read(study->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  for (const Study* one : {&*study, &*again}) {
    const Fates& fates = one->model.types[kStem].fates;
    ASSERT_EQ(fates.all.size(), 2u);
    EXPECT_EQ(fates.all[0].share, 0.6);
    EXPECT_EQ(fates.all[0].type, (std::array<std::uint16_t, 2>{kStem, kTransit}));
    EXPECT_EQ(fates.all[1].type, (std::array<std::uint16_t, 2>{kTransit, kTransit}));
    EXPECT_EQ(fates.polarity, DaughterPolarity::kMirrored);
  }
}

TEST(Fates, PolarityIsKeptOrMirrored) {
  // Cells divide along their polarity, first z: what the daughters have of it is seen when they divide.
  for (const bool mirrored : {false, true}) {
    const auto found = daughters_of(changed("axis: fixed, direction: [1, 0, 0]", "axis: polarity",
                                            changed("40 min, output: 40 min", "62 min, output: 62 min",
                                                    stem(mirrored ? "{polarity: mirrored}" : "{polarity: kept}", "sphere", 3))));
    int seen = 0;
    for (const auto& [mother, pair] : found) {
      if (mother.generation() != 1) continue;
      ++seen;
      bool is_second = false;
      for (std::uint64_t k = 1; k <= 9; ++k) is_second = is_second || mother == CellId::founder(k).daughter(1);
      EXPECT_GT((pair[0].z - pair[1].z) * (mirrored && is_second ? -1.0 : 1.0), 1.0) << mother.text();
    }
    EXPECT_EQ(seen, 18);
  }
}

TEST(Fates, NewPolaritiesOfSistersHaveNothingInCommon) {
  // Cells divide along polarities that are drawn at random. Sisters that keep their mother's divide along one line; the mean |cosine| of two
  // random ones is a half, with a standard deviation of √(1/12).
  for (const bool anew : {false, true}) {
    const std::string text = changed("polarity: {start: [0, 0, 1], turning", "polarity: {turning",
                                     changed("axis: fixed, direction: [1, 0, 0]", "axis: polarity",
                                             changed("40 min, output: 40 min", "62 min, output: 62 min",
                                                     stem(anew ? "{polarity: new}" : "{polarity: kept}", "sphere", 8))));
    const auto all = snapshots_of_run(text);
    ASSERT_FALSE(all.empty());
    std::map<CellId, std::map<CellId, Vec3d>> place;  // of granddaughters, by mother
    for (const Snapshot::Cell& cell : all.back().snapshot.cells) place[cell.parent][cell.id] = cell.centroid;
    double sum = 0.0;
    int sisters = 0;
    for (std::uint64_t k = 1; k <= 64; ++k) {
      Vec3d axis[2];
      for (int d = 0; d < 2; ++d) {
        const CellId mother = CellId::founder(k).daughter(d);
        ASSERT_EQ(place[mother].size(), 2u);
        axis[d] = normalized(place[mother][mother.daughter(0)] - place[mother][mother.daughter(1)]);
      }
      sum += std::abs(dot(axis[0], axis[1]));
      ++sisters;
    }
    if (anew)
      EXPECT_NEAR(sum / sisters, 0.5, 4.0 * std::sqrt(1.0 / 12.0 / sisters));
    else
      EXPECT_GT(sum / sisters, 0.95);
  }
}

TEST(Fates, TellWhatCannotBe) {
  const auto told = [](const std::string& text) {
    const auto study = read(text);
    return study.ok() ? std::string() : study.error().text();
  };
  EXPECT_EQ(told(stem("{fates: [{share: 50 %, types: [stem, transit]}]}", "shell", 2)), "");
  EXPECT_THAT(told(stem("{fates: [{share: 50 %, types: [stem, transsit]}]}", "shell", 2)), HasSubstr("transit"));
  EXPECT_THAT(told(stem("{fates: [{share: 50 %, types: [transit]}]}", "shell", 2)), HasSubstr("a division has two daughters"));
  EXPECT_THAT(told(stem("{fates: [{share: 60 %, types: [stem, transit]}, {share: 60 %, types: [stem, stem]}]}", "shell", 2)),
              HasSubstr("more than all of its divisions"));
  EXPECT_THAT(told(changed("nodes: 42, cortex: {elastic: none, tension: 0.4", "nodes: 642, cortex: {elastic: none, tension: 0.4",
                           stem("{fates: [{share: 50 %, types: [stem, transit]}]}", "shell", 2))),
              HasSubstr("another number of nodes"));
  EXPECT_THAT(told(changed("polarity: {start: [0, 0, 1], turning: 0 1/h}", "color: sky", stem("{polarity: mirrored}", "shell", 2))),
              HasSubstr("have none"));
  EXPECT_THAT(told(stem("{polarity: turned}", "shell", 2)), HasSubstr("mirrored"));
}

}  // namespace
}  // namespace morula::scenarios::test
