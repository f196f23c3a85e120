#include "scenarios/initial/make_tissue.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "core/random/philox.h"
#include "core/random/rotation.h"
#include "core/space/curve.h"
#include "coupling/behaviours/birth.h"
#include "coupling/behaviours/growth.h"
#include "coupling/cell_record.h"
#include "coupling/swaps.h"
#include "scenarios/initial/biconcave.h"
#include "scenarios/initial/cells_from_meshes.h"
#include "scenarios/initial/packing.h"
#include "scenarios/study/csv.h"

namespace morula::scenarios {
namespace {

double radius_of(double volume) { return std::cbrt(3.0 * volume / (4.0 * std::numbers::pi)); }

std::string micrometres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g um", length);
  return text;
}

/// A cell whose row and place are settled, its body still to be made.
struct Seedling {
  FullRow row;
  Vec3d center{};
  CellShape shape = CellShape::kSphere;
  Orientation orientation = Orientation::kRandom;
  std::optional<MeshCell> surface{};  ///< its own, instead of a shape
  const MeshCells* meshes = nullptr;
};

/// The rows of one entry with the volumes of time 0.
FullRow founder(const Study& study, const InitialCells& block, std::uint64_t number, std::uint16_t type_index) {
  const CellType& type = study.model.types[type_index];
  FullRow row = make_founder(CellId::founder(number), type_index, type, study.model.seed, 0.0, block.random_age);
  if (block.body_given) row.body = row.own_body = block.body;
  return row;
}

void start_small(FullRow& row, const InitialCells& block) {
  if (!(block.start_volume_fraction < 1.0)) return;
  const double whole = row.target_volume;
  row.target_volume = block.start_volume_fraction * whole;
  row.inflation_left = whole - row.target_volume;
  row.inflation_rate = row.inflation_left / block.inflate_time;
}

/// What a CSV row says about its cell.
void apply_csv(FullRow& row, const CsvCell& csv, const CellType& type) {
  if (csv.radius > 0.0) {
    const double volume = 4.0 / 3.0 * std::numbers::pi * csv.radius * csv.radius * csv.radius;
    row.target_volume *= volume / row.birth_volume;
    row.birth_volume = volume;
    row.division_volume = 2.0 * volume;
  }
  if (csv.phase >= 0.0 && type.cycles) {
    row.target_volume = volume_in_cycle(row.birth_volume, row.division_volume, type.exponential_growth, csv.phase);
    row.birth_time = -csv.phase * row.cycle_duration;
  }
  if (csv.body) row.body = row.own_body = *csv.body;
}

/// The cell has this volume at time 0, whatever the point of its cycle.
void set_volume(FullRow& row, double volume) {
  row.birth_volume *= volume / row.target_volume;
  row.division_volume = 2.0 * row.birth_volume;
  row.target_volume = volume;
}

/// The whole of one entry, the same on every rank.
class Builder {
 public:
  Builder(const Study& study, InitialTissue& out) : study_(study), out_(out) {}

  Status add(const InitialCells& block, std::size_t number) {
    const std::uint64_t first = cells_.size() + 1;
    const std::size_t before = cells_.size();
    switch (block.source) {
      case InitialCells::Source::kFill:
        fill(block, first);
        break;
      case InitialCells::Source::kPositions:
        for (std::size_t i = 0; i < block.positions.size(); ++i)
          cells_.push_back({founder(study_, block, first + i, block.type), block.positions[i]});
        for (std::size_t i = before; i < cells_.size(); ++i) start_small(cells_[i].row, block);
        break;
      case InitialCells::Source::kCsv:
        MORULA_TRY(from_csv(block, first));
        break;
      case InitialCells::Source::kMeshes:
        MORULA_TRY(from_meshes(block, first));
        break;
    }
    for (std::size_t i = before; i < cells_.size(); ++i) {
      cells_[i].shape = block.shape;
      cells_[i].orientation = block.orientation;
    }
    return inside_domain(before, number);
  }
  [[nodiscard]] std::vector<Seedling>& cells() { return cells_; }

 private:
  void fill(const InitialCells& block, std::uint64_t first) {
    std::vector<double> radius;
    bool shells = false;
    for (std::uint64_t i = 0; i < block.count; ++i) {
      cells_.push_back({founder(study_, block, first + i, block.type), {}});
      FullRow& row = cells_.back().row;
      start_small(row, block);
      radius.push_back(radius_of(row.target_volume));
      shells = shells || row.body == BodyKind::kShell;
    }
    // Regions make shells of spheres before the first step: those must not overlap either.
    const bool may_become_shells = shells || !study_.model.swaps.regions.empty();
    const double touch = may_become_shells ? kTouchOfShells : kTouchOfSpheres;
    const Packing packing = pack_cells(block, radius, touch, study_.model.space, first, study_.model.seed);
    for (std::size_t i = 0; i < radius.size(); ++i) cells_[first - 1 + i].center = packing.center[i];
    const std::string who = std::to_string(block.count) + " cells of " + study_.model.types[block.type].name;
    const double tolerance = 0.02 * radius.front();
    if (packing.reach_beyond > tolerance)
      out_.notes.push_back(who + " reach " + micrometres(packing.reach_beyond) + " out of the shape they fill");
    if (packing.worst_overlap > tolerance)
      out_.notes.push_back(who + " start with overlaps of up to " + micrometres(packing.worst_overlap));
  }

  Status from_csv(const InitialCells& block, std::uint64_t first) {
    std::vector<std::string> names;
    for (const CellType& type : study_.model.types) names.push_back(type.name);
    const UnitSystem units;
    Diagnostics diagnostics;
    const auto csv = read_cells_csv(block.csv_path, block.csv_path, names, {}, units, diagnostics);
    if (!csv) return diagnostics.as_error();
    if (csv->cells.size() != block.count)
      return Error{ErrorKind::kInput,
                   "'" + block.csv_path + "' has " + std::to_string(csv->cells.size()) + " cells, but had " + std::to_string(block.count) +
                       " when the study was checked",
                   "leave the file alone while the run starts"};
    std::vector<Vec3d> position;
    for (const CsvCell& cell : csv->cells) position.push_back(cell.position);
    move_apart(position, coincident_groups(position, block.coincident_below), block.coincident_shift, first, study_.model.seed);
    for (std::size_t i = 0; i < position.size(); ++i) {
      const CsvCell& cell = csv->cells[i];
      Seedling& made = cells_.emplace_back(Seedling{founder(study_, block, first + i, cell.type), position[i]});
      apply_csv(made.row, cell, study_.model.types[cell.type]);
      if (block.shared_volume > 0.0) set_volume(made.row, block.shared_volume);
      start_small(made.row, block);
    }
    return {};
  }

  /// The judgement of the surfaces was the check's; here they are only read again.
  Status from_meshes(const InitialCells& block, std::uint64_t first) {
    MeshCellsRead read = read_mesh_cells(block.meshes, block.type, false);
    if (!read.problems.empty()) return Error{ErrorKind::kInput, read.problems.front().text, read.problems.front().help};
    if (read.cells.size() != block.count)
      return Error{ErrorKind::kInput,
                   "the meshes hold " + std::to_string(read.cells.size()) + " cells, but held " + std::to_string(block.count) +
                       " when the study was checked",
                   "leave the files alone while the run starts"};
    for (std::size_t i = 0; i < read.cells.size(); ++i) {
      MeshCell& cell = read.cells[i];
      Seedling& made = cells_.emplace_back(Seedling{founder(study_, block, first + i, cell.type), {}});
      made.center = volume_centroid(cell.mesh.faces, cell.mesh.position);
      const dcm::ShellParameters& shell = study_.model.types[cell.type].shell;
      set_volume(made.row, cell.pressure ? target_volume_of(cell.volume, *cell.pressure, shell.tension, shell.bulk_modulus) : cell.volume);
      made.surface = std::move(cell);
      made.meshes = &block.meshes;
    }
    return {};
  }

  [[nodiscard]] Status inside_domain(std::size_t from, std::size_t number) const {
    const Box& box = study_.model.space.box;
    for (std::size_t i = from; i < cells_.size(); ++i)
      if (!box.contains(cells_[i].center))
        return Error{ErrorKind::kInput,
                     "entry " + std::to_string(number + 1) + " of `initial` puts cell " + cells_[i].row.id.text() + " outside the domain",
                     "make the domain larger, or the cells fewer"};
    return {};
  }

  const Study& study_;
  InitialTissue& out_;
  std::vector<Seedling> cells_;
};

Result<CellRecord> with_body(const Seedling& cell, const Model& model, ShapeLibrary& shapes) {
  CellRecord record;
  record.row = cell.row;
  record.row.order = curve_place(cell.center);
  const CellType& type = model.types[cell.row.type];
  if (cell.surface) {
    MORULA_TRY_ASSIGN(record.shell,
                      shell_of_surface(*cell.surface, *cell.meshes, free_reference_volume(cell.row.target_volume, type), shapes));
    place_nucleus(*record.shell, type, shapes);
    return record;
  }
  if (cell.row.body == BodyKind::kSphere) {
    record.sphere = SphereRecord{cell.center, radius_of(cell.row.target_volume), {}, {}};
    return record;
  }
  MORULA_TRY_ASSIGN(auto shape, shapes.icosphere(type.shell_nodes));
  if (cell.shape == CellShape::kBiconcave) shape = shapes.adopt(biconcave_shape(*shape));
  ShellRecord shell =
      spherical_shell(std::move(shape), cell.center, cell.row.target_volume, free_reference_volume(cell.row.target_volume, type));
  if (cell.orientation == Orientation::kRandom) {
    const Rotation turn = random_rotation(Random(model.seed, RandomStream::kOrientation), cell.row.id, 0);
    for (Vec3d& p : shell.position) p = cell.center + turn * (p - cell.center);
  }
  place_nucleus(shell, type, shapes);
  record.shell = std::move(shell);
  return record;
}

}  // namespace

Result<InitialTissue> make_tissue(const Study& study, ShapeLibrary& shapes, const Comm& comm) {
  InitialTissue out;
  Builder builder(study, out);
  for (std::size_t i = 0; i < study.initial.size(); ++i) MORULA_TRY(builder.add(study.initial[i], i));
  const std::vector<Seedling>& all = builder.cells();
  const auto share = [&](int rank) { return all.size() * static_cast<std::size_t>(rank) / static_cast<std::size_t>(comm.size()); };
  std::vector<CellRecord> mine;
  for (std::size_t i = share(comm.rank()); i < share(comm.rank() + 1); ++i) {
    MORULA_TRY_ASSIGN(CellRecord record, with_body(all[i], study.model, shapes));
    mine.push_back(std::move(record));
  }
  put_together(out.tissue, std::move(mine));
  out.tissue.clock.next_step = study.model.step.initial_step;
  out.tissue.clock.capped = study.model.step.start_cap > 0.0;
  return out;
}

}  // namespace morula::scenarios
