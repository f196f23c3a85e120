#include "study/fitted_law.h"

#include <span>
#include <utility>

#include "core/numbers/hash128.h"
#include "study/document.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;

/// What the file says of which a study takes a part; the rest is for people.
struct Knot {
  Given<double> packing, pressure;
};
struct AreaKnot {
  Given<double> pairs, cells;
};
struct TableKnot {
  Given<double> overlap, force, area;
};
struct Ends {
  Given<double> least, most;
};
struct Factor {
  Given<double> value;
  bool given = false;
};
/// Beside JKR, or beside the table.
struct Beside {
  Factor approach, along;
  std::vector<Named<Knot>> packing;
  std::vector<Named<AreaKnot>> area;
};
struct WithShells {
  Given<double> stiffness, adhesion;
  bool given = false;
};
struct File {
  Given<std::uint64_t> schema, nodes;
  Given<std::string> version, type, material, better, checksum;
  Given<double> radius, adhesion_of_shells;
  Given<double> young, poisson, adhesion, touch;
  Beside jkr, table;
  WithShells with_shells;
  Given<double> medium, cell_cell, cell_cell_tangential;
  bool has_friction = false;
  std::vector<Named<TableKnot>> knots;
  bool has_table = false;
  Ends overlap, radii, room;
  Given<std::string> other;                ///< figures that are not used
  Given<std::vector<std::string>> others;  ///< lists of such
};

KeySpec number(const char* name, Q quantity, double low, double high, bool required = true) {
  return {.name = name, .doc = "", .quantity = quantity, .required = required, .low = low, .high = high, .example = ""};
}
KeySpec required(const char* name) { return {.name = name, .doc = "", .required = true, .example = ""}; }
KeySpec section(const char* name) { return {.name = name, .doc = "", .example = ""}; }

void declare_knot(Section& s, Knot& knot) {
  s.quantity(number("packing", Q::kFraction, 0.0, 10.0), knot.packing);
  s.quantity(number("pressure", Q::kPressure, 0.0, 1e4), knot.pressure);
}

void declare_area_knot(Section& s, AreaKnot& knot) {
  s.quantity(number("pairs", Q::kFraction, 0.0, 10.0), knot.pairs);
  s.quantity(number("cells", Q::kFraction, 0.0, 10.0), knot.cells);
}

void declare_table_knot(Section& s, TableKnot& knot) {
  s.quantity(number("overlap", Q::kNumber, -10.0, 10.0), knot.overlap);
  s.quantity(number("force", Q::kTension, -1e4, 1e4), knot.force);
  s.quantity(number("area", Q::kNumber, 0.0, 1e3), knot.area);
}

void declare_ends(Section& s, Ends& ends, Q quantity, double low, double high) {
  s.quantity(number("least", quantity, low, high), ends.least);
  s.quantity(number("most", quantity, low, high), ends.most);
}

/// Figures that tell people how good the fit is.
void declare_figures(Section& s, File& f, std::initializer_list<const char*> names) {
  for (const char* name : names) s.text(section(name), f.other);
}

void declare_held_out(Section& s, File& f) {
  bool present = false;
  s.group(section("held_out"), present, [&f](Section& h) {
    declare_figures(
        h, f,
        {"pairs", "force_rms", "force_worst", "packings", "pressure_rms", "pressure_worst", "lattices", "lattice_rms", "lattice_worst"});
    for (const char* name : {"random", "clusters"}) h.words(section(name), f.others);
  });
}

/// What spheres have beside their pair law.
void declare_beside(Section& s, File& f, Beside& beside) {
  declare_held_out(s, f);
  for (const auto& [name, factor] : {std::pair{"approach", &beside.approach}, {"along", &beside.along}})
    s.group({.name = name, .doc = "", .optional_section = true, .example = ""}, factor->given, [&f, factor](Section& g) {
      g.quantity(number("factor", Q::kNumber, 0.0, 1e6), factor->value);
      declare_figures(g, f, {"friction", "misfit"});
      g.words(section("interval"), f.others);
    });
  s.list(section("packing"), beside.packing, &declare_knot);
  bool present = false;
  s.group({.name = "contact_area", .doc = "", .optional_section = true, .example = ""}, present, [&f, &beside](Section& g) {
    g.list(section("knots"), beside.area, &declare_area_knot);
    declare_figures(g, f, {"held_out", "pairs_alone"});
  });
}

void declare_with_shells(Section& s, File& f) {
  s.group({.name = "with_shells", .doc = "", .optional_section = true, .example = ""}, f.with_shells.given, [&f](Section& g) {
    g.quantity(number("stiffness", Q::kNumber, 1e-6, 1e3), f.with_shells.stiffness);
    g.quantity(number("adhesion", Q::kNumber, 0.0, 10.0), f.with_shells.adhesion);
    g.words(section("stiffness_interval"), f.others);
    g.words(section("adhesion_interval"), f.others);
    declare_figures(g, f, {"misfit", "outside", "outside_worst", "unfitted", "held_out", "promoted"});
  });
}

void declare_friction(Section& s, File& f) {
  s.group({.name = "friction_of_shells", .doc = "", .optional_section = true, .example = ""}, f.has_friction, [&f](Section& g) {
    g.quantity(number("medium", Q::kFrictionPerArea, 0.0, 1e6), f.medium);
    g.quantity(number("cell_cell", Q::kFrictionPerArea, 0.0, 1e6), f.cell_cell);
    g.quantity(number("cell_cell_tangential", Q::kFrictionPerArea, 0.0, 1e6), f.cell_cell_tangential);
  });
}

void declare_jkr(Section& s, File& f) {
  s.quantity(number("young", Q::kPressure, 1e-6, 1e4), f.young);
  s.quantity(number("poisson", Q::kNumber, 0.0, 0.5), f.poisson);
  s.quantity(number("adhesion", Q::kTension, 0.0, 1e4), f.adhesion);
  s.words(section("young_interval"), f.others);
  s.words(section("adhesion_interval"), f.others);
  declare_figures(s, f, {"young_error", "adhesion_error", "correlation", "loss", "residuals", "misfit"});
  declare_beside(s, f, f.jkr);
}

void declare_table(Section& s, File& f) {
  s.quantity(number("touch", Q::kNumber, -10.0, 10.0, false), f.touch);
  declare_figures(s, f, {"exponent", "exponent_error"});
  declare_beside(s, f, f.table);
  s.list(section("knots"), f.knots, &declare_table_knot);
}

void declare_ranges(Section& s, File& f) {
  bool present = false;
  s.group(required("overlap_over_radius"), present, [&f](Section& g) { declare_ends(g, f.overlap, Q::kNumber, -10.0, 10.0); });
  s.group(required("radius"), present, [&f](Section& g) { declare_ends(g, f.radii, Q::kLength, 0.01, 1e3); });
  s.group({.name = "volume_ratio", .doc = "", .optional_section = true, .example = ""}, present,
          [&f](Section& g) { declare_ends(g, f.room, Q::kNumber, 0.0, 10.0); });
  s.text(section("slowest_rate"), f.other);
}

void declare_file(Section& s, File& f) {
  bool present = false;
  s.whole({.name = "schema", .doc = "", .required = true, .low = 1.0, .high = 1.0, .example = "1"}, f.schema);
  for (const auto& [name, value] : {std::pair{"version", &f.version}, {"type", &f.type}, {"material", &f.material}})
    s.text(required(name), *value);
  s.text(section("hash"), f.other);
  s.whole(section("nodes"), f.nodes);
  s.text(section("checksum"), f.checksum);
  s.quantity(number("radius", Q::kLength, 0.01, 1e3), f.radius);
  s.quantity(number("adhesion_of_shells", Q::kTension, 0.0, 1e4), f.adhesion_of_shells);
  s.word({.name = "better", .doc = "", .required = true, .words = {"jkr", "table"}, .example = "jkr"}, f.better);
  s.group(required("jkr"), present, [&f](Section& g) { declare_jkr(g, f); });
  s.group({.name = "table", .doc = "", .optional_section = true, .example = ""}, f.has_table, [&f](Section& g) { declare_table(g, f); });
  declare_with_shells(s, f);
  declare_friction(s, f);
  s.group(required("ranges"), present, [&f](Section& g) { declare_ranges(g, f); });
  s.words(section("remarks"), f.others);
}

/// The table of the file; E533 where its knots make none.
std::optional<cbm::PairTable> table_of(const File& file, const Place& place, Diagnostics& diagnostics) {
  std::vector<cbm::PairTableKnot> knots;
  for (const auto& [name, at, knot] : file.knots) knots.push_back({knot.overlap.value, knot.force.value, knot.area.value});
  auto made = cbm::PairTable::through(knots, file.touch.value);
  if (made.ok()) return std::move(made).value();
  diagnostics.error(533, file.knots.empty() ? place : file.knots.front().place, "the table makes no law: " + made.error().message,
                    made.error().help);
  return {};
}

/// The curve through knots; where they make none the error `code` at the first of them, and an empty curve.
template <class Curve, class Knot, class Content>
Curve curve_through(const std::vector<Named<Content>>& knots, Knot (*knot_of)(const Content&), int code, const char* what,
                    Diagnostics& diagnostics) {
  if (knots.empty()) return {};
  std::vector<Knot> all;
  for (const auto& knot : knots) all.push_back(knot_of(knot.content));
  auto made = Curve::through(all);
  if (made.ok()) return std::move(made).value();
  diagnostics.error(code, knots.front().place, std::string(what) + ": " + made.error().message, made.error().help);
  return {};
}

cbm::PackingKnot packing_knot(const Knot& knot) { return {knot.packing.value, knot.pressure.value}; }
cbm::CrowdedKnot area_knot(const AreaKnot& knot) { return {knot.pairs.value, knot.cells.value}; }

FittedLaw::Spheres spheres_of(const Beside& read, Diagnostics& diagnostics) {
  FittedLaw::Spheres out;
  if (read.approach.given) out.approach = read.approach.value.value;
  out.along = read.along.given ? read.along.value.value : out.approach;
  out.packing = curve_through<cbm::PackingCurve>(read.packing, &packing_knot, 530, "packing", diagnostics);
  out.area = curve_through<cbm::CrowdedArea>(read.area, &area_knot, 533, "contact_area", diagnostics);
  return out;
}

}  // namespace

std::string checksum_of_law(std::string_view text_before) { return hash128(std::as_bytes(std::span(text_before))).hex(); }

std::optional<FittedLaw> read_fitted_law(const std::filesystem::path& path, const std::string& shown_name, const Place& referred_from,
                                         const Laws& laws, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  const auto source = read_text_file(path, shown_name, kMaxStudyBytes, referred_from, diagnostics);
  if (!source) return {};
  const Node document = parse_document(source, diagnostics);
  if (document.kind == Node::Kind::kNull) return {};
  if (document.kind != Node::Kind::kMap) {
    diagnostics.error(104, document.place, "a fitted law is a map (`key: value`)", "`morula calibrate` writes one");
    return {};
  }
  File file;
  const UnitSystem units;
  ReadSection top(&document, Place{source, 1, 1, 1}, "", laws, units, diagnostics);
  declare_file(top, file);
  top.finish();
  if (diagnostics.error_count() > errors) return {};
  if (const std::string_view text(source->bytes); file.checksum.given) {
    if (checksum_of_law(text.substr(0, text.rfind("checksum:"))) != file.checksum.value)
      diagnostics.warning(693, file.checksum.place, "the fitted law is not as it was made: its `checksum` is another one",
                          "`morula calibrate` makes it again; without the line `checksum` it is a law of your own");
  }
  FittedLaw out;
  out.version = file.version.value, out.type = file.type.value, out.material = file.material.value;
  out.table_is_better = file.better.value == "table";
  out.young = file.young.value, out.poisson = file.poisson.value, out.adhesion = file.adhesion.value;
  out.adhesion_of_shells = file.adhesion_of_shells.value;
  if (file.with_shells.given) out.with_shells = cbm::WithShells{file.with_shells.stiffness.value, file.with_shells.adhesion.value};
  out.of_jkr = spheres_of(file.jkr, diagnostics), out.of_table = spheres_of(file.table, diagnostics);
  if (file.has_friction) out.friction = CellFriction{file.medium.value, file.cell_cell.value, file.cell_cell_tangential.value};
  out.overlap = {file.overlap.least.value, file.overlap.most.value};
  out.smallest_radius = file.radii.least.value, out.largest_radius = file.radii.most.value;
  if (file.has_table) out.table = table_of(file, document.place, diagnostics);
  if (out.table_is_better && !file.has_table)
    diagnostics.error(533, file.better.place, "the table is said to be better, but there is none", "");
  if (!(out.overlap.least < out.overlap.most)) diagnostics.error(533, file.overlap.least.place, "the range of overlaps has no width", "");
  if (diagnostics.error_count() > errors) return {};
  return out;
}

}  // namespace morula::scenarios
