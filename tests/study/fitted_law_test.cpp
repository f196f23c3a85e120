#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "coupling/mechanics/contact_setup.h"
#include "coupling/simulation.h"
#include "scenarios/run/used_laws.h"
#include "study/cell_material.h"
#include "study/fitted_law.h"
#include "study/initial/make_tissue.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kStudy = R"(schema: 1
study: fitted
time: {end: 1 h}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell:
    radius: 6 um
    adhesion: {cell: 0.1 mN/m}
    cbm: {law: fitted, file: cell.jkr.yaml}
initial:
  - {type: cell, at: [[0 um, 0 um, 0 um]]}
)";

constexpr const char* kTable = R"(table:
  touch: 0
  exponent: 1.2
  exponent_error: 0.1
  held_out: {pairs: 10, force_rms: 0.1, force_worst: 0.2, packings: 0, pressure_rms: 0, pressure_worst: 0}
  knots:
    - {overlap: -0.1, force: -0.2 nN/um, area: 0}
    - {overlap: 0.05, force: 0 nN/um, area: 0.4}
    - {overlap: 0.3, force: 1 nN/um, area: 1.5}
)";

/// A file of the material of the study above with other numbers than its defaults; `extra`: further sections.
std::string file_text(const std::string& better = "jkr", const std::string& packing = "", const std::string& extra = "") {
  const auto plain = test::read(test::changed("{law: fitted, file: cell.jkr.yaml}", "{law: jkr}", kStudy));
  EXPECT_TRUE(plain.ok());
  return "schema: 1\nversion: 0\ntype: cell\nmaterial: \"" + material_of(*plain, "cell")->text() +
         "\"\nhash: 0\nnodes: 162\nradius: 6 um\nadhesion_of_shells: 0.1 nN/um\nbetter: " + better +
         "\njkr:\n  young: 0.5 kPa\n  young_interval: [0.4 kPa, 0.6 kPa]\n  poisson: 0.4\n  adhesion: 0.08 nN/um\n"
         "  adhesion_interval: [0 nN/um, .inf nN/um]\n  correlation: .nan\n" +
         packing + extra +
         "ranges: {overlap_over_radius: {least: -0.1, most: 0.3}, radius: {least: 5.9 um, most: 7.8 um}, slowest_rate: 0.0025 um/s}\n"
         "remarks:\n  - \"a remark, with 'words': in it\"\n";
}

constexpr const char* kPacking =
    "  packing: [{packing: 8 %, pressure: 0 kPa}, {packing: 12 %, pressure: 0.09 kPa}, {packing: 30 %, pressure: 0.5 kPa}]\n";

struct Written {
  test::Folder folder;
  explicit Written(const std::string& text) { std::ofstream(folder.path() / "cell.jkr.yaml") << text; }
  [[nodiscard]] Result<Study, Diagnostics> read(const std::string& study = kStudy) const { return test::read(study, {}, folder.path()); }
  [[nodiscard]] std::string errors(const std::string& study = kStudy) const { return test::errors_of(study, {}, folder.path()); }
};

TEST(FittedLaw, TakesModulusAdhesionPackingAndRangeFromTheFile) {
  const Written file(file_text("jkr", kPacking));
  const auto study = file.read();
  ASSERT_TRUE(study.ok()) << study.error().text();
  const cbm::SphereParameters& sphere = study->model.types[0].sphere;
  EXPECT_EQ(sphere.law->word, "jkr");
  EXPECT_EQ(sphere.young, 0.5);
  EXPECT_DOUBLE_EQ(sphere.adhesion_factor, 0.8);
  EXPECT_EQ(sphere.fitted.most, 0.3);
  EXPECT_EQ(sphere.packing.onset(), 0.08);
  EXPECT_EQ(study->model.pair(0, 0).adhesion, 0.1);  // shells keep theirs
  EXPECT_THAT(study->warnings.text(), Not(HasSubstr("E647")));
}

/// The file's factors reach the contact layer, methods.md and the resolved study; another number in the study is an error, and without a file both may be chosen.
TEST(FittedLaw, SpheresMeetShellsWithTheFactorsThatWereFitted) {
  const std::string fitted =
      "with_shells:\n  stiffness: 0.46\n  stiffness_interval: [0.3, .inf]\n  adhesion: 0.75\n  adhesion_interval: [0.6, 0.9]\n  misfit: "
      "0.1\n"
      "  unfitted: 0.2\n  outside: 0.05\n  outside_worst: 0.2\n  held_out: 0.1\n";
  const Written file(file_text("jkr", "", fitted));
  const auto study = file.read();
  ASSERT_TRUE(study.ok()) << study.error().text();
  const ContactMaterial contact = contact_materials(study->model).front();
  EXPECT_EQ(contact.sphere_stiffness, 0.46);
  EXPECT_EQ(contact.sphere_adhesion, 0.75);
  EXPECT_EQ(contact.law.adhesion, 0.1) << "shells keep theirs";
  EXPECT_THAT(study->resolved_text, AllOf(HasSubstr("stiffness: 0.46"), HasSubstr("adhesion: 0.75")));
  const auto both = file.read(
      test::changed("[[0 um, 0 um, 0 um]]", "[[0 um, 0 um, 0 um]], as: shell}\n  - {type: cell, at: [[20 um, 0 um, 0 um]]", kStudy));
  ASSERT_TRUE(both.ok()) << both.error().text();
  bool told = false;
  for (const UsedLaw& law : used_laws(*both))
    for (const auto& [name, value] : law.values)
      if (law.law.name == "sphere_foundation" && name == "adhesion_factor") told = value == 0.75;
  EXPECT_TRUE(told) << "methods.md says it";
  const auto own = [](const std::string& keys) {
    return test::changed("file: cell.jkr.yaml", "file: cell.jkr.yaml, with_shells: " + keys, kStudy);
  };
  EXPECT_THAT(file.errors(own("{stiffness: 0.5}")), AllOf(HasSubstr("E510"), HasSubstr("with_shells.stiffness")));
  EXPECT_THAT(file.errors(own("{adhesion: 0.5}")), AllOf(HasSubstr("E510"), HasSubstr("with_shells.adhesion")));
  const auto chosen = Written(file_text()).read(own("{stiffness: 2, adhesion: 0}"));
  ASSERT_TRUE(chosen.ok()) << chosen.error().text();
  EXPECT_EQ(chosen->model.types[0].sphere.with_shells.stiffness, 2.0);
  EXPECT_EQ(chosen->model.types[0].sphere.with_shells.adhesion, 0.0);
  EXPECT_EQ(Written(file_text()).read()->model.types[0].sphere.with_shells.stiffness, 1.0);
  for (const char* wrong : {"{stiffness: 0}", "{stiffness: -1}", "{adhesion: -0.1}", "{adhesion: 11}"})
    EXPECT_THAT(Written(file_text()).errors(own(wrong)), HasSubstr("E302")) << wrong;
  EXPECT_THAT(Written(file_text("jkr", "", "with_shells: {stiffness: 0, adhesion: 1}\n")).errors(), HasSubstr("E302"));
}

/// A number that was changed by hand is told; a law of one's own says nothing about how it was made.
TEST(FittedLaw, SaysThatTheFileWasChanged) {
  const std::string text = file_text("jkr", kPacking), made = text + "checksum: " + checksum_of_law(text) + "\n";
  const auto warnings = [](const std::string& of_file) {
    const auto study = Written(of_file).read();
    return study.ok() ? study->warnings.text() : study.error().text();
  };
  EXPECT_THAT(warnings(made), Not(HasSubstr("E693")));
  EXPECT_THAT(warnings(text), Not(HasSubstr("E693")));
  EXPECT_THAT(warnings(test::changed("young: 0.5 kPa", "young: 0.6 kPa", made)), AllOf(HasSubstr("E693"), HasSubstr("not as it was made")));
}

/// Areas that are told are those of cells among many; forces know nothing of it.
TEST(FittedLaw, TellsTheContactAreaOfCellsAmongMany) {
  const std::string area =
      "  contact_area: {knots: [{pairs: 1 %, cells: 1 %}, {pairs: 50 %, cells: 99 %}], held_out: 0.02, pairs_alone: 0.15}\n";
  const std::string row =
      test::changed("[[0 um, 0 um, 0 um]]", "[[-11.5 um, 0 um, 0 um], [0 um, 0 um, 0 um], [11.5 um, 0 um, 0 um]]", kStudy);
  const auto values = [&](const Written& file) {
    const auto study = file.read(row);
    EXPECT_TRUE(study.ok()) << study.error().text();
    ShapeLibrary shapes;
    auto tissue = make_tissue(*study, shapes, Comm());
    EXPECT_TRUE(tissue.ok());
    auto simulation = Simulation::create(study->model, std::move(tissue->tissue), Comm(), 1);
    EXPECT_TRUE(simulation.ok());
    return (*simulation)->values();
  };
  const BodyValues pairs = values(Written(file_text())), many = values(Written(file_text("jkr", area)));
  const double surface = 4.0 * std::numbers::pi * 36.0;
  ASSERT_EQ(pairs.contact_area.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const double share = pairs.contact_area[i] / surface;
    ASSERT_GT(share, 0.01);
    EXPECT_NEAR(many.contact_area[i], surface * (0.01 + 2.0 * (share - 0.01)), 1e-9) << i;
    EXPECT_EQ(many.pressure[i], pairs.pressure[i]);
  }
  const auto study = Written(file_text("jkr", area)).read();
  bool told = false;
  for (const UsedLaw& law : used_laws(*study)) told = told || law.law.name == "crowded_area";
  EXPECT_TRUE(told) << "methods.md says it";
  const std::string same = test::changed("pairs: 50 %", "pairs: 1 %", area), none = test::changed("{pairs: 1 %", "{pairs: 0 %", area);
  for (const std::string& wrong : {same, none})
    EXPECT_THAT(Written(file_text("jkr", wrong)).errors(), AllOf(HasSubstr("E533"), HasSubstr("contact_area: "))) << wrong;
  EXPECT_THAT(Written(file_text("jkr", test::changed("99 %", "-1 %", area))).errors(), HasSubstr("E302"));
}

TEST(FittedLaw, SpheresComeTogetherWithTheFrictionThatWasFitted) {
  const std::string approach =
      "  approach: {factor: 0.05, friction: 2.5 nN s/um^3, interval: [2 nN s/um^3, .inf nN s/um^3], misfit: 0.2}\n";
  const std::string along = "  along: {factor: 0.02, friction: 1 nN s/um^3, interval: [0.7 nN s/um^3, 1.4 nN s/um^3], misfit: 0.1}\n";
  const std::string shells = "friction_of_shells: {medium: 0.1 nN s/um^3, cell_cell: 50 nN s/um^3, cell_cell_tangential: 50 nN s/um^3}\n";
  const auto of_pairs = Written(file_text("jkr", approach, shells)).read();
  ASSERT_TRUE(of_pairs.ok()) << of_pairs.error().text();
  EXPECT_DOUBLE_EQ(sphere_contact_table(of_pairs->model).entry(0, 0).tangential_friction, 2.5) << "that of approach stands for it";
  const Written file(file_text("jkr", approach + along, shells));
  const auto study = file.read();
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_EQ(study->model.types[0].sphere.approach_factor, 0.05);
  EXPECT_THAT(study->warnings.text(), Not(HasSubstr("E542")));
  const cbm::ContactTable::Entry spheres = sphere_contact_table(study->model).entry(0, 0);
  EXPECT_DOUBLE_EQ(spheres.normal_friction, 2.5);
  EXPECT_DOUBLE_EQ(spheres.tangential_friction, 1.0);
  const ContactMaterial with_cells = contact_materials(study->model).front();
  EXPECT_DOUBLE_EQ(with_cells.with_sphere.normal, 2.5) << "a sphere has its factors against shells, too";
  EXPECT_DOUBLE_EQ(with_cells.with_sphere.tangential, 1.0);
  EXPECT_DOUBLE_EQ(with_cells.friction.normal, 50.0) << "shells keep theirs";
  EXPECT_DOUBLE_EQ(with_cells.friction.tangential, 50.0);
  const auto other = file.read(test::changed("    radius: 6 um", "    radius: 6 um\n    friction: {cell_cell: 1e10 N s/m^3}", kStudy));
  ASSERT_TRUE(other.ok()) << other.error().text();
  EXPECT_THAT(other->warnings.text(), AllOf(HasSubstr("E542"), HasSubstr("`cell_cell`")));
  EXPECT_DOUBLE_EQ(sphere_contact_table(other->model).entry(0, 0).normal_friction, 0.5);
  bool told = false;
  for (const UsedLaw& law : used_laws(*study)) {
    if (law.purpose != "contact of spheres of cell with cells") continue;
    for (const auto& [name, value] : law.values) {
      if (name != "normal_friction" && name != "tangential_friction") continue;
      EXPECT_DOUBLE_EQ(value, name == "normal_friction" ? 2.5 : 1.0);
      told = true;
    }
  }
  EXPECT_TRUE(told) << "methods.md says it";
  const auto own = [](const std::string& keys) {
    return test::changed("file: cell.jkr.yaml", "file: cell.jkr.yaml, friction: " + keys, kStudy);
  };
  EXPECT_THAT(file.errors(own("{approach: 0.5}")), AllOf(HasSubstr("E510"), HasSubstr("friction.approach")));
  EXPECT_THAT(file.errors(own("{along: 0.5}")), AllOf(HasSubstr("E510"), HasSubstr("friction.along")));
  const auto unknown = Written(file_text()).read();
  ASSERT_TRUE(unknown.ok());
  EXPECT_EQ(unknown->model.types[0].sphere.approach_factor, 1.0);
  EXPECT_EQ(unknown->model.types[0].sphere.along_factor, 1.0);
  EXPECT_EQ(Written(file_text()).read(own("{approach: 0.5, along: 0.25}"))->model.types[0].sphere.along_factor, 0.25);
  EXPECT_THAT(Written(file_text("jkr", "  approach: {factor: -1, misfit: 0}\n")).errors(), HasSubstr("E302"));
  EXPECT_THAT(Written(file_text("jkr", "  along: {factor: -1, misfit: 0}\n")).errors(), HasSubstr("E302"));
}

TEST(FittedLaw, ResolvedStudyTellsTheNumbersAndReadsBackTheSame) {
  const Written file(file_text("jkr", kPacking));
  const auto study = file.read();
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_THAT(study->resolved_text, AllOf(HasSubstr("young: 0.5 kPa\n"), HasSubstr("law: fitted"), HasSubstr("inputs/cell.jkr.yaml")));
  std::filesystem::create_directories(file.folder.path() / "inputs");
  std::filesystem::copy_file(file.folder.path() / "cell.jkr.yaml", file.folder.path() / "inputs" / "cell.jkr.yaml");
  const auto again = file.read(study->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->model.types[0].sphere.packing.onset(), 0.08);
  EXPECT_EQ(again->model.types[0].sphere.young, 0.5);
  const auto third = file.read(again->resolved_text);
  ASSERT_TRUE(third.ok()) << third.error().text();
  EXPECT_EQ(third->resolved_text, again->resolved_text);
}

TEST(FittedLaw, TheTableIsTakenWhereItIsBetterOrAskedFor) {
  const Written better(file_text("table", "", kTable));
  const auto by_file = better.read();
  ASSERT_TRUE(by_file.ok()) << by_file.error().text();
  EXPECT_EQ(by_file->model.types[0].sphere.law->word, "table");
  const auto jkr = better.read(test::changed("file:", "form: jkr, file:", kStudy));
  ASSERT_TRUE(jkr.ok()) << jkr.error().text();
  EXPECT_EQ(jkr->model.types[0].sphere.law->word, "jkr");
  const Written none(file_text());
  EXPECT_THAT(none.errors(test::changed("file:", "form: table, file:", kStudy)), AllOf(HasSubstr("E516"), HasSubstr("no table")));
}

TEST(FittedLaw, PackingIsTheStudysWhereTheFileHasNone) {
  const Written file(file_text());
  const auto study = file.read();
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_FALSE(study->model.types[0].sphere.packing.empty());  // of the ideal filled cell, with the fitted modulus
  EXPECT_THAT(file.errors(test::changed("file:", "packing: fitted, file:", kStudy)), HasSubstr("E516"));
}

TEST(FittedLaw, OtherCellsThanThoseThatWereFittedAreRefusedWithWhatDiffers) {
  const Written file(file_text());
  EXPECT_THAT(file.errors(test::changed("    cbm:", "    dcm: {cortex: {tension: 0.3 mN/m}}\n    cbm:", kStudy)),
              AllOf(HasSubstr("E532"), HasSubstr("tension"), HasSubstr("0.3 mN/m here"), HasSubstr("morula calibrate jkr cell")));
  EXPECT_THAT(file.errors(test::changed("    cbm:", "    dcm: {nodes: 642}\n    cbm:", kStudy)),
              AllOf(HasSubstr("E532"), HasSubstr("nodes")));
  EXPECT_THAT(file.errors(test::changed("0.1 mN/m", "0.2 mN/m", kStudy)), AllOf(HasSubstr("E532"), HasSubstr("adhesion")));
}

TEST(FittedLaw, RadiiOutsideOfTheFitAreTold) {
  const Written file(file_text());
  const auto study = file.read(test::changed("radius: 6 um", "radius: {mean: 6 um, spread: 20 %}", kStudy));
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_THAT(study->warnings.text(), AllOf(HasSubstr("E534"), HasSubstr("5.9 to 7.8 um")));
  EXPECT_THAT(file.read()->warnings.text(), Not(HasSubstr("E534")));
  const auto near = file.read(test::changed("radius: 6 um", "radius: {mean: 6 um, spread: 5 %}", kStudy));  // down to 5.1 um
  ASSERT_TRUE(near.ok());
  EXPECT_THAT(near->warnings.text(), Not(HasSubstr("E534"))) << "unequal pairs of up to 1.3 are held out of the fit";
  for (const auto& [ratio, warns] : {std::pair("2", false), {"8", true}}) {  // at division 7.6 and 12 um
    const auto grows =
        file.read(test::changed("radius: 6 um", std::string("radius: 6 um\n    cycle: {duration: 20 h, ratio: ") + ratio + "}", kStudy));
    ASSERT_TRUE(grows.ok()) << grows.error().text();
    EXPECT_EQ(grows->warnings.text().find("E534") != std::string::npos, warns) << grows->warnings.text();
  }
}

TEST(FittedLaw, KeysThatContradictTheFileOrHaveNoEffectAreErrors) {
  const Written file(file_text());
  EXPECT_THAT(file.errors(test::changed("file:", "young: 0.6 kPa, file:", kStudy)), AllOf(HasSubstr("E510"), HasSubstr("0.5 kPa")));
  EXPECT_THAT(file.errors(test::changed("law: fitted", "law: jkr", kStudy)), AllOf(HasSubstr("E515"), HasSubstr("`law: fitted`")));
  EXPECT_THAT(file.errors(test::changed(", file: cell.jkr.yaml", "", kStudy)), AllOf(HasSubstr("E516"), HasSubstr("morula calibrate jkr")));
  EXPECT_THAT(file.errors(test::changed("cell.jkr.yaml", "other.jkr.yaml", kStudy)), HasSubstr("E601"));
  for (const char* key : {"spring_stiffness: 0.1 nN/um", "packing: {law: fitted, bulk_modulus: 1 kPa}",
                          "packing: {law: fitted, knots: [{packing: 5 %, pressure: 0 kPa}, {packing: 30 %, pressure: 1 kPa}]}"})
    EXPECT_THAT(Written(file_text("jkr", kPacking)).errors(test::changed("law: fitted", std::string("law: fitted, ") + key, kStudy)),
                HasSubstr("E515"))
        << key;
}

TEST(FittedLaw, KnowsItsCellsInOtherUnits) {
  const Written file(file_text());
  const auto study = file.read(test::changed("    cbm:", "    dcm: {bulk_modulus: 2500 Pa}\n    cbm:", kStudy));
  EXPECT_TRUE(study.ok()) << study.error().text();
  EXPECT_THAT(file.errors(test::changed("    cbm:", "    dcm: {bulk_modulus: 2600 Pa}\n    cbm:", kStudy)), HasSubstr("E532"));
}

TEST(FittedLaw, DamagedFilesAreToldAtTheirPlace) {
  const auto errors = [](const std::string& from, const std::string& to) {
    return Written(test::changed(from, to, file_text("table", "", kTable))).errors();
  };
  EXPECT_THAT(errors("young: 0.5 kPa", "young: 0.5 nN"), AllOf(HasSubstr("cell.jkr.yaml:"), HasSubstr("kPa")));
  EXPECT_THAT(errors("young: 0.5 kPa", "young: -1 kPa"), HasSubstr("E302"));
  EXPECT_THAT(errors("better: table", "better: best"), HasSubstr("cell.jkr.yaml:"));
  EXPECT_THAT(errors("schema: 1", "schema: 2"), HasSubstr("cell.jkr.yaml:1"));
  EXPECT_THAT(errors("  adhesion: 0.08 nN/um\n", ""), HasSubstr("E103"));
  EXPECT_THAT(errors("remarks:", "notes:"), HasSubstr("E101"));
  EXPECT_THAT(errors("overlap: 0.05, force: 0", "overlap: -0.2, force: 0"), HasSubstr("E533"));
  EXPECT_THAT(errors("force: 1 nN/um", "force: -1 nN/um"), HasSubstr("E533"));
  EXPECT_THAT(errors("least: -0.1, most: 0.3", "least: 0.3, most: 0.3"), HasSubstr("E533"));
  EXPECT_THAT(Written("- 1\n").errors(), HasSubstr("E104"));
  EXPECT_THAT(Written(file_text("table")).errors(), HasSubstr("E533"));
}

}  // namespace
}  // namespace morula::scenarios
