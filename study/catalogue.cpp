#include "study/catalogue.h"

#include "study/declare.h"

namespace morula::scenarios {
namespace {

/// Lists the declarations of a section; values are not looked at.
class ListSection final : public Section {
 public:
  ListSection(Declaration& into, const Laws& laws) : Section(laws), into_(into) {}

  void quantity(const KeySpec& key, Given<double>&) override { add(Declaration::Kind::kQuantity, key); }
  void whole(const KeySpec& key, Given<std::uint64_t>&) override { add(Declaration::Kind::kWhole, key); }
  void word(const KeySpec& key, Given<std::string>&) override { add(Declaration::Kind::kWord, key); }
  void text(const KeySpec& key, Given<std::string>&) override { add(Declaration::Kind::kText, key); }
  void flag(const KeySpec& key, Given<bool>&) override { add(Declaration::Kind::kFlag, key); }
  void vector(const KeySpec& key, Given<Vec3d>&) override { add(Declaration::Kind::kVector, key); }
  void vectors(const KeySpec& key, Given<std::vector<Vec3d>>&) override { add(Declaration::Kind::kVectors, key); }
  void words(const KeySpec& key, Given<std::vector<std::string>>&) override { add(Declaration::Kind::kWords, key); }
  void one_or_more(const KeySpec& key, Given<std::vector<std::string>>&) override { add(Declaration::Kind::kOneOrMore, key); }
  void any_quantity(const KeySpec& key, Given<std::string>&) override { add(Declaration::Kind::kAnyQuantity, key); }
  void any_quantities(const KeySpec& key, Given<std::vector<std::string>>&) override { add(Declaration::Kind::kAnyQuantities, key); }
  void comparison(const KeySpec& key, Given<std::string>&) override { add(Declaration::Kind::kComparison, key); }
  void quantities(const KeySpec& key, std::vector<Named<Given<double>>>&) override { add(Declaration::Kind::kQuantities, key); }
  void suffixed(const char* suffix, const KeySpec& prefix_key, Given<std::string>&, const KeySpec& key, Given<double>&) override {
    add(Declaration::Kind::kText, prefix_key);
    add(Declaration::Kind::kQuantity, key).suffix = suffix;
  }
  void group(const KeySpec& key, bool&, const std::function<void(Section&)>& describe) override {
    ListSection inner(add(Declaration::Kind::kGroup, key), laws());
    describe(inner);
  }

 protected:
  void named_items(const KeySpec& key, const Container& items) override { add_items(Declaration::Kind::kNamed, key, items, ".<name>"); }
  void listed_items(const KeySpec& key, const Container& items) override { add_items(Declaration::Kind::kList, key, items, "[]"); }

 private:
  Declaration& add(Declaration::Kind kind, const KeySpec& key) {
    into_.children.push_back({kind, key, into_.path.empty() ? key.name : into_.path + "." + key.name, {}, {}});
    return into_.children.back();
  }
  void add_items(Declaration::Kind kind, const KeySpec& key, const Container& items, const char* path) {
    Declaration& list = add(kind, key);
    list.path += path;
    items.add("", {});
    ListSection inner(list, laws());
    items.describe(inner, items.size() - 1);
  }

  Declaration& into_;
};

void collect_paths(const Declaration& from, std::vector<std::string>& paths) {
  for (const Declaration& child : from.children) {
    paths.push_back(child.path);
    collect_paths(child, paths);
  }
}

}  // namespace

Declaration study_declarations(const Laws& laws) {
  Declaration root;
  draft::Study draft;
  ListSection section(root, laws);
  declare_study(section, draft);
  return root;
}

std::vector<std::string> study_key_paths(const Laws& laws) {
  std::vector<std::string> paths;
  collect_paths(study_declarations(laws), paths);
  return paths;
}

}  // namespace morula::scenarios
