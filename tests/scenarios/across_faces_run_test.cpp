/// A tissue across a face of a periodic domain is what it is in the middle: what regions see of it, and what measures tell.
#include <cmath>
#include <map>
#include <string>

#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

class AcrossFaces : public OwnParts {
 protected:
  AcrossFaces() : OwnParts([](Laws&) {}) {}

  /// The values of the criteria of a run, by id.
  std::map<std::string, double> values(const std::string& text, const std::string& name) {
    std::map<std::string, double> out;
    for (const Verdict& verdict : run_whole(text, name).verdicts) out[verdict.id] = verdict.value;
    return out;
  }
};

std::string at(double x, double y, double z) {
  const double inside = x - 100.0 * std::round(x / 100.0);  // as a user writes it
  return "[" + std::to_string(inside) + " um, " + std::to_string(y) + " um, " + std::to_string(z) + " um]";
}

/// Seven cells in the form of a cross about x.
std::string cross_of_cells(double x, double apart) {
  return "[" + at(x, 0, 0) + ", " + at(x + apart, 0, 0) + ", " + at(x - apart, 0, 0) + ", " + at(x, apart, 0) + ", " + at(x, -apart, 0) +
         ", " + at(x, 0, apart) + ", " + at(x, 0, -apart) + "]";
}

TEST_F(AcrossFaces, MeasuresTellTheSame) {
  const auto study = [](double x, const std::string& measures) {
    return R"(schema: 1
study: cross
time: {end: 20 min, output: 10 min}
domain: {size: [100 um, 100 um, 100 um], boundary: periodic}
cell_types:
  a: {radius: 5 um, body: shell, dcm: {nodes: 42}}
initial:
  - {type: a, orientation: aligned, at: )" +
           cross_of_cells(x, 9.9) + R"(}
output: {report: false}
criteria:
)" + measures;
  };
  const std::map<std::string, std::string> units{{"aggregate.roughness(a)", ""},
                                                 {"aggregate.motion(a)", " um"},
                                                 {"aggregate.contact_part(a)", ""},
                                                 {"outer.touched(a)", ""},
                                                 {"outer.hidden(a)", ""}};
  std::string measures;
  for (const auto& [measure, unit] : units)
    measures += "  - {id: \"" + measure + "\", measure: \"" + measure + "\", at: end, above: -1000" + unit + "}\n";
  const auto inside = values(study(0.0, measures), "inside"), across = values(study(49.0, measures), "across");
  EXPECT_GT(inside.at("aggregate.motion(a)"), 0.0);
  for (const auto& [measure, unit] : units) {
    const double value = inside.at(measure);
    EXPECT_NEAR(across.at(measure), value, 1e-3 * std::abs(value) + 1e-7) << measure;
  }
}

TEST_F(AcrossFaces, AContactOfTwoHasItsAngleAndThePairItsWholeWay) {
  const auto study = [](double x) {
    return R"(schema: 1
study: pair
time: {end: 30 min, output: 5 min}
domain: {size: [100 um, 100 um, 100 um], boundary: periodic}
cell_types:
  a: {radius: 5 um, body: shell, adhesion: {others: 1e-4 J/m^2}, dcm: {nodes: 162, cortex: {elastic: none, tension: 0.2 mN/m}}}
loads: {push: {type: a, body_force: [2 nN, 0 nN, 0 nN]}}
initial:
  - {type: a, orientation: aligned, at: [)" +
           at(x - 4.95, 0, 0) + ", " + at(x + 4.95, 0, 0) + R"(]}
output: {report: false}
criteria:
  - {id: angle, measure: cap.angle, of: {pair: [a, a]}, at: end, above: 0 deg}
  - {id: drift, measure: pair.drift, of: {pair: [a, a]}, at: end, above: 0}
)";
  };
  const auto inside = values(study(0.0), "inside"), across = values(study(47.0), "across");
  EXPECT_GT(inside.at("angle"), 0.5);
  EXPECT_NEAR(across.at("angle"), inside.at("angle"), 0.01);
  const double way = column("inside", "centre_drift").back();  // of the surfaces, that of the pair
  EXPECT_GT(way, 55.0) << "further than half of the domain";
  EXPECT_NEAR(inside.at("drift"), way / 5.0, 0.03 * way / 5.0);
  EXPECT_NEAR(across.at("drift"), inside.at("drift"), 1e-3 * inside.at("drift"));
}

/// A needle that goes round the domain passes a cell once every round, and the region about it does.
TEST_F(AcrossFaces, ARegionFollowsWhatGoesRoundTheDomain) {
  const auto told = values(R"(schema: 1
study: around
time: {end: 210 min, output: 30 min}
domain: {size: [100 um, 100 um, 100 um], boundary: {x: periodic, y: periodic, z: open}}
cell_types:
  a: {radius: 5 um}
geometry:
  needle:
    capsule: {from: [46 um, 0 um, -5 um], to: [46 um, 0 um, 5 um], radius: 3 um}
    motion: {direction: [1, 0, 0], course: [{time: 0 s, distance: 0 um}, {time: 4 h, distance: 400 um}]}
initial:
  - {type: a, at: [0 um, 20 um, 0 um]}
coupling:
  hold: 1 min
  regions:
    - {name: r, shape: around, geometry: needle, within: 24 um, margin: 1 um}
output: {report: false}
criteria:
  - {id: nearest, measure: obstacle.nearest_sphere(needle), at: 3 h, below: 80 um}
)",
                           "around");
  const auto shells = column("around", "shell_count");
  ASSERT_EQ(shells.size(), 8u);
  for (std::size_t k = 0; k < shells.size(); ++k) EXPECT_EQ(shells[k], k % 2 == 1 ? 1.0 : 0.0) << 30 * k << " min";
  EXPECT_NEAR(told.at("nearest"), std::hypot(46.0, 20.0) - 3.0, 0.1);
}

TEST_F(AcrossFaces, ARegionThatFollowsTheTissueIsInItsMiddle) {
  for (const double x : {20.0, 49.0}) {
    const std::string name = "follow" + std::to_string(static_cast<int>(x));
    run_whole(R"(schema: 1
study: follow
time: {end: 2 min, output: 1 min}
domain: {size: [100 um, 100 um, 100 um], boundary: periodic}
cell_types:
  a: {radius: 5 um}
initial:
  - {type: a, at: )" +
                  cross_of_cells(x, 9.4) + R"(}
coupling:
  regions:
    - {name: core, shape: sphere, radius: 4 um, follow_tissue: true}
output: {report: false}
)",
              name);
    EXPECT_EQ(column(name, "shell_count").front(), 1.0) << x;
  }
}

/// Growth that stops where cells are compressed does in either body: in a box with walls that is full, and in the same box twice as wide it does not.
TEST_F(AcrossFaces, ArrestByVolumeHoldsSpheresToo) {
  const auto volume = [&](const std::string& body, const std::string& size) {
    const std::string name = body + size.substr(0, 2);
    run_whole(R"(schema: 1
study: full
time: {end: 3 h, output: 1 h}
numerics: {start_cap: auto}
limits: {overlap: 3 um}
domain: {size: [)" +
                  size + ", " + size + ", " + size + R"(], boundary: wall}
cell_types:
  a:
    radius: 5 um
    body: )" + body +
                  R"(
    adhesion: {others: 0 J/m^2}
    dcm: {nodes: 42}
    cycle: {duration: 10 h, ratio: 8, arrest: {volume: {from: 97 %, to: 90 %}}}
    inhibit_growth: {pressure_above: never}
initial:
  - {type: a, count: 8, fill: box, size: [18 um, 18 um, 18 um], age: birth, start_volume: 55 %, inflate: 10 min}
output: {report: false}
)",
              name);
    return column(name, "total_volume").back();
  };
  const double free = 8.0 * 523.6 * (1.0 + 7.0 * 0.3);
  EXPECT_NEAR(volume("sphere", "40 um"), free, 0.01 * free);
  EXPECT_LT(volume("sphere", "18 um"), 0.75 * free);
  EXPECT_LT(volume("shell", "18 um"), 0.75 * free);
}

}  // namespace
}  // namespace morula::scenarios::test
