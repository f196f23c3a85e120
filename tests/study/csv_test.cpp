#include <gmock/gmock.h>

#include "study/csv.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Reading {
  std::optional<CsvCells> cells;
  std::string messages;
};

Reading read_csv(const std::string& bytes) {
  const Folder folder;
  Diagnostics diagnostics;
  const UnitSystem units;
  Reading reading;
  reading.cells = read_cells_csv(folder.write("cells.csv", bytes), "cells.csv", {"TE", "EPI"}, {}, units, diagnostics);
  reading.messages = diagnostics.text();
  EXPECT_EQ(reading.cells.has_value(), !diagnostics.has_errors()) << reading.messages;
  return reading;
}

TEST(StudyCsv, ReadsUnitsAndOptionalColumnsInAnyOrder) {
  const Reading r = read_csv(
      "type, z [nm],x [um] , y [um],radius [um],phase [%],model,source_cell\n# "
      "comment\nTE,1500,2.5,-3e0,6.5,25,dcm,1\n\nEPI,0,0,0,5,0,,26.45\r\n");
  ASSERT_TRUE(r.cells) << r.messages;
  ASSERT_EQ(r.cells->cells.size(), 2u);
  const CsvCell& a = r.cells->cells[0];
  EXPECT_DOUBLE_EQ(a.position.x, 2.5);
  EXPECT_DOUBLE_EQ(a.position.y, -3.0);
  EXPECT_DOUBLE_EQ(a.position.z, 1.5);
  EXPECT_DOUBLE_EQ(a.radius, 6.5);
  EXPECT_DOUBLE_EQ(a.phase, 0.25);
  EXPECT_EQ(a.body, BodyKind::kShell);
  EXPECT_EQ(r.cells->cells[1].type, 1);
  EXPECT_EQ(r.cells->cells[1].line, 5);
  EXPECT_FALSE(r.cells->cells[1].body);
  EXPECT_THAT(r.cells->ignored_columns, ElementsAre("source_cell"));
}

TEST(StudyCsv, NamesEveryBadValueWithItsPlace) {
  const Reading r = read_csv(
      "x [um],y [um],z [um],type\n1,2,TE\n1,NA,3,TE\n1,2,inf,TE\nnan,2,3,TE\n1,2,3,TX\n1,2,3 um,TE\n1,,3,TE\n1,2,3,TE,5\n1,2,1e999,EPI\n");
  EXPECT_THAT(r.messages, HasSubstr("cells.csv:2:1: error: row has 3 values, but the header names 4 [E611]"));
  EXPECT_THAT(r.messages, HasSubstr("cells.csv:3:3: error: 'y' is not a number: 'NA' [E612]"));
  EXPECT_THAT(r.messages, HasSubstr("cells.csv:4:5: error: 'z' is not a finite number: 'inf' [E612]"));
  EXPECT_THAT(r.messages, HasSubstr("cells.csv:5:1: error: 'x' is not a finite number: 'nan' [E612]"));
  EXPECT_THAT(r.messages, HasSubstr("cells.csv:6:7: error: there is no cell type 'TX' [E401]"));
  EXPECT_THAT(r.messages, HasSubstr("cells.csv:7:5: error: 'z' is not a number: '3 um' [E612]"));
  EXPECT_THAT(r.messages, HasSubstr("cells.csv:8:3: error: 'y' is empty [E612]"));
  EXPECT_THAT(r.messages, HasSubstr("cells.csv:9:1: error: row has 5 values"));
  EXPECT_THAT(r.messages, HasSubstr("cells.csv:10:5: error: 'z' is too large for a number: '1e999' [E612]"));
}

TEST(StudyCsv, HeaderMustNameTheColumns) {
  EXPECT_THAT(read_csv("1,2,3,TE\n").messages, HasSubstr("cells.csv:1:1: error: the header lacks the columns x, y, z, type [E610]"));
  EXPECT_THAT(read_csv("x [um],y [um],z [um],type,x\n1,2,3,TE,1\n").messages, HasSubstr("column 'x' stands twice"));
  EXPECT_THAT(read_csv("x [kPa],y,z,type\n1,2,3,TE\n").messages, HasSubstr("[E203]"));
  EXPECT_THAT(read_csv("x [um,y,z,type\n1,2,3,TE\n").messages, HasSubstr("[E610]"));
  EXPECT_THAT(read_csv("").messages, HasSubstr("[E613]"));
  EXPECT_THAT(read_csv("x [um],y [um],z [um],type\n").messages, HasSubstr("the file has a header but no cells [E613]"));
}

TEST(StudyCsv, ALengthWithoutAUnitIsRefused) {
  const std::string messages = read_csv("x [um],y,z [mm],type,radius,phase\n1,2,3,TE,6,0.5\n").messages;
  EXPECT_THAT(messages, HasSubstr("cells.csv:1:8: error: column 'y' has no unit [E655]"));
  EXPECT_THAT(messages, HasSubstr("column 'radius' has no unit [E655]"));
  EXPECT_THAT(messages, testing::Not(HasSubstr("'phase'")));
}

TEST(StudyCsv, UnitsOfTheEntryHoldForColumnsWithoutOne) {
  const Folder folder;
  folder.write("cells.csv", "x,y,z [um],type\n0.01,0.02,30,hepatocyte\n");
  const std::string entry = "{type: hepatocyte, count: 60, fill: sphere, radius: 40 um, as: cbm}";
  const auto read_with = [&](const std::string& with) { return read(changed(entry, with), {}, folder.path()); };
  EXPECT_TRUE(read_with("{csv: cells.csv, units: mm}").ok());
  const auto wrong = read_with("{csv: cells.csv, units: kPa}"), none = read_with("{csv: cells.csv}");
  ASSERT_FALSE(wrong.ok() || none.ok());
  EXPECT_THAT(wrong.error().text(), HasSubstr("[E203]"));
  EXPECT_THAT(none.error().text(), HasSubstr("column 'x' has no unit [E655]"));
  EXPECT_THAT(none.error().text(), HasSubstr("`units: um` beside `csv` in the study"));
  ASSERT_FALSE(read(changed("count: 60", "units: um, count: 60")).ok()) << "a key of another source of cells";
  folder.write("cells.csv", "x [mm],y [mm],z [um],type\n0.01,0.02,30,hepatocyte\n");
  EXPECT_TRUE(read_with("{csv: cells.csv}").ok());
  const auto idle = read_with("{csv: cells.csv, units: um}");
  ASSERT_FALSE(idle.ok());
  EXPECT_THAT(idle.error().text(), HasSubstr("'units' has no effect here: all columns of 'cells.csv' have a unit of their own [E515]"));
}

TEST(StudyCsv, AMillionEqualErrorsAreCutShort) {
  std::string bytes = "x [um],y [um],z [um],type\n";
  for (int i = 0; i < 1000; ++i) bytes += "NA,NA,NA,TE\n";
  EXPECT_THAT(read_csv(bytes).messages, HasSubstr("too many errors in this file"));
}

TEST(Coincident, GroupsAreTransitiveAndInOrder) {
  const std::vector<Vec3d> p{{0, 0, 0}, {9, 9, 9}, {0.0009, 0, 0}, {5, 5, 5}, {0.0018, 0, 0}, {5, 5, 5}, {0.003, 0, 0}};
  EXPECT_THAT(coincident_groups(p, 1e-3), ElementsAre(ElementsAre(0u, 2u, 4u), ElementsAre(3u, 5u)));
  EXPECT_THAT(coincident_groups(p, 0.0), ElementsAre(ElementsAre(3u, 5u)));
}

TEST(Coincident, AHundredThousandCellsAtOnePlaceAreFoundAtOnce) {
  const std::vector<Vec3d> p(100000, Vec3d{1, 2, 3});
  EXPECT_EQ(coincident_groups(p, 1e-3).size(), 1u);
}

TEST(Coincident, AreMovedByTheDistanceInADirectionOfTheirOwnNumber) {
  std::vector<Vec3d> p{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, later = p;
  const auto groups = coincident_groups(p, 1e-3);
  move_apart(p, groups, 6.0, 1, 42);
  EXPECT_EQ(p[0], (Vec3d{1, 1, 1}));
  EXPECT_NEAR(norm(p[1] - p[0]), 6.0, 1e-12);
  EXPECT_NEAR(norm(p[2] - p[0]), 6.0, 1e-12);
  EXPECT_GT(norm(p[2] - p[1]), 1e-3);
  move_apart(later, groups, 6.0, 2, 42);  // the same cells with numbers one higher
  EXPECT_EQ(later[1], p[2]);
}

std::string csv_study(const std::string& entry) {
  return changed("{type: hepatocyte, count: 60, fill: sphere, radius: 40 um, as: cbm}", entry);
}

TEST(StudyCsv, StudyChecksItsCellsAndNamesCoincidentOnes) {
  const Folder folder;
  folder.write("a.csv", "x [um],y [um],z [um],type,id\n1,2,3,hepatocyte,7\n4,5,6,hepatocyte,8\n1,2,3,hepatocyte,9\n");
  const auto study = read(csv_study("{csv: a.csv, start_volume: 50 %, inflate: 30 min}"), {}, folder.path());
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_EQ(study->initial[0].count, 3u);
  EXPECT_THAT(study->notes,
              ElementsAre("a.csv: columns left aside: `id`", "a.csv: cells 1 (line 2), 3 (line 4) lie at the same place; moved by 6 um: 3",
                          HasSubstr("3 cells become shells before the first step")));  // of the study's region
  EXPECT_EQ(study->input_files.size(), 1u);
  EXPECT_EQ(study->initial[0].csv_path, (folder.path() / "a.csv").string());
  folder.write("b.csv", "x [um],y [um],z [um],type\n1,2,300,hepatocyte\n");
  EXPECT_THAT(errors_of(csv_study("{csv: b.csv}"), {}, folder.path()),
              HasSubstr("b.csv:2:1: error: a cell at [1 um, 2 um, 300 um] is outside the domain [E505]"));
}

// The five measured embryos: cell counts and the two files without coincident rows are those of the data's README.
TEST(StudyCsv, MeasuredEmbryosAreRead) {
  const char* data = std::getenv("MORULA_SHARED_DATA");
  const std::filesystem::path folder =
      (data ? std::filesystem::path(data) : std::filesystem::path(__FILE__).parent_path() / "../../../shared/data") / "mouse_blastocyst";
  if (!std::filesystem::exists(folder / "embryo_44.csv")) GTEST_SKIP() << "no measured embryos beside this checkout";
  const UnitSystem units;
  const std::pair<int, bool> embryos[] = {{44, false}, {64, true}, {114, true}, {178, true}, {216, true}};
  for (const auto& [count, coincident] : embryos) {
    Diagnostics diagnostics;
    const auto cells = read_cells_csv(folder / ("embryo_" + std::to_string(count) + ".csv"), "embryo", {"TE", "EPI", "PRE", "DP", "DN"}, {},
                                      units, diagnostics);
    ASSERT_TRUE(cells) << diagnostics.text();
    EXPECT_EQ(cells->cells.size(), static_cast<std::size_t>(count));
    std::vector<Vec3d> positions;
    for (const CsvCell& cell : cells->cells) positions.push_back(cell.position);
    EXPECT_EQ(!coincident_groups(positions, 1e-3).empty(), coincident) << count;
  }
}

}  // namespace
}  // namespace morula::scenarios::test
