#include "study/initial/judge_places.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "coupling/cell_variables.h"
#include "coupling/overlap.h"
#include "coupling/simulation.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

constexpr double kWithin = 0.5;             // of the larger radius: nearer centres are not driven apart by the contact of the surfaces
constexpr double kCertain = 2.0;            // times the limit: meshes lie a little within their balls
constexpr double kSamePlace = 1e-6;         // of the larger radius
constexpr double kDeepSpheres = 0.5;        // of the sum of the radii: nearer spheres are far outside what their contact law was made for
constexpr std::size_t kMostNodes = 200000;  // whose contact is measured: a second

std::string place_text(const Vec3d& p) { return "[" + short_number(p.x) + ", " + short_number(p.y) + ", " + short_number(p.z) + "] um"; }
std::string rounded(double length) { return short_number(std::round(100.0 * length) / 100.0) + " um"; }

/// The worst of one kind between two entries, and how many there are.
struct Worst {
  double depth = -1e300;
  std::size_t count = 0;
  PlaceProblem problem;
};

class Judge {
 public:
  Judge(const Study& study, std::span<const PlacedCell> cells, const Surroundings& around)
      : study_(study), cells_(cells), around_(around), capped_(study.model.step.start_cap > 0.0) {
    for (const PlacedCell& cell : cells_) {
      center_.push_back(cell.center);
      radius_.push_back(cell.radius());
      bound_.push_back(is_shell(cell) ? bounding_radius(cell) : radius_.back());
    }
  }

  Result<JudgedPlaces> judge() {
    judge_each_other();
    judge_surfaces();
    const bool certain =
        !worst_.empty() && std::any_of(worst_.begin(), worst_.end(), [](const auto& w) { return !w.second.problem.is_warning; });
    if (!certain && !capped_) MORULA_TRY(measure_shells());
    for (auto& [key, worst] : worst_) {
      if (worst.count > 1) worst.problem.text += " (and " + std::to_string(worst.count - 1) + " more like this)";
      out_.problems.push_back(std::move(worst.problem));
    }
    return std::move(out_);
  }

 private:
  using Key = std::array<std::size_t, 3>;  // code, entry, other entry or surface

  static bool is_shell(const PlacedCell& cell) { return cell.surface.has_value() || cell.row.body == BodyKind::kShell; }
  /// Only the balls of spherical shells tell how deep they are.
  static bool is_ball(const PlacedCell& cell) { return !cell.surface && (cell.shape == CellShape::kSphere || !is_shell(cell)); }

  /// Of all points of a shell's mesh, about its centre [µm].
  [[nodiscard]] double bounding_radius(const PlacedCell& cell) const {
    if (cell.surface) {
      double square = 0.0;
      for (const Vec3d& p : cell.surface->mesh.position) square = std::max(square, norm2(p - cell.center));
      return std::sqrt(square);
    }
    if (cell.shape == CellShape::kBiconcave) return 1.5 * cell.radius();  // 3.91 µm for a volume of 94.1 µm³
    // The mesh encloses the ball's volume: its nodes lie out of the ball, by 4.6 % at 42 nodes and a quarter of that for each level.
    return cell.radius() * (1.0 + 0.046 * 42.0 / static_cast<double>(study_.model.types[cell.row.type].shell_nodes));
  }

  /// What comes of an overlap beyond `limits.overlap`: a capped start passes it, its check does not.
  [[nodiscard]] std::string too_deep() const {
    return capped_ ? ": the check INV.4 counts the start, too, and will fail" : ": the run would stop at its limit";
  }
  /// How cells that begin so deep come out [µm].
  [[nodiscard]] std::string let_apart(double depth) const {
    const std::string limit = "`limits: {overlap: " + short_number(std::ceil(1.2 * depth * 10.0) / 10.0) + " um}`";
    return capped_ ? limit : "let them come apart first with `numerics: {start_cap: auto}` and " + limit;
  }

  void add(int code, std::size_t entry, std::size_t other, double depth, PlaceProblem problem) {
    Worst& worst = worst_[{static_cast<std::size_t>(code), entry, other}];
    ++worst.count;
    if (depth <= worst.depth) return;
    worst.depth = depth;
    problem.code = code;
    problem.entry = entry;
    worst.problem = std::move(problem);
  }

  void judge_each_other() {
    if (cells_.size() < 2) return;
    const CellGrid grid(center_, 2.0 * *std::max_element(bound_.begin(), bound_.end()), study_.model.space);
    for (std::size_t i = 0; i < cells_.size(); ++i)
      grid.near(center_[i], [&](std::size_t j) {
        if (j > i) judge_pair(i, j, norm(study_.model.space.nearest_image(center_[j] - center_[i])));
      });
  }

  void judge_pair(std::size_t i, std::size_t j, double apart) {
    if (apart >= bound_[i] + bound_[j]) return;
    const double larger = std::max(radius_[i], radius_[j]), touch = radius_[i] + radius_[j], depth = touch - apart;
    const bool shells = is_shell(cells_[i]) && is_shell(cells_[j]), balls = is_ball(cells_[i]) && is_ball(cells_[j]);
    const std::size_t entry = cells_[j].entry, other = cells_[i].entry;
    const bool meshes = cells_[i].surface && cells_[j].surface && entry == other;  // the check of the files has measured these
    if (apart < kSamePlace * larger || (shells && balls && apart < kWithin * larger))
      return add(596, entry, other, depth,
                 {.text = "a cell at " + place_text(center_[j]) + " lies within another one: its centre is " + short_number(apart) +
                          " um from " + place_text(center_[i]),
                  .help = "place them at least " + short_number(larger) +
                          " um apart; smaller overlaps come apart with `numerics: {start_cap: auto}`"});
    if (!shells) {
      if (apart < kDeepSpheres * touch)
        add(661, entry, other, depth,
            {.text = "cells at " + place_text(center_[i]) + " and " + place_text(center_[j]) + " begin " + rounded(depth) +
                     " deep in each other: they will be driven apart at once",
             .help = "place them " + short_number(std::ceil(10.0 * touch) / 10.0) + " um apart",
             .is_warning = true});
      return;
    }
    const double limit = study_.model.limits.overlap;
    if (meshes && study_.initial[entry].meshes.overlap <= limit) return;
    if (balls && depth > kCertain * limit)
      return add(
          597, entry, other, depth,
          {.text = "cells at " + place_text(center_[i]) + " and " + place_text(center_[j]) + " overlap by " + rounded(depth) + too_deep(),
           .help = "place them " + short_number(std::ceil(10.0 * touch) / 10.0) + " um apart, or " + let_apart(depth),
           .is_warning = capped_});
    if (capped_) return;
    if (bound_[i] + bound_[j] - apart > limit) suspects_.insert({i, j});
  }

  void judge_surfaces() {
    for (std::size_t surface = 0; surface < around_.surface_count(); ++surface)
      for (std::size_t i = 0; i < cells_.size(); ++i) {
        const double apart = around_.distance(surface, center_[i], bound_[i]);
        if (apart >= bound_[i]) continue;
        judge_at_surface(i, surface, apart);
      }
  }

  void judge_at_surface(std::size_t i, std::size_t surface, double apart) {
    const std::size_t entry = cells_[i].entry;
    const std::string who = "a cell at " + place_text(center_[i]);
    if (apart < 0.0 && is_ball(cells_[i])) {
      const bool vessel = !around_.is_wall(surface) && study_.model.obstacles[surface].inside;
      return add(596, entry, surface, -apart,
                 {.text = who + " has its centre " + (vessel ? "outside " : "inside ") + around_.name(surface),
                  .help = vessel ? "with `side: inside` cells begin within the surface" : "place it outside, or write `side: inside`"});
    }
    const double limit = study_.model.limits.overlap, depth = radius_[i] - apart;
    if (!is_shell(cells_[i])) return;
    if (is_ball(cells_[i]) && depth > kCertain * limit)
      return add(597, entry, surface, depth,
                 {.text = who + " reaches " + rounded(depth) + " deep into " + around_.name(surface) + too_deep(),
                  .help = "move it away, or " + let_apart(depth),
                  .is_warning = capped_});
    if (capped_) return;
    if (bound_[i] - apart > limit) suspects_.insert({i});
  }

  /// The variables of a cell of the study by their numbers in a model that has less.
  [[nodiscard]] std::vector<double> variables_in(const Model& less, const CellState& cell) const {
    const std::vector<CellVariable> all = cell_variables(study_.model);
    std::vector<double> out;
    for (const CellVariable& variable : cell_variables(less))
      out.push_back(cell.variable(static_cast<std::size_t>(std::ranges::find(all, variable) - all.begin())));
    return out;
  }

  /// The contact of the shells in question as the run measures it in its first row.
  Status measure_shells() {
    if (suspects_.empty()) return {};
    std::size_t nodes = 0;
    ShapeLibrary shapes;
    std::vector<CellRecord> records;
    for (const std::size_t i : suspects_) {
      MORULA_TRY_ASSIGN(CellRecord record, with_body(cells_[i], study_.model, shapes));
      nodes += record.shell->position.size();
      if (nodes > kMostNodes) {
        out_.notes.push_back("the first contacts of " + std::to_string(suspects_.size()) +
                             " shells are measured when the run begins: they may lie deeper in each other than `limits.overlap`");
        return {};
      }
      records.push_back(std::move(record));
    }
    Model model = study_.model;  // what acts besides contact is left out
    model.fields.clear();
    number_trait_variables(model);
    model.loads.clear();
    model.lumens.clear();
    model.apical_springs.clear();
    Tissue tissue;
    tissue.cells.declare(cell_variables(model));
    for (CellRecord& record : records) record.row.variables = variables_in(model, record.row);
    put_together(tissue, std::move(records));
    MORULA_TRY_ASSIGN(auto simulation, Simulation::create(std::move(model), std::move(tissue), Comm(), 1));
    std::vector<Vec3d> ignored;
    simulation->mechanics().energy_and_forces(simulation->tissue(), ignored);
    const Extreme overlap = deepest_overlap(*simulation);
    if (overlap.value <= study_.model.limits.overlap) return {};
    const auto cell = std::find_if(cells_.begin(), cells_.end(), [&](const PlacedCell& c) { return c.row.id == overlap.cell; });
    const Vec3d at = cell == cells_.end() ? Vec3d{} : cell->center;
    add(597, cell == cells_.end() ? 0 : cell->entry, cells_.size(), overlap.value,
        {.text = "the surface of the cell at " + place_text(at) + " begins " + rounded(overlap.value) +
                 " deep in another one, an obstacle or a wall: the run would stop at its limit (" +
                 short_number(study_.model.limits.overlap) + " um)",
         .help = "place it further away, or " + let_apart(overlap.value)});
    return {};
  }

  const Study& study_;
  std::span<const PlacedCell> cells_;
  const Surroundings& around_;
  bool capped_;
  std::vector<Vec3d> center_;
  std::vector<double> radius_, bound_;
  std::map<Key, Worst> worst_;
  std::set<std::size_t> suspects_;  ///< shells whose contact must be measured
  JudgedPlaces out_;
};

}  // namespace

Result<JudgedPlaces> judge_places(const Study& study, std::span<const PlacedCell> cells, const Surroundings& around) {
  return Judge(study, cells, around).judge();
}

}  // namespace morula::scenarios
