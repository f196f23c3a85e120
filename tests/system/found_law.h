#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/system/morula_command.h"
#include "tests/system/studies.h"

namespace morula::test {

/// The last value of a column of series.csv.
inline double last_of_series(const std::filesystem::path& path, const std::string& column) {
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

/// What `morula calibrate` found for the type `small` of a study and wrote to `found`: all but what pressed clusters tell.
inline void expect_law_and_report(const TestFolder& folder, const std::string& study, const Outcome& told) {
  using testing::HasSubstr;
  EXPECT_THAT(told.out, HasSubstr("kPa"));
  const std::string report = read_text(folder.path() / "found" / "report.html"),
                    file = read_text(folder.path() / "found" / "small.jkr.yaml");
  EXPECT_THAT(report, testing::AllOf(HasSubstr("force over overlap"), HasSubstr("Held out"), HasSubstr("Profile of E"),
                                     HasSubstr("Two cells that come together by themselves"),
                                     HasSubstr("Contact area of a cell among many"), HasSubstr("A sphere and a shell")));
  EXPECT_THAT(file, testing::AllOf(HasSubstr("approach: {factor: "), HasSubstr("friction_of_shells: {medium: "), HasSubstr("with_shells:"),
                                   HasSubstr("held_out: "), HasSubstr("contact_area: {knots: [")));
  // A run with the law tells areas of cells among many: in a ball of spheres they are not those of pairs, which the file says without its curve.
  folder.write("many.jkr.yaml", file);
  folder.write("pairs.jkr.yaml", std::regex_replace(file, std::regex("\n  contact_area: [^\n]*"), ""));
  std::vector<double> area;
  for (const std::string name : {"many", "pairs"}) {
    folder.write(name + ".yaml",
                 "output: {report: false}\n" +
                     changed(changed(study, "dcm: {nodes: 42", "cbm: {law: fitted, file: " + name + ".jkr.yaml}, dcm: {nodes: 42"),
                             "at: [[0 um, 0 um, 0 um]]", "count: 40, fill: sphere, radius: 20 um, as: sphere"));
    const Outcome run = run_morula({"run", name + ".yaml", "--out", name}, folder.path());
    ASSERT_EQ(run.exit_code, 0) << run.all();
    area.push_back(last_of_series(folder.path() / name / "series.csv", "mean_contact_area [um^2]"));
  }
  EXPECT_GT(area[1], 0.0);
  EXPECT_GT(std::abs(area[0] / area[1] - 1.0), 0.01);
}

}  // namespace morula::test
