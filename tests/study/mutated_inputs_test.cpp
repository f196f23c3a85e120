// Files that are nearly right: studies, surfaces, tables of cells and what a run wrote, each altered at random. Whatever is read is refused with a
// message or read in full; nothing crashes, and nothing takes long. MORULA_ROUNDS=100 tries a hundred times as many.
#include <gmock/gmock.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>

#include "core/mesh/mesh_check.h"
#include "core/mesh/surface_file.h"
#include "results/hdf5_journal.h"
#include "results/run_record.h"
#include "results/series_reader.h"
#include "results/snapshot_file.h"
#include "results/state_hash.h"
#include "scenarios/library/library.h"
#include "study/csv.h"
#include "tests/results/results_support.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;
using Random = std::mt19937_64;

constexpr double kLong = 20.0;  // for one file [s of CPU: how long that takes depends on what else the machine does]

double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::size_t below(Random& random, std::size_t n) { return n == 0 ? 0 : random() % n; }

/// A number of the text replaced by one that is hard to take.
void replace_number(std::string& text, Random& random) {
  static const char* const kHard[] = {"0",          "-1",         "1e300", "-1e300", "nan", "inf",     "1e-300", "99999999999999999999",
                                      "4294967296", "2147483648", "0x10",  "1e9999", "010", "1_000_0", "~",      "",
                                      ".",          "-0",         "1e",    "٣"};
  const std::size_t from = text.find_first_of("0123456789", below(random, text.size()));
  if (from == std::string::npos) return;
  const std::size_t to = std::min(text.find_first_not_of("0123456789.eE+-", from), text.size());
  text.replace(from, to - from, kHard[below(random, std::size(kHard))]);
}

/// One to four alterations of a text or of bytes.
std::string altered(std::string bytes, Random& random) {
  for (std::size_t left = 1 + below(random, 4); left > 0 && !bytes.empty(); --left) {
    const std::size_t at = below(random, bytes.size()), length = std::min(1 + below(random, 40), bytes.size() - at);
    switch (below(random, 8)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(random, 8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(random());
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(below(random, bytes.size()), bytes.substr(at, length));
        break;
      case 4:
        bytes.resize(at);
        break;
      case 5:
        bytes.insert(at, 1, "\n\t :,-[]{}#'\"&*!|>%@`\0"[below(random, 22)]);
        break;
      case 6:
        bytes.replace(at, length, length, '\0');
        break;
      default:
        replace_number(bytes, random);
        break;
    }
  }
  return bytes;
}

/// Runs `look` on alterations of the texts in turn, each within a fair time.
template <class Look>
void on_altered(const std::vector<std::string>& texts, int count, Look&& look) {
  ASSERT_FALSE(texts.empty());
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const std::string text = altered(texts[static_cast<std::size_t>(i) % texts.size()], random);
    const double began = cpu_seconds();
    look(text);
    ASSERT_LT(cpu_seconds() - began, kLong) << text.substr(0, 2000);
    if (i % 1000 == 999) std::fprintf(stderr, "%d of %d\n", i + 1, count);
    if (testing::Test::HasFatalFailure()) return;
  }
}

class MutatedInputs : public testing::Test {
 protected:
  Comm alone;
  Folder folder{alone};
};

TEST_F(MutatedInputs, FittedLawsAreRefusedWithMessagesOrRead) {
  std::string study, law;
  for (const TemplateFile& file : find_template("calibrate_hepatocyte")->files) {
    if (file.path == "study.yaml") study = std::string(file.content);
    if (file.path.ends_with(".jkr.yaml")) law = std::string(file.content);
  }
  ASSERT_FALSE(law.empty());
  int good = 0, all = 0;
  on_altered({law}, rounds(200), [&](const std::string& text) {
    spit(folder / "hepatocyte.jkr.yaml", text);
    const auto read = test::read(study, {}, folder.path());
    good += read.ok(), ++all;
    ASSERT_TRUE(read.ok() || !read.error().text().empty());
  });
  EXPECT_LT(good, all);
}

TEST_F(MutatedInputs, StudiesAreRefusedWithMessagesOrRead) {
  std::vector<std::string> quick{test::kGoodStudy}, slow;  // those whose cells are remeshed take seconds each
  for (const Template& study : templates())
    for (const TemplateFile& file : study.files)
      if (file.path.ends_with(".yaml") && !file.path.ends_with(".jkr.yaml"))
        (file.content.find("meshes:") == std::string_view::npos ? quick : slow).emplace_back(file.content);
      else
        spit(folder / std::string(file.path), std::string(file.content));
  ASSERT_FALSE(slow.empty());
  std::vector<std::string> studies;
  for (const std::string& one : slow) {
    studies.push_back(one);
    for (int times = 0; times < 4; ++times) studies.insert(studies.end(), quick.begin(), quick.end());
  }
  int good = 0;
  on_altered(studies, rounds(200), [&](const std::string& text) {
    const auto study = test::read(text, {}, folder.path());
    good += study.ok();
    ASSERT_TRUE(study.ok() || !study.error().text().empty());
  });
  EXPECT_GT(good, 0) << "some alterations, as of a comment, leave a study right";
}

TEST_F(MutatedInputs, SurfacesAreRefusedWithMessagesOrRead) {
  const Template& embryo = *find_template("embryo");
  for (const char* ending : {".stl", ".obj", ".vtk"}) {
    SCOPED_TRACE(ending);
    std::vector<std::string> texts;
    if (std::string(ending) == ".stl") {
      TriangleMesh mesh;
      mesh.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      mesh.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
      ASSERT_TRUE(write_stl(folder / "whole.stl", mesh).ok());
      texts = {slurp(folder / "whole.stl"),
               "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"};
    } else if (std::string(ending) == ".obj") {
      texts = {"o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1/1 4/2 3/3\nf -3//1 -2//1 -1//1\n"};
    } else {
      texts = {
          "# vtk DataFile Version 4.2\na\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0\n0 1 0 0 0 1\nPOLYGONS 4 16\n3 0 2 1\n3 0 1 "
          "3\n"
          "3 0 3 2\n3 1 2 3\nCELL_DATA 4\nSCALARS id int 1\nLOOKUP_TABLE default\n7 7 8 8\nFIELD FieldData 1\np 1 4 double\n1 2 3 4\n",
          "# vtk DataFile Version 4.2\na\nBINARY\nDATASET POLYDATA\nPOINTS 1 float\n" + std::string(12, '\1') + "\nPOLYGONS 0 0\n"};
      for (const TemplateFile& file : embryo.files)
        if (file.path.ends_with(".vtk")) texts.emplace_back(file.content.substr(0, 20'000));
    }
    const fs::path path = folder / ("altered" + std::string(ending));
    on_altered(texts, rounds(100), [&](const std::string& text) {
      spit(path, text);
      const auto labelled = read_labelled_mesh(path, 1.0);
      ASSERT_TRUE(labelled.ok() || !labelled.error().message.empty());
      if (labelled.ok()) (void)check_mesh(labelled->mesh.position, labelled->mesh.faces);
      if (path.extension() == ".vtk") return;
      const auto surface = read_surface(path);
      if (surface.ok()) (void)check_mesh(surface->position, surface->faces);
    });
  }
}

TEST_F(MutatedInputs, TablesOfCellsAreRefusedWithMessagesOrRead) {
  const UnitSystem units;
  const std::vector<std::string> types{"a", "b"};
  on_altered({"x [um],y [um],z [um],type,radius [um],phase,model\n0,0,0,a,6,0.5,sphere\n12,0,0,b,5.5,0,shell\n# a "
              "comment\n\n-3.5e1,1,2,a,6,0.25,\n"},
             rounds(300), [&](const std::string& text) {
               spit(folder / "cells.csv", text);
               Diagnostics diagnostics;
               const auto cells = read_cells_csv(folder / "cells.csv", "cells.csv", types, {}, units, diagnostics);
               ASSERT_NE(cells.has_value(), diagnostics.error_count() > 0);
             });
}

TEST_F(MutatedInputs, CheckpointsAreReadWholeOrRefused) {
  ShapeLibrary library;
  const Tissue tissue = make_tissue(alone, library);
  const fs::path path = folder / "cp.h5";
  ASSERT_TRUE(write_checkpoint(path, tissue, {"run", "hash", 1.0, ""}, alone).ok());
  const std::string hash = state_hash(tissue, alone).hex();
  const Model model = model_of_test_tissue();
  int refused = 0;
  on_altered({slurp(path)}, rounds(50), [&](const std::string& bytes) {
    spit(path, bytes);
    const auto read = read_checkpoint(path, model, library, alone);
    ASSERT_TRUE(!read.ok() || state_hash(read->tissue, alone).hex() == hash);
    refused += !read.ok();
  });
  EXPECT_GT(refused, 0);
}

TEST_F(MutatedInputs, ResultsAreReadWholeOrRefusedAndNeverStopAWriter) {
  ShapeLibrary library;
  const auto snapshot = [&](double time) {
    Snapshot out;
    out.time = time;
    out.type_names = {"a"};
    for (int c = 1; c <= 5; ++c) {
      Snapshot::Cell cell;
      cell.id = CellId::founder(static_cast<std::uint64_t>(c));
      cell.volume = c + time;
      out.cells.push_back(cell);
    }
    return out;
  };
  const fs::path path = folder / "results.h5";
  for (const double time : {0.0, 1.0, 2.0}) ASSERT_TRUE(append_snapshot(path, snapshot(time), {}, alone).ok());
  const std::string whole = slurp(path);
  Journal change{whole.size(), {{whole.size() / 2, {std::byte{1}, std::byte{2}}}}};
  ASSERT_TRUE(write_journal(path, change).ok());
  const std::string journal = slurp(journal_path(path));
  int refused = 0;
  on_altered({whole}, rounds(50), [&](const std::string& bytes) {
    spit(path, bytes);
    fs::remove(journal_path(path));
    for (const std::size_t index : {0u, 2u}) {
      const auto read = read_snapshot(path, index);
      refused += !read.ok();
      if (!read.ok() || read->time != static_cast<double>(index))
        continue;  // an altered file may have lost its last snapshots, and no more
      for (std::size_t c = 0; c < 5; ++c) ASSERT_EQ(read->cells.at(c).volume, static_cast<double>(c + 1 + index));
    }
    (void)append_snapshot(path, snapshot(3.0), {}, alone);  // a value or an error
  });
  EXPECT_GT(refused, 0);
  // A journal that is not whole is none.
  on_altered({journal}, rounds(50), [&](const std::string& bytes) {
    spit(path, whole);
    spit(journal_path(path), bytes);
    if (bytes == journal) return;
    ASSERT_FALSE(read_journal(path).has_value());
    ASSERT_EQ(list_snapshots(path)->size(), 3u);
  });
}

TEST_F(MutatedInputs, RecordsOfRunsAreReadOrRefused) {
  RunRecord record;
  record.study = "a";
  record.final_state = FinalState{1.0, 2, 1, 1, "0123"};
  record.inputs = {{"a", "b", "c"}};
  on_altered({to_json(record), to_json(RunStatus{})}, rounds(50), [&](const std::string& text) {
    spit(folder / "run.json", text);
    (void)read_run_record(folder / "run.json");
    (void)read_run_status(folder / "run.json");
    (void)event_of_line(text);
  });
  on_altered({"time [s],cell_count [1]\n0,20\n60,21\n120,22.5\n"}, rounds(50), [&](const std::string& text) {
    spit(folder / "series.csv", text);
    const auto series = read_series(folder / "series.csv");
    ASSERT_TRUE(series.ok() || !series.error().message.empty());
  });
}

}  // namespace
}  // namespace morula::scenarios
