#include <algorithm>

#include "study/catalogue.h"
#include "study/document.h"

namespace morula::scenarios {
namespace {

constexpr std::size_t kMostInARow = 32, kMostValues = 1000000;
constexpr std::size_t kMostTypes = 256;  // more are refused anyway

const Declaration* child_of(const Declaration* section, const std::string& key) {
  if (!section) return nullptr;
  const auto& children = section->children;
  const auto child = std::find_if(children.begin(), children.end(), [&](const Declaration& d) { return key == d.spec.name; });
  return child == children.end() ? nullptr : &*child;
}

/// A section written as a bare value, written out: `radius: 6 um` is `radius: {mean: 6 um}`.
Node written_out(const Node& node, const Declaration* section) {
  const bool bare = node.kind == Node::Kind::kScalar || node.kind == Node::Kind::kList;
  if (!bare || !section || section->kind != Declaration::Kind::kGroup || !section->spec.shorthand) return node;
  Node map;
  map.kind = Node::Kind::kMap;
  map.place = node.place;
  map.entries.push_back({section->spec.shorthand, node.place, node});
  return map;
}

/// `key: default` takes back what the other type says of this key.
bool takes_back(const Node& node) { return node.kind == Node::Kind::kScalar && node.text == "default"; }

/// `own` over `base`: maps key by key, all else as a whole.
Node over(const Node& base, const Node& own, const Declaration* section) {
  const Node below = written_out(base, section), above = written_out(own, section);
  if (below.kind != Node::Kind::kMap || above.kind != Node::Kind::kMap) return own;
  Node out = above;
  out.entries.clear();
  for (const Node::Entry& entry : below.entries) {
    const Node* mine = above.find(entry.key);
    if (mine && takes_back(*mine)) continue;
    out.entries.push_back({entry.key, entry.key_place, mine ? over(entry.value, *mine, child_of(section, entry.key)) : entry.value});
  }
  for (const Node::Entry& entry : above.entries)
    if (!below.find(entry.key)) out.entries.push_back(entry);
  return out;
}

std::size_t values_in(const Node& node) {
  std::size_t count = 1;
  for (const Node::Entry& entry : node.entries) count += values_in(entry.value);
  for (const Node& item : node.items) count += values_in(item);
  return count;
}

class LikeExpansion {
 public:
  LikeExpansion(Node& types, const Declaration* type, Diagnostics& diagnostics)
      : types_(types), type_(type), diagnostics_(diagnostics), done_(types.entries.size(), false) {
    for (const Node::Entry& entry : types_.entries) names_.push_back(entry.key);
  }

  void expand_all() {
    for (std::size_t i = 0; i < done_.size() && values_ <= kMostValues; ++i) expand(i);
  }

 private:
  std::size_t index_of(const std::string& name) const {
    return static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
  }

  void expand(std::size_t index) {
    std::vector<std::size_t> row{index};  // from a type to what it is like
    while (!done_[row.back()]) {
      Node& node = types_.entries[row.back()].value;
      const Node* like = node.kind == Node::Kind::kMap ? node.find("like") : nullptr;
      if (!like || like->kind != Node::Kind::kScalar) break;
      const std::size_t other = index_of(like->text);
      if (other == names_.size()) {
        diagnostics_.error(401, like->place, "there is no cell type '" + like->text + "'", suggest(like->text, names_));
        break;
      }
      if (std::find(row.begin(), row.end(), other) != row.end())
        return refuse(row, like->place, "cell types are like each other in a circle: " + circle(row, other),
                      "one of them says all its keys");
      if (row.size() >= kMostInARow)
        return refuse(row, like->place, "more than " + std::to_string(kMostInARow) + " cell types are each like the next",
                      "let several be like the same one");
      row.push_back(other);
    }
    done_[row.back()] = true;
    for (std::size_t k = row.size() - 1; k-- > 0;) take_over(row[k], row[k + 1]);
  }

  void refuse(const std::vector<std::size_t>& row, const Place& place, const std::string& text, const std::string& help) {
    diagnostics_.error(656, place, text, help);
    for (const std::size_t i : row) done_[i] = true;
  }

  std::string circle(const std::vector<std::size_t>& row, std::size_t back) const {
    std::string text;
    for (auto i = std::find(row.begin(), row.end(), back); i != row.end(); ++i) text += names_[*i] + ", ";
    return text + names_[back];
  }

  void take_over(std::size_t index, std::size_t from) {
    done_[index] = true;
    Node base = types_.entries[from].value;
    if (base.kind != Node::Kind::kMap) return;  // told when it is read
    values_ += values_in(base);
    if (values_ > kMostValues) {
      diagnostics_.error(404, types_.entries[index].key_place,
                         "cell types that are like others hold more than " + std::to_string(kMostValues) + " values", "");
      return;
    }
    std::erase_if(base.entries, [](const Node::Entry& entry) { return entry.key == "adhesion" || entry.key == "like"; });
    Node& own = types_.entries[index].value;
    own = over(base, own, type_);
  }

  Node& types_;
  const Declaration* type_;
  Diagnostics& diagnostics_;
  std::vector<bool> done_;
  std::vector<std::string> names_;
  std::size_t values_ = 0;
};

/// The entry of a type, or of the nearest that it is like, in a map by cell type; null: none of them stands there.
const Node::Entry* entry_of(const Node& by_type, const Node& types, std::string name) {
  for (std::size_t k = 0; k < kMostInARow; ++k) {
    for (const Node::Entry& entry : by_type.entries)
      if (entry.key == name) return &entry;
    const Node* type = types.find(name);
    const Node* like = type && type->kind == Node::Kind::kMap ? type->find("like") : nullptr;
    if (!like || like->kind != Node::Kind::kScalar) return nullptr;
    name = like->text;
  }
  return nullptr;
}

/// What cells of a type take from a field and give to it, those of a type that is like it do, too, where the field does not name them.
void expand_reactions(Node& fields, const Declaration* declared, const Node& types) {
  if (fields.kind != Node::Kind::kMap || !declared) return;
  for (Node::Entry& field : fields.entries) {
    if (field.value.kind != Node::Kind::kMap) continue;
    for (Node::Entry& section : field.value.entries) {
      const Declaration* of_section = child_of(declared, section.key);
      if (!of_section || of_section->kind != Declaration::Kind::kNamed || section.value.kind != Node::Kind::kMap) continue;
      std::vector<Node::Entry> more;
      for (const Node::Entry& type : types.entries) {
        const Node::Entry* entry = entry_of(section.value, types, type.key);
        if (entry && entry->key != type.key) more.push_back({type.key, entry->key_place, entry->value});
      }
      section.value.entries.insert(section.value.entries.end(), more.begin(), more.end());
    }
  }
}

}  // namespace

void expand_likes(Node& document, const Declaration& declared, Diagnostics& diagnostics) {
  Node* types = document.find("cell_types");
  if (!types || types->kind != Node::Kind::kMap || types->entries.size() > kMostTypes) return;
  LikeExpansion(*types, child_of(&declared, "cell_types"), diagnostics).expand_all();
  if (Node* fields = document.find("fields")) expand_reactions(*fields, child_of(&declared, "fields"), *types);
}

}  // namespace morula::scenarios
