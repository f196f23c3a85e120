#pragma once
#include <algorithm>

#include "coupling/loads/load.h"
#include "coupling/model.h"

namespace morula::keys {

using Kind = OwnKey::Kind;

inline OwnKey load_axis(const char* doc) {
  return {Kind::kDirection, {.name = "axis", .doc = doc, .fallback = "[1, 0, 0]", .example = "[1, 0, 0]", .source = "chosen"}};
}

inline OwnKey load_part(const char* fallback, const char* doc) {
  return {Kind::kQuantity,
          {.name = "part",
           .doc = doc,
           .quantity = Quantity::kFraction,
           .fallback = fallback,
           .low = 0.0,
           .high = 1.0,
           .low_open = true,
           .example = "2 %",
           .source = "chosen"}};
}

inline OwnKey load_ends() {
  return {Kind::kWord,
          {.name = "ends",
           .doc = "The nodes of the undeformed cell with the largest coordinate along the axis (`high`), the smallest (`low`), or both.",
           .fallback = "both",
           .words = {"both", "high", "low"},
           .example = "both",
           .source = "chosen"}};
}

inline OwnKey load_mark(const char* doc) { return {Kind::kMark, {.name = "marked", .doc = doc, .example = "apical"}}; }

inline OwnKey required(Kind kind, const char* name, const char* doc, Quantity quantity, const char* example) {
  return {kind, {.name = name, .doc = doc, .quantity = quantity, .required = true, .example = example}};
}

/// Of springs to places of the laboratory.
inline OwnKey hold_stiffness(const char* doc) {
  return {Kind::kQuantity,
          {.name = "stiffness",
           .doc = doc,
           .quantity = Quantity::kTension,
           .fallback = "10 mN/m",
           .low = 0.0,
           .high = 1e6,
           .low_open = true,
           .example = "10 mN/m",
           .source = "chosen: 1 nN moves it by 0.1 um"}};
}

inline OwnKey way_direction() {
  return {Kind::kDirection,
          {.name = "direction",
           .doc = "Direction of `way`; need not have length 1.",
           .fallback = "[0, 0, 1]",
           .example = "[0, 0, 1]",
           .source = "chosen"}};
}

inline OwnKey way() {
  return {Kind::kCourse,
          {.name = "way",
           .doc = "How far its place has moved along `direction` over time: straight lines between these points, at rest before the first "
                  "and after "
                  "the last. Steps land on the points.",
           .quantity = Quantity::kLength,
           .example = "[{time: 0 s, distance: 0 um}, {time: 5 min, distance: 6 um}]"}};
}

/// A load that holds places of the laboratory cannot follow a cell through a periodic face.
inline std::vector<LawProblem> judge_places(const CellLoad& load, const Model& model) {
  if (std::ranges::any_of(load.course.value, [](double factor) { return factor < 0.0; }))
    return {{302, "", "the course of a " + load.what->info.name + " has a factor below 0: its springs would push away from where they are",
             "0 lets the cell go"}};
  for (int axis = 0; axis < 3; ++axis)
    if (model.space.periodic(axis))
      return {{570, "center", "a " + load.what->info.name + " holds places, but the domain is periodic along " + "xyz"[axis],
               "use `open` or `wall` faces"}};
  return {};
}

inline LawParameter part_of_nodes() { return given_by_study("part", "number", "1", "Part of the nodes, at an end of the axis."); }

/// `axis`, `part` and `ends`.
inline void set_ends(const OwnValues& values, CellLoad& load) {
  load.axis = values.vector("axis");
  load.part = values("part");
  load.end = static_cast<LoadEnd>(values.number("ends"));  // in the order of the words
}

/// Keys that say where a load acts, beside a mark that says it, too: a value that is not the default contradicts it (the resolved study writes
/// defaults out).
inline void judge_marked(const CellLoad& load, const Model& model, std::initializer_list<std::pair<const char*, bool>> is_default,
                         std::vector<LawProblem>& out) {
  if (load.mark < 0) return;
  const std::string& mark = model.mark_names[static_cast<std::size_t>(load.mark)];
  for (const auto& [key, usual] : is_default)
    if (!usual)
      out.push_back(
          {594, key, "load '" + load.name + "' acts on the faces marked '" + mark + "', wherever they are", "remove this key or `marked`"});
}

}  // namespace morula::keys
