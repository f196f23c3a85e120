#include <algorithm>

#include "coupling/regions/region.h"
#include "fields/reaction.h"
#include "study/declare.h"
#include "study/own_section.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;

void declare_reaction(Section& s, const fields::Reaction& reaction, draft::Field& f) {
  const std::string name = reaction.section.name;
  if (reaction.where == fields::Reaction::Where::kCells)
    return s.named(reaction.section, f.by_cell_type[name],
                   [&reaction](Section& inner, draft::OwnSection& own) { declare_own_keys(inner, reaction.keys, own, true); });
  draft::OwnSection& own = f.reactions[name];
  if (reaction.bare) return declare_own_keys(s, reaction.keys, own, true);
  KeySpec section = reaction.section;
  section.optional_section = true;
  s.group(section, own.present, [&](Section& inner) { declare_own_keys(inner, reaction.keys, own, true); });
}

void declare_region(Section& s, draft::Region& r) {
  s.text({.name = "name", .doc = "Name of the region in messages and events.", .required = true, .example = "core"}, r.name);
  KeySpec shape{.name = "shape", .doc = "Shape of the region.", .required = true, .example = "sphere"};
  for (const auto& one : s.laws().region_shapes) shape.words.push_back(one->info.name);
  s.word(shape, r.shape);
  s.vector({.name = "center",
            .doc = "Centre; of a half space, a point of its border.",
            .quantity = Q::kLength,
            .fallback = "[0 um, 0 um, 0 um]",
            .example = "[0 um, 0 um, 0 um]",
            .source = "chosen"},
           r.center);
  std::vector<std::string> declared;
  for (const auto& one : s.laws().region_shapes)
    for (const OwnKey& key : one->keys) {
      if (std::ranges::find(declared, key.spec.name) != declared.end()) continue;
      declared.emplace_back(key.spec.name);
      declare_own_keys(s, {key}, r.own, false);
    }
  s.word({.name = "as",
          .doc = "Body of the cells inside.",
          .fallback = "shell",
          .words = {"sphere", "shell"},
          .synonyms = {{"cbm", "sphere"}, {"dcm", "shell"}},
          .example = "shell",
          .source = "chosen"},
         r.body);
  s.quantity({.name = "margin",
              .doc = "Up to this far beyond its border a cell keeps the body that the region gives; it leaves beyond. In a box that "
                     "follows a course regions go along with it, their size, too; the margin stays.",
              .quantity = Q::kLength,
              .fallback = "3 um",
              .low = 0.0,
              .example = "3 um",
              .source = "chosen: half a cell radius"},
             r.margin);
  s.flag({.name = "follow_tissue",
          .doc = "The centre is relative to the centroid of the tissue.",
          .fallback = "false",
          .example = "true",
          .source = "chosen"},
         r.follow_tissue);
  s.text({.name = "follow", .doc = "Name of an obstacle that the region moves along with.", .example = "needle"}, r.follow);
  s.quantity({.name = "from",
              .doc = "The region exists from this time.",
              .quantity = Q::kTime,
              .fallback = "0 s",
              .low = 0.0,
              .example = "1 h",
              .source = "chosen"},
             r.from);
  s.quantity({.name = "until",
              .doc = "The region ends at this time; cells inside then become what they were without it: what `as` of `initial` says, or "
                     "else their type.",
              .quantity = Q::kTime,
              .fallback = "never",
              .low = 0.0,
              .specials = {{"never", std::numeric_limits<double>::infinity()}},
              .example = "1.5 h",
              .source = "chosen"},
             r.until);
}

void declare_trigger(Section& s, draft::Trigger& t) {
  std::string values;
  for (const auto& one : s.laws().trigger_values)
    if (one != field_value()) values += "`" + one->info.name + "`, ";
  values.replace(values.size() - 2, 2, " or a field of the cell passes a value.");
  s.comparison({.name = "promote", .doc = "Make a sphere a shell when " + values, .example = "pressure > 1 kPa"}, t.promote);
  s.comparison(
      {.name = "demote", .doc = "Make it a sphere again when it passes a value on the other side.", .example = "pressure < 600 Pa"},
      t.demote);
  s.quantity(
      {.name = "outside_law",
       .doc = "Instead of promote and demote: a sphere that is this far beyond the range of its laws becomes a shell, and a sphere again "
              "below 0.9 of it. 1: at the end of the range.",
       .quantity = Q::kNumber,
       .low = 0.0,
       .low_open = true,
       .example = "1.0"},
      t.outside_law);
  s.text({.name = "type", .doc = "Instead of promote and demote: all cells of this type are shells.", .example = "trophectoderm"}, t.type);
  s.text({.name = "phase", .doc = "Instead of promote and demote: cells in this phase of their cycle are shells.", .example = "M"},
         t.phase);
  s.quantity({.name = "hold",
              .doc = "No second exchange of body within this time; a cell goes back after the longest of the holds of rules.",
              .quantity = Q::kTime,
              .fallback = "30 min",
              .low = 0.0,
              .example = "30 min",
              .source = "chosen"},
             t.plain, &Trigger::hold);
}

}  // namespace

void declare_field(Section& s, draft::Field& f) {
  s.quantity({.name = "diffusion",
              .doc = "Diffusion coefficient.",
              .quantity = Q::kDiffusion,
              .required = true,
              .low = 0.0,
              .example = "2e-9 m^2/s"},
             f.spec, &fields::FieldSpec::diffusion);
  s.quantity({.name = "initial",
              .doc = "Concentration at time 0.",
              .quantity = Q::kConcentration,
              .required = true,
              .low = 0.0,
              .example = "0.2 mM"},
             f.spec, &fields::FieldSpec::initial);
  s.quantity(
      {.name = "voxel",
       .doc = "Edge of a voxel, at most; the domain is divided evenly. What a cell sees of its own uptake or secretion leans on where it "
              "lies in the grid: with 10 um a cell of 6 um sees 0.5 to 1.6 times what is right, with 5 um 0.9 to 1.0 times. What others "
              "do is right within a few per cent three voxels away.",
       .quantity = Q::kLength,
       .fallback = "10 um",
       .low = 0.0,
       .low_open = true,
       .example = "10 um",
       .source = "chosen: about one cell"},
      f.voxel);
  s.quantity({.name = "tolerance",
              .doc = "Relative error tolerance of the time integration.",
              .fallback = "1e-4",
              .low = 1e-12,
              .high = 0.1,
              .example = "1e-4",
              .source = "chosen"},
             f.spec, &fields::FieldSpec::relative_tolerance);
  s.quantity(
      {.name = "interval_tolerance",
       .doc = "Between two integrations the field waits while cells move and grow, up to five minutes or the tenth of a voxel that "
              "a cell goes: as long as no concentration changes by more than this part of the largest one. Cells act on what they saw "
              "last, and those that are there in the end count for the whole time, daughters, too. 0: integrated after every step.",
       .fallback = "5e-3",
       .low = 0.0,
       .high = 0.1,
       .example = "5e-3",
       .source = "chosen: decision 0061"},
      f.spec, &fields::FieldSpec::interval_tolerance);
  bool present = false;
  s.group({.name = "boundary",
           .doc = "At the faces of the domain: a concentration, or `no_flux`; one for all, or by face. Ignored on periodic axes.",
           .shorthand = "all",
           .example = "{all: 0.2 mM}"},
          present, [&f](Section& b) {
            const auto face = [&b](const char* name, const char* doc, Given<double>& value, const char* fallback = nullptr) {
              b.quantity({.name = name,
                          .doc = doc,
                          .quantity = Q::kConcentration,
                          .fallback = fallback,
                          .low = 0.0,
                          .specials = {{"no_flux", -1.0}},
                          .example = "0.2 mM",
                          .source = fallback ? "chosen" : ""},
                         value);
            };
            face("all", "All faces.", f.boundary.all, "no_flux");
            face("x_low", "The face at the low end of x.", f.boundary.x_low);
            face("x_high", "The face at the high end of x.", f.boundary.x_high);
            face("y_low", "The face at the low end of y.", f.boundary.y_low);
            face("y_high", "The face at the high end of y.", f.boundary.y_high);
            face("z_low", "The face at the low end of z.", f.boundary.z_low);
            face("z_high", "The face at the high end of z.", f.boundary.z_high);
          });
  s.list({.name = "course",
          .doc = "The concentrations on the faces over time, as parts of those of `boundary`: straight lines between these points, "
                 "constant outside. Steps land on "
                 "the points.",
          .not_empty = true,
          .example = "[{time: 0 h, factor: 1}, {time: 24 h, factor: 1}, {time: 25 h, factor: 0}]"},
         f.course, &declare_course_point);
  for (const auto& reaction : s.laws().reactions) declare_reaction(s, *reaction, f);
}

void declare_coupling(Section& s, draft::Coupling& c) {
  s.whole({.name = "max_shells",
           .doc = "No sphere becomes a shell while there are as many shells as this; daughters of shells are shells all the same. First "
                  "come cells of the "
                  "region or trigger that stands first (regions before triggers), among them those deepest within it or furthest beyond "
                  "its threshold.",
           .fallback = "unlimited",
           .low = 0,
           .high = 2.0e8,
           .specials = {{"unlimited", std::numeric_limits<double>::infinity()}},
           .example = "120",
           .source = "chosen"},
          c.swaps, &Swaps::max_shells);
  s.quantity(
      {.name = "hold",
       .doc = "No second exchange of body by a region within this time. Daughters keep their body until they have parted (half an hour), "
              "dying cells keep it, and shells that would be packed beyond the law of spheres stay shells; they are asked again when this "
              "time is over (without regions, after the longest hold of a trigger).",
       .quantity = Q::kTime,
       .fallback = "10 min",
       .low = 0.0,
       .example = "10 min",
       .source = "chosen"},
      c.swaps, &Swaps::hold);
  s.word(
      {.name = "exchange",
       .doc = "What room a sphere takes that becomes a shell. Balls overlap, shells do not. gradual: beside shells, and beside others that "
              "become shells with it, it begins with what its ball has behind the planes in which it meets theirs, and comes to its own "
              "volume with a time constant of ten minutes; alone among spheres it has its own volume at once. at_once: its own volume "
              "in any case; a group may then be left deep within each other, or find no room.",
       .fallback = "gradual",
       .words = {"gradual", "at_once"},
       .example = "at_once",
       .source = "decision 0059"},
      c.exchange);
  s.list({.name = "regions",
          .doc = "Where cells are shells (or spheres). Once a run has begun, one cell in a hundred (at least one) "
                 "exchanges its body in a step, the most urgent first; the others wait."},
         c.regions, &declare_region);
  s.list({.name = "triggers", .doc = "When cells become shells, and spheres again; as many in a step as of regions."}, c.triggers,
         &declare_trigger);
}

}  // namespace morula::scenarios
