// Lineages of a run: lives from its first snapshot and its events.
#include "results/lineage.h"

#include <gtest/gtest.h>

#include "core/cell_id_text.h"
#include "results/file_io.h"
#include "results/snapshot_file.h"
#include "tests/results/results_support.h"

namespace morula::scenarios {
namespace {

class Lineage : public ::testing::Test {
 protected:
  Lineage() {
    Snapshot first;
    first.type_names = {"egg", "wall"};
    for (std::uint64_t number : {2, 11}) {
      Snapshot::Cell& cell = first.cells.emplace_back();
      cell.id = CellId::founder(number);
      cell.type = number == 2 ? 0 : 1;
      cell.age = number == 2 ? 600.0 : 0.0;
      cell.radius = 5.0;
    }
    append(first);
  }
  void append(const Snapshot& snapshot) {
    const Status status = append_snapshot(results(), snapshot, {}, Comm());
    EXPECT_TRUE(status.ok()) << status.error().message;
  }
  [[nodiscard]] std::filesystem::path results() const { return folder_ / "results.h5"; }
  /// `last`: who lives at the end, after two hours.
  Result<std::vector<CellLife>> read(const std::string& events, std::initializer_list<const char*> last) {
    Snapshot snapshot;
    snapshot.type_names = {"egg", "wall"};
    snapshot.time = 7200.0;
    for (const char* id : last) snapshot.cells.emplace_back().id = cell_id_of(id).value();
    append(snapshot);
    EXPECT_TRUE(write_file_atomically(folder_ / "events.jsonl", events).ok());
    return read_lineage(results(), folder_ / "events.jsonl");
  }
  std::vector<CellLife> lives(const std::string& events, std::initializer_list<const char*> last = {"2.00", "2.01", "11"}) {
    auto out = read(events, last);
    EXPECT_TRUE(out.ok()) << out.error().message;
    return out.ok() ? *out : std::vector<CellLife>{};
  }
  testing_support::Folder folder_{Comm()};
};

constexpr const char* kEvents =
    "{\"time_s\":1200.0,\"kind\":\"division\",\"cell\":\"2\",\"daughters\":[\"2.0\",\"2.1\"],\"volume_um3\":1000.0,"
    "\"birth_volumes_um3\":[300.0,700.0],\"text\":\"\"}\n"
    "{\"time_s\":1300.0,\"kind\":\"promotion\",\"cell\":\"2.0\",\"text\":\"\"}\n"
    "{\"time_s\":3000.0,\"kind\":\"death\",\"cell\":\"2.1\",\"text\":\"\"}\n"
    "{\"time_s\":4800.0,\"kind\":\"division\",\"cell\":\"2.0\",\"daughters\":[\"2.00\",\"2.01\"],\"text\":\"\"}\n"
    "{\"time_s\":6000.0,\"kind\":\"removal\",\"cell\":\"2.1\",\"text\":\"\"}\n"
    "{\"time_s\":6600.0,\"kind\":\"death\",\"cell\":\"2.01\",\"text\":\"\"}\n"
    "{\"time_s\":9000.0,\"kind\":\"division\",\"cell\":\"11\",\"daughters\":[\"11.0\",\"11.1\"],\"text\":\"\"}\n";

TEST_F(Lineage, DaughtersAreOfTheTypesThatTheDivisionTells) {
  const std::vector<CellLife> found = lives(
      "{\"time_s\":1200.0,\"kind\":\"division\",\"cell\":\"2\",\"daughters\":[\"2.0\",\"2.1\"],\"birth_types\":[\"egg\",\"wall\"],"
      "\"text\":\"\"}\n",
      {"2.0", "2.1", "11"});
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[1].type, "egg");
  EXPECT_EQ(found[2].id, "2.1");
  EXPECT_EQ(found[2].type, "wall");
}

TEST_F(Lineage, TellsEveryLifeFromBirthToEnd) {
  EXPECT_EQ(lineage_csv(lives(kEvents)),
            "id,parent,type,birth [s],end [s],how,birth volume [um^3],division volume [um^3]\n"
            "2,0,egg,-600,1200,divided,,1000\n"
            "2.0,2,egg,1200,4800,divided,300,\n"
            "2.1,2,egg,1200,6000,died,700,\n"
            "2.00,2.0,egg,4800,7200,alive,,\n"
            "2.01,2.0,egg,4800,7200,dying,,\n"
            "11,0,wall,0,7200,alive,,\n")
      << "what comes after the last snapshot is not told";
}

/// A division that is gone from the file would leave its mother alive for ever.
TEST_F(Lineage, IsRefusedWhereEventsAndTheLastSnapshotDisagree) {
  std::string events = kEvents;
  events.erase(0, events.find('\n') + 1);
  const auto found = read(events, {"2.00", "2.01", "11"});
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().kind, ErrorKind::kFile);
  EXPECT_NE(found.error().message.find("differ in who lives"), std::string::npos) << found.error().message;
}

TEST_F(Lineage, IsATreeForEachFounder) {
  EXPECT_EQ(lineage_newick(lives(kEvents)),
            "((2.00:0.6666666666666666,2.01:0.6666666666666666)2.0:1,2.1:1.3333333333333333)2:0.5;\n11:2;\n");
}

TEST_F(Lineage, IsWrittenIntoAFolder) {
  lives(kEvents);
  const auto cells = export_lineage(results(), folder_ / "events.jsonl", folder_ / "lineage");
  ASSERT_TRUE(cells.ok());
  EXPECT_EQ(*cells, 6u);
  EXPECT_EQ(read_file(folder_ / "lineage" / "lineage.csv").value().substr(0, 3), "id,");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "lineage" / "lineage.nwk"));
  EXPECT_FALSE(read_lineage(folder_ / "none.h5", folder_ / "events.jsonl").ok());
}

}  // namespace
}  // namespace morula::scenarios
