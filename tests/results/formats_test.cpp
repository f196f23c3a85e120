// results.h5 of a run describes itself, and docs/formats.md describes it: a study with every kind of dataset, run and read back.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "results/export.h"
#include "results/hdf5_reader.h"
#include "results/snapshot_file.h"
#include "scenarios/run/driver.h"
#include "tests/results/results_support.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

using testing_support::slurp;
namespace fs = std::filesystem;

/// Spheres and shells, a type with phases that divides, one that renews its meshes, nuclei of both kinds, a field, an obstacle that moves, a wall, marks and a cavity.
const std::string kEverything = R"(schema: 1
study: everything
title: Every dataset once
seed: 77
time: {end: 4 min, output: 2 min}
domain: {size: [120 um, 120 um, 120 um], boundary: {all: open, z_low: wall}}
cell_types:
  liver:
    radius: 6 um
    cycle: {model: phases, duration: 3 min}
  lung:
    radius: 6 um
    polarity: {start: [0, 3, 4]}
    dcm: {nodes: 162, renew_mesh_below: 0.4, own_mesh: true, nucleus: {kind: rigid, radius: 2 um}}
  skin:
    radius: 6 um
    dcm: {nodes: 162, nucleus: {kind: shell, radius: 3 um}}
contact: {range: 0.5 um}
geometry:
  plate: {plane: {center: [0 um, 0 um, -30 um], size: 40 um}, motion: {velocity: [0 um/h, 0 um/h, 60 um/h]}}
initial:
  - {type: liver, at: [[-30 um, 0 um, 0 um], [-30 um, 20 um, 0 um]], as: sphere}
  - {type: lung, at: [[0 um, 0 um, 0 um]], as: shell}
  - {type: skin, at: [[30 um, 0 um, 0 um]], as: shell}
fields:
  oxygen: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, boundary: {all: 0.2 mM}, uptake: {lung: 40 amol/s}, voxel: 20 um}
  glucose: {diffusion: 1e-9 m^2/s, initial: 5 mM, boundary: {all: 5 mM}, voxel: 20 um}
marks:
  top: {types: [lung, skin], cone: {axis: [0, 0, 1], angle: 60 deg}}
limits: {volume_error: 20 %}   # a volume that doubles in three minutes is not followed closer
output: {report: false, formats: [hdf5, vtk]}
)";

/// Paths of all datasets of a file.
std::vector<std::string> dataset_paths(const fs::path& path) {
  std::vector<std::string> out;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const auto add = [](hid_t, const char* name, const H5O_info_t* info, void* to) -> herr_t {
    if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(to)->emplace_back(name);
    return 0;
  };
  if (file < 0 || H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, add, &out) < 0) out.clear();
  if (file >= 0) H5Fclose(file);
  return out;
}

/// The path as docs/formats.md writes it: without the snapshot, names of the study replaced by what they are names of.
std::string as_documented(std::string path) {
  path = std::regex_replace(path, std::regex("^snapshots/[0-9]+/"), "");
  path = std::regex_replace(path, std::regex("^series/.*"), "series/<column>");
  path = std::regex_replace(path, std::regex("^obstacles/[^/]*/(position|faces)"), "obstacles/<name>/$1");
  path = std::regex_replace(path, std::regex("^fields/[^/]*/"), "fields/<field>/");
  return std::regex_replace(path, std::regex("^cells/(amount|concentration)/.*"), "cells/$1/<field>");
}

/// What a command prints; nothing if it fails.
std::optional<std::string> output_of(const std::string& command) {
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string out;
  for (char buffer[4096]; std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe);) out.append(buffer, got);
  return ::pclose(pipe) == 0 ? std::optional(out) : std::nullopt;
}

class Formats : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new test::Folder();
    auto study = test::read(kEverything, {}, folder_->path());
    ASSERT_TRUE(study.ok()) << study.error().text();
    RunRequest request;
    request.out = folder_->path() / "run";
    const auto done = run(*study, request, Comm());
    ASSERT_TRUE(done.ok()) << done.error().message;
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static fs::path run_folder() { return folder_->path() / "run"; }
  static Hdf5Reader results() { return Hdf5Reader::open(run_folder() / "results.h5").value(); }
  static std::string page() { return slurp(fs::path(MORULA_DOCS) / "formats.md"); }

  static test::Folder* folder_;
};
test::Folder* Formats::folder_ = nullptr;

TEST_F(Formats, EveryDatasetIsDescribedInTheFileAndOnThePage) {
  const Hdf5Reader file = results();
  const std::vector<std::string> paths = dataset_paths(run_folder() / "results.h5");
  ASSERT_FALSE(paths.empty());
  std::set<std::string> documented, seen;
  const std::string text = page();
  const std::regex quoted("`([a-z_]+/[a-z_<>/]+|time|[a-z]+_(?:names|units))`");
  for (std::sregex_iterator it(text.begin(), text.end(), quoted), end; it != end; ++it) documented.insert((*it)[1]);
  for (const std::string& path : paths) {
    const std::string description = file.description(path).value();
    EXPECT_FALSE(description.empty()) << path;
    EXPECT_FALSE(description.starts_with("The same ")) << path << ": as what?";
    EXPECT_TRUE(documented.count(as_documented(path)) == 1) << path << " is not on the page as " << as_documented(path);
    seen.insert(as_documented(path));
  }
  // The study has no cavity that is old enough to be seen; all else on the page is there.
  for (const std::string& path : documented)
    EXPECT_TRUE(path.starts_with("lumens/") || path.starts_with("cells/cavity/") || seen.count(path) == 1)
        << path << " is on the page but not in the file";
}

TEST_F(Formats, RootSaysWhatWasRun) {
  const Hdf5Reader file = results();
  EXPECT_EQ(file.root_text("program"), "Morula");
  EXPECT_FALSE(file.root_text("version").empty());
  EXPECT_EQ(file.root_text("study"), "everything");
  EXPECT_EQ(file.root_number("seed"), 77u);
  EXPECT_EQ(file.root_number("schema"), 2u);
  EXPECT_EQ(file.text("study/source").value(), kEverything);
  EXPECT_EQ(file.text("study/resolved").value(), slurp(run_folder() / "study.resolved.yaml"));
}

TEST_F(Formats, KindsAreEnumerations) {
  const Hdf5Reader file = results();
  const std::string cells = "snapshots/000000/cells/";
  EXPECT_EQ(file.kinds(cells + "type").value(), (std::vector<std::string>{"liver", "lung", "skin"}));
  EXPECT_EQ(file.kinds(cells + "body").value(), (std::vector<std::string>{"sphere", "shell"}));
  EXPECT_EQ(file.kinds(cells + "phase").value(), (std::vector<std::string>{"growing", "waiting", "resting", "dying"}));
  EXPECT_EQ(file.read<std::uint16_t>(cells + "type").value(), (std::vector<std::uint16_t>{0, 0, 1, 2}));
  const auto kinds = file.kinds("events/kind").value();
  EXPECT_NE(std::find(kinds.begin(), kinds.end(), "division"), kinds.end());
}

TEST_F(Formats, PolarityIsThereWhereCellsHaveOne) {
  const Hdf5Reader file = results();
  const std::string polarity = "snapshots/000002/cells/polarity/";
  const std::vector<double> x = file.read<double>(polarity + "x").value(), y = file.read<double>(polarity + "y").value(),
                            z = file.read<double>(polarity + "z").value();
  const auto types = file.read<std::uint16_t>("snapshots/000002/cells/type").value();
  ASSERT_EQ(x.size(), types.size());
  for (std::size_t i = 0; i < types.size(); ++i) {
    EXPECT_EQ(x[i], 0.0);
    EXPECT_NEAR(y[i], types[i] == 1 ? 0.6 : 0.0, 1e-12);
    EXPECT_NEAR(z[i], types[i] == 1 ? 0.8 : 0.0, 1e-12) << "liver and skin have none";
  }
}

TEST_F(Formats, IdsAreTheSameInHdf5EventsAndCsv) {
  const Hdf5Reader file = results();
  std::set<std::string> mothers, daughters;
  std::istringstream lines(slurp(run_folder() / "events.jsonl"));
  std::size_t events = 0;
  for (std::string line; std::getline(lines, line); ++events) {
    const auto json = nlohmann::json::parse(line);
    if (!json.contains("daughters")) continue;
    mothers.insert(json["cell"].get<std::string>());
    for (const auto& name : json["daughters"]) daughters.insert(name.get<std::string>());
  }
  ASSERT_GE(daughters.size(), 2u) << "the study must divide";
  std::set<std::string> in_results;
  const std::vector<std::string> of_divisions = file.texts("events/daughters").value();
  for (const std::string& two : of_divisions) {
    std::istringstream names(two);
    for (std::string name; names >> name;) in_results.insert(name);
  }
  EXPECT_EQ(in_results, daughters);
  EXPECT_EQ(file.rows("events/time").value(), events);
  const auto ids = file.texts("snapshots/000002/cells/id").value();
  for (const std::string& name : daughters)  // at the end, or divided once more
    EXPECT_NE(std::count(ids.begin(), ids.end(), name) == 1, mothers.count(name) == 1) << name;
  const auto last = read_snapshot(run_folder() / "results.h5", 2);
  ASSERT_TRUE(last.ok()) << last.error().message;
  std::istringstream csv(cells_as_csv(*last));
  std::string row;
  std::getline(csv, row);
  EXPECT_TRUE(row.starts_with("id,parent,type,body,phase,x [um]")) << row;
  for (const std::string& name : ids) {
    ASSERT_TRUE(std::getline(csv, row));
    EXPECT_EQ(row.substr(0, row.find(',')), name);
  }
}

TEST_F(Formats, SeriesAndObstaclesAreInTheFile) {
  const Hdf5Reader file = results();
  EXPECT_EQ(file.read<double>("series/time").value(), (std::vector<double>{0.0, 120.0, 240.0}));
  EXPECT_EQ(file.units("series/mean_pressure").value(), "kPa");
  EXPECT_EQ(file.description("series/cell_count").value(), "Number of cells.");
  const auto last = read_snapshot(run_folder() / "results.h5", 2);
  ASSERT_EQ(last->obstacles.size(), 2u);
  EXPECT_EQ(last->obstacles[0].name, "plate");
  EXPECT_NEAR(last->obstacles[0].offset.z, 4.0, 1e-9);  // 60 µm/h for 4 min
  EXPECT_EQ(last->obstacles[1].name, "wall z low");
  for (const Vec3d& p : last->obstacles[1].position) EXPECT_EQ(p.z, -60.0);
  EXPECT_TRUE(fs::exists(run_folder() / "vtk/obstacles.pvd"));
}

/// The ten lines of the page, run by the reader's own tools where they are here; else the library's tool must see the same file.
TEST_F(Formats, TenLinesOfPythonReadTheFile) {
  std::string python;
  for (const char* name : {"python3", "/usr/bin/python3"})
    if (python.empty() && output_of(std::string(name) + " -c 'import h5py' 2>/dev/null")) python = name;
  if (python.empty()) {
    const auto dump = output_of("cd " + run_folder().string() + " && h5dump -d /snapshots/000002/cells/body results.h5 2>/dev/null");
    if (!dump) GTEST_SKIP() << "neither h5py nor h5dump is here";
    EXPECT_NE(dump->find("shell"), std::string::npos);
    return;
  }
  const std::string text = page(), fence = "```python\n";
  const std::size_t begin = text.find(fence) + fence.size();
  testing_support::spit(run_folder() / "read.py", text.substr(begin, text.find("```", begin) - begin));
  const auto printed = output_of("cd " + run_folder().string() + " && " + python + " read.py");
  ASSERT_TRUE(printed);
  EXPECT_TRUE(printed->starts_with("everything seed 77\n3 ")) << *printed;  // the shells are founders 3 and 4
  EXPECT_NE(printed->find("\n4 "), std::string::npos) << *printed;
  EXPECT_NE(printed->find(" kPa\n3 rows, "), std::string::npos) << *printed;
}

/// The files for ParaView, read by a reader that is not ours where it is here; results_export_test.cpp decodes the same files by itself.
TEST_F(Formats, MeshioReadsTheVtuFilesAndFindsWhatResultsHave) {
  std::string python;
  for (const char* name : {"python3", "/usr/bin/python3"})
    if (python.empty() && output_of(std::string(name) + " -c 'import meshio, h5py' 2>/dev/null")) python = name;
  if (python.empty()) GTEST_SKIP() << "no Python with meshio and h5py is here; Exports.* judge the format";
  testing_support::spit(run_folder() / "meshes.py", R"(import h5py, meshio, numpy as np
f = h5py.File("results.h5")
for n in sorted(f["snapshots"]):
    s = f["snapshots"][n]; cells = s["cells"]; body = cells["body"][:]
    kinds = h5py.check_enum_dtype(cells["body"].dtype)
    read = lambda stem: meshio.read(f"vtk/{stem}_{n}.vtu")
    paths = [v.decode() for v in s["variable_names"][:]]
    titled = {p.split("/")[1] if p.startswith("concentration/") else " of ".join(p.split("/")): p for p in paths}
    assert len(titled) == 2 * len(s["fields"]) + 3 + 5 + 8 + 1 + 3  # cycle, renewed meshes, own ones, outside_law, polarity
    def same(data, rows):
        for name, values in data.items():
            column = name.split(" [")[0]
            if column in ("cell_id", "parent") or column.startswith("mark "): continue
            mine = cells[titled.get(column, column)][:]
            units = cells[titled.get(column, column)].attrs["units"].decode()
            assert units == "1" or name == f"{column} [{units}]", name
            assert np.array_equal(np.squeeze(values), np.squeeze(mine[rows])), name
    spheres = read("spheres"); rows = np.flatnonzero(body == kinds["sphere"])
    assert np.array_equal(spheres.points, cells["centroid"][:][rows])
    same(spheres.point_data, rows)
    shells = read("shells")
    rows = np.repeat(s["shells/cell"][:], s["topologies/face_count"][:][s["shells/topology"][:]])
    assert np.array_equal(shells.points, s["shells/node"][:]) and len(shells.cells_dict["triangle"]) == len(rows)
    same({k: v[0] for k, v in shells.cell_data.items()}, rows)
    nuclei = read("nuclei")
    assert np.array_equal(nuclei.points, s["nuclei/center"][:]) and len(read("nuclear_shells").points) == len(s["nuclear_shells/node"])
    plate = f["obstacles/plate/position"][:] + s["obstacles/offset"][0]
    assert np.array_equal(read("obstacles").points[: len(plate)], plate)
    assert shells.field_data["TimeValue"] == s["time"][0] and shells.field_data["body shell"] == kinds["shell"]
print(len(f["snapshots"]), "snapshots agree")
)");
  EXPECT_EQ(output_of("cd " + run_folder().string() + " && " + python + " meshes.py 2>&1").value_or("failed"), "3 snapshots agree\n");
}

TEST_F(Formats, ResultsOfAnotherSchemaAreRefused) {
  const Comm comm;
  StoragePlan plan(comm);
  plan.add_value("snapshots/000000/time", "s", 0.0);
  ASSERT_TRUE(create_file(folder_->path() / "old.h5", std::move(plan), comm).ok());
  const auto old = list_snapshots(folder_->path() / "old.h5");
  ASSERT_FALSE(old.ok());
  EXPECT_NE(old.error().message.find("has schema 1"), std::string::npos) << old.error().message;
}

}  // namespace
}  // namespace morula::scenarios
