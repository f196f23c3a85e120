#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/system/morula_command.h"
#include "tests/system/studies.h"

namespace morula::test {
namespace {

using testing::HasSubstr;

constexpr std::chrono::seconds kLong(800);

/// The last value of a column of series.csv.
double last_of_series(const std::filesystem::path& path, const std::string& column) {
  std::istringstream lines(read_text(path));
  std::string header, line, last;
  std::getline(lines, header);
  while (std::getline(lines, line)) last = line;
  std::istringstream names(header), values(last);
  for (std::string name, value; std::getline(names, name, ',') && std::getline(values, value, ',');)
    if (name == column) return std::stod(value);
  ADD_FAILURE() << "no column '" << column << "' in " << header;
  return 0.0;
}

/// One command from a study to numbers and a report, for shells with default parameters.
TEST(Calibrate, FindsALawOfShellsAndWritesAReport) {
  const TestFolder folder;
  folder.write("study.yaml", calibrated_study());
  const Outcome first = run_morula({"calibrate", "jkr", "small", "study.yaml", "--out", "found"}, folder.path(), {.timeout = kLong});
  ASSERT_EQ(first.exit_code, 0) << first.all();
  EXPECT_THAT(first.out, HasSubstr("kPa"));
  const std::string report = read_text(folder.path() / "found" / "report.html");
  EXPECT_THAT(report, testing::AllOf(HasSubstr("force over overlap"), HasSubstr("Held out"), HasSubstr("Profile of E"),
                                     HasSubstr("Two cells that come together by themselves"), HasSubstr("that two plates press flat"),
                                     HasSubstr("Contact area of a cell among many"), HasSubstr("A sphere and a shell")));
  EXPECT_THAT(read_text(folder.path() / "found" / "small.jkr.yaml"),
              testing::AllOf(HasSubstr("approach: {factor: "), HasSubstr("along the contact"), HasSubstr("friction_of_shells: {medium: "),
                             HasSubstr("with_shells:"), HasSubstr("held_out: "), HasSubstr("contact_area: {knots: [")));
  // A run with the law tells areas of cells among many: in a ball of spheres they are not those of pairs, which the file says without its curve.
  const std::string file = read_text(folder.path() / "found" / "small.jkr.yaml");
  folder.write("many.jkr.yaml", file);
  folder.write("pairs.jkr.yaml", std::regex_replace(file, std::regex("\n  contact_area: [^\n]*"), ""));
  std::vector<double> area;
  for (const std::string name : {"many", "pairs"}) {
    folder.write(name + ".yaml", changed(changed(calibrated_study(), "dcm: {nodes: 42}",
                                                 "cbm: {law: fitted, file: " + name + ".jkr.yaml}, dcm: {nodes: 42}"),
                                         "at: [[0 um, 0 um, 0 um]]", "count: 40, fill: sphere, radius: 20 um, as: sphere"));
    const Outcome run = run_morula({"run", name + ".yaml", "--out", name}, folder.path());
    ASSERT_EQ(run.exit_code, 0) << run.all();
    area.push_back(last_of_series(folder.path() / name / "series.csv", "mean_contact_area [um^2]"));
  }
  EXPECT_GT(area[1], 0.0);
  EXPECT_GT(std::abs(area[0] / area[1] - 1.0), 0.01);
}

TEST(Calibrate, LeavesOutWhatItsBudgetHasNoTimeFor) {
  const TestFolder folder;
  folder.write("study.yaml", calibrated_study());
  const auto within = [&](const char* budget) {
    return run_morula({"calibrate", "jkr", "small", "study.yaml", "--budget", budget, "--out", "short"}, folder.path(), {.timeout = kLong});
  };
  const Outcome too_small = within("1 ms");
  EXPECT_EQ(too_small.exit_code, 2) << too_small.all();
  EXPECT_THAT(too_small.err, HasSubstr("is too small for any fit: two cells at two rates alone take about 2 s of one core"));
  const Outcome done = within("1.5 s");
  ASSERT_EQ(done.exit_code, 0) << done.all();
  const Outcome again = within("1.5 s");
  EXPECT_EQ(again.exit_code, 0) << again.all();
  EXPECT_EQ(again.out, done.out);
  EXPECT_THAT(done.err, HasSubstr("equal_pair_1: Two cells"));
  EXPECT_THAT(again.err, testing::Not(HasSubstr("equal_pair_1: Two cells"))) << "nothing is run again";
  EXPECT_TRUE(std::filesystem::exists(folder / "short/equal_pair_2"));
  EXPECT_FALSE(std::filesystem::exists(folder / "short/equal_pair_3"));
  EXPECT_FALSE(std::filesystem::exists(folder / "short/packing_random_1"));
  EXPECT_THAT(read_text(folder / "short/small.jkr.yaml"),
              testing::AllOf(HasSubstr("young:"), HasSubstr("no time for packing_fcc, packing_bcc")));
}

/// The study may name the file before there is one, and after its cells have become others; then the study runs with it.
TEST(Calibrate, MakesTheFileThatTheStudyNames) {
  const TestFolder folder;
  const auto study = [&](const char* tension) {
    std::ofstream(folder / "study.yaml")
        << "schema: 1\nstudy: small\ntime: {end: 1 min}\ndomain: {size: [80 um, 80 um, 80 um], boundary: open}\n"
           "cell_types: {small: {radius: 5 um, cbm: {law: fitted, file: calibrations/small/small.jkr.yaml}, dcm: {nodes: 42, cortex: "
           "{tension: "
        << tension << "}}}}\ninitial: [{type: small, at: [[0 um, 0 um, 0 um]]}]\n";
  };
  const auto calibrate = [&] {
    return run_morula({"calibrate", "jkr", "small", "study.yaml", "--budget", "2 s"}, folder.path(), {.timeout = kLong});
  };
  study("0.2 mN/m");
  EXPECT_EQ(run_morula({"check", "study.yaml"}, folder.path()).exit_code, 3);
  const Outcome first = calibrate();
  ASSERT_EQ(first.exit_code, 0) << first.all();
  EXPECT_EQ(run_morula({"check", "study.yaml"}, folder.path()).exit_code, 0);
  study("0.3 mN/m");
  EXPECT_THAT(run_morula({"check", "study.yaml"}, folder.path()).err, HasSubstr("E532"));
  const Outcome second = calibrate();
  ASSERT_EQ(second.exit_code, 0) << second.all();
  EXPECT_NE(second.out, first.out);
  EXPECT_EQ(run_morula({"run", "study.yaml"}, folder.path()).exit_code, 0);
}

TEST(Calibrate, RefusesATypeThatTheStudyHasNot) {
  const TestFolder folder;
  folder.write("study.yaml", calibrated_study());
  const Outcome outcome = run_morula({"calibrate", "jkr", "smal", "study.yaml"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 2) << outcome.all();
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("no cell type 'smal'"), HasSubstr("`small`")));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "calibrations"));
  EXPECT_EQ(run_morula({"calibrate", "hertz", "small", "study.yaml"}, folder.path()).exit_code, 2);
}

}  // namespace
}  // namespace morula::test
