#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <set>

#include "results/damaged_file.h"
#include "results/hdf5_journal.h"
#include "results/hdf5_reader.h"
#include "results/snapshot_file.h"
#include "tests/results/results_support.h"

namespace morula::scenarios {
namespace {

using namespace testing_support;

/// This rank's part of a made-up moment: every third cell a shell, with two topologies.
Snapshot make_snapshot(double time, int cells, const Comm& comm, ShapeLibrary& library) {
  Snapshot out;
  out.time = time;
  out.type_names = {"hepatocyte", "τύπος"};
  for (const auto& shape : {library.icosphere(42).value(), tetrahedron()})
    out.topologies.emplace_back(shape->topology->faces().begin(), shape->topology->faces().end());
  out.variables = {{"amount/oxygen", "amol", {}}, {"concentration/oxygen", "mM", {}}, {"anger", "1", {}}};
  for (int c = 0; c < cells; ++c) {
    if ((c * 5) % comm.size() != comm.rank()) continue;
    const CellId id = CellId::founder(static_cast<std::uint64_t>(cells - c));
    CellNumbers numbers(id.bits());
    Snapshot::Cell cell;
    cell.id = id;
    cell.parent = CellId::founder(1);
    cell.type = static_cast<std::uint16_t>(id.bits() % 2);
    cell.body = id.bits() % 3 == 0 ? BodyKind::kShell : BodyKind::kSphere;
    cell.phase = Phase::kDying;
    cell.centroid = numbers.vector();
    for (double* value : {&cell.volume, &cell.area, &cell.pressure, &cell.inner_pressure, &cell.stress_xx, &cell.stress_xy, &cell.stress_xz,
                          &cell.stress_yy, &cell.stress_yz, &cell.stress_zz, &cell.contact_area, &cell.age, &cell.radius})
      *value = numbers.next() + time;
    for (Snapshot::Variable& variable : out.variables) variable.values.push_back(numbers.next());
    if (cell.body == BodyKind::kShell) {
      const std::uint32_t topology = id.bits() % 2, nodes = topology == 0 ? 42 : 4;
      out.shells.push_back({static_cast<std::uint32_t>(out.cells.size()), static_cast<std::uint32_t>(out.nodes.size()), nodes, topology});
      for (std::uint32_t n = 0; n < nodes; ++n) out.nodes.push_back(numbers.vector());
    }
    out.cells.push_back(cell);
  }
  out.fields.resize(2);
  out.fields[0].name = "oxygen";
  out.fields[1].name = "glucose";
  return out;
}

/// Everything of a snapshot as text, shells by their own faces, so that two can be compared.
std::string description(const Snapshot& s) {
  std::ostringstream out;
  out << std::hexfloat << s.time;
  for (const auto& name : s.type_names) out << ' ' << name;
  for (const auto& variable : s.variables) {
    out << ' ' << variable.name << ' ' << variable.unit;
    for (const double value : variable.values) out << ' ' << value;
  }
  for (const auto& c : s.cells) {
    out << '\n'
        << c.id.text() << ' ' << c.parent.text() << ' ' << c.type << ' ' << int(c.body) << ' ' << int(c.phase) << ' ' << c.centroid.x << ' '
        << c.centroid.y << ' ' << c.centroid.z << ' ' << c.volume << ' ' << c.area << ' ' << c.pressure << ' ' << c.inner_pressure << ' '
        << c.stress_xx << ' ' << c.stress_xy << ' ' << c.stress_xz << ' ' << c.stress_yy << ' ' << c.stress_yz << ' ' << c.stress_zz << ' '
        << c.contact_area << ' ' << c.age << ' ' << c.radius;
  }
  for (const auto& shell : s.shells) {
    out << "\nshell of " << s.cells[shell.cell].id.text();
    for (std::uint32_t n = 0; n < shell.node_count; ++n)
      out << ' ' << s.nodes[shell.first_node + n].x << ' ' << s.nodes[shell.first_node + n].z;
    for (const Triangle& f : s.topologies[shell.topology]) out << ' ' << f[0] << f[1] << f[2];
  }
  return out.str();
}

struct Snapshots : ::testing::Test {
  Comm comm{MPI_COMM_WORLD};
  Comm alone{MPI_COMM_SELF};
  ShapeLibrary library;
  Folder folder{comm};
  std::filesystem::path path = folder / "results.h5";

  Status append(const std::filesystem::path& file, double time, int cells, const Comm& ranks) {
    const std::vector<fields::Field> fields{make_field(0, ranks, 1), make_field(1, ranks, 5)};
    return append_snapshot(file, make_snapshot(time, cells, ranks, library), fields, ranks);
  }
  std::vector<double> times(const std::filesystem::path& file) {
    std::vector<double> out;
    const auto list = list_snapshots(file);
    EXPECT_TRUE(list.ok()) << (list.ok() ? "" : list.error().message);
    if (list.ok())
      for (const auto& entry : *list) out.push_back(entry.time);
    return out;
  }
};

TEST_F(Snapshots, ComeBackBitForBitSortedById) {
  for (const int cells : {30, 0, 1, 31})
    ASSERT_TRUE(append(path, 100.0 + cells + 10 * (cells < 30 ? 100 : cells == 31 ? 200 : 0), cells, comm).ok());
  ASSERT_EQ(times(path).size(), 4u);
  const auto read = read_snapshot(path, 3);
  ASSERT_TRUE(read.ok()) << read.error().message;
  ASSERT_EQ(read->cells.size(), 31u);
  for (std::size_t i = 0; i < 31; ++i) EXPECT_EQ(read->cells[i].id, CellId::founder(i + 1));
  Snapshot expected = make_snapshot(times(path)[3], 31, alone, library);
  std::reverse(expected.cells.begin(), expected.cells.end());  // made in decreasing order of id
  std::reverse(expected.shells.begin(), expected.shells.end());
  for (auto& shell : expected.shells) shell.cell = 30 - shell.cell;
  for (auto& variable : expected.variables) std::reverse(variable.values.begin(), variable.values.end());
  EXPECT_EQ(description(*read), description(expected));
}

TEST_F(Snapshots, FieldsComeBackWithXFastest) {
  ASSERT_TRUE(append(path, 1.0, 3, comm).ok());
  const auto read = read_snapshot(path, 0);
  ASSERT_TRUE(read.ok());
  ASSERT_EQ(read->fields.size(), 2u);
  EXPECT_EQ(read->fields[1].name, "glucose");
  const fields::Field whole = make_field(1, alone, 1);
  const auto [nx, ny, nz] = whole.grid.voxels;
  ASSERT_EQ(read->fields[1].concentration.size(), static_cast<std::size_t>(nx * ny * nz));
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        const int brick = ((z / 8) * whole.grid.bricks[1] + y / 8) * whole.grid.bricks[0] + x / 8;
        const int width = std::min(8, nx - x / 8 * 8), height = std::min(8, ny - y / 8 * 8);
        const double expected =
            whole.concentration[static_cast<std::size_t>(brick)][static_cast<std::size_t>(((z % 8) * height + y % 8) * width + x % 8)];
        ASSERT_EQ(read->fields[1].concentration[static_cast<std::size_t>((z * ny + y) * nx + x)], expected) << x << ' ' << y << ' ' << z;
      }
}

TEST_F(Snapshots, EveryDatasetSaysItsUnits) {
  ASSERT_TRUE(append(path, 1.0, 3, comm).ok());
  const auto file = Hdf5Reader::open(path);
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(file->units("snapshots/000000/cells/pressure").value(), "kPa");
  EXPECT_EQ(file->units("snapshots/000000/shells/node").value(), "um");
  EXPECT_EQ(file->units("snapshots/000000/fields/oxygen/concentration").value(), "mM");
}

TEST_F(Snapshots, AreReplacedAfterARestartAndNeverDoubled) {
  for (const double time : {0.0, 1.0, 2.0, 3.0}) ASSERT_TRUE(append(path, time, 10, comm).ok());
  ASSERT_TRUE(truncate_snapshots(path, 1.5, comm).ok());
  comm.barrier();
  EXPECT_EQ(times(path), (std::vector<double>{0.0, 1.0}));
  comm.barrier();
  for (const double time : {2.0, 3.0, 4.0}) ASSERT_TRUE(append(path, time, 20, comm).ok());
  ASSERT_TRUE(append(path, 3.0, 12, comm).ok());  // again from 3 on, without having cut back
  EXPECT_EQ(times(path), (std::vector<double>{0.0, 1.0, 2.0, 3.0}));
  EXPECT_EQ(read_snapshot(path, 1)->cells.size(), 10u);
  EXPECT_EQ(read_snapshot(path, 2)->cells.size(), 20u);
  EXPECT_EQ(read_snapshot(path, 3)->cells.size(), 12u);
  EXPECT_TRUE(truncate_snapshots(folder / "none.h5", 1.0, comm).ok());
}

TEST_F(Snapshots, SurviveAFullDisk) {
  ASSERT_TRUE(append(path, 0.0, 30, comm).ok());
  const std::string before_failure = slurp(path);
  {
    auto* old_handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit old_limit{};
    ::getrlimit(RLIMIT_FSIZE, &old_limit);
    const rlimit limit{before_failure.size() + 9000, old_limit.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const Status status = append(path, 1.0, 30, comm);
    ::setrlimit(RLIMIT_FSIZE, &old_limit);
    std::signal(SIGXFSZ, old_handler);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().kind, ErrorKind::kResources);
  }
  comm.barrier();
  EXPECT_TRUE(slurp(path) == before_failure) << std::filesystem::file_size(path) << " bytes, were " << before_failure.size();
  comm.barrier();
  const Status again = append(path, 1.0, 30, comm);
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ(times(path).size(), 2u);
}

TEST_F(Snapshots, NoAlteredByteIsReadAsIfItWereWhole) {
  if (!comm.is_root() || comm.size() > 1) return;  // nothing of it is done by several ranks
  for (const double time : {0.0, 1.0}) ASSERT_TRUE(append(path, time, 10, alone).ok());
  const std::string whole = slurp(path);
  const std::string first = description(*read_snapshot(path, 0)), second = description(*read_snapshot(path, 1));
  std::mt19937_64 random(1);
  int noticed = 0;
  for (int i = 0; i < 200; ++i) {
    std::string bytes = whole;
    char& byte = bytes[random() % bytes.size()];
    byte = static_cast<char>(byte ^ (1 << random() % 8));
    spit(path, bytes);
    for (const std::size_t index : {0u, 1u}) {
      const auto read = read_snapshot(path, index);
      if (read.ok()) {
        ASSERT_EQ(description(*read), index == 0 ? first : second) << "change " << i;
      } else {
        ++noticed;
        EXPECT_EQ(read.error().kind, ErrorKind::kFile);
      }
    }
  }
  EXPECT_GT(noticed, 40) << "most bytes are read";
}

TEST_F(Snapshots, AreSetAsideWithTheirJournalUnderANameOfTheirOwn) {
  if (!comm.is_root()) return;
  for (const char* name : {"results.damaged-1.h5", "results.damaged-2.h5"}) {
    spit(path, name);
    spit(journal_path(path), "journal");
    const auto aside = set_aside(path, alone);
    ASSERT_TRUE(aside.ok());
    EXPECT_EQ(*aside, folder / name);
    EXPECT_EQ(slurp(folder / name), name);
    EXPECT_EQ(slurp(journal_path(folder / name)), "journal");
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_FALSE(std::filesystem::exists(journal_path(path)));
  }
  EXPECT_TRUE(set_aside(path, alone)->empty()) << "there is nothing";
  std::filesystem::create_symlink(folder / "results.damaged-1.h5", path);
  EXPECT_TRUE(set_aside(path, alone)->empty()) << "a link is not followed";
}

TEST_F(Snapshots, AJournalLeftByAKilledProcessIsFinishedOrDropped) {
  if (!comm.is_root()) return;
  ASSERT_TRUE(append(path, 0.0, 10, alone).ok());
  const std::string old_bytes = slurp(path);
  ASSERT_TRUE(append(path, 1.0, 20, alone).ok());
  const std::string new_bytes = slurp(path);
  // The moment after the new part and the journal are on disk, and before the old part is changed:
  Journal journal{new_bytes.size(), {}};
  for (std::size_t i = 0; i < old_bytes.size(); ++i)
    if (old_bytes[i] != new_bytes[i]) journal.ranges.push_back({i, {static_cast<std::byte>(new_bytes[i])}});
  ASSERT_FALSE(journal.ranges.empty());
  spit(path, old_bytes + new_bytes.substr(old_bytes.size()));
  ASSERT_TRUE(write_journal(path, journal).ok());
  const std::string whole_journal = slurp(journal_path(path));
  EXPECT_EQ(times(path), (std::vector<double>{0.0, 1.0}));  // the reader sees what the journal says
  EXPECT_EQ(read_snapshot(path, 1)->cells.size(), 20u);
  ASSERT_TRUE(append(path, 2.0, 5, alone).ok());  // the next writer finishes it
  EXPECT_EQ(times(path), (std::vector<double>{0.0, 1.0, 2.0}));
  EXPECT_FALSE(std::filesystem::exists(journal_path(path)));
  // Half way through changing the old part, the journal still there:
  std::string half = old_bytes + new_bytes.substr(old_bytes.size());
  for (std::size_t r = 0; r < journal.ranges.size() / 2; ++r) half[journal.ranges[r].place] = static_cast<char>(journal.ranges[r].bytes[0]);
  spit(path, half);
  spit(journal_path(path), whole_journal);
  EXPECT_EQ(times(path), (std::vector<double>{0.0, 1.0}));
  // Only a part of the journal was written: nothing of the old part has changed yet.
  spit(path, old_bytes + new_bytes.substr(old_bytes.size(), 500));
  spit(journal_path(path), whole_journal.substr(0, whole_journal.size() / 2));
  EXPECT_EQ(times(path), (std::vector<double>{0.0}));
  ASSERT_TRUE(append(path, 2.0, 5, alone).ok());
  EXPECT_EQ(times(path), (std::vector<double>{0.0, 2.0}));
}

TEST_F(Snapshots, SurviveSigkillAtAnyMoment) {
  if (!comm.is_root() || comm.size() > 1) return;
  std::mt19937 engine(5);
  std::size_t most = 0;
  for (int round = 0; round < rounds(12); ++round) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      for (int i = 0;; ++i)
        if (!append(path, i, 20, alone).ok() || ::write(ends[1], "", 1) != 1) ::_exit(1);
    }
    char done = 0;  // every third child has written three before it is killed
    for (int k = 0; k < 3 && round % 3 == 0; ++k) ASSERT_EQ(::read(ends[0], &done, 1), 1);
    ::usleep(5000 + engine() % 60000);
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ::close(ends[0]);
    ::close(ends[1]);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the child stopped by itself";
    if (!std::filesystem::exists(path)) continue;
    const std::vector<double> before = times(path);
    most = std::max(most, before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ(before[i], static_cast<double>(i));
      ASSERT_TRUE(read_snapshot(path, i).ok());
    }
    ASSERT_TRUE(append(path, 1000.0, 7, alone).ok());
    EXPECT_EQ(times(path).size(), before.size() + 1);
  }
  EXPECT_GT(most, 2u);
}

TEST_F(Snapshots, AreCountedByTheirTimes) {
  for (const double time : {0.0, 10.0, 20.0, 30.0}) ASSERT_TRUE(append(path, time, 3, comm).ok());
  const auto earlier = [&](double time, bool with_equal) {
    const auto counts = count_snapshots(path, time, with_equal);
    EXPECT_TRUE(counts.ok());
    EXPECT_EQ(counts->all, 4u);
    return counts->earlier;
  };
  EXPECT_EQ(earlier(-1.0, true), 0u);
  EXPECT_EQ(earlier(0.0, false), 0u);
  EXPECT_EQ(earlier(0.0, true), 1u);
  EXPECT_EQ(earlier(20.0, false), 2u);
  EXPECT_EQ(earlier(20.0, true), 3u);
  EXPECT_EQ(earlier(25.0, true), 3u);
  EXPECT_EQ(earlier(31.0, false), 4u);
  EXPECT_EQ(count_snapshots(folder / "none.h5", 0.0, true).error().kind, ErrorKind::kFile);
}

TEST_F(Snapshots, ThatAreNotThereAreAClearError) {
  EXPECT_EQ(list_snapshots(folder / "none.h5").error().kind, ErrorKind::kFile);
  ASSERT_TRUE(append(path, 0.0, 3, comm).ok());
  const auto read = read_snapshot(path, 7);
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find("no snapshot 7 (it has 1)"), std::string::npos);
  if (comm.is_root()) spit(folder / "text.h5", "this is no HDF5 file");
  comm.barrier();
  EXPECT_EQ(list_snapshots(folder / "text.h5").error().kind, ErrorKind::kFile);
}

}  // namespace
}  // namespace morula::scenarios
