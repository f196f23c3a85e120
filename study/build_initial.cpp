#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/ball.h"
#include "core/mesh/convex_hull.h"
#include "study/build.h"
#include "study/build_meshes.h"
#include "study/csv.h"
#include "study/initial/nearest_regions.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

/// Volume of spheres at random over that of their shape, where they may overlap by 5 % of the radius: 0.64 · (1/0.975)³.
constexpr double kMostAtRandom = 0.69;

std::string place_text(const Vec3d& p) {
  return "[" + short_number(p.x) + " um, " + short_number(p.y) + " um, " + short_number(p.z) + " um]";
}

std::string domain_text(const Box& box) { return "the domain reaches from " + place_text(box.low) + " to " + place_text(box.high); }

class InitialBuilder {
 public:
  InitialBuilder(BuildContext& context, const UnitSystem& units) : c_(context), units_(units), domain_(context.study.model.space.box) {}

  void build(draft::Initial& d, const Place& place) {
    const int sources = (d.fill.given || d.count.given) + d.at.given + d.csv.given + d.has_meshes;
    if (sources != 1) {
      c_.diagnostics.error(111, place,
                           sources == 0 ? "an entry of `initial` needs `fill`, `at`, `csv` or `meshes`"
                                        : "an entry of `initial` has only one of `fill`, `at`, `csv` and `meshes`",
                           "for example `{type: hepatocyte, count: 400, fill: sphere, radius: 60 um}`");
      return;
    }
    InitialCells cells;
    cells.random_age = d.age.value != "birth";
    cells.body_given = d.body.known();
    cells.body = d.body.value == "shell" ? BodyKind::kShell : BodyKind::kSphere;
    cells.start_volume_fraction = d.start_volume.value;
    cells.inflate_time = d.inflate.value;
    cells.shape = d.shape.value == "biconcave" ? CellShape::kBiconcave : CellShape::kSphere;
    cells.orientation = d.orientation.value == "aligned" ? Orientation::kAligned : Orientation::kRandom;
    check_inflation(d, place);
    int type = -1;
    if (!d.csv.given) {
      if (!d.type.given && !d.has_meshes && d.types.empty())
        c_.diagnostics.error(103, place, "key 'type' is missing in an entry of `initial`", "name one of the cell types");
      if (!d.types.empty()) type = build_mixture(d, cells);
      if (d.type.known()) type = find_type(c_, d.type.value, d.type.place);
      cells.type = static_cast<std::uint16_t>(std::max(0, type));
    }
    refuse_strays(d);
    if (!d.has_meshes && !d.csv.given) refuse_meshes_of_spheres(d, cells, type);
    if (d.has_meshes)
      build_meshes(c_, d, place, cells);
    else if (d.csv.given)
      build_csv(d, cells);
    else if (d.at.given)
      build_positions(d, cells);
    else
      build_fill(d, place, type, cells);
    total_ += cells.count;
    if (total_ >= (std::uint64_t{1} << CellId::kFounderBits))
      c_.diagnostics.error(404, place, "more than " + std::to_string((std::uint64_t{1} << CellId::kFounderBits) - 1) + " cells at time 0",
                           "");
    c_.study.initial.push_back(std::move(cells));
  }

 private:
  void stray(bool given, const Place& place, const char* key, const char* with) {
    if (given) c_.diagnostics.error(111, place, std::string("'") + key + "' has no meaning with `" + with + "`", "leave it away");
  }
  /// Keys of another source of cells are errors; their defaults are no part of the resolved study.
  void refuse_strays(draft::Initial& d) {
    const char* with = d.has_meshes ? "meshes" : d.csv.given ? "csv" : d.at.given ? "at" : nullptr;
    if (with) {
      stray(d.radius.given, d.radius.place, "radius", with);
      stray(d.size.given, d.size.place, "size", with);
      stray(d.center.given, d.center.place, "center", with);
      if (!d.types.empty()) stray(true, d.types[0].place, "types", with);
      stray(d.on.given, d.on.place, "on", with);
      d.center.text.clear();
    }
    if (d.csv.given) {
      stray(d.type.given, d.type.place, "type", with);
    } else {
      stray(d.coincident_shift.given, d.coincident_shift.place, "coincident_shift", with ? with : "fill");
      stray(d.units.given, d.units.place, "units", with ? with : "fill");
      stray(d.coincident_below.given, d.coincident_below.place, "coincident_below", with ? with : "fill");
      stray(d.has_hull, d.hull_margin.place, "volume_from_hull", with ? with : "fill");
      d.coincident_shift.text.clear();
      d.coincident_below.text.clear();
    }
  }

  /// A sphere has no mesh yet; one that it is given later is an icosphere, turned by the cell's id. Their defaults are
  /// no part of the resolved study.
  void refuse_meshes_of_spheres(draft::Initial& d, const InitialCells& cells, int type) {
    if (type < 0 || (cells.body_given && cells.body == BodyKind::kShell)) return;
    if (!cells.body_given)
      for (std::size_t t = 0; t < c_.study.model.types.size(); ++t)
        if (cells.may_have(t) && c_.study.model.types[t].initial_body == BodyKind::kShell) return;
    for (const auto& [key, name] : {std::pair{&d.shape, "shape"}, std::pair{&d.orientation, "orientation"}})
      if (key->given)
        c_.diagnostics.error(111, key->place, std::string("'") + name + "' has no meaning for cells that begin as spheres",
                             "leave it away, or begin with shells: `as: shell`");
    d.shape.text.clear();
    d.orientation.text.clear();
  }

  void check_inflation(const draft::Initial& d, const Place& place) {
    if (!d.start_volume.known() || !d.inflate.known()) return;
    if (d.start_volume.value < 1.0 && d.inflate.value == 0.0)
      c_.diagnostics.error(510, d.start_volume.place,
                           "cells start at " + d.start_volume.text + " of their volume, but no time is given to inflate them",
                           "add for example `inflate: 30 min`");
    if (d.start_volume.value == 1.0 && d.inflate.value > 0.0)
      c_.diagnostics.error(510, d.inflate.given ? d.inflate.place : place,
                           "'inflate' has no meaning for cells that start with their whole volume", "add for example `start_volume: 50 %`");
  }

  void build_positions(const draft::Initial& d, InitialCells& cells) {
    cells.source = InitialCells::Source::kPositions;
    cells.positions = d.at.value;
    cells.count = cells.positions.size();
    if (!d.at.known() || !c_.draft.domain.size.known()) return;
    for (const Vec3d& p : cells.positions)
      if (!domain_.contains(p))
        c_.diagnostics.error(505, d.at.place, "a cell at " + place_text(p) + " is outside the domain", domain_text(domain_));
  }

  void build_csv(draft::Initial& d, InitialCells& cells) {
    cells.source = InitialCells::Source::kCsv;
    cells.coincident_shift = d.coincident_shift.value;
    cells.coincident_below = d.coincident_below.value;
    if (!d.csv.known()) return;
    if (d.units.known()) {
      if (const auto factor = units_.factor(d.units.value, Quantity::kLength); !factor.ok()) {
        c_.diagnostics.error(factor.error().kind == UnitError::Kind::kWrongDimension ? 203 : 202, d.units.place,
                             "'units' " + factor.error().message, "for example `units: um`");
        return;
      }
      cells.csv_unit = d.units.value;
    }
    const std::string shown = d.csv.value;
    cells.csv_path = add_input_file(c_, d.csv);
    std::vector<std::string> names;
    for (const auto& type : c_.draft.cell_types) names.push_back(type.name);
    const auto csv = read_cells_csv(cells.csv_path, c_.shown(shown), names, d.csv.place, units_, c_.diagnostics, cells.csv_unit);
    if (!csv) return;
    if (d.units.known() && !csv->common_unit_used)
      c_.diagnostics.error(515, d.units.place, "'units' has no effect here: all columns of '" + shown + "' have a unit of their own",
                           "leave it away, or take the units out of the header");
    cells.count = csv->cells.size();
    for (const CsvCell& cell : csv->cells) {
      const BodyKind usual = cells.body_given ? cells.body : c_.study.model.types[cell.type].initial_body;
      (cell.body.value_or(usual) == BodyKind::kShell ? cells.csv_shells : cells.csv_spheres).insert(cell.type);
    }
    if (d.age.given && d.age.value == "birth" && std::ranges::all_of(csv->cells, [](const CsvCell& cell) { return cell.phase >= 0.0; }))
      c_.diagnostics.warning(515, d.age.place, "'age' has no effect here: all rows of '" + shown + "' have a `phase`",
                             "leave it away, or take the column out");
    if (!csv->ignored_columns.empty()) {
      std::string note = shown + ": columns left aside:";
      for (const std::string& column : csv->ignored_columns) note += " `" + column + "`";
      c_.study.notes.push_back(note);
    }
    std::vector<Vec3d> positions;
    for (const CsvCell& cell : csv->cells) positions.push_back(cell.position);
    const auto groups = coincident_groups(positions, cells.coincident_below);
    note_coincident(*csv, shown, d, groups);
    if (d.has_hull) share_hull(*csv, shown, d, positions, groups, cells);
    if (c_.draft.domain.size.known()) check_rows_inside(*csv);
  }

  /// Each cell's part of the inflated hull of all places, less the cavity.
  void share_hull(const CsvCells& csv, const std::string& shown, const draft::Initial& d, const std::vector<Vec3d>& positions,
                  const std::vector<std::vector<std::size_t>>& groups, InitialCells& cells) {
    if (!d.hull_margin.known() || (d.has_cavity && !(d.cavity_radius.known() && d.cavity_center.known()))) return;
    const Place& place = d.hull_margin.place;
    for (const CsvCell& cell : csv.cells)
      if (cell.radius > 0.0) {
        c_.diagnostics.error(
            510, place, "'" + shown + "' gives cells a radius (line " + std::to_string(cell.line) + "), and `volume_from_hull` another",
            "leave one of them away");
        return;
      }
    const auto hull = convex_hull(positions);
    if (!hull) {
      c_.diagnostics.error(510, place, "the places in '" + shown + "' share no volume: " + hull.error().message,
                           "leave `volume_from_hull` away");
      return;
    }
    if (d.has_cavity && hull->depth(d.cavity_center.value) < -d.hull_margin.value)
      c_.diagnostics.error(510, d.cavity_center.place, "the cavity's centre is outside the inflated hull of the cells", "move it inside");
    const double whole = hull->inflated_volume(d.hull_margin.value);
    const double cavity = d.has_cavity ? ball_volume(d.cavity_radius.value) : 0.0;
    if (cavity >= whole) {
      c_.diagnostics.error(510, d.cavity_radius.place,
                           "the cavity is larger than the inflated hull of the cells (" + short_number(whole) + " um^3)",
                           "make it smaller");
      return;
    }
    if (d.has_cavity) {
      cells.cavity_center = d.cavity_center.value;
      cells.cavity_radius = d.cavity_radius.value;
    }
    const std::string room = shown + ": hull of the cells inflated by " + d.hull_margin.text + ": " + short_number(whole) + " um^3" +
                             (d.has_cavity ? ", less the cavity: " + short_number(whole - cavity) + " um^3" : "");
    if (d.hull_share.value != "nearest") {
      const double each = (whole - cavity) / static_cast<double>(cells.count);
      cells.room.assign(cells.count, each);
      c_.study.notes.push_back(room + "; each cell has " + short_number(each) + " um^3 (radius " + short_number(ball_radius(each)) +
                               " um)");
      return;
    }
    const auto hollow = d.has_cavity ? std::optional(Hollow{cells.cavity_center, cells.cavity_radius}) : std::nullopt;
    cells.room = nearest_regions(*hull, positions, groups, d.hull_margin.value, hollow);
    for (const CsvCell& cell : csv.cells)
      if (hollow && norm(cell.position - hollow->center) < hollow->radius)
        c_.study.notes.push_back(shown + " line " + std::to_string(cell.line) + ": a cell at " + place_text(cell.position) +
                                 " is within the cavity; its room is found as if there were none");
    const auto [least, most] = std::ranges::minmax(cells.room);
    c_.study.notes.push_back(room + "; the cells have " + short_number(least) + " to " + short_number(most) +
                             " um^3 of it that are nearest to them (radius " + short_number(ball_radius(least)) + " to " +
                             short_number(ball_radius(most)) + " um)");
  }

  void note_coincident(const CsvCells& csv, const std::string& shown, const draft::Initial& d,
                       const std::vector<std::vector<std::size_t>>& groups) {
    for (const auto& group : groups) {
      std::string same, moved;
      for (std::size_t k = 0; k < group.size(); ++k) {
        const std::string number = std::to_string(total_ + group[k] + 1);
        same += (k ? ", " : "") + number + " (line " + std::to_string(csv.cells[group[k]].line) + ")";
        if (k) moved += (k > 1 ? ", " : "") + number;
      }
      c_.study.notes.push_back(shown + ": cells " + same + " lie at the same place; moved by " + d.coincident_shift.text + ": " + moved);
    }
  }

  void check_rows_inside(const CsvCells& csv) {
    constexpr int kMost = 20;
    int outside = 0;
    for (const CsvCell& cell : csv.cells) {
      if (domain_.contains(cell.position)) continue;
      if (++outside <= kMost) {
        const std::size_t begin = csv.source->line_begin[static_cast<std::size_t>(cell.line) - 1];
        c_.diagnostics.error(505, place_at(csv.source, begin, csv.source->line(cell.line).size()),
                             "a cell at " + place_text(cell.position) + " is outside the domain", domain_text(domain_));
      }
    }
    if (outside > kMost)
      c_.diagnostics.error(505, {csv.source, 0, 0, 1}, std::to_string(outside - kMost) + " more cells are outside the domain",
                           domain_text(domain_));
  }

  /// The parts of a mixture; the first of its types, or −1.
  int build_mixture(const draft::Initial& d, InitialCells& cells) {
    const Place& place = d.types[0].place;
    if (d.type.given)
      c_.diagnostics.error(111, d.type.place, "'type' and 'types' both say the type of the cells", "leave one of them away");
    double sum = 0.0;
    for (const auto& share : d.types) {
      const int type = find_type(c_, share.name, share.place);
      if (type < 0) return -1;
      sum += share.content.value;
      cells.mixture.push_back({static_cast<std::uint16_t>(type), share.content.value});
    }
    if (std::abs(sum - 1.0) > 1e-6) {
      c_.diagnostics.error(660, place, "the parts of the mixture add up to " + short_number(100.0 * sum) + " %",
                           "make them 100 % together");
      return -1;
    }
    cells.type = cells.mixture[0].type;
    return cells.type;
  }

  void build_fill(const draft::Initial& d, const Place& place, int type, InitialCells& cells) {
    cells.source = InitialCells::Source::kFill;
    cells.count = d.count.value;
    cells.center = d.center.value;
    cells.radius = d.radius.value;
    cells.size = d.size.value;
    const bool random = d.fill.value == "random", layer = d.fill.value == "layer";
    cells.pattern = layer ? FillPattern::kLayer : random ? FillPattern::kRandom : FillPattern::kPacked;
    const bool box = d.fill.value == "box" || ((random || layer) && d.size.given), sphere = !box;
    cells.fill = box ? FillShape::kBox : FillShape::kSphere;
    const auto missing = [&](bool given, const char* key) {
      if (!given)
        c_.diagnostics.error(103, place, std::string("key '") + key + "' is missing in an entry of `initial`",
                             "a filled shape needs `count`, `fill`, and `radius` (sphere), `size` (box) or `on` (layer)");
    };
    missing(d.count.given, "count");
    missing(d.fill.given, "fill");
    if (!d.fill.known()) return;
    if (layer) return build_layer(d, place, cells);
    missing(sphere ? d.radius.given : d.size.given, sphere ? "radius" : "size");
    const std::string with = random ? "size" : "fill: " + d.fill.value;
    stray(sphere ? d.size.given : d.radius.given, sphere ? d.size.place : d.radius.place, sphere ? "size" : "radius", with.c_str());
    stray(d.on.given, d.on.place, "on", ("fill: " + d.fill.value).c_str());
    if (!(sphere ? d.radius.known() : d.size.known()) || !d.center.known()) return;
    const Vec3d half = sphere ? Vec3d{cells.radius, cells.radius, cells.radius} : cells.size * 0.5;
    const Box shape{cells.center - half, cells.center + half};
    if (c_.draft.domain.size.known() && !(domain_.contains(shape.low) && domain_.contains(shape.high)))
      c_.diagnostics.error(502, sphere ? d.radius.place : d.size.place, "the shape to fill reaches out of the domain",
                           domain_text(domain_));
    if (type >= 0 && d.count.known()) check_room(d, type, cells, sphere);
  }

  void build_layer(const draft::Initial& d, const Place& place, InitialCells& cells) {
    if (d.radius.given && d.size.given)
      c_.diagnostics.error(111, d.size.place, "a layer keeps to a disc (`radius`) or to a rectangle (`size`)", "leave one of them away");
    if (!d.on.given)
      c_.diagnostics.error(103, place, "key 'on' is missing in an entry of `initial`",
                           "a layer lies on a plane or wall: for example `on: z_low`");
    if (!d.on.known()) return;
    const std::string& on = d.on.value;
    const auto& space = c_.study.model.space;
    std::vector<std::string> known;
    for (const auto& [name, at, obstacle] : c_.draft.geometry) {
      known.push_back(name);
      if (name != on) continue;
      if (obstacle.plane.present && norm2(obstacle.plane.normal.value) > 0.0)
        cells.plane = {obstacle.plane.center.value, normalized(obstacle.plane.normal.value)};
      else
        c_.diagnostics.error(660, d.on.place, "obstacle '" + on + "' is no plane", "a layer lies on a `plane`, or on a wall of the domain");
      return;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t side = 0; side < 2; ++side) {
        const std::string face = std::string(1, "xyz"[axis]) + (side == 0 ? "_low" : "_high");
        known.push_back(face);
        if (face != on) continue;
        cells.plane = {};
        cells.plane.normal = {};
        cells.plane.normal[axis] = side == 0 ? 1.0 : -1.0;
        cells.plane.point = side == 0 ? domain_.low : domain_.high;
        if (space.boundary[axis][side] != BoundaryKind::kWall)
          c_.diagnostics.error(660, d.on.place, "the face '" + face + "' of the domain is no wall: a layer would lie on nothing",
                               "write `domain: {boundary: {" + face + ": wall}}`");
        return;
      }
    c_.diagnostics.error(660, d.on.place, "there is nothing called '" + on + "' to lie on", suggest(on, known));
  }

  /// Spheres of the type's radius need more room than the shape has.
  void check_room(const draft::Initial& d, int type, const InitialCells& cells, bool sphere) {
    const Given<double>& radius = c_.draft.cell_types[static_cast<std::size_t>(type)].content.radius.mean;
    if (!radius.known() || !d.start_volume.known()) return;
    const double ball = 4.0 / 3.0 * std::numbers::pi;
    double cube = cells.mixture.empty() ? std::pow(radius.value, 3) : 0.0;  // mean of the third powers of the radii [um^3]
    for (const InitialCells::Share& share : cells.mixture) {
      const Given<double>& of_type = c_.draft.cell_types[share.type].content.radius.mean;
      if (!of_type.known()) return;
      cube += share.part * std::pow(of_type.value, 3);
    }
    const double need = static_cast<double>(cells.count) * ball * cube * cells.start_volume_fraction;
    const double room = sphere ? ball * std::pow(cells.radius, 3) : cells.size.x * cells.size.y * cells.size.z;
    const bool random = cells.pattern == FillPattern::kRandom;
    const double most = 0.64;  // balls at random, shaken together (random close packing)
    if (need <= (random ? kMostAtRandom : 1.0) * room) return;
    const std::string fits = sphere ? "a radius of at least " + short_number(std::ceil(std::cbrt(need / most / ball))) + " um"
                                    : "a volume of at least " + short_number(need / most) + " um^3";
    c_.diagnostics.error(506, d.count.place,
                         std::to_string(cells.count) + " cells " +
                             (cells.mixture.empty() ? "of radius " + radius.text + " " : "of these types ") + "have " +
                             short_number(need / room) + " times the volume of the shape they fill" +
                             (random ? std::string(": at random they fill 0.64 of it") : ""),
                         "give the shape " + fits + ", or fewer cells");
  }

  BuildContext& c_;
  const UnitSystem& units_;
  const Box& domain_;
  std::uint64_t total_ = 0;
};

}  // namespace

void build_initial(BuildContext& c) {
  const UnitSystem units;
  InitialBuilder builder(c, units);
  for (auto& [name, place, d] : c.draft.initial) builder.build(d, place);
}

}  // namespace morula::scenarios
