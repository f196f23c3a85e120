#include "scenarios/compare/settings.h"

#include <algorithm>
#include <memory>
#include <set>

#include "study/document.h"

namespace morula::scenarios {
namespace {

void add(const Node& node, const std::string& path, Settings& out) {
  const auto below = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
  switch (node.kind) {
    case Node::Kind::kNull:
      return;
    case Node::Kind::kScalar:
      out[path] = node.text;
      return;
    case Node::Kind::kMap:
      for (const Node::Entry& entry : node.entries) add(entry.value, below(entry.key), out);
      return;
    case Node::Kind::kList:
      for (std::size_t i = 0; i < node.items.size(); ++i) add(node.items[i], below(std::to_string(i)), out);
  }
}

}  // namespace

Result<Settings> settings_of(const std::string& resolved_text, const std::string& origin) {
  Diagnostics diagnostics;
  const auto source = std::make_shared<const SourceText>(origin, resolved_text);
  const Node document = parse_document(source, diagnostics);
  if (diagnostics.has_errors()) return Error{ErrorKind::kFile, "'" + origin + "' is damaged: " + diagnostics.text(), ""};
  Settings out;
  add(document, "", out);
  return out;
}

std::string setting(const Settings& settings, const std::string& path) {
  const auto at = settings.find(path);
  return at != settings.end() ? at->second : "";
}

std::vector<std::string> differing_paths(const std::vector<const Settings*>& all, const std::vector<std::string>& but) {
  std::set<std::string> paths;
  for (const Settings* one : all)
    for (const auto& [path, text] : *one) paths.insert(path);
  std::vector<std::string> out;
  for (const std::string& path : paths) {
    const bool same = std::ranges::all_of(all, [&](const Settings* one) { return setting(*one, path) == setting(*all.front(), path); });
    if (!same && std::ranges::find(but, path) == but.end()) out.push_back(path);
  }
  return out;
}

}  // namespace morula::scenarios
