#include <gtest/gtest.h>

#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kStudy = R"(schema: 1
study: box
time: {end: 1 h}
domain: {size: [60 um, 60 um, 60 um], boundary: periodic, course: [{time: 10 min, volume: 1}, {time: 1 h, volume: 85 %}]}
cell_types:
  cell: {radius: 6 um}
initial:
  - {type: cell, count: 20, fill: box, size: [20 um, 50 um, 50 um]}
)";

std::string with(const std::string& from, const std::string& to) { return test::changed(from, to, kStudy); }

TEST(BoxCourse, IsReadAndResolvesToItself) {
  const auto study = test::read(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_EQ(study->model.box_volume.time, (std::vector<double>{600.0, 3600.0}));
  EXPECT_EQ(study->model.box_volume.value, (std::vector<double>{1.0, 0.85}));
  const auto again = test::read(study->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->model.box_volume.value, study->model.box_volume.value);
}

struct Refused {
  const char *from, *to, *code, *place;
};

TEST(BoxCourse, IsRefusedWithThePlaceWhereItCannotBeFollowed) {
  for (const Refused& bad : {
           Refused{"boundary: periodic", "boundary: {all: periodic, z: wall}", "E518", "study.yaml:4:"},
           Refused{"initial:", "fields:\n  oxygen: {diffusion: 2e-9 m^2/s, initial: 0.2 mM}\ninitial:", "E518", "study.yaml:8:"},
           Refused{"initial:", "geometry:\n  ball: {sphere: {radius: 8 um}}\ninitial:", "E518", "study.yaml:8:"},
           Refused{"volume: 1}", "volume: 0.95}", "E518", "study.yaml:4:"},
           Refused{"volume: 85 %", "volume: 0.2", "E302", "study.yaml:4:"},
           Refused{"volume: 85 %", "volume: 3.5", "E302", "study.yaml:4:"},
           Refused{"time: 1 h, volume", "time: 5 min, volume", "E510", "study.yaml:4:"},
           Refused{", {time: 1 h, volume: 85 %}", "", "E510", "study.yaml:4:"},
           Refused{"[60 um, 60 um, 60 um]", "[26 um, 60 um, 60 um]", "E511", "study.yaml:4:"},
       }) {
    const auto study = test::read(with(bad.from, bad.to));
    ASSERT_FALSE(study.ok()) << bad.to;
    const std::string text = study.error().text();
    EXPECT_NE(text.find(bad.code), std::string::npos) << bad.to << ": " << text;
    EXPECT_NE(text.find(bad.place), std::string::npos) << bad.to << ": " << text;
  }
  EXPECT_TRUE(test::read(test::changed(", course: [{time: 10 min, volume: 1}, {time: 1 h, volume: 85 %}]", "",
                                       with("[60 um, 60 um, 60 um]", "[26 um, 60 um, 60 um]")))
                  .ok())
      << "without a course the smaller box is large enough";
}

/// Shells that are pressed reach further than balls: two of 8 um touched on both sides of a face of a box of 36 um, where 34 are enough for balls.
TEST(PeriodicDomain, IsToldWhereShellsMayMeetOnBothSides) {
  const auto told = [](const std::string& edge, const std::string& body) {
    const auto study = test::read(R"(schema: 1
study: box
time: {end: 1 h}
domain: {size: [)" + edge + ", " + edge +
                                  ", " + edge + R"(], boundary: periodic}
cell_types: {cell: {radius: 6 um, body: )" +
                                  body + R"(}}
initial:
  - {type: cell, at: [0 um, 0 um, 0 um]}
)");
    return study.ok() ? study->warnings.text() : "refused: " + study.error().text();
  };
  // 2 (2 R + c) = 25 um and 2 (2.5 R + c) = 31 um
  EXPECT_NE(told("28 um", "shell").find("warning: the domain is small along x"), std::string::npos) << told("28 um", "shell");
  EXPECT_EQ(told("24 um", "shell").find("refused"), 0u);
  EXPECT_EQ(told("32 um", "shell").find("E511"), std::string::npos);
  EXPECT_EQ(told("28 um", "sphere").find("E511"), std::string::npos);
}

}  // namespace
}  // namespace morula::scenarios
