// Two cells that touch come together as fast in either body, where the law of the spheres was found from the shells.
#include <gtest/gtest.h>

#include "results/snapshot_file.h"
#include "scenarios/library/library.h"
#include "tests/scenarios/run_into.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

/// When two cells of the library's calibrated type have come half of their way [s], in a body and with overrides.
double half_time(const std::string& body, std::vector<std::string> overrides, const char* end, const char* output) {
  const test::Folder folder;
  for (const TemplateFile& file : find_template("calibrate_hepatocyte")->files)
    folder.write(std::string(file.path), std::string(file.content));
  for (const std::string& one :
       {std::string("initial=[{type: hepatocyte, at: [[0 um, 0 um, -6 um], [0 um, 0 um, 6 um]], as: ") + body + "}]",
        std::string("time.end=") + end, std::string("time.checkpoint=") + end, std::string("time.output=") + output,
        std::string("output.report=false")})
    overrides.push_back(one);
  ReadOptions options;
  options.overrides = overrides;
  options.scenario_names = template_names();
  const auto study = read_study(folder.path() / "study.yaml", options);
  if (!study.ok()) return ADD_FAILURE() << study.error().text(), -1.0;
  if (!test::run_into(folder.path() / "run", *study)) return -1.0;
  const auto path = folder.path() / "run" / "results.h5";
  const auto entries = list_snapshots(path);
  if (!entries.ok()) return ADD_FAILURE() << entries.error().message, -1.0;
  std::vector<double> overlap;
  for (const auto& entry : *entries) {
    const auto snapshot = read_snapshot(path, entry.index);
    overlap.push_back(12.0 - norm(snapshot->cells[1].centroid - snapshot->cells[0].centroid));
  }
  EXPECT_GT(overlap.back(), 1.0);
  for (std::size_t i = 0; i < overlap.size(); ++i)
    if (overlap[i] > 0.5 * overlap.back()) return (*entries)[i].time;
  return -1.0;
}

TEST(Approach, OfFittedSpheresIsAsFastAsThatOfShells) {
  const double shells = half_time("shell", {}, "40 min", "10 s"), spheres = half_time("sphere", {}, "40 min", "10 s");
  EXPECT_NEAR(spheres / shells, 1.0, 0.35) << spheres << " s against " << shells;
  const double plain = half_time("sphere", {"cell_types.hepatocyte.cbm={law: jkr, young: 0.094 kPa}"}, "40 h", "10 min");
  EXPECT_GT(plain, 5.0 * shells) << "or there is nothing to fit";
}

}  // namespace
}  // namespace morula::scenarios
