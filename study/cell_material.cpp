#include "study/cell_material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "core/numbers/joined.h"
#include "core/numbers/number_text.h"
#include "core/numbers/unit_conversion.h"
#include "study/document.h"

namespace morula::scenarios {
namespace {

constexpr std::array<const char*, 2> kOfShells{"dcm", "osmosis"};
/// Keys of these that say how a mesh follows its surface, not what the surface is made of.
constexpr std::array<const char*, 2> kNoMaterial{"own_mesh", "self_contact"};

void leave_material(Node& section) {
  std::erase_if(section.entries, [](const Node::Entry& e) { return std::ranges::find(kNoMaterial, e.key) != kNoMaterial.end(); });
}

/// A part of a document in one line.
std::string flow(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kNull:
      return "~";
    case Node::Kind::kScalar:
      return node.text;
    case Node::Kind::kList:
      return "[" + joined(node.items, flow) + "]";
    case Node::Kind::kMap:
      return "{" + joined(node.entries, [](const Node::Entry& entry) { return entry.key + ": " + flow(entry.value); }) + "}";
  }
  return "";
}

bool names_both(const Node& pair, const std::string& type) {
  const Node* between = pair.find("between");
  return between != nullptr && between->items.size() == 2 && between->items[0].text == type && between->items[1].text == type;
}

/// The section `contact`, and what it says of pairs of the type. `repulsion`: what `auto` stands for where pairs say nothing else [kPa/µm].
void take_contact(const Node& document, const std::string& type, double repulsion, CellMaterial& out) {
  const Node* contact = document.find("contact");
  out.contact = "{}";
  if (contact == nullptr) return;
  if (const Node* pairs = contact->find("pairs"))
    for (const Node& pair : pairs->items)
      if (names_both(pair, type))
        for (const Node::Entry& entry : pair.entries)
          if (entry.key != "between") out.pair += ", " + entry.key + ": " + flow(entry.value);
  Node all = *contact;
  std::erase_if(all.entries, [](const Node::Entry& e) { return e.key == "pairs"; });
  for (Node::Entry& entry : all.entries)
    if (entry.key == "repulsion" && entry.value.text == "auto") entry.value.text = shortest_text(repulsion) + " kPa/um";
  out.contact = flow(all);
}

/// Whether two values are one quantity in different words, as 1 kPa and 1000 Pa are.
bool same_quantity(const std::string& a, const std::string& b) {
  constexpr double kRounding = 1e-12;
  const UnitSystem units;
  for (int q = 0; q < kQuantityCount; ++q) {
    const auto first = units.parse(a, static_cast<Quantity>(q)), second = units.parse(b, static_cast<Quantity>(q));
    if (first.ok() && second.ok()) return std::abs(*first - *second) <= kRounding * std::max(std::abs(*first), std::abs(*second));
  }
  return false;
}

/// What two maps say differently first; empty: nothing.
std::string difference(const Node& here, const Node& there, const std::string& path) {
  if (here.kind != Node::Kind::kMap || there.kind != Node::Kind::kMap) {
    const std::string a = flow(here), b = flow(there);
    return a == b || same_quantity(a, b) ? "" : "`" + path + "` is " + a + " here and " + b + " there";
  }
  const auto under = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
  for (const Node::Entry& entry : here.entries) {
    const Node* other = there.find(entry.key);
    if (other == nullptr) return "`" + under(entry.key) + "` is " + flow(entry.value) + " here and not said there";
    if (std::string found = difference(entry.value, *other, under(entry.key)); !found.empty()) return found;
  }
  for (const Node::Entry& entry : there.entries)
    if (here.find(entry.key) == nullptr) return "`" + under(entry.key) + "` is " + flow(entry.value) + " there and not said here";
  return "";
}

std::string names_of(const Model& model) { return listed(model.types, &CellType::name); }

}  // namespace

std::string CellMaterial::text() const {
  const std::string touch = pair.empty() ? "" : pair.substr(2);  // without the comma before the first
  return "{" + shell + (shell.empty() ? "" : ", ") + "contact: " + contact + ", pair: {" + touch + "}, radius: " + shortest_text(radius) +
         " um, adhesion: " + shortest_text(adhesion) + " nN/um}";
}

std::string first_difference(const std::string& here, const std::string& there) {
  if (here == there) return "";
  Diagnostics ignored;
  const auto parsed = [&](const std::string& text) {
    Node out = parse_document(std::make_shared<SourceText>(SourceText("material", text)), ignored);
    for (Node::Entry& entry : out.entries) leave_material(entry.value);  // files of before have such keys
    return out;
  };
  const std::string found = difference(parsed(here), parsed(there), "");
  return found;
}

Result<CellMaterial> material_of(const Study& study, const std::string& name) {
  const Model& model = study.model;
  const auto found = std::ranges::find(model.types, name, &CellType::name);
  if (found == model.types.end()) return Error{ErrorKind::kInput, "the study has no cell type '" + name + "'", "it has " + names_of(model)};
  if (!found->regional_tension.regions.empty() || !model.mark_names.empty())
    return Error{ErrorKind::kInput, "the surface of '" + name + "' has parts of its own",
                 "one law of contact cannot stand for them: calibrate a type without marks and regions"};
  Diagnostics ignored;
  const Node document = parse_document(std::make_shared<SourceText>(SourceText("resolved", study.resolved_text)), ignored);
  const Node* types = document.find("cell_types");
  const Node* type = types != nullptr ? types->find(name) : nullptr;
  if (type == nullptr) return Error{ErrorKind::kInternal, "the resolved study lacks the type '" + name + "'", ""};
  CellMaterial out;
  out.type = name;
  out.radius = found->radius.mean;
  out.tension = found->shell.tension;
  out.nodes = found->shell_nodes;
  const auto t = static_cast<std::size_t>(found - model.types.begin());
  const ContactPair& pair = model.pair(t, t);
  out.adhesion = pair.adhesion;
  out.friction = {found->medium_friction, pair.normal_friction, pair.tangential_friction};
  out.range = pair.range > 0.0 ? pair.range : model.contact.range;
  take_contact(document, name, pair.repulsion > 0.0 ? pair.repulsion : model.contact.repulsion, out);
  for (const char* section : kOfShells) {
    const Node* found_part = type->find(section);
    if (found_part == nullptr) continue;
    Node part = *found_part;
    leave_material(part);
    out.shell += (out.shell.empty() ? "" : ", ") + std::string(section) + ": " + flow(part);
  }
  return out;
}

}  // namespace morula::scenarios
