#pragma once
#include <gtest/gtest.h>
#include <mpi.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "core/parallel/comm.h"
#include "core/parallel/quiet_mpi.h"
#include "coupling/tissue.h"
#include "results/checkpoint.h"

namespace morula::scenarios::testing_support {

/// MPI for the tests of this program, whether started by mpirun or not.
class MpiEnvironment : public ::testing::Environment {
 public:
  void SetUp() override {
    int running = 0;
    MPI_Initialized(&running);
    if (running == 0) {
      quiet_mpi();
      MPI_Init(nullptr, nullptr);
      ours_ = true;
    }
  }
  void TearDown() override {
    if (ours_) MPI_Finalize();
  }

 private:
  bool ours_ = false;
};
inline ::testing::Environment* const kMpiEnvironment = ::testing::AddGlobalTestEnvironment(new MpiEnvironment);

/// A folder of its own for a test, the same on all ranks, gone afterwards.
class Folder {
 public:
  explicit Folder(const Comm& comm, const std::string& parent = "/tmp") : comm_(comm) {
    std::string name = parent + "/morula_results_XXXXXX";
    if (comm.is_root()) {
      EXPECT_NE(::mkdtemp(name.data()), nullptr);
    }
    std::vector<std::byte> bytes(name.size());
    std::memcpy(bytes.data(), name.data(), name.size());
    comm.broadcast(bytes);
    path_ = std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  ~Folder() {
    comm_.barrier();
    std::error_code ignored;
    if (comm_.is_root()) std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  Comm comm_;
  std::filesystem::path path_;
};

/// How often something is tried at random: MORULA_ROUNDS=100 tries it a hundred times as often.
inline int rounds(int count) {
  const char* more = std::getenv("MORULA_ROUNDS");
  return count * (more != nullptr ? std::max(1, std::atoi(more)) : 1);
}

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
inline void spit(const std::filesystem::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

/// Numbers for one cell that depend on its id only.
class CellNumbers {
 public:
  explicit CellNumbers(std::uint64_t seed) : engine_(seed * 2654435761u + 17) {}
  double next() { return std::uniform_real_distribution<double>(-100.0, 100.0)(engine_); }
  Vec3d vector() {
    const double x = next(), y = next(), z = next();
    return {x, y, z};
  }
  Vec3f vector_f() {
    const Vec3d v = vector();
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  }

 private:
  std::mt19937_64 engine_;
};

inline std::shared_ptr<const ReferenceShape> tetrahedron() {
  auto topology = Topology::build(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  EXPECT_TRUE(topology.ok());
  return make_reference_shape(topology.value(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
}

inline Model model_of_test_tissue() {
  Model model;
  model.types.resize(3);
  model.types[1].interior.nucleus_fraction = 0.07;
  model.types[2].interior.nucleus_fraction = 0.05;
  model.types[2].interior.nucleus_nodes = 42;
  model.obstacles.resize(2);
  model.fields.resize(2);
  model.fields[0].name = "oxygen";
  model.fields[1].name = "glucose";
  model.lumens.resize(2);
  model.lumens[0].name = "lumen";
  model.lumens[1].name = "cyst";
  return model;
}

inline CellState make_row(CellId id, BodyKind body) {
  CellNumbers numbers(id.bits());
  CellState row;
  row.id = id;
  row.parent = CellId::founder(3);
  row.order = (id.bits() * 7919) % 64;  // many cells share a place along the curve
  for (double* value : {&row.birth_time, &row.birth_volume, &row.target_volume, &row.division_volume, &row.cycle_duration, &row.pressure,
                        &row.death_time, &row.last_swap_time, &row.reference_excess})
    *value = numbers.next();
  row.polarity = numbers.vector();
  row.migration_velocity = numbers.vector();
  for (std::size_t f = 0; f < 2; ++f) {
    row.variables.push_back(numbers.next());
    row.variables.push_back(-0.0);
  }
  row.draws = id.bits() % 5;
  row.type = static_cast<std::uint16_t>(id.bits() % 3);
  row.phase = static_cast<Phase>(id.bits() % 4);
  row.body = body;
  row.own_body = id.bits() % 2 == 0 ? BodyKind::kSphere : BodyKind::kShell;
  return row;
}

inline void add_sphere(cbm::Spheres& spheres, CellId id) {
  CellNumbers numbers(id.bits() + 1000);
  spheres.position.push_back(numbers.vector());
  spheres.radius.push_back(numbers.next());
  spheres.type.push_back(static_cast<std::uint16_t>(id.bits() % 3));
  spheres.velocity.push_back(numbers.vector_f());
  cbm::Partners partners;
  for (std::uint64_t p = 0; p < id.bits() % 4; ++p) partners.push_back(CellId::founder(p + 1));
  spheres.attached.push_back(partners);
}

inline void add_shell(dcm::Shells& shells, CellId id, const std::shared_ptr<const ReferenceShape>& shape) {
  CellNumbers numbers(id.bits() + 2000);
  shells.shape.push_back(shape);
  shells.first_node.push_back(shells.first_node.back() + shape->topology->node_count());
  shells.first_edge.push_back(shells.first_edge.back() + shape->topology->edge_count());
  shells.type.push_back(static_cast<std::uint16_t>(id.bits() % 3));
  shells.reference_volume.push_back(numbers.next());
  shells.rest_volume.push_back(numbers.next());
  for (std::uint32_t n = 0; n < shape->topology->node_count(); ++n) {
    shells.position.push_back(numbers.vector());
    shells.velocity.push_back(numbers.vector_f());
  }
  for (std::uint32_t e = 0; e < shape->topology->edge_count(); ++e) shells.rest_length.push_back(numbers.next());
  shells.nucleus.push_back(id.bits() % 3 == 1 ? std::optional(numbers.vector()) : std::nullopt);
  if (id.bits() % 2 == 0) return;  // some shells have no marks
  for (std::uint32_t f = 0; f < shape->topology->face_count(); ++f) {
    shells.faces_of(shells.size() - 1).mark.push_back(static_cast<std::uint8_t>((id.bits() + 3 * f) % 256));
    if (id.bits() % 3 == 0) shells.faces_of(shells.size() - 1).contact.push_back(static_cast<float>(numbers.next()));
  }
}

/// What a checkpoint of the tests says of its run.
inline const CheckpointInfo kInfo{"spheroid-0001", "abcdef", 12.5, ""};

/// A test that writes and reads checkpoints of the test tissue.
struct CheckpointTest : ::testing::Test {
  Comm comm{MPI_COMM_WORLD};
  ShapeLibrary library;
  Folder folder{comm};
  Model model = model_of_test_tissue();
};

inline fields::Field make_field(int index, const Comm& comm, int spread) {
  fields::Field field;
  field.grid.box.low = {-10.0, -20.0, -30.0};
  field.grid.box.high = {10.0 + index, 20.0, 30.0};
  field.grid.voxels = {20, 17, 9};
  field.grid.bricks = {3, 3, 2};
  field.next_step = 0.25 * (index + 1);
  field.time = 60.0 * (index + 1);
  field.interval = 7.0 * (index + 1);
  field.way = 0.5 * (index + 1);
  for (std::int64_t brick = 0; brick < field.grid.brick_count(); ++brick) {
    if ((brick * spread) % comm.size() != comm.rank()) continue;
    CellNumbers numbers(static_cast<std::uint64_t>(brick + 100 * index));
    std::size_t count = 1;
    std::int64_t rest = brick;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t along = rest % field.grid.bricks[axis];
      rest /= field.grid.bricks[axis];
      count *= static_cast<std::size_t>(std::min<std::int64_t>(8, field.grid.voxels[axis] - 8 * along));
    }
    field.owned_bricks.push_back(brick);
    auto& values = field.concentration.emplace_back();
    for (std::size_t v = 0; v < count; ++v) values.push_back(numbers.next());
  }
  return field;
}

/// A tissue whose content does not depend on the number of ranks; `spread` says which rank gets which cell and brick.
inline Tissue make_tissue(const Comm& comm, ShapeLibrary& library, int cells = 60, int spread = 1) {
  Tissue tissue;
  tissue.clock = {123.456, 17.25, 4711, true};
  for (int f = 0; f < 2; ++f) tissue.ledger.fields.push_back({1.5 + f, 0.1 * f, 3.0, -0.0});
  tissue.cells.declare(cell_variables(model_of_test_tissue()));
  tissue.ledger.divisions = 5;
  tissue.ledger.deaths = 6;
  tissue.ledger.promotions = 7;
  tissue.ledger.demotions = 8;
  tissue.ledger.drift = {0.5, -0.25, 1e-9};
  tissue.ledger.rotation = {1e-3, 0.0, -2e-3};
  tissue.ledger.way = 12.5;
  tissue.obstacle_offset = {{1, 2, 3}, {4, 5, 6}};
  tissue.lumens = {{10.5, 3.25, 1e5, 0.02, 4e3, 0.97}, {-1e300, 7.0, 0.0, 0.0, 0.0, 0.0}};
  const auto tetra = tetrahedron();
  std::vector<CellState> rows;
  for (int c = 0; c < cells; ++c) {
    if ((c * spread) % comm.size() != comm.rank()) continue;
    CellId id = CellId::founder(static_cast<std::uint64_t>(cells - c));
    if (c % 5 == 0) id = id.daughter(c % 2);
    rows.push_back(make_row(id, c % 3 == 0 ? BodyKind::kShell : BodyKind::kSphere));
  }
  std::sort(rows.begin(), rows.end(), before);
  for (const CellState& row : rows) tissue.cells.push_back(row);
  for (const CellRow& row : tissue.cells.rows) {
    if (row.body == BodyKind::kSphere)
      add_sphere(tissue.spheres, row.id);
    else if (row.id.founder_number() % 2 == 0)
      add_shell(tissue.shells, row.id, tetra);
    else
      add_shell(tissue.shells, row.id, library.icosphere(42).value());
    if (row.body == BodyKind::kShell && row.type == 2) {
      add_shell(tissue.nuclei.shells, CellId::founder(row.id.founder_number() + 300), library.icosphere(42).value());
      tissue.nuclei.shells.type.back() = row.type;
      tissue.nuclei.shells.nucleus.clear();
      tissue.nuclei.shells.face.clear();
      tissue.nuclei.owner.push_back(static_cast<std::uint32_t>(tissue.shells.size() - 1));
    }
  }
  for (int f = 0; f < 2; ++f) tissue.fields.push_back(make_field(f, comm, spread));
  return tissue;
}

}  // namespace morula::scenarios::testing_support
