#include <algorithm>
#include <numeric>

#include "core/numbers/hash128.h"
#include "results/parcels.h"
#include "results/state_hash.h"
#include "tests/results/results_support.h"

namespace morula::scenarios {
namespace {

using namespace testing_support;

std::string hash_of_text(const std::string& text) { return hash128(std::as_bytes(std::span(text))).hex(); }

// Known answers of MurmurHash3 x64 128, seed 0; the digest prints the first word last here.
TEST(Hash128, GivesTheKnownAnswersOfMurmurHash3) {
  EXPECT_EQ(hash_of_text(""), "00000000000000000000000000000000");
  EXPECT_EQ(hash_of_text("hello"), "5b1e906a48ae1d19cbd8a7b341bd9b02");
  EXPECT_EQ(hash_of_text("The quick brown fox jumps over the lazy dog"), "7a433ca9c49a9347e34bbc7bbc071b6c");
}

TEST(Hash128, AddsModulo2To128) {
  Hash128 sum{~std::uint64_t{0}, 4};
  sum += {1, 0};
  EXPECT_EQ(sum, (Hash128{0, 5}));
  sum = {~std::uint64_t{0}, ~std::uint64_t{0}};
  sum += {1, 0};
  EXPECT_EQ(sum, (Hash128{0, 0}));
}

TEST(Hash128, TableChecksumOfSlicesIsThatOfTheWhole) {
  std::vector<double> table(30);
  std::iota(table.begin(), table.end(), 0.5);
  const auto bytes = std::as_bytes(std::span(table));
  const Hash128 whole = table_checksum(bytes, 24, 0);
  Hash128 slices = table_checksum(bytes.subspan(24 * 4), 24, 4);
  slices += table_checksum(bytes.first(24 * 4), 24, 0);
  EXPECT_EQ(whole, slices);
  std::swap_ranges(table.begin(), table.begin() + 3, table.begin() + 3);  // rows 0 and 1
  EXPECT_NE(table_checksum(bytes, 24, 0), whole);
}

/// What shells of cells and of nuclei have alike.
void append_shell(const dcm::Shells& from, std::size_t i, dcm::Shells& to) {
  to.shape.push_back(from.shape[i]);
  to.type.push_back(from.type[i]);
  to.reference_volume.push_back(from.reference_volume[i]);
  to.rest_volume.push_back(from.rest_volume[i]);
  to.position.insert(to.position.end(), from.position.begin() + from.first_node[i], from.position.begin() + from.first_node[i + 1]);
  to.velocity.insert(to.velocity.end(), from.velocity.begin() + from.first_node[i], from.velocity.begin() + from.first_node[i + 1]);
  to.rest_length.insert(to.rest_length.end(), from.rest_length.begin() + from.first_edge[i],
                        from.rest_length.begin() + from.first_edge[i + 1]);
  to.first_node.push_back(static_cast<std::uint32_t>(to.position.size()));
  to.first_edge.push_back(static_cast<std::uint32_t>(to.rest_length.size()));
}

/// Order of cells in memory turned around, bricks too.
Tissue turned_around(const Tissue& from) {
  Tissue to = from;
  to.cells = from.cells.without_rows();
  for (std::size_t i = from.cells.size(); i-- > 0;) to.cells.push_back(from.cells.state(i));
  std::reverse(to.spheres.position.begin(), to.spheres.position.end());
  std::reverse(to.spheres.radius.begin(), to.spheres.radius.end());
  std::reverse(to.spheres.type.begin(), to.spheres.type.end());
  std::reverse(to.spheres.velocity.begin(), to.spheres.velocity.end());
  to.spheres.attached = {};
  for (std::size_t i = from.spheres.size(); i-- > 0;) to.spheres.attached.push_back(from.spheres.attached[i]);
  to.shells = {};
  for (std::size_t i = from.shells.size(); i-- > 0;) {
    append_shell(from.shells, i, to.shells);
    to.shells.nucleus.push_back(from.shells.nucleus[i]);
    if (!from.shells.faces_of(i).empty()) to.shells.faces_of(to.shells.size() - 1) = from.shells.faces_of(i);
  }
  to.nuclei = {};
  for (std::size_t n = from.nuclei.size(); n-- > 0;) {
    append_shell(from.nuclei.shells, n, to.nuclei.shells);
    to.nuclei.owner.push_back(static_cast<std::uint32_t>(from.shells.size() - 1 - from.nuclei.owner[n]));
  }
  for (fields::Field& field : to.fields) {
    std::reverse(field.owned_bricks.begin(), field.owned_bricks.end());
    std::reverse(field.concentration.begin(), field.concentration.end());
  }
  return to;
}

TEST(StateHash, DoesNotDependOnOrderOrRank) {
  const Comm comm(MPI_COMM_WORLD);
  ShapeLibrary library;
  const Tissue tissue = make_tissue(comm, library);
  const Hash128 hash = state_hash(tissue, comm);
  EXPECT_EQ(hash, state_hash(turned_around(tissue), comm));
  EXPECT_EQ(hash, state_hash(make_tissue(comm, library, 60, 3), comm));
  const Comm alone(MPI_COMM_SELF);
  EXPECT_EQ(hash, state_hash(make_tissue(alone, library), alone)) << "the hash depends on the number of ranks";
}

TEST(StateHash, SeesEveryPartOfTheState) {
  const Comm comm(MPI_COMM_SELF);
  ShapeLibrary library;
  const Tissue tissue = make_tissue(comm, library);
  std::vector<Hash128> hashes{state_hash(tissue, comm)};
  const auto after = [&](auto change) {
    Tissue changed = tissue;
    change(changed);
    hashes.push_back(state_hash(changed, comm));
  };
  after([](Tissue& t) { t.clock.steps++; });
  after([](Tissue& t) { t.clock.capped = false; });
  after([](Tissue& t) { t.ledger.demotions++; });
  after([](Tissue& t) { t.ledger.drift.y += 1e-12; });
  after([](Tissue& t) { t.ledger.rotation.z += 1e-12; });
  after([](Tissue& t) { t.ledger.way += 1e-12; });
  after([](Tissue& t) { t.ledger.fields[0].start = 0.0; });  // was −0.0
  after([](Tissue& t) { t.cells.variables[concentration_of(1)].values.set(5, 0.0); });
  after([](Tissue& t) { t.cells.rows[5].draws++; });
  after([](Tissue& t) {
    t.cells.rows[5].phase = Phase::kDying;
    t.cells.rows[6].phase = Phase::kDying;
  });
  after([](Tissue& t) { t.spheres.velocity[3].y *= 2; });
  after([](Tissue& t) {
    cbm::PartnerLists changed;
    for (std::size_t i = 0; i < t.spheres.size(); ++i) {
      cbm::Partners partners(t.spheres.attached[i].begin(), t.spheres.attached[i].end());
      cbm::set_adheres(partners, CellId::founder(99), i == 0);
      changed.push_back(partners);
    }
    t.spheres.attached = changed;
  });
  after([](Tissue& t) { std::swap(t.spheres.position[0], t.spheres.position[1]); });
  after([](Tissue& t) { t.shells.position[7].z += 1e-13; });
  after([](Tissue& t) { t.shells.velocity[7].z += 1; });
  after([](Tissue& t) { t.shells.rest_length[7] *= 2; });
  after([](Tissue& t) { t.shells.reference_volume[1] *= 2; });
  after([](Tissue& t) {
    for (auto& nucleus : t.shells.nucleus)
      if (nucleus) nucleus->y += 1e-13;
  });
  after([](Tissue& t) { t.nuclei.shells.position[7].z += 1e-13; });
  after([](Tissue& t) { t.nuclei.shells.rest_length[7] *= 2; });
  after([](Tissue& t) { t.shells.faces_of(0).mark.assign(5, 1); });
  after([](Tissue& t) { t.shells.faces_of(0).mark.assign(5, 2); });
  after([](Tissue& t) { t.shells.faces_of(0).contact.assign(5, 0.5f); });
  after([](Tissue& t) { t.lumens[1].amount *= 2; });
  after([](Tissue& t) { t.lumens[1].looked_at = 7.0; });
  after([](Tissue& t) { t.fields[1].concentration[3][2] += 1e-12; });
  after([](Tissue& t) { std::swap(t.fields[0], t.fields[1]); });
  after([](Tissue& t) { t.fields[0].next_step = 0.0; });
  after([](Tissue& t) { t.fields[0].time += 1.0; });
  after([](Tissue& t) { t.fields[0].interval += 1.0; });
  after([](Tissue& t) { t.fields[0].way += 1.0; });
  after([](Tissue& t) { t.obstacle_offset[1].x = 7; });
  for (std::size_t i = 0; i < hashes.size(); ++i)
    for (std::size_t j = i + 1; j < hashes.size(); ++j)
      EXPECT_NE(hashes[i], hashes[j]) << "changes " << i << " and " << j << " have the same hash";
}

TEST(StateHash, IgnoresPadding) {
  const Comm comm(MPI_COMM_SELF);
  ShapeLibrary library;
  Tissue tissue = make_tissue(comm, library);
  const Hash128 hash = state_hash(tissue, comm);
  tissue.cells.rows[0].unused_[2] = 7;
  EXPECT_EQ(hash, state_hash(tissue, comm));
}

TEST(Parcels, AreSortedOverRanksWithoutLoss) {
  const Comm comm(MPI_COMM_WORLD);
  Parcels local;
  std::mt19937_64 engine(7 + static_cast<unsigned>(comm.rank()));
  const int mine = 50 * (comm.rank() + 1);
  for (int i = 0; i < mine; ++i) {
    const std::uint64_t key = engine() % 97;
    const std::vector<std::uint64_t> content(key % 4, key);
    local.add(key, std::as_bytes(std::span(content)));
  }
  const Parcels sorted = sort_over_ranks(local, comm);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    EXPECT_LE(sorted.key(i == 0 ? 0 : i - 1), sorted.key(i));
    ASSERT_EQ(sorted.bytes(i).size(), 8 * (sorted.key(i) % 4));
  }
  EXPECT_EQ(comm.sum(static_cast<std::int64_t>(sorted.size())), comm.sum(std::int64_t{mine}));
  const auto firsts = comm.gather_to_all(sorted.size() == 0 ? -1 : static_cast<std::int64_t>(sorted.key(0)));
  const auto lasts = comm.gather_to_all(sorted.size() == 0 ? -1 : static_cast<std::int64_t>(sorted.key(sorted.size() - 1)));
  std::int64_t last = -1;
  for (std::size_t r = 0; r < firsts.size(); ++r) {
    if (firsts[r] < 0) continue;
    EXPECT_LT(last, firsts[r]) << "equal keys on two ranks, or stretches out of order";
    last = lasts[r];
  }
}

}  // namespace
}  // namespace morula::scenarios
