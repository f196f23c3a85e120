#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "study/diagnostics.h"

namespace morula::scenarios {

/// A YAML document as the user wrote it: every key and value with its place, scalars as text. Numbers are read later, by the key they
/// belong to, so that `010` or `1e3 kPa` never depend on what YAML takes them for.
struct Node {
  enum class Kind { kNull, kScalar, kList, kMap };
  struct Entry;

  Kind kind = Kind::kNull;
  std::string text;  ///< of a scalar
  Place place;
  std::vector<Entry> entries;  ///< of a map, in the order of the file
  std::vector<Node> items;     ///< of a list
  bool cut_off = false;        ///< a map or list whose end was not read: the document has too many nodes

  [[nodiscard]] const Node* find(std::string_view key) const;
  [[nodiscard]] Node* find(std::string_view key);
};

struct Node::Entry {
  std::string key;
  Place key_place;
  Node value;
};

/// Number of keys, values, lists and maps that are read of one document. Reading takes about 2 µs for each: a file full of mistakes is answered
/// at once, and the largest tables that belong into a study (places of 50,000 cells) have room.
inline constexpr std::size_t kMaxNodes = 200'000;

/// Parse YAML text. Refused with a message: syntax errors (E100), double keys (E102), tabs in indentation (E105), anchors, aliases, merge
/// keys and tags (E106), more than one document or none (E107), keys that are not words (E112), more than `max_nodes` nodes (E690). What could be
/// parsed is returned.
Node parse_document(const std::shared_ptr<const SourceText>& source, Diagnostics& diagnostics, std::size_t max_nodes = kMaxNodes);

struct Declaration;

/// Put `key.path=value` of the command line into the document, as if it were written there. Parts of the path are keys, or numbers (from 0)
/// of list items; what stands there as a bare value is opened. The user's names (of cell types, fields ...) must exist: a new thing comes
/// only with all of it, `fields.drug={...}`, and not by a name within two edits of another. Errors (E110) point at the command line.
void apply_override(Node& document, const Declaration& declared, const std::string& assignment, Diagnostics& diagnostics);

/// Give every cell type with `like: other` the keys of the other that it does not have itself, section by section; `adhesion` is left to
/// the table of pairs. E401: no such type; E656: types like each other in a circle, or too many in a row; E404: too much in all.
void expand_likes(Node& document, const Declaration& declared, Diagnostics& diagnostics);

}  // namespace morula::scenarios
