#include "study/initial/place_cells.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/ball.h"
#include "core/random/philox.h"
#include "core/random/rotation.h"
#include "core/space/curve.h"
#include "coupling/behaviours/balanced_growth.h"
#include "coupling/behaviours/birth.h"
#include "coupling/behaviours/growth.h"
#include "coupling/swaps.h"
#include "study/csv.h"
#include "study/initial/biconcave.h"
#include "study/initial/packing.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

constexpr std::uint64_t kMixtureDraw = 4;  // of the stream of positions

std::string micrometres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g um", length);
  return text;
}

/// The rows of one entry with the volumes of time 0.
CellState founder(const Study& study, const InitialCells& block, std::uint64_t number, std::uint16_t type_index) {
  const CellType& type = study.model.types[type_index];
  CellState row = make_founder(CellId::founder(number), type_index, type, study.model.seed, 0.0, block.random_age,
                               cycle_variables_of(study.model.fields.size()));
  if (block.body_given) row.body = row.own_body = block.body;
  return row;
}

void start_small(CellState& row, const InitialCells& block) {
  if (!(block.start_volume_fraction < 1.0)) return;
  const double whole = row.target_volume;
  row.target_volume = block.start_volume_fraction * whole;
  row.inflation_left = whole - row.target_volume;
  row.inflation_rate = row.inflation_left / block.inflate_time;
}

/// The cell has this volume at time 0, whatever the point of its cycle.
void set_volume(CellState& row, const Model& model, double volume) {
  row.birth_volume *= volume / row.target_volume;
  row.division_volume = division_volume(row, model.types[row.type], model.seed);
  row.target_volume = volume;
}

/// What a CSV row says about its cell.
void apply_csv(CellState& row, const CsvCell& csv, const CellType& type, const Model& model) {
  if (csv.phase >= 0.0 && type.cycles)
    set_place(row, type, settle_at(row, type, model.seed, 0.0, csv.phase), cycle_variables_of(model.fields.size()));
  if (csv.radius > 0.0) set_volume(row, model, ball_volume(csv.radius));
  if (csv.body) row.body = row.own_body = *csv.body;
}

/// The type of every cell of a fill: exact counts by largest remainder, in an order drawn by the cells' numbers.
std::vector<std::uint16_t> types_of(const InitialCells& block, std::uint64_t first, std::uint32_t seed) {
  std::vector<std::uint16_t> types(block.count, block.type);
  if (block.mixture.empty()) return types;
  struct Count {
    std::uint64_t whole;
    double rest;
    std::size_t share;
  };
  std::vector<Count> counts;
  std::uint64_t given = 0;
  for (std::size_t k = 0; k < block.mixture.size(); ++k) {
    const double part = block.mixture[k].part * static_cast<double>(block.count);
    const double whole = std::floor(part + 1e-9);
    counts.push_back({static_cast<std::uint64_t>(whole), part - whole, k});
    given += counts.back().whole;
  }
  std::stable_sort(counts.begin(), counts.end(), [](const Count& a, const Count& b) { return a.rest > b.rest + 1e-9; });
  for (std::size_t k = 0; given < block.count; k = (k + 1) % counts.size(), ++given) ++counts[k].whole;
  std::sort(counts.begin(), counts.end(), [](const Count& a, const Count& b) { return a.share < b.share; });

  const Random random(seed, RandomStream::kInitialPosition);
  std::vector<std::pair<double, std::uint64_t>> order;
  for (std::uint64_t i = 0; i < block.count; ++i) order.emplace_back(random.uniform(CellId::founder(first + i), kMixtureDraw).first, i);
  std::sort(order.begin(), order.end());
  std::size_t at = 0;
  for (const Count& count : counts)
    for (std::uint64_t i = 0; i < count.whole && at < order.size(); ++i) types[order[at++].second] = block.mixture[count.share].type;
  return types;
}

/// The whole of all entries, the same on every rank.
class Placer {
 public:
  Placer(const Study& study, Surroundings around, int threads, PlacedCells& out)
      : study_(study), around_(std::move(around)), threads_(threads), out_(out) {}

  Status add(const InitialCells& block, std::size_t entry) {
    const std::uint64_t first = out_.cells.size() + 1;
    const std::size_t before = out_.cells.size();
    switch (block.source) {
      case InitialCells::Source::kFill:
        fill(block, first, entry);
        break;
      case InitialCells::Source::kPositions:
        for (std::size_t i = 0; i < block.positions.size(); ++i)
          out_.cells.push_back({founder(study_, block, first + i, block.type), block.positions[i]});
        for (std::size_t i = before; i < out_.cells.size(); ++i) start_small(out_.cells[i].row, block);
        break;
      case InitialCells::Source::kCsv:
        MORULA_TRY(from_csv(block, first));
        break;
      case InitialCells::Source::kMeshes:
        MORULA_TRY(from_meshes(block, first));
        break;
    }
    for (std::size_t i = before; i < out_.cells.size(); ++i) {
      PlacedCell& cell = out_.cells[i];
      cell.shape = block.shape;
      cell.orientation = block.orientation;
      cell.entry = entry;
    }
    inside_domain(before, entry);
    for (std::size_t i = before; i < out_.cells.size(); ++i) around_.add(out_.cells[i].center, out_.cells[i].radius());
    return {};
  }

 private:
  void fill(const InitialCells& block, std::uint64_t first, std::size_t entry) {
    if (block.count == 0) return;
    const std::vector<std::uint16_t> types = types_of(block, first, study_.model.seed);
    std::vector<double> radius;
    std::vector<PlacedCell> cells;
    bool shells = false;
    for (std::uint64_t i = 0; i < block.count; ++i) {
      cells.push_back({founder(study_, block, first + i, types[i]), {}});
      CellState& row = cells.back().row;
      start_small(row, block);
      radius.push_back(cells.back().radius());
      shells = shells || row.body == BodyKind::kShell;
    }
    // Regions make shells of spheres before the first step: those must not overlap either.
    const bool may_become_shells = shells || !study_.model.swaps.regions.empty();
    const double touch = may_become_shells ? kTouchOfShells : kTouchOfSpheres;
    around_.prepare(*std::max_element(radius.begin(), radius.end()), touch);
    const Packing packing = places(block, radius, touch, first);
    const std::string who = std::to_string(block.count) + " cells of " + names(block);
    const double tolerance = std::max(0.02 * radius.front(), packing.allowed_overlap);
    if (packing.jammed) {
      out_.problems.push_back(
          {658, entry,
           who + " cannot be packed so densely at random: they have " +
               short_number(std::round(100.0 * filled_part(block, radius)) / 100.0) + " times its volume and still overlap by " +
               micrometres(packing.worst_overlap),
           std::string("make the shape larger or the cells fewer (balls drawn at random fill up to 0.64 of it), or write `fill: ") +
               (block.fill == FillShape::kBox ? "box" : "sphere") + "`, which puts them in order"});
      return;
    }
    if (packing.room < block.count || packing.worst_intrusion > tolerance) {
      const bool few = packing.room < block.count;
      out_.problems.push_back({658, entry,
                               who + " find no room" + (block.pattern == FillPattern::kPacked ? " beside what is there already" : "") +
                                   ": " +
                                   (few ? "there are places for " + std::to_string(packing.room) : deepest_of(packing, radius, touch)),
                               "make the shape larger or the cells fewer, or move away what is there"});
      return;
    }
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i].center = packing.center[i];
    out_.cells.insert(out_.cells.end(), std::make_move_iterator(cells.begin()), std::make_move_iterator(cells.end()));
    if (packing.reach_beyond > tolerance)
      out_.notes.push_back(who + " reach " + micrometres(packing.reach_beyond) + " out of the shape they fill");
    if (packing.worst_overlap > tolerance)
      out_.notes.push_back(who + " start with overlaps of up to " + micrometres(packing.worst_overlap));
  }

  [[nodiscard]] Packing places(const InitialCells& block, std::span<const double> radius, double touch, std::uint64_t first) const {
    const Space& space = study_.model.space;
    const std::uint32_t seed = study_.model.seed;
    switch (block.pattern) {
      case FillPattern::kLayer:
        return layer_cells(block, radius, touch, space, around_, threads_);
      case FillPattern::kRandom:
        return scatter_cells(block, radius, touch, space, first, seed, around_, threads_);
      case FillPattern::kPacked:
        break;
    }
    return pack_cells(block, radius, touch, space, first, seed, around_, threads_);
  }

  /// Which of these cells lies how deep in what.
  [[nodiscard]] std::string deepest_of(const Packing& packing, std::span<const double> radius, double touch) const {
    std::size_t worst = 0;
    double deepest = -1e300;
    Vec3d ignored;
    for (std::size_t i = 0; i < packing.center.size(); ++i)
      if (const double depth = around_.push(packing.center[i], radius[i], touch, ignored); depth > deepest) {
        deepest = depth;
        worst = i;
      }
    return "the one of radius " + micrometres(radius[worst]) + " would lie " + micrometres(deepest) + " deep in " +
           around_.what_is_at(packing.center[worst], radius[worst], touch);
  }

  [[nodiscard]] std::string names(const InitialCells& block) const {
    std::string out = study_.model.types[block.type].name;
    for (std::size_t k = 1; k < block.mixture.size(); ++k) out += " and " + study_.model.types[block.mixture[k].type].name;
    return out;
  }

  Status from_csv(const InitialCells& block, std::uint64_t first) {
    std::vector<std::string> names;
    for (const CellType& type : study_.model.types) names.push_back(type.name);
    const UnitSystem units;
    Diagnostics diagnostics;
    const auto csv = read_cells_csv(block.csv_path, block.csv_path, names, {}, units, diagnostics, block.csv_unit);
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
      PlacedCell& made = out_.cells.emplace_back(PlacedCell{founder(study_, block, first + i, cell.type), position[i]});
      apply_csv(made.row, cell, study_.model.types[cell.type], study_.model);
      if (!block.room.empty()) set_volume(made.row, study_.model, block.room[i]);
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
      PlacedCell& made = out_.cells.emplace_back(PlacedCell{founder(study_, block, first + i, cell.type), {}});
      made.center = volume_centroid(cell.mesh.faces, cell.mesh.position);
      const CellType& type = study_.model.types[cell.type];
      const double tension = type.shell.tension * (1.0 + deviation(made.row, type, Trait::kTension));
      set_volume(made.row, study_.model,
                 cell.pressure ? target_volume_of(cell.volume, *cell.pressure, tension, type.shell.bulk_modulus) : cell.volume);
      made.surface = std::move(cell);
      made.meshes = &block.meshes;
    }
    return {};
  }

  /// Cells outside the domain are a problem of their entry.
  void inside_domain(std::size_t from, std::size_t entry) const {
    const Box& box = study_.model.space.box;
    for (std::size_t i = from; i < out_.cells.size(); ++i)
      if (!box.contains(out_.cells[i].center)) {
        out_.problems.push_back(
            {505, entry,
             "entry " + std::to_string(entry + 1) + " of `initial` puts cell " + out_.cells[i].row.id.text() + " outside the domain",
             "make the domain larger, or the cells fewer"});
        return;
      }
  }

  const Study& study_;
  Surroundings around_;
  int threads_;
  PlacedCells& out_;
};

}  // namespace

double PlacedCell::radius() const { return ball_radius(row.target_volume); }

Result<PlacedCells> place_cells(const Study& study, int threads) {
  PlacedCells out;
  MORULA_TRY_ASSIGN(Surroundings around, Surroundings::of(study.model));
  Placer placer(study, std::move(around), threads, out);
  for (std::size_t i = 0; i < study.initial.size(); ++i) MORULA_TRY(placer.add(study.initial[i], i));
  return out;
}

Result<CellRecord> with_body(const PlacedCell& cell, const Model& model, ShapeLibrary& shapes) {
  CellRecord record;
  record.row = cell.row;
  record.row.order = curve_place(cell.center);
  const CellType& type = model.types[cell.row.type];
  const double reference = free_reference_volume(cell.row.target_volume, type, deviation(cell.row, type, Trait::kTension));
  if (cell.surface) {
    MORULA_TRY_ASSIGN(record.shell, shell_of_surface(*cell.surface, *cell.meshes, reference, shapes));
    place_nucleus(*record.shell, type, shapes);
    return record;
  }
  if (cell.row.body == BodyKind::kSphere) {
    record.sphere = SphereRecord{cell.center, ball_radius(cell.row.target_volume), {}, {}};
    return record;
  }
  MORULA_TRY_ASSIGN(auto shape, shapes.icosphere(type.shell_nodes));
  if (cell.shape == CellShape::kBiconcave) shape = shapes.adopt(biconcave_shape(*shape));
  ShellRecord shell = spherical_shell(std::move(shape), cell.center, cell.row.target_volume, reference);
  if (cell.orientation == Orientation::kRandom) {
    const Rotation turn = random_rotation(Random(model.seed, RandomStream::kOrientation), cell.row.id, 0);
    for (Vec3d& p : shell.position) p = cell.center + turn * (p - cell.center);
  }
  place_nucleus(shell, type, shapes);
  record.shell = std::move(shell);
  return record;
}

}  // namespace morula::scenarios
