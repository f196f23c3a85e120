#include "study/document.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <unordered_map>

namespace morula::scenarios {
namespace {

/// The way out of the parser where there are too many nodes.
struct TooManyNodes {
  YAML::Mark mark;
};

/// Builds our Node tree from the parser's events. Events carry everything that yaml-cpp's own node tree loses: double keys, anchors, marks.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::shared_ptr<const SourceText> source, std::size_t max_nodes, Diagnostics& diagnostics)
      : source_(std::move(source)), diagnostics_(diagnostics), nodes_left_(max_nodes) {}

  Node root;
  bool any = false;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    count(mark);
    refuse_anchor(mark, anchor);
    Node node;
    node.place = open_.empty() || !open_.back().has_key ? place(mark, 1) : open_.back().key_place;
    add(std::move(node), "");
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    count(mark);
    diagnostics_.error(106, place(mark, token_length(mark)), "aliases (`*name`) are not allowed in a study", "write the value out");
    Node node;
    node.place = place(mark, 1);
    add(std::move(node), "*");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, const std::string& value) override {
    count(mark);
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    Node node;
    node.kind = Node::Kind::kScalar;
    node.text = value;
    const char first = byte(mark) < source_->bytes.size() ? source_->bytes[byte(mark)] : ' ';
    node.place = place(mark, value.size() + (first == '"' || first == '\'' ? 2 : 0));
    add(std::move(node), value);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
    begin(mark, tag, anchor, Node::Kind::kList);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
    begin(mark, tag, anchor, Node::Kind::kMap);
  }
  void OnMapEnd() override { end(); }

  /// Close what is open, without its end.
  void cut_off() {
    while (!open_.empty()) {
      open_.back().node.cut_off = true;
      end();
    }
  }

 private:
  struct Open {
    Node node;
    bool has_key = false;
    std::string key;
    Place key_place;
    std::unordered_map<std::string, int> line_of;  ///< of each key so far
  };

  [[nodiscard]] std::size_t byte(const YAML::Mark& mark) const { return mark.pos < 0 ? 0 : static_cast<std::size_t>(mark.pos); }
  [[nodiscard]] Place place(const YAML::Mark& mark, std::size_t length) const { return place_at(source_, byte(mark), length); }
  [[nodiscard]] std::size_t token_length(const YAML::Mark& mark) const {
    const std::size_t stop = source_->bytes.find_first_of(" \t\r\n,]}", byte(mark));
    return (stop == std::string::npos ? source_->bytes.size() : stop) - std::min(byte(mark), source_->bytes.size());
  }

  void refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor)
      diagnostics_.error(106, place(mark, token_length(mark)), "anchors (`&name`) are not allowed in a study", "write the value out");
  }
  void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    if (!tag.empty() && tag != "?" && tag != "!")
      diagnostics_.error(106, place(mark, token_length(mark)), "tags (`!name`) are not allowed in a study", "leave the tag away");
  }

  void count(const YAML::Mark& mark) {
    if (nodes_left_-- == 0) throw TooManyNodes{mark};
  }

  void begin(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, Node::Kind kind) {
    count(mark);
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    Open open;
    open.node.kind = kind;
    open.node.place = place(mark, 1);
    open_.push_back(std::move(open));
  }
  void end() {
    Node node = std::move(open_.back().node);
    open_.pop_back();
    add(std::move(node), "");
  }

  void add(Node node, const std::string& as_key) {
    if (open_.empty()) {
      root = std::move(node);
      any = true;
      return;
    }
    Open& parent = open_.back();
    if (parent.node.kind == Node::Kind::kList) {
      parent.node.items.push_back(std::move(node));
    } else if (!parent.has_key) {
      take_key(parent, node, as_key);
    } else {
      parent.has_key = false;
      if (!parent.key.empty()) parent.node.entries.push_back({std::move(parent.key), std::move(parent.key_place), std::move(node)});
    }
  }

  void take_key(Open& parent, const Node& node, const std::string& as_key) {
    parent.has_key = true;
    parent.key.clear();  // an empty key: its value is dropped
    parent.key_place = node.place;
    if (as_key == "<<") {
      diagnostics_.error(106, node.place, "merge keys (`<<`) are not allowed in a study", "write the keys out");
    } else if (node.kind != Node::Kind::kScalar || as_key.empty()) {
      if (as_key != "*") diagnostics_.error(112, node.place, "a key must be a word", "write `name: value`");
    } else if (const auto [first, fresh] = parent.line_of.try_emplace(as_key, node.place.line); !fresh) {
      diagnostics_.error(102, node.place, "key '" + as_key + "' is given twice, first in line " + std::to_string(first->second),
                         "keep one of them");
    } else {
      parent.key = as_key;
    }
  }

  std::shared_ptr<const SourceText> source_;
  Diagnostics& diagnostics_;
  std::vector<Open> open_;
  std::size_t nodes_left_;
};

/// Tabs may not indent YAML; found here because the parser's own message depends on what follows the tab.
bool refuse_tabs(const std::shared_ptr<const SourceText>& source, Diagnostics& diagnostics) {
  bool found = false;
  for (const std::size_t begin : source->line_begin) {
    const std::size_t word = source->bytes.find_first_not_of(" \t", begin);
    if (word == std::string::npos || source->bytes[word] == '\n' || source->bytes[word] == '\r') continue;
    // Within the indentation only: a search to the end of the file from each of its lines takes seconds in a large one.
    const std::size_t tab = std::string_view(source->bytes).substr(begin, word - begin).find('\t');
    if (tab == std::string_view::npos) continue;
    diagnostics.error(105, place_at(source, begin + tab, 1), "a tab is used for indentation", "indent with spaces");
    found = true;
  }
  return found;
}

}  // namespace

const Node* Node::find(std::string_view key) const {
  for (const Entry& entry : entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

Node* Node::find(std::string_view key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

Node parse_document(const std::shared_ptr<const SourceText>& source, Diagnostics& diagnostics, std::size_t max_nodes) {
  if (refuse_tabs(source, diagnostics)) return {};
  TreeBuilder builder(source, max_nodes, diagnostics);
  const Place start{source, 1, 1, 1};
  try {
    std::istringstream stream(source->bytes);
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder) || !builder.any || builder.root.kind == Node::Kind::kNull) {
      diagnostics.error(107, start, "the study is empty", "`morula new` writes one to start from");
      return {};
    }
    Node first = std::move(builder.root);
    if (parser.HandleNextDocument(builder))
      diagnostics.error(107, builder.root.place, "a study is one YAML document, but another one follows",
                        "remove the line `---` and what comes after");
    return first;
  } catch (const TooManyNodes& end) {
    builder.cut_off();
    diagnostics.error(690, Place{source, 0, 0, 1},
                      "the study has more than " + std::to_string(max_nodes) + " keys and values: of its " +
                          std::to_string(source->line_begin.size()) + " lines, those from line " + std::to_string(end.mark.line + 1) +
                          " on are not read",
                      "a table of cells belongs into a file of its own: `csv: cells.csv`");
    return std::move(builder.root);
  } catch (const YAML::Exception& e) {  // the parser's way to report syntax errors; it ends here
    const Place at = e.mark.is_null() ? start : place_at(source, static_cast<std::size_t>(std::max(0, e.mark.pos)), 1);
    diagnostics.error(100, at, "not valid YAML: " + e.msg,
                      "check the indentation, colons, quotes and brackets at this place and just before it");
    return {};
  }
}

}  // namespace morula::scenarios
