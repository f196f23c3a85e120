#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "study/build.h"
#include "study/color.h"
#include "study/declare.h"
#include "study/law_keys.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

constexpr std::size_t kMaxTypes = 256;

void build_color(BuildContext& c, const draft::CellType& draft) {
  if (draft.color.known() && !color_of_text(draft.color.value)) {
    std::vector<std::string> names;
    for (const char* name : color_names()) names.emplace_back(name);
    c.diagnostics.error(680, draft.color.place, "'" + draft.color.value + "' is no colour",
                        suggest(draft.color.value, names) + "; or write for example \"#d55e00\", in quotes");
  }
  c.study.type_colors.push_back(draft.color.value);
}

/// W of every pair by material index. What the file says twice must agree. A pair is what one of the two says of the other by name, else what
/// one of them says of `others`, else what the types say that the two are like, else the default.
class PairTable {
 public:
  explicit PairTable(BuildContext& context)
      : c_(context), types_(c_.draft.cell_types.size()), materials_(types_ + c_.draft.geometry.size()) {
    named_.resize(types_ * materials_);
    others_.resize(types_);
  }

  void read() {
    for (std::size_t i = 0; i < types_; ++i) {
      auto& items = c_.draft.cell_types[i].content.adhesion;
      for (const auto& item : items)
        if (item.name == kOthers)
          others_[i] = item.content;
        else
          read_one(i, item);
      std::erase_if(items, [](const auto& item) { return item.name == kOthers; });
    }
    all_ = named_;
    for (std::size_t material = 0; material < materials_; ++material) row_.push_back(row_of(material));
  }

  void fill_unnamed() {
    for (std::size_t i = 0; i < types_; ++i)
      for (std::size_t j = i; j < materials_; ++j) {
        if (named_[slot(i, j)]) continue;
        Given<double> value = unnamed(i, j);
        c_.draft.cell_types[i].content.adhesion.push_back({name(j), value.place, value});
        all_[slot(i, j)] = std::move(value);
      }
    for (auto& type : c_.draft.cell_types) type.content.like.text.clear();  // all of it is written out in the resolved study
  }

  [[nodiscard]] const Given<double>& at(std::size_t i, std::size_t j) const { return *all_[slot(i, j)]; }

 private:
  static constexpr const char* kOthers = "others";

  [[nodiscard]] std::string name(std::size_t material) const {
    return material < types_ ? c_.draft.cell_types[material].name : c_.draft.geometry[material - types_].name;
  }
  [[nodiscard]] std::size_t slot(std::size_t i, std::size_t j) const { return std::min(i, j) * materials_ + std::max(i, j); }

  void read_one(std::size_t i, const Named<Given<double>>& item) {
    std::vector<std::string> names;
    std::size_t j = 0;
    for (; j < materials_ && name(j) != item.name; ++j) names.push_back(name(j));
    if (j == materials_) {
      names.emplace_back(kOthers);
      c_.diagnostics.error(401, item.place, "there is no cell type or obstacle '" + item.name + "'", suggest(item.name, names));
      return;
    }
    auto& before = named_[slot(i, j)];
    if (before && before->value != item.content.value) {
      c_.diagnostics.error(510, item.content.place,
                           "the adhesion of '" + name(i) + "' and '" + name(j) + "' is " + item.content.text + " here, but " +
                               before->text + " in line " + std::to_string(before->place.line),
                           "give each pair once");
      return;
    }
    before = item.content;
  }

  /// A material, the type it is like, the type that one is like ...
  [[nodiscard]] std::vector<std::size_t> row_of(std::size_t material) const {
    std::vector<std::size_t> row{material};
    while (row.back() < types_) {
      const auto& types = c_.draft.cell_types;
      const std::string& like = types[row.back()].content.like.value;
      const auto other = std::find_if(types.begin(), types.end(), [&](const auto& type) { return type.name == like; });
      const auto index = static_cast<std::size_t>(other - types.begin());
      if (other == types.end() || std::find(row.begin(), row.end(), index) != row.end()) break;
      row.push_back(index);
    }
    return row;
  }

  /// What `others` of one of the two says of a pair.
  void add_others(std::size_t i, std::size_t j, std::vector<Given<double>>& found) const {
    for (const std::size_t k : {i, j})
      if (k < types_ && others_[k]) found.push_back(*others_[k]);
  }

  /// What is said of the pair; else of one of them and the type that the other is like; and so on, the nearest first, and names before `others`.
  Given<double> unnamed(std::size_t i, std::size_t j) {
    const std::vector<std::size_t>&a = row_[i], &b = row_[j];
    for (std::size_t steps = 0; steps + 1 < a.size() + b.size(); ++steps) {
      std::vector<Given<double>> by_name, by_others;
      for (std::size_t k = 0; k < a.size() && k <= steps; ++k) {
        if (steps - k >= b.size() || (a[k] >= types_ && b[steps - k] >= types_)) continue;
        if (const auto& value = named_[slot(a[k], b[steps - k])]) by_name.push_back(*value);
        add_others(a[k], b[steps - k], by_others);
      }
      if (!by_name.empty()) return one_of(by_name, i, j);
      if (!by_others.empty()) return one_of(by_others, i, j);
    }
    Given<double> value;  // Table 1 of Van Liedekerke et al.
    value.value = j < types_ ? 0.1 : 0.01;
    value.text = j < types_ ? "1e-4 J/m^2" : "1e-5 J/m^2";
    value.place = c_.draft.cell_types[i].place;
    return value;
  }

  Given<double> one_of(const std::vector<Given<double>>& found, std::size_t i, std::size_t j) {
    for (const Given<double>& other : found)
      if (other.value != found[0].value) {
        c_.diagnostics.error(657, c_.draft.cell_types[i].place,
                             "the adhesion of '" + name(i) + "' and '" + name(j) + "' could be " + found[0].text + " (line " +
                                 std::to_string(found[0].place.line) + ") or " + other.text + " (line " + std::to_string(other.place.line) +
                                 ")",
                             "name this pair in the `adhesion` of one of them");
        break;
      }
    return found[0];
  }

  BuildContext& c_;
  std::size_t types_, materials_;
  std::vector<std::optional<Given<double>>> named_, all_;
  std::vector<std::optional<Given<double>>> others_;
  std::vector<std::vector<std::size_t>> row_;  ///< row_of() each
};

/// The law of a type's spheres with the values of its own keys. E515 for keys of other laws.
void set_sphere_law(BuildContext& c, const draft::CellType& t, cbm::SphereParameters& sphere) {
  if (t.sphere_law.value == kFittedLaw) return;  // see build_fitted_law()
  for (const auto& law : c.options.laws->spheres)
    if (law->word == t.sphere_law.value) sphere.law = law;
  for (const KeySpec& key : sphere.law->own)
    if (const auto own = t.sphere_own.find(key.name); own != t.sphere_own.end()) sphere.own.set(key.name, own->second.value);
  check_law_keys(c, t.sphere_own, choosable_sphere_laws(*c.options.laws), sphere.law->word, "law");
}

/// In what cells of a type differ: E515.
void set_variation(BuildContext& c, const draft::CellType& t, CellType& type) {
  const auto tell = [&](const Given<double>& key, const char* name, const std::string& why) {
    c.diagnostics.error(515, key.place, "'" + std::string(name) + "' has no effect here", why);
  };
  for (const Trait trait : kTraits) {
    const draft::Spread& given = t.variation[number_of(trait)];
    type.traits.factor[number_of(trait)] = {1.0, given.spread.value, given.correlation.value};
    if (given.spread.value == 0.0 && given.correlation.value != 0.0)
      tell(given.correlation, "correlation", "give `spread`: all cells of the type are alike without one");
  }
  const draft::Spread &tension = t.variation[number_of(Trait::kTension)], &stiffness = t.variation[number_of(Trait::kStiffness)];
  if (tension.spread.value > 0.0 && t.tension.known() && t.tension.value == 0.0)
    tell(tension.spread, "spread", "give `dcm.cortex.tension`");
  const auto& parameters = type.sphere.law->info.parameters;
  const bool elastic = std::ranges::any_of(parameters, [](const LawParameter& one) { return one.name == "young"; });
  if (stiffness.spread.value > 0.0 && (!elastic || type.sphere.law->table != nullptr))
    tell(stiffness.spread, "spread", "the law of spheres of '" + type.name + "' does not ask for their modulus: `cbm: {law: jkr}`");
}

}  // namespace

void build_cell_types(BuildContext& c) {
  if (c.draft.cell_types.size() > kMaxTypes)
    c.diagnostics.error(404, c.draft.cell_types[kMaxTypes].place, "more than " + std::to_string(kMaxTypes) + " cell types", "");
  for (auto& [name, place, t] : c.draft.cell_types) {
    CellType type;
    type.name = name;
    type.radius = {t.radius.mean.value, t.radius.spread.value};
    type.inhibit_pressure = t.pressure_above.value;
    build_cycle(c, t, place, type);
    build_behaviours(c, t, place, type);
    t.plain.write_to(type);
    build_osmosis(c, t, type);
    type.medium_friction = t.friction_medium.value;
    type.initial_body = t.body.value == "shell" ? BodyKind::kShell : BodyKind::kSphere;
    type.shell_nodes = static_cast<std::uint32_t>(t.nodes.value);
    type.sphere.young = t.sphere_young.value;
    type.sphere.poisson = t.sphere_poisson.value;
    set_sphere_law(c, t, type.sphere);
    build_fitted_law(c, name, t, type.sphere);
    t.sphere_friction.write_to(type.sphere);
    t.with_shells.write_to(type.sphere.with_shells);
    cbm::PackingCurve packing = build_packing(c, name, t);
    if (type.sphere.packing.empty()) type.sphere.packing = std::move(packing);
    type.shell = build_shell(c, name, t, t.friction_medium.value);
    set_variation(c, t, type);
    type.interior = build_interior(c, t, name);
    type.self_contact = build_self_contact(c, t);
    type.renew_mesh_below = build_mesh_renewal(c, t, type);
    type.own_mesh = build_own_mesh(c, t, type);
    build_color(c, t);
    c.study.model.types.push_back(std::move(type));
  }
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) build_fates(c, c.draft.cell_types[i].content, c.study.model.types[i]);
}

void build_pairs(BuildContext& c) {
  const std::size_t types = c.draft.cell_types.size(), materials = types + c.draft.geometry.size();
  auto& pairs = c.study.model.pairs;
  pairs.assign(materials * materials, ContactPair{0.0, 0.0, 0.0});
  if (types > kMaxTypes) return;  // told
  PairTable table(c);
  table.read();
  table.fill_unnamed();
  for (std::size_t i = 0; i < types; ++i) {
    for (std::size_t j = 0; j < materials; ++j) {
      const draft::CellType& a = c.draft.cell_types[i].content;
      const double friction = j < types ? 0.5 * (a.friction_cell_cell.value + c.draft.cell_types[j].content.friction_cell_cell.value)
                                        : a.friction_obstacle.value;
      const auto along = [](const Given<double>& tangential, const Given<double>& same) {
        return tangential.value < 0.0 ? same.value : tangential.value;
      };
      double tangential = along(a.tangential_obstacle, a.friction_obstacle);
      if (j < types) {
        const draft::CellType& b = c.draft.cell_types[j].content;
        tangential = 0.5 * (along(a.tangential_cell_cell, a.friction_cell_cell) + along(b.tangential_cell_cell, b.friction_cell_cell));
      }
      pairs[i * materials + j] = pairs[j * materials + i] = {table.at(i, j).value, friction, tangential};
    }
  }
  for (std::size_t i = 0; i < types; ++i) {
    for (std::size_t j = i; j < materials; ++j) {
      if (!may_be_shell(c, i) || (j < types && !may_be_shell(c, j))) continue;
      const draft::CellType& a = c.draft.cell_types[i].content;
      const draft::CellType& b = j < types ? c.draft.cell_types[j].content : a;
      const Given<double>& w = table.at(i, j);
      const auto least = [](const draft::CellType& t) {
        return t.tension.value * (1.0 - 3.0 * t.variation[number_of(Trait::kTension)].spread.value);
      };
      const auto most = [](const draft::CellType& t) { return 1.0 + 3.0 * t.variation[number_of(Trait::kAdhesion)].spread.value; };
      if (w.value == 0.0 || !a.tension.known() || !b.tension.known() ||
          w.value * std::sqrt(most(a) * (j < types ? most(b) : 1.0)) < least(a) + least(b))
        continue;
      const bool no_rest = !resists_in_plane(a) || (j < types && !resists_in_plane(c.draft.cell_types[j].content));
      const std::string partner = j < types ? c.draft.cell_types[j].name : c.draft.geometry[j - types].name;
      const Place& place = w.given ? w.place : a.tension.place;
      const std::string what = "shells of '" + c.draft.cell_types[i].name + "' adhere to '" + partner + "' by " + w.text +
                               ", not less than twice the cortical tension (" + a.tension.text +
                               (w.value < a.tension.value + b.tension.value ? ", as cells vary by three spreads): " : "): ");
      const std::string help = "raise `dcm.cortex.tension` above half of the adhesion, or lower the adhesion";
      if (no_rest)
        c.diagnostics.error(509, place, what + "a cortex that is not elastic spreads without end", help);
      else
        c.diagnostics.warning(509, place, what + "only the elasticity of the cortex stops the spreading", help);
    }
  }
}

}  // namespace morula::scenarios
