/// The user's road to cells of a type that differ: tensions, and cycles that daughters have from their mothers.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "report/methods.h"
#include "scenarios/run/used_laws.h"
#include "tests/scenarios/snapshots_of_run.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;

/// Values of two columns of a run's last snapshot, or of others, by cell.
struct Told {
  std::map<CellId, Snapshot::Cell> cells;
  std::map<std::string, std::map<CellId, double>> of;  ///< deviations by trait
  std::map<CellId, double>& deviation = of["tension"];

  Told() = default;
  Told(const Told& other) : cells(other.cells), of(other.of) {}
};

Told run(const std::string& text) {
  Told out;
  const auto all = snapshots_of_run(text);
  if (all.empty()) return out;
  const Snapshot& end = all.back().snapshot;
  for (std::size_t i = 0; i < end.cells.size(); ++i) {
    out.cells[end.cells[i].id] = end.cells[i];
    for (const Snapshot::Variable& variable : end.variables)
      if (variable.name.ends_with("/deviation"))
        out.of[variable.name.substr(0, variable.name.find('/'))][end.cells[i].id] = variable.values[i];
  }
  return out;
}

/// n² places in a plane.
std::string grid(int n, double apart) {
  std::string out;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      out += (out.empty() ? "" : ", ") + place_text({apart * (i - 0.5 * (n - 1)), apart * (j - 0.5 * (n - 1)), 0.0});
  return out;
}

/// Free shells, 30 µm apart.
constexpr const char* kFree = R"(
schema: 1
study: free
time: {end: 20 min, output: 20 min}
domain: {size: [400 um, 400 um, 100 um]}
cell_types:
  cell:
    body: shell
    radius: 5 um
    variation: {tension: VARIATION}
    dcm: {nodes: 42, bulk_modulus: 2 kPa, cortex: {elastic: none, tension: 0.5 mN/m}}
MORE
initial: [{type: cell, at: [PLACES]}]
output: {report: false}
)";

std::string free_cells(const std::string& variation, const std::string& more = "") {
  return changed("PLACES", grid(10, 30.0), changed("VARIATION", variation, changed("MORE", more, kFree)));
}

TEST(Variation, OfTensionsIsBornByThePressureOfEachShell) {
  const Told told = run(free_cells("{spread: 10 %}"));
  ASSERT_EQ(told.deviation.size(), 100u);
  double sum = 0.0, squares = 0.0;
  for (const auto& [id, d] : told.deviation) {
    sum += d;
    squares += d * d;
    // A free shell at rest: Laplace's law with the tension of its own; its mesh of 42 nodes is 1.5 % off.
    const Snapshot::Cell& cell = told.cells.at(id);
    const double radius = std::cbrt(3.0 * cell.volume / (4.0 * 3.141592653589793));
    EXPECT_NEAR(cell.inner_pressure / (2.0 * 0.5 * (1.0 + d) / radius), 1.0, 0.03) << id.text();
    EXPECT_NEAR(cell.volume / (4.0 / 3.0 * 3.141592653589793 * 125.0), 1.0, 0.01) << "each begins in balance with its own tension";
  }
  EXPECT_NEAR(sum / 100.0, 0.0, 3.0 * 0.1 / 10.0);
  EXPECT_NEAR(std::sqrt(squares / 100.0), 0.0987, 3.0 * 0.1 / std::sqrt(200.0)) << "cut at 3: 0.987 of the spread";
}

TEST(Variation, ReachesTheTensionsOfRegionsToo) {
  // `whole` takes the place of the cell's own tension: twice it, and so each pressure.
  const Told told = run(free_cells("{spread: 10 %}"));
  const Told twice =
      run(changed("tension: 0.5 mN/m}", "tension: 0.5 mN/m, regions: {whole: {tension: 1 mN/m}}}", free_cells("{spread: 10 %}")));
  ASSERT_EQ(told.cells.size(), 100u);
  ASSERT_EQ(twice.cells.size(), 100u);
  EXPECT_EQ(told.deviation, twice.deviation);
  for (const auto& [id, cell] : told.cells) {
    const Snapshot::Cell& other = twice.cells.at(id);
    EXPECT_NEAR(other.inner_pressure * std::cbrt(other.volume) / (cell.inner_pressure * std::cbrt(cell.volume)), 2.0, 0.01) << id.text();
  }
}

TEST(Variation, IsKeptByASphereUntilItIsAShellAgain) {
  const std::string coupling =
      "coupling: {hold: 1 min, regions: [{name: late, shape: everything, as: sphere, from: 5 min, until: 10 min}]}";
  const Told told = run(free_cells("{spread: 10 %}").append(coupling + "\n"));
  const Told alone = run(free_cells("{spread: 10 %}"));
  ASSERT_EQ(told.deviation.size(), 100u);
  EXPECT_EQ(told.deviation, alone.deviation);
  for (const auto& [id, cell] : told.cells) {
    if (cell.body != BodyKind::kShell) continue;  // one in a hundred cells a step
    EXPECT_NEAR(cell.inner_pressure / alone.cells.at(id).inner_pressure, 1.0, 0.01) << id.text();
  }
}

/// Spheres that divide every half hour, far enough apart from the start that they do not care about each other.
std::string dividing(const std::string& duration, const std::string& variation, const std::string& end) {
  return R"(
schema: 1
study: lineage
seed: 11
time: {end: )" +
         end + R"(, output: 10 min}
domain: {size: [3 mm, 3 mm, 100 um]}
cell_types:
  cell:
    radius: 3 um
    variation: {tension: )" +
         variation + R"(}
    cycle: {duration: )" +
         duration + R"(}
coupling: {regions: [{name: r, shape: sphere, center: [-1450 um, 0 um, 0 um], radius: 1 um}]}
initial: [{type: cell, at: [)" +
         grid(20, 100.0) +
         R"(], age: birth}]
output: {report: false}
)";
}

double correlation_of(const std::vector<std::pair<double, double>>& pairs) {
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  const auto n = static_cast<double>(pairs.size());
  for (const auto& [a, b] : pairs) x += a / n, y += b / n;
  for (const auto& [a, b] : pairs) xx += (a - x) * (a - x), yy += (b - y) * (b - y), xy += (a - x) * (b - y);
  return xy / std::sqrt(xx * yy);
}

TEST(Variation, OfDaughtersFollowsThatOfTheirMothers) {
  const auto all = snapshots_of_run(dividing("{mean: 30 min, spread: 10 %}", "{spread: 10 %, correlation: 60 %}", "45 min"));
  ASSERT_FALSE(all.empty());
  std::map<CellId, double> deviation;
  std::map<CellId, CellId> parent;
  for (const auto& [time, snapshot] : all)
    for (const Snapshot::Variable& variable : snapshot.variables)
      for (std::size_t i = 0; variable.name == "tension/deviation" && i < snapshot.cells.size(); ++i) {
        deviation[snapshot.cells[i].id] = variable.values[i];
        parent[snapshot.cells[i].id] = snapshot.cells[i].parent;
      }
  std::vector<std::pair<double, double>> pairs, sisters;
  double squares = 0.0;
  for (const auto& [id, d] : deviation) {
    if (!parent[id].valid()) continue;
    pairs.emplace_back(deviation[parent[id]], d);
    squares += d * d;
    if (id == parent[id].daughter(0)) sisters.emplace_back(d, deviation[parent[id].daughter(1)]);
  }
  ASSERT_EQ(pairs.size(), 800u);
  // Fisher's z of so many pairs; sisters share a mother, each with 0.6: 0.36.
  EXPECT_NEAR(std::atanh(correlation_of(pairs)), std::atanh(0.6), 4.0 / std::sqrt(797.0));
  EXPECT_NEAR(std::atanh(correlation_of(sisters)), std::atanh(0.36), 4.0 / std::sqrt(397.0));
  EXPECT_NEAR(std::sqrt(squares / 800.0), 0.0987, 4.0 * 0.1 / std::sqrt(2.0 * 800.0)) << "as wide as that of the founders";
}

TEST(Variation, OfCyclesFollowsThatOfTheMothers) {
  // From `events.jsonl`: when founders and their daughters divide.
  for (const double rho : {0.0, 0.7, -0.5}) {
    const auto all =
        snapshots_of_run(dividing("{mean: 30 min, spread: 10 %, correlation: " + std::to_string(100.0 * rho) + " %}", "0 %", "82 min"));
    ASSERT_FALSE(all.empty());
    std::map<CellId, double> birth;
    for (const auto& [time, snapshot] : all)
      for (const Snapshot::Cell& cell : snapshot.cells) birth.emplace(cell.id, time - cell.age);
    std::vector<std::pair<double, double>> pairs;  // cycles of founders and daughters
    for (const auto& [id, born] : birth) {
      if (id.generation() != 1) continue;
      const auto died = birth.find(id.daughter(0));
      if (died != birth.end()) pairs.emplace_back(born, died->second - born);
    }
    ASSERT_EQ(pairs.size(), 800u) << rho;
    EXPECT_NEAR(std::atanh(correlation_of(pairs)), std::atanh(rho), 4.0 / std::sqrt(797.0)) << rho;
  }
}

/// Pairs of cells 60 µm apart, along y; in each the second lies at `way` from the first.
std::string pairs(int n, double way, const std::string& first, const std::string& second,
                  const std::string& of_first = ", orientation: aligned", const std::string& of_second = ", orientation: aligned") {
  std::string a, b;
  for (int i = 0; i < n; ++i) {
    const double y = 60.0 * (i - 0.5 * (n - 1));
    a += (i > 0 ? ", " : "") + place_text({0.0, y, 0.0});
    b += (i > 0 ? ", " : "") + place_text({way, y, 0.0});
  }
  return "initial:\n  - {type: " + first + ", at: [" + a + "]" + of_first + "}\n  - {type: " + second + ", at: [" + b + "]" + of_second +
         "}\n";
}

std::string adhering(const std::string& types, const std::string& initial, const std::string& end) {
  return "schema: 1\nstudy: pairs\ntime: {end: " + end + ", output: " + end +
         "}\ndomain: {size: [100 um, 1000 um, 100 um]}\ncell_types:\n" + types + initial + "output: {report: false}\n";
}

/// f_a f_b of the two cells of pair i among n in a trait of deviations by cell.
double product(const std::map<CellId, double>& deviation, std::uint64_t i, std::uint64_t n) {
  return (1.0 + deviation.at(CellId::founder(i + 1))) * (1.0 + deviation.at(CellId::founder(n + i + 1)));
}

TEST(Variation, OfSpheresIsThatOfJohnsonKendallAndRoberts) {
  const std::string type =
      "  cell: {radius: 5 um, variation: {stiffness: 15 %, adhesion: 15 %}, adhesion: {cell: 5e-5 J/m^2}, "
      "cbm: {young: 1 kPa, poisson: 0.4, packing: none}}\n";
  const Told told = run(adhering(type, pairs(12, 9.8, "cell", "cell", "", ""), "2 h"));
  ASSERT_EQ(told.of.at("stiffness").size(), 24u);
  double least = 1e9, most = 0.0;
  for (std::uint64_t i = 0; i < 12; ++i) {
    const CellId a = CellId::founder(i + 1), b = CellId::founder(12 + i + 1);
    // δ0 = a0²/(3R*), a0³ = 9πWR*²/(2E*); 1/E* = Σ (1 − ν²)/E (Johnson, Kendall & Roberts 1971)
    const double compliance = 0.84 / (1.0 + told.of.at("stiffness").at(a)) + 0.84 / (1.0 + told.of.at("stiffness").at(b));
    const double w = 0.05 * std::sqrt(product(told.of.at("adhesion"), i, 12)), radius = 2.5;
    const double contact = std::cbrt(9.0 * 3.141592653589793 * w * radius * radius * compliance / 2.0);
    const double overlap = 10.0 - norm(told.cells.at(a).centroid - told.cells.at(b).centroid);
    EXPECT_NEAR(overlap, contact * contact / (3.0 * radius), 1e-3 * overlap) << i;
    least = std::min(least, overlap), most = std::max(most, overlap);
  }
  EXPECT_GT(most / least, 1.15) << "they differ";
}

TEST(Variation, OfShellsIsThatOfAPairWithTheMeanAdhesion) {
  const auto type = [](const std::string& name, const std::string& more) {
    return "  " + name + ": {radius: 5 um, body: shell, " + more + "dcm: {nodes: 162, cortex: {elastic: none, tension: 0.2 mN/m}}}\n";
  };
  const Told told =
      run(adhering(type("cell", "variation: {adhesion: 15 %}, adhesion: {cell: 1.5e-4 J/m^2}, "), pairs(4, 9.9, "cell", "cell"), "40 min"));
  ASSERT_EQ(told.of.at("adhesion").size(), 8u);
  for (const std::uint64_t i : {0u, 3u}) {
    const double w = 1.5e-4 * std::sqrt(product(told.of.at("adhesion"), i, 4));
    const Told alone =
        run(adhering(type("cell", "adhesion: {cell: " + std::to_string(1e3 * w) + " mJ/m^2}, "), pairs(1, 9.9, "cell", "cell"), "40 min"));
    EXPECT_NEAR(told.cells.at(CellId::founder(i + 1)).contact_area / alone.cells.at(CellId::founder(1)).contact_area, 1.0, 0.01) << i;
  }
  double least = 1e9, most = 0.0;
  for (std::uint64_t i = 1; i <= 4; ++i) {
    least = std::min(least, told.cells.at(CellId::founder(i)).contact_area);
    most = std::max(most, told.cells.at(CellId::founder(i)).contact_area);
  }
  EXPECT_GT(most / least, 1.05) << "they differ";
}

TEST(Variation, OfASphereAndAShellIsThatOfBoth) {
  const auto types = [](const std::string& ball, const std::string& adhesion) {
    return "  ball: {radius: 5 um, adhesion: {bag: " + adhesion + "}, " + ball + "}\n  bag: {radius: 5 um, body: shell, " +
           (adhesion == "1e-4 J/m^2" ? "variation: {adhesion: 15 %, stiffness: 15 %}, " : "") +
           "dcm: {nodes: 162, cortex: {elastic: none, tension: 0.2 mN/m}}}\n";
  };
  const Told told = run(adhering(types("variation: {adhesion: 15 %, stiffness: 15 %}, cbm: {young: 0.5 kPa, packing: none}", "1e-4 J/m^2"),
                                 pairs(4, 9.9, "ball", "bag", ""), "40 min"));
  ASSERT_EQ(told.of.at("stiffness").size(), 8u);
  for (const std::uint64_t i : {0u, 3u}) {
    const double w = 0.1 * std::sqrt(product(told.of.at("adhesion"), i, 4));
    const double young = 0.5 * (1.0 + told.of.at("stiffness").at(CellId::founder(i + 1)));
    const Told alone = run(adhering(types("cbm: {young: " + std::to_string(young) + " kPa, packing: none}", std::to_string(w) + " mJ/m^2"),
                                    pairs(1, 9.9, "ball", "bag", ""), "40 min"));
    const auto apart = [](const Told& of, std::uint64_t a, std::uint64_t b) {
      return norm(of.cells.at(CellId::founder(a)).centroid - of.cells.at(CellId::founder(b)).centroid);
    };
    EXPECT_NEAR(apart(told, i + 1, 4 + i + 1), apart(alone, 1, 2), 0.005) << i;
    EXPECT_NEAR(told.cells.at(CellId::founder(4 + i + 1)).contact_area / alone.cells.at(CellId::founder(2)).contact_area, 1.0, 0.01) << i;
  }
}

TEST(Variation, OfStiffnessMakesShellsGiveWayLess) {
  // Springs without tension, pulled at both ends: the extension goes with one over the stiffness where the volume is kept.
  const std::string cells =
      changed("variation: {tension: VARIATION}", "variation: {stiffness: 15 %}",
              changed("elastic: none, tension: 0.5 mN/m", "elastic: springs, tension: 0 mN/m, young: 5 kPa, thickness: 0.2 um",
                      changed("PLACES", grid(5, 40.0),
                              changed("at: [PLACES]}", "at: [PLACES], orientation: aligned}",
                                      changed("MORE", "loads: {pull: {type: cell, pull: {force: 0.5 nN}}}", kFree)))));
  const Told told = run(cells);
  ASSERT_EQ(told.of.at("stiffness").size(), 25u);
  std::vector<std::pair<double, double>> pairs_;
  for (const auto& [id, d] : told.of.at("stiffness"))
    pairs_.emplace_back(1.0 / (1.0 + d), told.cells.at(id).area - 4.0 * 3.141592653589793 * 25.0);
  EXPECT_GT(correlation_of(pairs_), 0.95) << "the area grows with the square of the extension";
}

TEST(Variation, IsToldInTheMethods) {
  const auto methods = [](const std::string& text) {
    const auto study = read(text);
    EXPECT_TRUE(study.ok()) << (study.ok() ? "" : study.error().text());
    return study.ok() ? methods_text("a study", used_laws(*study), study->resolved_text) : std::string();
  };
  const std::string alike = methods(free_cells("0 %")), tensions = methods(free_cells("12.5 %"));
  EXPECT_THAT(alike, testing::Not(HasSubstr("tension of cell")));
  EXPECT_THAT(tensions, HasSubstr("tension of cell"));
  EXPECT_THAT(tensions, HasSubstr("0.125"));
  EXPECT_THAT(methods(dividing("{mean: 30 min, spread: 15 %, correlation: 25 %}", "10 %", "1 h")), HasSubstr("cycle of cell"));
}

TEST(Variation, TellsWhatHasNoEffect) {
  const auto told = [](const std::string& text) {
    const auto study = read(text);
    return study.ok() ? std::string() : study.error().text();
  };
  EXPECT_EQ(told(free_cells("10 %")), "");
  EXPECT_THAT(told(free_cells("{spread: 30 %}")), HasSubstr("[E302]"));
  EXPECT_THAT(told(free_cells("{spread: 10 %, correlation: 110 %}")), HasSubstr("[E302]"));
  EXPECT_THAT(told(free_cells("{correlation: 50 %}")), HasSubstr("'correlation' has no effect here"));
  EXPECT_THAT(told(changed("body: shell", "body: sphere", free_cells("10 %"))), HasSubstr("are always spheres"));
  EXPECT_THAT(told(changed("elastic: none, tension: 0.5 mN/m", "elastic: springs, tension: 0 mN/m", free_cells("10 %"))),
              HasSubstr("[E515]"));
  EXPECT_THAT(told(free_cells("10 %, adhesion: {correlation: 50 %}")), HasSubstr("'correlation' has no effect here"));
  EXPECT_THAT(
      told(changed("    dcm: {nodes", "    cbm: {law: linear, stiffness: 1 nN/um}\n    dcm: {nodes", free_cells("10 %, stiffness: 10 %"))),
      HasSubstr("does not ask for their modulus"));
  EXPECT_THAT(told(dividing("{mean: 30 min, correlation: 20 %}", "10 %", "1 h")), HasSubstr("'correlation' has no effect here"));
  // Tension 0.5 mN/m, adhesion 0.8 mJ/m²: below twice the tension of most cells, but not of all.
  const std::string sticky = changed("radius: 5 um", "radius: 5 um\n    adhesion: {cell: 8e-4 J/m^2}", free_cells("10 %"));
  EXPECT_THAT(told(sticky), HasSubstr("as cells vary by three spreads"));
  EXPECT_EQ(told(changed("8e-4", "6e-4", sticky)), "");
}

}  // namespace
}  // namespace morula::scenarios::test
