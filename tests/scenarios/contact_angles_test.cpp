// Contact angles of fluid cells on 162 nodes: the ways to them, and the length of the steps (physics/dcm.md §8, T8.1; physics/scenarios.md S4, S6).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "core/ball.h"
#include "scenarios/criteria/judge.h"
#include "scenarios/library/library.h"
#include "scenarios/measures/shape_measures.h"
#include "scenarios/run/driver.h"
#include "tests/scenarios/simulation_of.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
  return text;
}

/// A limit of the study on fine meshes, and that of physics/scenarios.md (S4, S6: quick) in its place.
struct CoarseLimit {
  const char *fine, *coarse;
};
constexpr CoarseLimit kDoublet[] = {{"[wide_010, wide_050, wide_090], against: youngs_law, within: 0.015",
                                     "[wide_010, wide_050, wide_090], against: youngs_law, within: 0.06"},
                                    {"youngs_law, within: 0.015", "youngs_law, within: 0.03"},  // above: with a range of R0/6 twice that
                                    {"youngs_law, within: 2 deg", "youngs_law, within: 8 deg"},
                                    {"youngs_law, within: 3 deg", "youngs_law, within: 8 deg"},
                                    {"youngs_law, within: 3 %", "youngs_law, within: 6 %"},
                                    {"youngs_law, within: 5 %", "youngs_law, within: 10 %"},
                                    {"youngs_law, within: 0.5 %", "youngs_law, within: 6 %"},
                                    {"youngs_law, within: 1.5 %", "youngs_law, within: 6 %"},
                                    {"}, within: 2 deg", "}, within: 4 deg"},
                                    {"}, within: 1 deg", "}, within: 2 deg"},
                                    {"contact_radius(half_010, glass)\"}, within: 2 %", "contact_radius(half_010, glass)\"}, within: 4 %"},
                                    {"contact_radius(half_050, glass)\"}, within: 2 %", "contact_radius(half_050, glass)\"}, within: 4 %"},
                                    {"contact_radius(half_090, glass)\"}, within: 2 %", "contact_radius(half_090, glass)\"}, within: 4 %"},
                                    {"below: 0.05", "below: 0.06"}};
constexpr CoarseLimit kSpreading[] = {
    {"youngs_law, within: 2 deg", "youngs_law, within: 10 deg"}, {"youngs_law, within: 5 deg", "youngs_law, within: 10 deg"},
    {"youngs_law, within: 0.5 %", "youngs_law, within: 10 %"},   {"youngs_law, within: 5 %", "youngs_law, within: 10 %"},
    {"youngs_law, within: 6 %", "youngs_law, within: 10 %"},     {"}, within: 1 deg", "}, within: 2 deg"}};

/// A study of the library with 162 instead of 642 nodes a cell, all ranges of contact twice as long, and the limits of such cells.
std::string on_coarse_meshes(const std::string& scenario, const char* file) {
  std::string text;
  for (const TemplateFile& one : find_template(scenario)->files)
    if (one.path == file) text = std::string(one.content);
  text = replaced(replaced(replaced(text, "nodes: 642", "nodes: 162"), "range: 0.5 um", "range: 1 um"), "range: 0.25 um", "range: 0.5 um");
  for (const CoarseLimit& limit :
       scenario == "doublet" ? std::span<const CoarseLimit>(kDoublet) : std::span<const CoarseLimit>(kSpreading)) {
    EXPECT_NE(text.find(limit.fine), std::string::npos) << "the study does not hold: " << limit.fine;
    text = replaced(text, limit.fine, limit.coarse);
  }
  return text;
}

class ContactAngles : public testing::TestWithParam<const char*> {};

TEST_P(ContactAngles, AreThoseOfYoungFromSmallAndFromLargeContacts) {
  const test::Folder folder;
  ReadOptions options;
  options.overrides = {"output.report=false"};
  const auto study = test::read(on_coarse_meshes(GetParam(), "angles.yaml"), options);
  ASSERT_TRUE(study.ok()) << study.error().text();
  RunRequest request;
  request.runs = folder.path() / "runs";
  const auto run = scenarios::run(*study, request, Comm());
  ASSERT_TRUE(run.ok()) << run.error().message;
  int angles = 0, ways = 0;
  for (const Verdict& v : run->verdicts) {
    EXPECT_TRUE(v.passed) << v.id << ": " << v.quantity << " is " << v.value << ", wanted " << v.limit;
    angles += v.quantity.starts_with("contact angle");
    ways += v.id == "T8.1";
  }
  EXPECT_GE(angles, 10);  // five strengths, two ways
  EXPECT_EQ(ways, 5);
  const auto plots = declared_plots(*study, run->path);
  ASSERT_TRUE(plots.ok()) << plots.error().message;
  for (const NamedPlot& plot : *plots)
    for (const Curve& curve : plot.plot.curves) EXPECT_FALSE(curve.x.empty()) << plot.name << ": " << curve.name;
}

INSTANTIATE_TEST_SUITE_P(Library, ContactAngles, testing::Values("doublet", "spreading"),
                         [](const auto& instance) { return std::string(instance.param); });

/// Angle of one cell with a fluid cortex and the radius of its contact over R0.
struct Shape {
  double angle = 0.0;  ///< [deg]
  double contact_radius = 0.0;
};

/// A doublet (W/T = 1) or a cell on glass (W/T = 0.5): both have an angle of 60 degrees.
std::string one_contact(bool doublet) {
  const std::string cell = R"(
cell_types:
  cell:
    radius: 6 um
    friction: {medium: 1e8 N s/m^3, cell_cell: 1e8 N s/m^3, obstacle: 1e8 N s/m^3}
    adhesion: {cell: 0.1 mJ/m^2)";
  const std::string shell = R"(}
    dcm:
      nodes: 162
      cortex: {young: 1 Pa, thickness: 200 nm, poisson: 0.5, tension: 0.1 mN/m}
      bulk_modulus: 2.5 kPa
      shape_stiffness: 0.02 mN/m
      fold_barrier: {stiffness: 0.2 fJ, angle: 1.6 rad}
contact: {range: 0.5 um, repulsion: 20 kPa/um, points: 3}
)";
  return std::string(
             "schema: 1\nstudy: drift\nseed: 1\ntime: {end: 2 h, step: 20 s}\ndomain: {size: [60 um, 60 um, 60 um], boundary: open}") +
         cell + (doublet ? "" : ", glass: 0.05 mJ/m^2") + shell +
         (doublet ? "initial:\n  - {type: cell, at: [[0 um, 0 um, -6 um], [0 um, 0 um, 6 um]], as: shell}\n"
                  : "geometry:\n  glass: {plane: {center: [0 um, 0 um, -6 um], normal: [0, 0, 1], size: 60 um}}\n"
                    "initial:\n  - {type: cell, at: [[0 um, 0 um, 0.1 um]], as: shell}\n");
}

Shape shape_of(Simulation& simulation, bool doublet) {
  const Tissue& tissue = simulation.tissue();
  const BodyValues& values = simulation.values();
  std::vector<Vec3d> center;
  for (std::size_t s = 0; s < tissue.shells.size(); ++s)
    center.push_back(volume_centroid(tissue.shells.topology(s).faces(), tissue.shells.nodes(s)));
  const Vec3d point = doublet ? (center[0] + center[1]) * 0.5 : Vec3d{0, 0, -6};
  const Vec3d axis = doublet ? normalized(center[1] - center[0]) : Vec3d{0, 0, 1};
  Shape out;
  for (std::size_t s = 0; s < center.size(); ++s) {
    const Snapshot::Cell cell{};
    const auto cap =
        fit_cap({tissue.shells.nodes(s), tissue.shells.topology(s).faces(), &cell}, point, axis * (s == 0 && doublet ? -1.0 : 1.0));
    if (!cap) return {};
    out.angle += cap->angle * 180.0 / std::numbers::pi / static_cast<double>(center.size());
    out.contact_radius += cap->contact_radius / ball_radius(values.volume[s]) / static_cast<double>(center.size());
  }
  return out;
}

/// Runs on for a time with the allowed displacement and the longest step divided by a number. Returns the steps taken.
std::uint64_t go_on(std::unique_ptr<Simulation>& simulation, const Study& study, int divided, double duration) {
  Model model = study.model;
  model.step.max_displacement /= divided;
  model.step.max_step /= divided;
  Tissue tissue = simulation->tissue();
  auto made = Simulation::create(model, std::move(tissue), Comm(), 1);
  EXPECT_TRUE(made.ok());
  if (!made.ok()) return 0;
  simulation = std::move(*made);
  const std::uint64_t before = simulation->tissue().clock.steps;
  const double end = simulation->tissue().clock.time + duration;
  while (simulation->tissue().clock.time < end) {
    const auto done = simulation->step(end);
    EXPECT_TRUE(done.ok()) << done.error().message;
    if (!done.ok()) return 0;
  }
  return simulation->tissue().clock.steps - before;
}

class StepLength : public testing::TestWithParam<bool> {};

/// Twice halved, the steps lead from the same ball to the same angle: within a fifth of a degree, a tenth of what is asked of the angle itself, and 0.3 %
/// of the contact radius. The relaxed cells go on for as long with steps halved once and twice, and keep their angle within a tenth of a degree.
TEST_P(StepLength, ChangesNeitherTheAngleThatIsReachedNorThatWhichIsKept) {
  const bool doublet = GetParam();
  constexpr double kTime = 1800.0;
  const auto study = test::read(one_contact(doublet));
  ASSERT_TRUE(study.ok()) << study.error().text();
  std::array<Shape, 3> reached;
  std::array<std::uint64_t, 3> steps{};
  for (int k = 2; k >= 0; --k) {
    const auto at = static_cast<std::size_t>(k);
    auto made = test::simulation_of(*study);
    ASSERT_TRUE(made.ok());
    steps[at] = go_on(*made, *study, 1 << k, kTime);
    reached[at] = shape_of(**made, doublet);
    EXPECT_NEAR(reached[at].angle, 60.0, 2.0);
    EXPECT_NEAR(reached[at].angle, reached[2].angle, 0.2) << k;
    EXPECT_NEAR(reached[at].contact_radius / reached[2].contact_radius, 1.0, 0.003) << k;
    for (int divided = 2; k == 0 && divided <= 4; divided *= 2) {
      go_on(*made, *study, divided, kTime);
      const Shape kept = shape_of(**made, doublet);
      EXPECT_NEAR(kept.angle, reached[0].angle, 0.1) << divided;
      EXPECT_NEAR(kept.contact_radius / reached[0].contact_radius, 1.0, 0.003) << divided;
    }
  }
  EXPECT_GT(steps[1], steps[0]);
  EXPECT_GT(steps[2], steps[1]);
}

INSTANTIATE_TEST_SUITE_P(DoubletAndCellOnGlass, StepLength, testing::Bool(),
                         [](const auto& instance) { return instance.param ? "doublet" : "on_glass"; });

}  // namespace
}  // namespace morula::scenarios
