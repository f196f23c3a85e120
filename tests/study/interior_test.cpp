// Keys of what is inside a cell: read, refused, written and read again; a run with all of them, its files and its picture.
#include <gmock/gmock.h>

#include <numbers>

#include "dcm/builtin.h"
#include "dcm/derived_parameters.h"
#include "report/pictures/rasterize.h"
#include "results/snapshot_file.h"
#include "results/vtk_writer.h"
#include "scenarios/library/library.h"
#include "scenarios/run/driver.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The good study with a key of `dcm` (or of the cell type) added.
std::string with_shell_key(const std::string& key) { return changed("bulk_modulus: 2.5 kPa", key); }
std::string with_type_key(const std::string& key) { return changed("    cbm: {law", "    " + key + "\n    cbm: {law"); }

CellType read_type(const std::string& text) {
  const auto study = read(text);
  EXPECT_TRUE(study.ok()) << study.error().text();
  return study.ok() ? study->model.types[0] : CellType{};
}

TEST(InteriorKeys, AreOffUnlessGiven) {
  const CellType type = read_type(kGoodStudy);
  EXPECT_FALSE(type.osmosis.acts());
  EXPECT_FALSE(type.interior.acts());
  EXPECT_FALSE(read_type(with_shell_key("nucleus: {kind: none}")).interior.acts());
}

TEST(InteriorKeys, AreReadInInternalUnits) {
  const CellType type = read_type(with_shell_key(
      "nucleus: {radius: 3 um, cytoplasm_viscosity: 2 Pa s}\n      cytoskeleton:\n        nucleus_links: {number: 50, stiffness: 0.01 "
      "nN/um, damping: 1e-5 N s/m}\n        cortex_links: {stiffness: 2 uN/m, tension_only: true}"));
  EXPECT_DOUBLE_EQ(type.interior.nucleus_fraction, 0.125);
  EXPECT_DOUBLE_EQ(type.interior.cytoplasm_viscosity, 2e-3);
  EXPECT_EQ(type.interior.nucleus_links.count, 50u);
  EXPECT_DOUBLE_EQ(type.interior.nucleus_links.stiffness, 0.01);
  EXPECT_DOUBLE_EQ(type.interior.nucleus_links.damping, 0.01);
  EXPECT_EQ(type.interior.cortex_links.count, dcm::LinkParameters::kAll);
  EXPECT_DOUBLE_EQ(type.interior.cortex_links.stiffness, 0.002);
  EXPECT_TRUE(type.interior.cortex_links.tension_only);
  EXPECT_DOUBLE_EQ(read_type(with_shell_key("nucleus: {volume_fraction: 10 %}")).interior.nucleus_fraction, 0.1);

  const CellType wet =
      read_type(with_type_key("osmosis: {permeability: 1e-13 m/s/Pa, inactive: 40 %, outside: 450 mM, field: oxygen, course: [{time: 0 s, "
                              "factor: 1}, {time: 1 min, factor: 0.5}]}"));
  EXPECT_DOUBLE_EQ(wet.osmosis.permeability, 1e-4);
  EXPECT_DOUBLE_EQ(wet.osmosis.inactive, 0.4);
  EXPECT_DOUBLE_EQ(wet.osmosis.inside, 300.0);
  EXPECT_DOUBLE_EQ(wet.osmosis.outside, 450.0);
  EXPECT_EQ(wet.osmosis.field, 0);
  EXPECT_DOUBLE_EQ(wet.osmosis.course.at(30.0), 0.75);
  EXPECT_TRUE(read_type(with_type_key("osmosis: {}")).osmosis.acts()) << "the defaults act";
}

TEST(InteriorKeys, WrongOnesAreRefusedWithPlaceAndHelp) {
  EXPECT_THAT(errors_of(with_shell_key("nucleus: {radius: 7 um}")),
              AllOf(HasSubstr("is larger than the cell"), HasSubstr("[E537]"), HasSubstr("4.8 um")));
  EXPECT_THAT(errors_of(with_shell_key("nucleus: {radius: 5.5 um}")), AllOf(HasSubstr("leaves no room"), HasSubstr("[E537]")));
  EXPECT_THAT(errors_of(with_shell_key("nucleus: {volume_fraction: 60 %}")), HasSubstr("[E537]"));
  EXPECT_THAT(errors_of(with_shell_key("nucleus: {}")), HasSubstr("[E111]"));
  EXPECT_THAT(errors_of(with_shell_key("nucleus: {radius: 2 um, volume_fraction: 4 %}")), HasSubstr("[E111]"));
  EXPECT_THAT(errors_of(with_shell_key("nucleus: {radius: -2 um}")), HasSubstr("[E302]"));
  EXPECT_THAT(errors_of(with_shell_key("nucleus: {radius: 2 um, cytoplasm_viscosity: 0 Pa s}")), HasSubstr("[E302]"));
  EXPECT_THAT(errors_of(with_shell_key("cytoskeleton: {nucleus_links: {stiffness: 0.01 nN/um}}")),
              AllOf(HasSubstr("no nucleus"), HasSubstr("[E538]")));
  EXPECT_THAT(errors_of(with_shell_key("cytoskeleton: {cortex_links: {stiffness: 0.01 nN/um, number: 500}}")), HasSubstr("[E539]"));
  EXPECT_THAT(errors_of(with_shell_key("cytoskeleton: {cortex_links: {stiffness: 0.01 nN/um, number: 82}}")),
              AllOf(HasSubstr("at most 81"), HasSubstr("[E539]")));
  EXPECT_THAT(errors_of(with_shell_key("cytoskeleton: {cortex_links: {number: 5}}")), HasSubstr("[E103]"));
  EXPECT_THAT(errors_of(with_shell_key("cytoskeleton: {cortex_links: {stiffness: -1 nN/um}}")), HasSubstr("[E302]"));
  EXPECT_THAT(errors_of(with_shell_key("bulk_modulus: 0 kPa")),
              AllOf(HasSubstr("no resistance to changes of their volume"), HasSubstr("[E535]")));
  EXPECT_THAT(errors_of(with_type_key("osmosis: {outside: 10 mM}")), AllOf(HasSubstr("21.3 times its target volume"), HasSubstr("[E536]")));
  EXPECT_THAT(errors_of(with_type_key("osmosis: {course: [{time: 0 s, factor: 1}, {time: 9 s, factor: -1}]}")), HasSubstr("[E536]"));
  EXPECT_THAT(errors_of(with_type_key("osmosis: {course: [{time: 9 s, factor: 1}, {time: 0 s, factor: 1}]}")), HasSubstr("[E510]"));
  EXPECT_THAT(errors_of(with_type_key("osmosis: {field: sugar}")), HasSubstr("[E402]"));
  EXPECT_THAT(errors_of(with_type_key("osmosis: {permeability: 0 m/s/Pa}")), HasSubstr("[E302]"));
  EXPECT_THAT(errors_of(with_type_key("osmosis: {inactive: 95 %}")), HasSubstr("[E302]"));
}

/// What a field adds to the medium, at the start and on the faces of the domain.
TEST(InteriorKeys, OsmolaritiesAreJudgedWithWhatAFieldAdds) {
  const auto text = [](const std::string& osmosis, const std::string& field) {
    return "schema: 1\nstudy: salt\ntime: {end: 1 h}\ndomain: {size: [100 um, 100 um, 100 um]}\ncell_types:\n  a: {body: shell, cycle: "
           "{model: none}, osmosis: {" +
           osmosis + ", field: salt}}\ninitial: [{type: a, at: [0 um, 0 um, 0 um]}]\nfields: {salt: {diffusion: 1000 um^2/s, " + field +
           "}}\n";
  };
  const auto told = [&text](const std::string& osmosis, const std::string& field) { return errors_of(text(osmosis, field)); };
  EXPECT_TRUE(read(text("outside: 1 mM", "initial: 299 mM")).ok());
  EXPECT_TRUE(read(text("outside: 150 mM", "initial: 150 mM, boundary: 300 mM")).ok());
  EXPECT_THAT(told("outside: 1 mM", "initial: 0 mM, boundary: 299 mM"), AllOf(HasSubstr("[E536]"), HasSubstr("(0 mM of it 'salt')")));
  EXPECT_THAT(told("outside: 300 mM, inactive: 10 %", "initial: 0 mM, boundary: 5000 mM"),
              AllOf(HasSubstr("an osmolarity of 5300 mM outside (5000 mM of it 'salt')"), HasSubstr("[E536]")));
  EXPECT_THAT(told("outside: 300 mM, inactive: 10 %",
                   "initial: 0 mM, boundary: {x_low: 100 mM}, course: [{time: 0 h, factor: 1}, {time: 1 h, factor: 50}]"),
              HasSubstr("(5000 mM of it 'salt')"));
  // Faces across which the domain goes on have no concentration.
  std::string periodic = text("outside: 300 mM, inactive: 10 %", "initial: 0 mM, boundary: {x_low: 5000 mM}");
  EXPECT_THAT(errors_of(periodic), HasSubstr("[E536]"));
  const std::string size = "size: [100 um, 100 um, 100 um]";
  periodic.replace(periodic.find(size), size.size(), size + ", boundary: {x: periodic}");
  EXPECT_TRUE(read(periodic).ok());
}

TEST(InteriorKeys, ThatDoNotGoTogetherAreRefused) {
  const std::string nucleus = with_shell_key("nucleus: {volume_fraction: 40 %}");
  EXPECT_THAT(errors_of(changed("    cbm: {law", "    osmosis: {}\n    cbm: {law", nucleus)),
              AllOf(HasSubstr("is 40 % of the cell, but only 30 % are inactive"), HasSubstr("[E540]")));
  EXPECT_THAT(errors_of(changed("as: cbm}", "as: dcm, shape: biconcave}", with_shell_key("nucleus: {radius: 1 um}"))),
              AllOf(HasSubstr("no room for a nucleus"), HasSubstr("[E537]")));
}

TEST(InteriorKeys, ANucleusLimitsTheExplicitStep) {  // 6π η R over a tenth of k_r π R²: 2 × 0.0377 / 125.7 s
  const std::string text = changed("time: {end: 96 h, step: auto", "time: {end: 96 h, integrator: explicit_euler, step: 1 ms",
                                   with_shell_key("nucleus: {radius: 2 um}"));
  EXPECT_THAT(errors_of(text),
              AllOf(HasSubstr("explicit Euler is unstable with a step of 1 ms"), HasSubstr("0.0006"), HasSubstr("[E507]")));
}

TEST(InteriorKeys, SurviveTheResolvedStudy) {
  const std::string text = changed("    cbm: {law", "    osmosis: {outside: 200 mM}\n    cbm: {law",
                                   with_shell_key("nucleus: {radius: 3 um}\n      cytoskeleton: {nucleus_links: {stiffness: 0.01 nN/um}}"));
  const auto study = read(text);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto again = read(study->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_DOUBLE_EQ(again->model.types[0].interior.nucleus_fraction, 0.125);
  EXPECT_EQ(again->model.types[0].interior.nucleus_links.count, dcm::LinkParameters::kAll);
  EXPECT_DOUBLE_EQ(again->model.types[0].osmosis.outside, 200.0);
}

/// Half lengths along x of the cells at the end of a part of the optical stretcher's study.
std::vector<double> stretched_lengths(const std::vector<std::string>& overrides, Snapshot* last = nullptr) {
  const Folder folder;
  for (const TemplateFile& file : find_template("optical_stretcher")->files)
    folder.write(std::string(file.path), std::string(file.content));
  ReadOptions options;
  options.overrides = {"output.report=false", "time.end=82 s", "time.checkpoint=82 s"};
  options.overrides.insert(options.overrides.end(), overrides.begin(), overrides.end());
  const auto study = read_study(folder.path() / "study.yaml", options);
  EXPECT_TRUE(study.ok()) << study.error().text();
  if (!study.ok()) return {};
  RunRequest request;
  request.runs = folder.path() / "runs";
  const auto run = scenarios::run(*study, request, Comm());
  EXPECT_TRUE(run.ok()) << run.error().message;
  if (!run.ok()) return {};
  const auto entries = list_snapshots(run->path / "results.h5");
  EXPECT_TRUE(entries.ok());
  const auto snapshot = read_snapshot(run->path / "results.h5", entries->back().index);
  EXPECT_TRUE(snapshot.ok());
  std::vector<double> out;
  for (const Snapshot::Shell& shell : snapshot->shells) {
    double low = 1e300, high = -1e300;
    for (std::uint32_t i = 0; i < shell.node_count; ++i)
      low = std::min(low, snapshot->nodes[shell.first_node + i].x), high = std::max(high, snapshot->nodes[shell.first_node + i].x);
    out.push_back(0.5 * (high - low));
  }
  if (last != nullptr) *last = *snapshot;
  return out;
}

TEST(OpticalStretcher, IsTheSameWithAFloatingNucleusToOnePercentOfItsStrain) {  // S1.6
  const std::vector<double> rest = stretched_lengths({"time.end=20 s", "time.checkpoint=20 s"});
  const std::vector<double> bare = stretched_lengths({});
  std::vector<std::string> nuclei;
  for (const char* type : {"tension_0", "tension_10", "tension_30", "tension_100"})
    nuclei.push_back("cell_types." + std::string(type) + ".dcm.nucleus={radius: 2.5 um}");
  Snapshot last;
  const std::vector<double> with = stretched_lengths(nuclei, &last);
  ASSERT_EQ(rest.size(), 4u);
  ASSERT_EQ(bare.size(), 4u);
  ASSERT_EQ(with.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const double strain = bare[i] / rest[i] - 1.0;
    EXPECT_GT(strain, 1e-3);
    EXPECT_NEAR(with[i] / rest[i] - 1.0, strain, 0.01 * strain);
  }

  ASSERT_EQ(last.nuclei.size(), 4u) << "nuclei are in the results";
  for (const Snapshot::Nucleus& nucleus : last.nuclei) {
    EXPECT_NEAR(nucleus.radius, 2.5, 1e-9);
    EXPECT_LT(norm(nucleus.center - last.cells[nucleus.cell].centroid), 0.3);
  }
  const Folder folder;
  ASSERT_TRUE(write_vtk(last, folder.path(), 0).ok());
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "nuclei_000000.vtu"));
}

TEST(NuclearShellKeys, AreThoseOfAShellWithDefaultsOfANucleus) {
  const CellType plain = read_type(with_shell_key("nucleus: {kind: shell, radius: 3 um}"));
  EXPECT_TRUE(plain.interior.has_nuclear_shell());
  EXPECT_FALSE(plain.interior.has_rigid_nucleus());
  EXPECT_EQ(plain.interior.nucleus_nodes, 162u);
  EXPECT_DOUBLE_EQ(plain.interior.nucleus_fraction, 0.125);
  EXPECT_DOUBLE_EQ(plain.interior.nucleus_shell.spring_stiffness, dcm::spring_stiffness(5.0, 0.2));
  EXPECT_DOUBLE_EQ(plain.interior.nucleus_shell.bulk_modulus, 10.0);
  EXPECT_EQ(plain.interior.nucleus_shell.tension, 0.0);
  EXPECT_EQ(plain.interior.nucleus_shell.medium_friction, 0.0);

  const CellType given = read_type(with_shell_key(
      "nucleus:\n        kind: shell\n        volume_fraction: 20 %\n        nodes: 42\n        lamina: {elastic: neo_hooke, young: 3 kPa, "
      "thickness: "
      "100 nm, poisson: 0.4, tension: 0.02 mN/m}\n        bending: {law: helfrich, rigidity: 2e-19 J}\n        bulk_modulus: 20 kPa"));
  EXPECT_EQ(given.interior.nucleus_nodes, 42u);
  EXPECT_DOUBLE_EQ(dcm::shell_law("neo_hooke").strength().of(given.interior.nucleus_shell), dcm::sheet_shear_modulus(3.0, 0.1, 0.4));
  EXPECT_EQ(given.interior.nucleus_shell.spring_stiffness, 0.0);
  EXPECT_DOUBLE_EQ(given.interior.nucleus_shell.helfrich_rigidity, 2e-4);
  EXPECT_DOUBLE_EQ(given.interior.nucleus_shell.tension, 0.02);
  EXPECT_DOUBLE_EQ(given.interior.nucleus_shell.bulk_modulus, 20.0);
  EXPECT_EQ(read_type(with_shell_key("nucleus: {radius: 3 um}")).interior.nucleus_nodes, 0u) << "rigid";
}

TEST(NuclearShellKeys, AreRefusedWhereTheyMakeNoSense) {
  const auto refused = [](const std::string& keys) { return errors_of(with_shell_key("nucleus: " + keys)); };
  EXPECT_THAT(refused("{radius: 3 um, nodes: 42}"), AllOf(HasSubstr("'nodes' has no effect"), HasSubstr("[E590]")));
  EXPECT_THAT(refused("{radius: 3 um, lamina: {young: 3 kPa}}"), AllOf(HasSubstr("'young' has no effect"), HasSubstr("[E590]")));
  EXPECT_THAT(refused("{kind: none, bulk_modulus: 3 kPa}"), HasSubstr("[E590]"));
  EXPECT_THAT(refused("{kind: shell, radius: 7 um}"), AllOf(HasSubstr("larger than the cell"), HasSubstr("[E537]")));
  EXPECT_THAT(refused("{kind: shell, radius: 3 um, nodes: 100}"), HasSubstr("42"));
  EXPECT_THAT(refused("{kind: shell, radius: 3 um, lamina: {young: -1 kPa}}"), HasSubstr("[E302]"));
  EXPECT_THAT(refused("{kind: shell, radius: 3 um, lamina: {tension: -1 mN/m}}"), HasSubstr("[E302]"));
  EXPECT_THAT(refused("{kind: shell, radius: 3 um, lamina: {elastic: springs_with_area, poisson: 0.2}}"), HasSubstr("[E514]"));
  EXPECT_THAT(refused("{kind: shell, radius: 3 um, bulk_modulus: 0 kPa}"), AllOf(HasSubstr("no resistance"), HasSubstr("[E591]")));
  EXPECT_THAT(refused("{kind: shell, radius: 3 um, bulk_modulus: 1 kPa, lamina: {tension: 5 mN/m}}"),
              AllOf(HasSubstr("would collapse"), HasSubstr("[E591]")));
  EXPECT_THAT(
      errors_of(changed("radius: {mean: 6 um", "radius: {mean: 20 um", with_shell_key("nucleus: {kind: shell, radius: 10 um, nodes: 42}"))),
      AllOf(HasSubstr("too coarse"), HasSubstr("nodes: 162"), HasSubstr("[E592]")));
}

TEST(NuclearShellKeys, AreWrittenAndReadAgain) {
  for (const char* nucleus : {"nucleus: {kind: shell, radius: 3 um, nodes: 42, lamina: {young: 3 kPa}}", "nucleus: {radius: 3 um}"}) {
    const auto first = read(with_shell_key(nucleus));
    ASSERT_TRUE(first.ok()) << first.error().text();
    const auto again = read(first->resolved_text);
    ASSERT_TRUE(again.ok()) << again.error().text();
    const dcm::InteriorParameters &a = first->model.types[0].interior, &b = again->model.types[0].interior;
    EXPECT_EQ(a.nucleus_nodes, b.nucleus_nodes);
    EXPECT_EQ(a.nucleus_shell.spring_stiffness, b.nucleus_shell.spring_stiffness);
    EXPECT_EQ(a.nucleus_shell.hinge_stiffness, b.nucleus_shell.hinge_stiffness);
  }
}

TEST(OpticalStretcher, TakesNucleiThatAreShells) {
  std::vector<std::string> nuclei{"time.end=20 s", "time.checkpoint=20 s"};
  for (const char* type : {"tension_0", "tension_10", "tension_30", "tension_100"})
    nuclei.push_back("cell_types." + std::string(type) + ".dcm.nucleus={kind: shell, radius: 2.5 um, nodes: 42}");
  Snapshot last;
  (void)stretched_lengths(nuclei, &last);
  ASSERT_EQ(last.nuclear_shells.size(), 4u) << "they are in the results";
  EXPECT_EQ(last.shells.size(), 4u);
  EXPECT_EQ(last.cells.size(), 4u);
  EXPECT_EQ(last.nuclear_nodes.size(), 4u * 42u);
  EXPECT_TRUE(last.nuclei.empty());
  for (const Snapshot::NuclearShell& nucleus : last.nuclear_shells) {
    const auto faces = last.topologies[nucleus.topology];
    const std::span<const Vec3d> nodes = std::span(last.nuclear_nodes).subspan(nucleus.first_node, nucleus.node_count);
    EXPECT_EQ(faces.size(), 80u);
    const Vec3d center = volume_centroid(faces, nodes);
    EXPECT_LT(norm(center - last.cells[nucleus.cell].centroid), 0.3);
    EXPECT_NEAR(enclosed_volume(faces, nodes, center) / (4.0 / 3.0 * std::numbers::pi * 2.5 * 2.5 * 2.5), 1.0, 0.01);
  }
  const Folder folder;
  ASSERT_TRUE(write_vtk(last, folder.path(), 0).ok());
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "nuclear_shells_000000.vtu"));
}

TEST(Pictures, ShowANucleusInTheCutFaceOfItsCellOnly) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(162).value();
  Snapshot snapshot;
  snapshot.cells.resize(1);
  snapshot.cells[0].body = BodyKind::kShell;
  snapshot.cells[0].radius = 6.0;
  for (const Vec3d& x : shape->position) snapshot.nodes.push_back(x * std::cbrt(4.0 / 3.0 * std::numbers::pi * 216.0));
  snapshot.topologies.emplace_back(shape->topology->faces().begin(), shape->topology->faces().end());
  snapshot.shells.push_back({0, 0, 162, 0});
  snapshot.nuclei.push_back({0, {1.0, 0.5, 0.0}, 2.5});
  Camera camera;
  camera.pixels_per_um = 20.0;
  const double depth = 1.5;  // of the plane before the centre of the nucleus: a disc of radius 2
  PixelBuffer cut(400, 400), whole(400, 400);
  const Vec3d to_eye = camera.toward;
  rasterize(snapshot, camera, CutPlane{snapshot.nuclei[0].center + depth * to_eye, to_eye}, cut);
  rasterize(snapshot, camera, std::nullopt, whole);
  const auto count = [](const PixelBuffer& pixels, std::int32_t surface) {
    return std::count(pixels.surface.begin(), pixels.surface.end(), surface);
  };
  EXPECT_NEAR(static_cast<double>(count(cut, 3)), std::numbers::pi * 4.0 * 400.0, 60.0);
  EXPECT_GT(count(cut, 1), count(cut, 3)) << "the cell's own cut face around it";
  EXPECT_EQ(count(whole, 3), 0);

  // The same as a shell, its nodes on a ball of about the same size: 162 of them enclose 0.966 of the volume of their ball.
  snapshot.nuclear_shells.push_back({0, 0, 162, 0});
  for (const Vec3d& x : shape->position)
    snapshot.nuclear_nodes.push_back(snapshot.nuclei[0].center + x * std::cbrt(4.0 / 3.0 * std::numbers::pi * 2.5 * 2.5 * 2.5));
  const Vec3d middle = snapshot.nuclei[0].center;
  snapshot.nuclei.clear();
  PixelBuffer cut_shell(400, 400), whole_shell(400, 400);
  rasterize(snapshot, camera, CutPlane{middle + depth * to_eye, to_eye}, cut_shell);
  rasterize(snapshot, camera, std::nullopt, whole_shell);
  EXPECT_NEAR(static_cast<double>(count(cut_shell, 3)), std::numbers::pi * 4.0 * 400.0, 300.0);
  EXPECT_EQ(count(whole_shell, 3), 0);
}

}  // namespace
}  // namespace morula::scenarios::test
