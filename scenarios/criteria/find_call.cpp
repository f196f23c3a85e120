// Which measure a study means, and of what.
#include <algorithm>
#include <cctype>

#include "scenarios/criteria/understand.h"
#include "scenarios/measures/measures.h"

namespace morula::scenarios {
namespace {

using Names = std::vector<std::string>;

template <class Thing>
Names names_of(const std::vector<Thing>& things) {
  Names out;
  for (const Thing& thing : things) out.push_back(thing.name);
  return out;
}

std::string trimmed(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  text.erase(0, std::min(text.find_first_not_of(" \t"), text.size()));
  return text;
}

/// `name(a, b)` taken apart; nothing where brackets do not close.
std::optional<std::pair<std::string, Names>> taken_apart(const std::string& text) {
  const std::size_t open = text.find('(');
  if (open == std::string::npos) return std::pair(trimmed(text), Names{});
  if (text.back() != ')') return std::nullopt;
  Names arguments;
  std::string inside = text.substr(open + 1, text.size() - open - 2);
  for (std::size_t begin = 0; begin <= inside.size();) {
    const std::size_t end = std::min(inside.find(',', begin), inside.size());
    arguments.push_back(trimmed(inside.substr(begin, end - begin)));
    begin = end + 1;
  }
  return std::pair(trimmed(text.substr(0, open)), arguments);
}

/// The things of one call, looked up in the study.
class Finder {
 public:
  Finder(const Study& study, const Measure& measure, Diagnostics& diagnostics)
      : study_(study), measure_(measure), diagnostics_(diagnostics) {}

  std::vector<Subject> by_arguments(const Names& arguments, const Place& place) {
    switch (measure_.of) {
      case MeasureOf::kRun:
        return wrong_number(place);
      case MeasureOf::kCells:
        return each(arguments, [&](const std::string& name) { return cells(name, place); });
      case MeasureOf::kField:
        return arguments.size() == 2 ? with_field(arguments[0], arguments[1], place) : wrong_number(place);
      case MeasureOf::kPair:
      case MeasureOf::kContact:
        return arguments.size() <= 2 ? pair(arguments[0], arguments.back(), place) : wrong_number(place);
      case MeasureOf::kLoad:
      case MeasureOf::kObstacle:
        return each(arguments, [&](const std::string& name) { return thing(name, place); });
    }
    return {};
  }

  std::vector<Subject> by_keys(const MeasuredThings& of, const Place& place) {
    std::vector<Subject> out;
    const auto add = [&out](std::vector<Subject> more) { out.insert(out.end(), more.begin(), more.end()); };
    switch (measure_.of) {
      case MeasureOf::kRun:
        break;
      case MeasureOf::kCells:
        for (const std::string& name : of.type.value) add(type(name, of.type.place));
        if (of.cell.given) add(cells(of.cell.value, of.cell.place));
        break;
      case MeasureOf::kField:
        for (const std::string& name : of.type.value)
          for (const std::string& field : of.field.value) add(with_field(name, field, of.field.place));
        break;
      case MeasureOf::kPair:
      case MeasureOf::kContact:
        if (of.pair.given && of.pair.value.size() != 2)
          diagnostics_.error(412, of.pair.place, "'pair' names " + std::to_string(of.pair.value.size()) + " types, but needs 2", "");
        if (of.pair.value.size() == 2) add(pair(of.pair.value[0], of.pair.value[1], of.pair.place));
        for (const std::string& name : of.type.value) {
          if (of.obstacle.value.empty()) add(pair(name, name, of.type.place));
          for (const std::string& obstacle : of.obstacle.value) add(pair(name, obstacle, of.obstacle.place));
        }
        break;
      case MeasureOf::kLoad:
        for (const std::string& name : of.load.value) add(thing(name, of.load.place));
        break;
      case MeasureOf::kObstacle:
        for (const std::string& name : of.obstacle.value) add(thing(name, of.obstacle.place));
        break;
    }
    refuse_others(of);
    if (out.empty() && !diagnostics_.has_errors()) return missing(of.present ? of_place(of, place) : place);
    return out;
  }

  std::vector<Subject> missing(const Place& place) {
    if (measure_.of == MeasureOf::kRun) return kept(Subject{}, true, place);
    diagnostics_.error(412, place, "'" + measure_.name + "' is not taken of the run as a whole: of what?",
                       "for example `of: " + example() + "`");
    return {};
  }

 private:
  template <class Find>
  static std::vector<Subject> each(const Names& names, const Find& find) {
    std::vector<Subject> out;
    for (const std::string& name : names)
      for (Subject& one : find(name)) out.push_back(std::move(one));
    return out;
  }

  std::string example() const {
    const Model& m = study_.model;
    const auto first = [](const auto& things, const char* instead) { return things.empty() ? std::string(instead) : things.front().name; };
    const std::string a_type = first(m.types, "cell");
    switch (measure_.of) {
      case MeasureOf::kField:
        return "{type: " + a_type + ", field: " + first(m.fields, "oxygen") + "}";
      case MeasureOf::kContact:
        if (!m.obstacles.empty()) return "{type: " + a_type + ", obstacle: " + m.obstacles.front().name + "}";
        [[fallthrough]];
      case MeasureOf::kPair:
        return "{pair: [" + a_type + ", " + a_type + "]}";
      case MeasureOf::kLoad:
        return "{load: " + first(m.loads, "pull") + "}";
      case MeasureOf::kObstacle:
        return "{obstacle: " + first(m.obstacles, "glass") + "}";
      default:
        return "{type: " + a_type + "}";
    }
  }

  std::vector<Subject> wrong_number(const Place& place) {
    const bool none = measure_.of == MeasureOf::kRun;
    diagnostics_.error(412, place, "'" + measure_.name + "' is " + (none ? "of the run as a whole" : "not taken of so many things"),
                       none ? "write `" + measure_.name + "` alone" : "for example `of: " + example() + "`");
    return {};
  }

  static Place of_place(const MeasuredThings& of, const Place& otherwise) {
    for (const auto* one : {&of.type, &of.load, &of.obstacle, &of.field, &of.pair})
      if (one->given) return one->place;
    return of.cell.given ? of.cell.place : otherwise;
  }

  /// Keys of `of` that this measure does not look at.
  void refuse_others(const MeasuredThings& of) {
    const MeasureOf m = measure_.of;
    const bool touch = m == MeasureOf::kPair || m == MeasureOf::kContact;
    const auto refuse = [&](bool given, bool used, const Place& place, const char* key) {
      if (given && !used)
        diagnostics_.error(412, place, "'" + measure_.name + "' is not taken of a " + key,
                           m == MeasureOf::kRun ? "it is of the run as a whole: leave `of` away" : "for example `of: " + example() + "`");
    };
    refuse(of.type.given, touch || m == MeasureOf::kCells || m == MeasureOf::kField, of.type.place, "type");
    refuse(of.cell.given, m == MeasureOf::kCells, of.cell.place, "cell");
    refuse(of.pair.given, touch, of.pair.place, "pair");
    refuse(of.load.given, m == MeasureOf::kLoad, of.load.place, "load");
    refuse(of.obstacle.given, m == MeasureOf::kContact || m == MeasureOf::kObstacle, of.obstacle.place, "obstacle");
    refuse(of.field.given, m == MeasureOf::kField, of.field.place, "field");
  }

  /// Number of a name in a list; −1 and an error where it is not there.
  int find(const std::string& name, const Names& names, const Place& place, int code, const char* what) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<int>(found - names.begin());
    diagnostics_.error(code, place, std::string("there is no ") + what + " '" + name + "'",
                       names.empty() ? std::string("the study has none") : suggest(name, names));
    return -1;
  }

  std::vector<Subject> kept(const Subject& subject, bool found, const Place& place) {
    if (!found) return {};
    if (measure_.fits)
      if (const Status fits = measure_.fits(study_, subject); !fits.ok()) {
        diagnostics_.error(412, place,
                           "'" + measure_.name + "'" + (subject.text.empty() ? "" : " of " + subject.text) + " " + fits.error().message,
                           fits.error().help);
        return {};
      }
    return {subject};
  }

  /// Whether cells begin with a type, or come to have it by division.
  [[nodiscard]] bool has_cells(int type) const {
    const auto of_type = static_cast<std::uint16_t>(type);
    const auto leads_to_it = [of_type](const Fate& fate) { return std::ranges::find(fate.type, of_type) != fate.type.end(); };
    return std::ranges::any_of(study_.initial, [of_type](const InitialCells& cells) { return cells.may_have(of_type); }) ||
           std::ranges::any_of(study_.model.types,
                               [&](const CellType& mother) { return std::ranges::any_of(mother.fates.all, leads_to_it); });
  }
  /// A type that is there, and E412 as a warning where no cell is ever of it.
  int find_type(const std::string& name, const Place& place) {
    const int out = find(name, names_of(study_.model.types), place, 401, "cell type");
    if (out >= 0 && !has_cells(out))
      diagnostics_.warning(412, place, "no cell is ever of type '" + name + "': there is nothing to measure", "");
    return out;
  }

  std::vector<Subject> type(const std::string& name, const Place& place) {
    Subject out;
    out.text = name;
    out.type = find_type(name, place);
    return kept(out, out.type >= 0, place);
  }

  std::vector<Subject> cells(const std::string& name, const Place& place) {
    Subject out;
    const Names types = names_of(study_.model.types);
    if (name == "all") {
      out.text = "all cells";
    } else if (!name.empty() && std::isdigit(static_cast<unsigned char>(name[0]))) {
      out.cell = name;
      out.text = "cell " + name;
    } else {
      return type(name, place);
    }
    return kept(out, true, place);
  }

  std::vector<Subject> with_field(const std::string& name, const std::string& field, const Place& place) {
    std::vector<Subject> out = type(name, place);
    if (out.empty()) return out;
    out[0].field = find(field, names_of(study_.model.fields), place, 402, "field");
    out[0].text = field + " at " + name;
    return kept(out[0], out[0].field >= 0, place);
  }

  std::vector<Subject> pair(const std::string& first, const std::string& second, const Place& place) {
    Subject out;
    Names materials = names_of(study_.model.types);
    out.type = find_type(first, place);
    const int types = static_cast<int>(materials.size());
    if (measure_.of == MeasureOf::kContact)
      for (const ObstacleSpec& obstacle : study_.model.obstacles) materials.push_back(obstacle.name);
    out.partner = find(second, materials, place, 401, measure_.of == MeasureOf::kContact ? "cell type or obstacle" : "cell type");
    out.text = first == second ? first : first + (out.partner >= types ? " on " : " and ") + second;
    return kept(out, out.type >= 0 && out.partner >= 0, place);
  }

  std::vector<Subject> thing(const std::string& name, const Place& place) {
    Subject out;
    out.text = name;
    int& index = measure_.of == MeasureOf::kLoad ? out.load : out.obstacle;
    index = measure_.of == MeasureOf::kLoad ? find(name, names_of(study_.model.loads), place, 412, "load")
                                            : find(name, names_of(study_.model.obstacles), place, 401, "obstacle");
    return kept(out, index >= 0, place);
  }

  const Study& study_;
  const Measure& measure_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<MeasureCall> find_call(const Study& study, const std::string& text, const Place& place, const MeasuredThings* of,
                                     Diagnostics& diagnostics) {
  const auto parts = taken_apart(text);
  if (!parts) {
    diagnostics.error(410, place, "'" + text + "' names no measure", "a measure is written `name`, or `name(thing)`");
    return std::nullopt;
  }
  const auto& [name, arguments] = *parts;
  const std::optional<Measure> measure = find_measure(study, name);
  if (!measure) {
    diagnostics.error(410, place, "there is no measure '" + name + "'", suggest(name, measure_names(study)));
    return std::nullopt;
  }
  Diagnostics found;
  Finder finder(study, *measure, found);
  MeasureCall out{*measure, {}, text};
  if (arguments.empty())
    out.subjects = of != nullptr && of->present ? finder.by_keys(*of, place) : finder.missing(place);
  else
    out.subjects = finder.by_arguments(arguments, place);
  const bool wrong = found.has_errors() || out.subjects.empty();
  diagnostics.append(std::move(found));
  return wrong ? std::nullopt : std::optional(std::move(out));
}

}  // namespace morula::scenarios
