#include <algorithm>
#include <cmath>

#include "coupling/regions/region.h"
#include "fields/reaction.h"
#include "study/own_section.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

fields::FaceCondition condition(const Given<double>& face, const Given<double>& all) {
  const double value = face.known() ? face.value : all.value;
  if (value < 0.0) return {fields::FaceCondition::Kind::kNoFlux, 0.0};  // the word `no_flux`
  return {fields::FaceCondition::Kind::kValue, value};
}

void check_voxels(BuildContext& c, const draft::Field& f) {
  if (!f.voxel.known() || !c.draft.domain.size.known()) return;
  const Vec3d size = c.draft.domain.size.value;
  constexpr double kMaxVoxels = 1e9;
  double voxels = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) voxels *= std::ceil(size[axis] / f.voxel.value);
  if (voxels > kMaxVoxels)
    c.diagnostics.error(
        512, f.voxel.place,
        "voxels of " + f.voxel.text + " in this domain are " + short_number(voxels) + ", more than " + short_number(kMaxVoxels),
        "make the voxels larger or the domain smaller");
  if (f.voxel.value > std::fmin(size.x, std::fmin(size.y, size.z)))
    c.diagnostics.warning(512, f.voxel.place,
                          "a voxel (" + f.voxel.text + ") is larger than the domain: the field is uniform along an axis",
                          "make the voxels smaller");
}

/// A reaction with these values, if it ever does anything.
void add_values(BuildContext& c, const std::shared_ptr<const fields::Reaction>& what, const draft::OwnSection& own, const Place& place,
                std::uint16_t type, fields::FieldSpec& spec) {
  if (!missing_keys(what->keys, own).empty()) return;  // told
  const auto values = own_values(c, what->keys, own);
  if (!values || (what->never_acts != nullptr && what->never_acts(*values))) return;
  if (const auto problem = what->judge != nullptr ? what->judge(*values) : std::nullopt) return tell_problem(c, *problem, own, place);
  spec.reactions.push_back({what, *values, type});
  if (what->of_dying == nullptr) return;
  LawValues of_dying = what->of_dying(*values);
  if (what->never_acts != nullptr && what->never_acts(of_dying)) return;
  spec.reactions.push_back({what, std::move(of_dying), static_cast<std::uint16_t>(c.draft.cell_types.size() + type)});
}

void add_reaction(BuildContext& c, const std::shared_ptr<const fields::Reaction>& what, const draft::Field& f, const Place& place,
                  fields::FieldSpec& spec) {
  const std::string name = what->section.name;
  if (what->where == fields::Reaction::Where::kVolume) {
    const auto own = f.reactions.find(name);  // none where the field was no map; told
    if (own != f.reactions.end() && (what->bare || own->second.present)) add_values(c, what, own->second, place, 0, spec);
    return;
  }
  const auto types = f.by_cell_type.find(name);
  if (types == f.by_cell_type.end()) return;
  for (const auto& [type_name, type_place, own] : types->second) {
    const int type = find_type(c, type_name, type_place);
    if (type >= 0) add_values(c, what, own, type_place, static_cast<std::uint16_t>(type), spec);
  }
}

/// E510 for concentrations below 0; E111 where there is nothing on the faces that could follow.
void build_border_course(BuildContext& c, const draft::Field& f, fields::FieldSpec& spec) {
  if (f.course.empty()) return;
  spec.course = build_course(c, f.course);
  for (const auto& [number, place, point] : f.course)
    if (point.value.known() && point.value.value < 0.0)
      c.diagnostics.error(510, point.value.place, "a concentration cannot be " + point.value.text + " times what it is", "0 or more");
  const auto is_held = [](const fields::FaceCondition& face) {
    return face.kind == fields::FaceCondition::Kind::kValue && face.value > 0.0;
  };
  bool any_open = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (c.study.model.space.periodic(static_cast<int>(axis))) continue;
    any_open = true;
    if (std::ranges::any_of(spec.boundary[axis], is_held)) return;
  }
  if (any_open)
    c.diagnostics.error(111, f.course.front().place, "the faces of field '" + spec.name + "' have a course, but no concentration above 0",
                        "give them one: `boundary: {all: 0.2 mM}`");
  else
    c.diagnostics.error(111, f.course.front().place,
                        "the faces of field '" + spec.name + "' have a course, but all faces of the domain are periodic",
                        "leave the course out, or make faces `open` or `wall`");
}

}  // namespace

void build_fields(BuildContext& c) {
  for (const auto& [name, place, f] : c.draft.fields) {
    const auto is_value = [&name](const auto& value) { return value->info.name == name; };
    if (name == "type" || std::ranges::any_of(c.options.laws->trigger_values, is_value))
      c.diagnostics.error(112, place, "a field cannot be called '" + name + "'", "triggers use this word for the cell's own value");
    fields::FieldSpec spec;
    spec.name = name;
    f.spec.write_to(spec);
    spec.voxel = f.voxel.value;
    const draft::FieldBoundary& b = f.boundary;
    spec.boundary = {{{condition(b.x_low, b.all), condition(b.x_high, b.all)},
                      {condition(b.y_low, b.all), condition(b.y_high, b.all)},
                      {condition(b.z_low, b.all), condition(b.z_high, b.all)}}};
    build_border_course(c, f, spec);
    for (const auto& reaction : c.options.laws->reactions) add_reaction(c, reaction, f, place, spec);
    check_voxels(c, f);
    c.study.model.fields.push_back(std::move(spec));
  }
}

}  // namespace morula::scenarios
