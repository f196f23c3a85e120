#include <algorithm>
#include <cctype>
#include <charconv>

#include "study/catalogue.h"
#include "study/document.h"

namespace morula::scenarios {
namespace {

constexpr const char* kExample = "write `key.path=value`, for example `cell_types.hepatocyte.radius=\"7 um\"` or `time.end=2h`";

/// Where a comment begins in YAML: at a `#` after a blank, outside of quotes; npos without one.
std::size_t comment_in(const std::string& text, std::size_t from) {
  char quote = '\0';
  for (std::size_t i = from; i < text.size(); ++i) {
    if (quote != '\0')
      quote = text[i] == quote ? '\0' : quote;
    else if (text[i] == '"' || text[i] == '\'')
      quote = text[i];
    else if (text[i] == '#' && (i == from || std::isspace(static_cast<unsigned char>(text[i - 1])) != 0))
      return i;
  }
  return std::string::npos;
}

/// The value as it stands after the `=`; its places are those of the argument as it was typed.
bool parse_value(const std::shared_ptr<const SourceText>& whole, std::size_t equals, Node& value, Diagnostics& diagnostics) {
  const std::string& assignment = whole->bytes;
  if (const std::size_t cut = comment_in(assignment, equals + 1); cut != std::string::npos) {
    diagnostics.error(110, place_at(whole, cut, 1), "from this `#` on the value would be read as a comment",
                      "put the value in quotes of its own: `key.path='\"a # b\"'`");
    return false;
  }
  // The value keeps its column: blanks stand where the key path was.
  const auto text = std::make_shared<const SourceText>("command line", std::string(equals + 1, ' ') + assignment.substr(equals + 1));
  Diagnostics of_value;
  value = parse_document(text, of_value);
  if (of_value.has_errors()) {
    diagnostics.error(110, place_at(whole, equals + 1, assignment.size()), "the value of '" + assignment + "' cannot be read", kExample);
    return false;
  }
  const auto retarget = [&whole](auto& self, Node& node) -> void {
    node.place.source = whole;
    for (Node::Entry& entry : node.entries) entry.key_place.source = whole, self(self, entry.value);
    for (Node& item : node.items) self(self, item);
  };
  retarget(retarget, value);
  return true;
}

/// A walk along the path, in the document and in the declarations.
class Walk {
 public:
  Walk(Node& document, const Declaration& declared, const std::shared_ptr<const SourceText>& whole, Diagnostics& diagnostics)
      : at_(&document), declared_(&declared), whole_(whole), diagnostics_(diagnostics) {}

  /// One part of the path further, which ends at byte `end`; `value` is that of the whole override where this is its last part.
  bool step(const std::string& part, std::size_t begin, std::size_t end, const Node* value) {
    const Place here = place_at(whole_, begin, end - begin);
    if (part == "+" && declared_ && declared_->kind == Declaration::Kind::kList) return open_new_item(here, end);
    open_bare_value();
    if (at_->kind == Node::Kind::kList) {
      std::size_t index = 0;
      const auto [stop, code] = std::from_chars(part.data(), part.data() + part.size(), index);
      if (code != std::errc() || stop != part.data() + part.size() || index >= at_->items.size()) return no_place(here, end);
      at_ = &at_->items[index];
      return true;
    }
    if (part.empty() || at_->kind != Node::Kind::kMap) return no_place(here, end);
    const bool is_name = names_;
    follow_declaration(part);
    if (Node* found = at_->find(part)) {
      at_ = found;
      return true;
    }
    if (is_name && !may_be_new(part, here, begin, value)) return false;
    Node fresh;
    fresh.place = here;
    at_->entries.push_back({part, here, std::move(fresh)});
    at_ = &at_->entries.back().value;
    return true;
  }
  [[nodiscard]] Node& at() { return *at_; }

 private:
  /// A new item before the first of a list.
  bool open_new_item(const Place& here, std::size_t end) {
    if (at_->kind == Node::Kind::kNull) at_->kind = Node::Kind::kList;
    if (at_->kind != Node::Kind::kList) return no_place(here, end);
    Node fresh;
    fresh.place = here;
    at_ = &*at_->items.insert(at_->items.begin(), std::move(fresh));
    return true;
  }

  void open_bare_value() {
    if (at_->kind == Node::Kind::kNull) at_->kind = Node::Kind::kMap;
    const bool bare = at_->kind == Node::Kind::kScalar || at_->kind == Node::Kind::kList;
    if (!bare || !declared_ || names_ || !declared_->spec.shorthand || declared_->kind == Declaration::Kind::kList) return;
    Node map;
    map.kind = Node::Kind::kMap;
    map.place = at_->place;
    map.entries.push_back({declared_->spec.shorthand, at_->place, std::move(*at_)});
    *at_ = std::move(map);
  }

  void follow_declaration(const std::string& part) {
    if (names_ || !declared_) {
      names_ = false;  // a name leads to the section that is declared for all of them
      return;
    }
    const auto& children = declared_->children;
    const auto child = std::find_if(children.begin(), children.end(), [&](const Declaration& d) { return part == d.spec.name; });
    declared_ = child == children.end() ? nullptr : &*child;
    names_ = declared_ && declared_->kind == Declaration::Kind::kNamed;
  }

  bool may_be_new(const std::string& part, const Place& here, std::size_t begin, const Node* value) {
    std::vector<std::string> names;
    for (const Node::Entry& entry : at_->entries) names.push_back(entry.key);
    const std::string near = suggest(part, names);
    const bool whole_thing = value && value->kind == Node::Kind::kMap;
    if (whole_thing && !near.starts_with("did you mean")) return true;
    const std::string section = begin > 0 ? whole_->bytes.substr(0, begin - 1) : "the study";
    const std::string fresh = "to add a thing, give all of it: `" + section + "." + part + "={...}`";
    diagnostics_.error(110, here, "there is no '" + part + "' in `" + section + "`", near.empty() ? fresh : near);
    return false;
  }

  bool no_place(const Place& here, std::size_t end) {
    diagnostics_.error(110, here, "'" + whole_->bytes.substr(0, end) + "' is not a place in the study", kExample);
    return false;
  }

  Node* at_;
  const Declaration* declared_;  ///< of the section that `at_` is; null where nothing is declared
  bool names_ = false;           ///< the section's keys are names given by the user
  std::shared_ptr<const SourceText> whole_;
  Diagnostics& diagnostics_;
};

}  // namespace

void apply_override(Node& document, const Declaration& declared, const std::string& assignment, Diagnostics& diagnostics) {
  const auto whole = std::make_shared<const SourceText>("command line", assignment);
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    diagnostics.error(110, place_at(whole, 0, assignment.size()), "'" + assignment + "' does not set a key", kExample);
    return;
  }
  Node value;
  if (!parse_value(whole, equals, value, diagnostics)) return;
  Walk walk(document, declared, whole, diagnostics);
  for (std::size_t begin = 0, dot = 0; dot != equals; begin = dot + 1) {
    dot = std::min(assignment.find('.', begin), equals);
    if (!walk.step(assignment.substr(begin, dot - begin), begin, dot, dot == equals ? &value : nullptr)) return;
  }
  walk.at() = std::move(value);
}

}  // namespace morula::scenarios
