#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

struct Case {
  const char* name;
  const char* from;
  const char* to;
  const char* expected;  ///< part of the message
};
void PrintTo(const Case& study, std::ostream* out) { *out << study.name; }

class BadStudy : public testing::TestWithParam<Case> {};

TEST_P(BadStudy, IsRefusedWithPlaceCodeAndReason) {
  const Case& c = GetParam();
  const std::string message = errors_of(changed(c.from, c.to));
  EXPECT_THAT(message, HasSubstr(c.expected));
  EXPECT_TRUE(message.starts_with("study.yaml:")) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Structure, BadStudy,
    testing::Values(
        Case{"DoubleKey", "title: S", "study: twice\ntitle: S",
             "study.yaml:3:1: error: key 'study' is given twice, first in line 2 [E102]"},
        Case{"DoubleKeyInFlow", "spread: 10 %}", "spread: 10 %, mean: 7 um}", "study.yaml:9:40: error: key 'mean' is given twice"},
        Case{"DecimalComma", "spread: 10 %}", "spread: 10,5 %}", "numbers have a decimal point, `18.5 h`"},
        Case{"Missing", "domain: {size: [400 um, 400 um, 400 um], boundary: open}\n", "", "key 'domain' is missing in the study [E103]"},
        Case{"MissingInSection", "end: 96 h, ", "", "study.yaml:5:1: error: key 'end' is missing in `time` [E103]"},
        Case{"NoValue", "seed: 20261121", "seed:", "study.yaml:4:1: error: 'seed' has no value [E104]"},
        Case{"MapForScalar", "seed: 20261121", "seed: {a: 1}", "'seed' must be a single value, but here is a map [E104]"},
        Case{"ScalarForMap", "limits: {volume_error: 2 %, overlap: 0.3 um, field_balance: 1e-6}", "limits: 3", "'limits' must be a map"},
        Case{"ColumnTwice", "series: [cell_count, volume_error]", "series: [cell_count, volume_error, cell_count]",
             "column 'cell_count' is named twice [E102]"},
        Case{"ScalarForList", "series: [cell_count, volume_error]", "series: cell_count", "must be a list of words"},
        Case{"Tab", "    radius:", "\tradius:", "study.yaml:9:1: error: a tab is used for indentation [E105]"},
        Case{"Anchor", "    radius: {", "    radius: &r {", "anchors (`&name`) are not allowed in a study [E106]"},
        Case{"MergeKey", "    radius:", "    <<: {mean: 1 um}\n    radius:", "merge keys (`<<`) are not allowed in a study [E106]"},
        Case{"Tag", "seed: 20261121", "seed: !!int 20261121", "tags (`!name`) are not allowed"},
        Case{"TwoDocuments", "title: S", "---\ntitle: S", "a study is one YAML document, but another one follows [E107]"},
        Case{"Version", "schema: 1", "schema: 2", "'schema' is 2, but must be 1 [E302]"},
        Case{"StudyName", "study: spheroid_core", "study: ../../etc", "'../../etc' cannot be the name of a study [E112]"},
        Case{"TypeName", "hepatocyte:\n", "\"hepato cyte\":\n", "'hepato cyte' cannot be a name [E112]"},
        Case{"UnclosedBracket", "limits: {volume", "limits: {{volume", "[E100]"}),
    [](const auto& one) { return one.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Numbers, BadStudy,
    testing::Values(
        Case{"NoUnit", "thickness: 200 nm", "thickness: 200", "'thickness' is a length"},
        Case{"UnknownUnit", "thickness: 200 nm", "thickness: 200 smoots", "[E202]"},
        Case{"WrongUnit", "end: 96 h", "end: 96 um", "'end' is a time, but 'um' is a length [E203]"},
        Case{"NoNumber", "end: 96 h", "end: soon", "[E204]"}, Case{"Comma", "end: 96 h", "end: \"9,6 h\"", "[E20"},
        Case{"TwoNumbers", "end: 96 h", "end: 9 6 h", "[E20"}, Case{"UnitOnPlain", "poisson: 0.5,", "poisson: 0.5 kPa,", "[E205]"},
        Case{"NaN", "poisson: 0.5,", "poisson: .nan,", "[E301]"}, Case{"Inf", "end: 96 h", "end: inf h", "[E301]"},
        Case{"Overflow", "end: 96 h", "end: 1e999 h", "[E301]"},
        Case{"OutOfRange", "poisson: 0.5,", "poisson: 0.7,", "'poisson' is 0.7, but must be between 0 and 0.5 [E302]"},
        Case{"Negative", "speed: 2 um/h", "speed: -2 um/h", "[E302]"},
        Case{"Octal", "seed: 20261121", "seed: 010", "'seed' begins with a zero: '010' could be meant as octal [E304]"},
        Case{"OctalQuantity", "end: 96 h", "end: 096 h", "[E304]"},
        Case{"Hexadecimal", "seed: 20261121", "seed: 0x10", "'seed' must be a whole number, but is '0x10' [E109]"},
        Case{"SeedTooLarge", "seed: 20261121", "seed: 4294967296", "[E302]"},
        Case{"SeedHuge", "seed: 20261121", "seed: 99999999999999999999999999", "[E302]"},
        Case{"NegativeCount", "count: 60", "count: -4", "'count' is -4, but must be between 1 and 2e+08 [E302]"},
        Case{"NodesNotAnIcosphere", "nodes: 162", "nodes: 163", "must be one of 42, 162, 642, 2562 [E302]"},
        Case{"TwoComponents", "[400 um, 400 um, 400 um]", "[400 um, 400 um]", "'size' has 2 numbers, but needs 3: [x, y, z] [E303]"},
        Case{"ComponentWithoutUnit", "[400 um, 400 um, 400 um]", "[400 um, 400, 400 um]", "study.yaml:6:25: error: 'size' is a length"}),
    [](const auto& one) { return one.param.name; });

INSTANTIATE_TEST_SUITE_P(
    References, BadStudy,
    testing::Values(
        Case{"TypeOfInitial", "{type: hepatocyte, count", "{type: hepatocyt, count", "there is no cell type 'hepatocyt' [E401]"},
        Case{"Adhesion", "capsule: 1e-6 J/m^2", "capsul: 1e-6 J/m^2", "there is no cell type or obstacle 'capsul' [E401]"},
        Case{"DeathField", "oxygen_below", "glucose_below", "there is no field 'glucose' [E402]"},
        Case{"TriggerField", "promote: pressure > 1 kPa", "promote: oxigen > 1 mM", "there is no field 'oxigen' to compare [E402]"},
        Case{"TriggerWithoutSign", "promote: pressure > 1 kPa", "promote: pressure 1 kPa", "is not a comparison: 'pressure 1 kPa' [E113]"},
        Case{"TriggerUnit", "promote: pressure > 1 kPa", "promote: pressure > 1 um", "[E203]"},
        Case{"TriggerHalf", "demote: pressure < 600 Pa, ", "",
             "a trigger needs `promote` and `demote`, `outside_law`, `phase`, or `type` [E111]"},
        Case{"TriggerOfTwoForms", "demote: pressure < 600 Pa, ", "demote: pressure < 600 Pa, outside_law: 1, ",
             "a trigger has either `type`, `phase`, `outside_law`, or `promote` and `demote` [E111]"},
        Case{"TriggerOfNoPhase", "promote: pressure > 1 kPa, demote: pressure < 600 Pa", "phase: G7", "no type has a phase 'G7' [E405]"},
        Case{"NamedCellOfNoName", "shape: sphere, center: [0 um, 0 um, 0 um], radius: 25 um, as: dcm, margin: 3 um",
             "shape: cells, ids: [3, 7.2]", "'7.2' is not the id of a cell [E114]"},
        Case{"NamedCellThatIsNone", "shape: sphere, center: [0 um, 0 um, 0 um], radius: 25 um, as: dcm, margin: 3 um",
             "shape: cells, ids: 61", "there is no cell 61 and will be none: the study begins with 60 cells [E406]"},
        Case{"CriterionOfACellThatIsNone", "output:\n",
             "criteria: [{id: A, measure: volume, of: {cell: \"61\"}, above: 1 um^3}]\noutput:\n",
             "there is no cell 61 and will be none: the study begins with 60 cells [E406]"},
        Case{"MigrationWithoutSpeed", "speed: 2 um/h, persistence: 30 min", "law: chemotaxis, field: oxygen",
             "'law' has no effect without a speed [E515]"},
        Case{"PhaseWithoutModulation", "tension: 0.2 mN/m}", "tension: 0.2 mN/m, regions: {whole: {tension: 0.2 mN/m, phase: 90 deg}}}",
             "'phase' of 'whole' has no effect without a modulation [E515]"},
        Case{"EasingWithoutLateral", "tension: 0.2 mN/m}", "tension: 0.2 mN/m, lateral_easing: 30 s}",
             "'lateral_easing' has no effect here [E515]"},
        Case{"NamedCellsWithMargin", "shape: sphere, center: [0 um, 0 um, 0 um], radius: 25 um, as: dcm, margin: 3 um",
             "shape: cells, ids: 3, margin: 3 um", "'margin' has no effect here [E515]"},
        Case{"EverythingWithMargin", "shape: sphere, center: [0 um, 0 um, 0 um], radius: 25 um, as: dcm, margin: 3 um",
             "shape: everything, margin: 3 um", "'margin' has no effect here [E515]"},
        Case{"NamedCellsWithRadius", "shape: sphere, center: [0 um, 0 um, 0 um], radius: 25 um, as: dcm, margin: 3 um",
             "shape: cells, ids: 3, radius: 3 um", "a region of shape 'cells' has no `radius` [E111]"},
        Case{"NamedCellsWithoutNames", "shape: sphere, center: [0 um, 0 um, 0 um], radius: 25 um, as: dcm, margin: 3 um", "shape: cells",
             "a region of shape 'cells' needs `ids` [E103]"},
        Case{"TriggerOfNoRange", "promote: pressure > 1 kPa, demote: pressure < 600 Pa", "outside_law: 0",
             "'outside_law' is 0, but must be"},
        Case{"NoSource", "count: 60, fill: sphere, radius: 40 um, ", "",
             "an entry of `initial` needs `fill`, `at`, `csv` or `meshes` [E111]"},
        Case{"TwoSources", "count: 60, ", "count: 60, csv: a.csv, ", "[E111]"},
        Case{"TwoShapes", "{sphere: {radius: 150 um}", "{box: {size: [1 um, 1 um, 1 um]}, sphere: {radius: 150 um}",
             "more than one shape [E111]"},
        Case{"FieldThatMakesAColumnOfAnother", "fields:\n", "fields:\n  contact_area: {diffusion: 1e-9 m^2/s, initial: 1 mM}\n",
             "'contact_area' would make a second column 'mean_contact_area' [E112]"},
        Case{"TypeAndObstacle", "geometry:\n  capsule", "geometry:\n  hepatocyte", "'hepatocyte' is a cell type and an obstacle [E112]"},
        Case{"MissingStl", "{sphere: {radius: 150 um}", "{stl: mesh/none.stl", "file 'mesh/none.stl' does not exist [E601]"},
        Case{"MissingCsv", "{type: hepatocyte, count: 60, fill: sphere, radius: 40 um, as: cbm}", "{csv: none.csv}",
             "file 'none.csv' does not exist [E601]"}),
    [](const auto& one) { return one.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Physics, BadStudy,
    testing::Values(
        Case{"RegionOutside", "center: [0 um, 0 um, 0 um], radius: 25 um", "center: [900 um, 0 um, 0 um], radius: 25 um",
             "region 'core' lies outside the domain"},
        Case{"BothSigns", "demote: pressure < 600 Pa", "demote: pressure > 600 Pa", "[E501]"},
        Case{"RangeTooLong", "limits: {", "contact: {range: 1.2 um}\nlimits: {",
             "more than half of the mean edge (1.82 um) of a shell of 'hepatocyte' with 162 nodes [E503]"},
        Case{"NoFriction", "medium: 1e8 N s/m^3", "medium: 0 N s/m^3", "no cell has friction with the medium"},
        Case{"NoFrictionOfEitherDirection", "medium: 1e8 N s/m^3", "medium: 0 N s/m^3, medium_tangential: 0 N s/m^3",
             "no cell has friction with the medium"},
        Case{"FillOutside", "radius: 40 um", "radius: 201 um", "the shape to fill reaches out of the domain [E502]"},
        Case{"TooManyCells", "count: 60", "count: 400",
             "400 cells of radius 6 um have 1.35 times the volume of the shape they fill [E506]"},
        Case{"CellOutside", "{type: hepatocyte, count: 60, fill: sphere, radius: 40 um,",
             "{type: hepatocyte, at: [[0 um, 0 um, 0 um], [201 um, 0 um, 0 um]],",
             "a cell at [201 um, 0 um, 0 um] is outside the domain [E505]"},
        Case{"ExplicitStep", "step: auto", "step: 1 s, integrator: explicit_euler", "explicit Euler is unstable with a step of 1 s"},
        Case{"StartVolume", "as: cbm}", "as: cbm, start_volume: 50 %}", "no time is given to inflate them [E510]"},
        Case{"PeriodicTooSmall", "size: [400 um, 400 um, 400 um], boundary: open", "size: [400 um, 400 um, 20 um], boundary: {z: periodic}",
             "the domain is too small along z"},
        Case{"HalfPeriodic", "boundary: open", "boundary: {x_low: periodic}", "only one of the faces across x is periodic [E510]"},
        Case{"ManyVoxels", "diffusion: 2e-9", "voxel: 0.1 um, diffusion: 2e-9", "[E512]"},
        Case{"ObstacleOutside", "{radius: 150 um}", "{radius: 10 um, center: [900 um, 0 um, 0 um]}",
             "obstacle 'capsule' lies outside the domain"}),
    [](const auto& one) { return one.param.name; });

INSTANTIATE_TEST_SUITE_P(
    ShellLaws, BadStudy,
    testing::Values(
        Case{"UnknownLaw", "cortex: {young", "cortex: {elastic: neo_hookean, young", "neo_hooke"},
        Case{"AreaTwice", "cortex: {young: 1 kPa", "area: {local: 0.1 mN/m}\n      cortex: {elastic: neo_hooke, young: 1 kPa",
             "study.yaml:19:21: error: shells of 'hepatocyte' resist changes of area twice: by `cortex.elastic: neo_hooke` and by "
             "`area.local` "
             "[E513]"},
        Case{"AreaTwiceByMesh", "cortex: {young: 1 kPa", "area: {global: 1 mN/m}\n      cortex: {elastic: springs_with_area, young: 1 kPa",
             "by `cortex.elastic: springs_with_area` and by `area.global` [E513]"},
        Case{"LocalAndGlobalArea", "cortex: {young: 1 kPa", "area: {local: 1 mN/m, global: 1 mN/m}\n      cortex: {young: 1 kPa",
             "by `area.local` and by `area.global` [E513]"},
        Case{"PoissonOfSprings", "poisson: 0.5,", "poisson: 0.3, elastic: springs_with_area,",
             "a net of springs with an area modulus cannot have a Poisson ratio of 0.3 [E514]"},
        Case{"PoissonOfSheet", "poisson: 0.5,", "poisson: 0.6, elastic: stvk,", "'poisson' is 0.6, but must be between 0 and 0.5 [E302]"},
        Case{"SkalakKey", "poisson: 0.5,", "shear_modulus: 5 uN/m,", "'shear_modulus' has no effect here [E515]"},
        Case{"SkalakRatio", "poisson: 0.5,", "area_ratio: 50, elastic: neo_hooke,", "'area_ratio' has no effect here [E515]"},
        Case{"CurvatureOfHinges", "bulk_modulus: 2.5 kPa", "bending: {spontaneous_radius: 3 um}",
             "'spontaneous_radius' has no effect here [E515]"},
        Case{"CurvatureZero", "bulk_modulus: 2.5 kPa", "bending: {law: helfrich, spontaneous_radius: 0 um}", "too small a sphere [E302]"},
        Case{"TwoSheets", "cortex: {young: 1 kPa",
             "membrane: {elastic: skalak, shear_modulus: 5 uN/m, area_ratio: 1}\n      cortex: {elastic: neo_hooke, young: 1 kPa",
             "by `cortex.elastic: neo_hooke` and by `membrane.elastic: skalak` [E513]"},
        Case{"BarrierFromWhereItIsTooLate", "bulk_modulus: 2.5 kPa", "fold_barrier: {angle: 2.9 rad}",
             "'angle' is 2.9 rad, but must be between 0.2 rad and 2.8 rad [E302]"},
        Case{"TwoCurvatures", "bulk_modulus: 2.5 kPa",
             "bending: {law: helfrich}\n      membrane: {bending: helfrich, rigidity: 2e-19 J, spontaneous_radius: 3 um}",
             "the spontaneous curvature of the membrane is not that of the layer below [E595]"},
        Case{"MembraneWithoutLaw", "bulk_modulus: 2.5 kPa", "membrane: {}", "a membrane without a law has no effect [E515]"},
        Case{"MembraneWithoutModulus", "bulk_modulus: 2.5 kPa", "membrane: {elastic: springs}",
             "the membrane's 'springs' needs 'shear_modulus' [E103]"},
        Case{"MembraneWithoutAreaRatio", "bulk_modulus: 2.5 kPa", "membrane: {elastic: stvk, shear_modulus: 5 uN/m}",
             "the membrane's 'stvk' needs 'area_ratio' [E103]"},
        Case{"MembraneAreaRatio", "bulk_modulus: 2.5 kPa", "membrane: {elastic: springs, shear_modulus: 5 uN/m, area_ratio: 2}",
             "'area_ratio' has no effect here [E515]"},
        Case{"MembraneRigidity", "bulk_modulus: 2.5 kPa", "membrane: {elastic: springs, shear_modulus: 5 uN/m, rigidity: 2e-19 J}",
             "'rigidity' has no effect here [E515]"},
        Case{"FluidWithAMembrane", "thickness: 200 nm, poisson: 0.5, tension: 0.2 mN/m",
             "elastic: none, tension: 0.05 mN/m}\n      membrane: {bending: helfrich, rigidity: 2e-19 J",
             "a cortex that is not elastic spreads without end [E509]"},
        Case{"TurnoverOfAFluid", "poisson: 0.5,", "elastic: none, turnover: 10 min,", "'turnover' has no effect here [E515]"},
        Case{"FluidThatSpreads", "thickness: 200 nm, poisson: 0.5, tension: 0.2 mN/m", "elastic: none, tension: 0.05 mN/m",
             "a cortex that is not elastic spreads without end [E509]"},
        Case{"NegativeModulus", "bulk_modulus: 2.5 kPa", "area: {local: -1 mN/m}", "[E302]"},
        Case{"NegativeViscosity", "bulk_modulus: 2.5 kPa", "bulk_viscosity: -1 Pa s", "[E302]"},
        Case{"NoTimeOfTurnover", "poisson: 0.5,", "turnover: 0 s,", "[E302]"}),
    [](const auto& one) { return one.param.name; });

TEST(BadStudyFile, EmptyFileIsRefused) {
  EXPECT_THAT(errors_of(""), HasSubstr("the study is empty [E107]"));
  EXPECT_THAT(errors_of("# only a comment\n"), HasSubstr("the study is empty [E107]"));
}

std::string file_error(const std::filesystem::path& path, ErrorKind kind = ErrorKind::kInput) {
  const auto study = read_study(path);
  EXPECT_FALSE(study.ok());
  if (study.ok()) return "";
  EXPECT_EQ(study.error().kind(), kind);
  return study.error().text();
}

TEST(BadStudyFile, MissingFileIsAFileError) {
  const Folder folder;
  EXPECT_THAT(file_error(folder.path() / "none.yaml", ErrorKind::kFile), AllOf(HasSubstr("none.yaml"), HasSubstr("does not exist [E601]")));
}

TEST(BadStudyFile, FolderIsNotAFile) {
  const Folder folder;
  EXPECT_THAT(file_error(folder.path()), HasSubstr("is a folder, not a file [E602]"));
}

TEST(BadStudyFile, BinaryFileIsRefused) {
  const Folder folder;
  const auto path = folder.write("study.yaml", std::string("\x7f"
                                                           "ELF\x02\x01\0\0\0",
                                                           9));
  EXPECT_THAT(file_error(path), HasSubstr("is binary: byte 7 is zero [E604]"));
}

TEST(BadStudyFile, TextThatIsNotUtf8IsRefused) {
  const Folder folder;
  const auto path = folder.write("study.yaml", "schema: 1\ntitle: M\xfcller\n");
  EXPECT_THAT(file_error(path), AllOf(HasSubstr("study.yaml:2:9: error:"), HasSubstr("is not UTF-8 text: byte 19 [E605]")));
}

TEST(BadStudyFile, HundredMegabytesAreRefusedUnread) {
  const Folder folder;
  const auto path = folder.write("study.yaml", "schema: 1\n");
  std::filesystem::resize_file(path, 100u << 20);  // a sparse file: reading it would find zero bytes instead
  EXPECT_THAT(file_error(path), HasSubstr("is too large: 100 MiB, at most 5 MiB [E603]"));
}

TEST(BadStudyFile, SurfacesThatArePipesDevicesOrHugeAreRefusedUnread) {
  const Folder folder;
  ASSERT_EQ(::mkfifo((folder.path() / "pipe.stl").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", folder.path() / "zero.stl");
  std::filesystem::resize_file(folder.write("huge.stl", "solid"), std::uintmax_t{3} << 30);
  for (const auto& [name, says] : {std::pair("pipe", "is a pipe or device, not a regular file [E602]"),
                                   std::pair("zero", "is a pipe or device, not a regular file [E602]"),
                                   std::pair("huge", "is too large: 3072 MiB, at most 1024 MiB [E603]")}) {
    const std::string file = std::string(name) + ".stl";
    EXPECT_THAT(file_error(folder.write("study.yaml", changed("sphere: {radius: 150 um}", "stl: " + file))), HasSubstr(says));
    const std::string meshes = "initial: [{type: round, meshes: {file: " + file + ", scale: 1 um}}]\n";
    EXPECT_THAT(file_error(folder.write("study.yaml",
                                        "schema: 1\nstudy: a\ntime: {end: 1 h}\ndomain: {size: [90 um, 90 um, 90 um]}\n"
                                        "cell_types: {round: {radius: 6 um, dcm: {nodes: 42}}}\n" +
                                            meshes)),
                HasSubstr(says));
  }
}

TEST(BadStudyFile, DeepNestingDoesNotOverflowTheStack) {
  const auto study = read("a: " + std::string(100000, '['));
  ASSERT_FALSE(study.ok());
  EXPECT_THAT(study.error().text(), HasSubstr("[E100]"));
}

TEST(BadStudyFile, ByteOrderMarkAndWindowsLineEndsAreAccepted) {
  const Folder folder;
  std::string text = "\xEF\xBB\xBF";
  for (const char* c = kGoodStudy; *c; ++c) text += *c == '\n' ? std::string("\r\n") : std::string(1, *c);
  const auto study = read_study(folder.write("study.yaml", text));
  EXPECT_TRUE(study.ok()) << study.error().text();
}

}  // namespace
}  // namespace morula::scenarios::test
