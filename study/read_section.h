#pragma once
#include "study/document.h"
#include "study/section.h"

namespace morula::scenarios {

/// Reads one section of a study from its node: values where the file has them, defaults elsewhere, errors for all that is not declared.
class ReadSection final : public Section {
 public:
  /// `node` is null when the file has no such section; `place` is where messages about the section as a whole point to.
  ReadSection(const Node* node, Place place, std::string path, const Laws& laws, const UnitSystem& units, Diagnostics& diagnostics)
      : Section(laws), node_(node), place_(std::move(place)), path_(std::move(path)), units_(units), diagnostics_(diagnostics) {}

  void quantity(const KeySpec& key, Given<double>& value) override;
  void whole(const KeySpec& key, Given<std::uint64_t>& value) override;
  void word(const KeySpec& key, Given<std::string>& value) override;
  void text(const KeySpec& key, Given<std::string>& value) override;
  void flag(const KeySpec& key, Given<bool>& value) override;
  void vector(const KeySpec& key, Given<Vec3d>& value) override;
  void vectors(const KeySpec& key, Given<std::vector<Vec3d>>& value) override;
  void words(const KeySpec& key, Given<std::vector<std::string>>& value) override;
  void one_or_more(const KeySpec& key, Given<std::vector<std::string>>& value) override;
  void suffixed(const char* suffix, const KeySpec& prefix_key, Given<std::string>& prefix, const KeySpec& key,
                Given<double>& value) override;
  void group(const KeySpec& key, bool& present, const std::function<void(Section&)>& describe) override;
  void quantities(const KeySpec& key, std::vector<Named<Given<double>>>& items) override;

  /// After the declaration has run: refuse the keys that nobody asked for.
  void finish();

 protected:
  void named_items(const KeySpec& key, const Container& items) override;
  void listed_items(const KeySpec& key, const Container& items) override;

 private:
  struct Suffix {
    std::string suffix;
    KeySpec value_key;
    Given<std::string>* prefix;
    Given<double>* value;
  };

  const Node::Entry* take(const KeySpec& key);
  /// The key as the user wrote it: a bare value that stands for a key of this section goes by the section's name.
  [[nodiscard]] std::string shown_name(const KeySpec& key) const;
  [[nodiscard]] std::string shown(const KeySpec& key) const;
  [[nodiscard]] std::string path_of(const std::string& name) const { return path_.empty() ? name : path_ + "." + name; }
  /// The scalar of a key as text with its place: from the file, or the default. Null when there is neither, or on an error.
  const Node* scalar(const KeySpec& key, Node& storage, bool& given);
  /// The same, and what is known of the value before it is read: whether it is given, its place, its default.
  template <class T>
  const Node* scalar(const KeySpec& key, Node& storage, Given<T>& value) {
    const Node* node = scalar(key, storage, value.given);
    value.place = node ? node->place : place_;
    value.fallback = key.fallback;
    return node;
  }
  /// The words of a node that is a list.
  void word_items(const KeySpec& key, const Node& node, Given<std::vector<std::string>>& value);
  bool vector_items(const KeySpec& key, const Node& node, Vec3d& value, std::string& text);
  void read_section(const KeySpec& key, const Node& node, const Place& key_place, const std::string& path,
                    const std::function<void(Section&)>& describe);
  bool read_number(const KeySpec& key, const Node& node, double& value);
  void wrong_shape(const KeySpec& key, const Node& node, const char* expected);
  bool take_suffixed(const Node::Entry& entry);

  const Node* node_;
  Place place_;
  std::string path_;
  const UnitSystem& units_;
  Diagnostics& diagnostics_;
  std::string short_key_, short_for_;  ///< of a section written as a bare value: the key that it stands for, and the section's name
  std::vector<std::string> declared_;
  std::vector<Suffix> suffixes_;
};

/// Text as a YAML scalar: plain where that is safe, else in double quotes.
std::string yaml_scalar(const std::string& text);
/// A name for cell types, fields, obstacles and studies: a letter or `_`, then letters, digits, `_` or `-`; at most 64 characters.
bool is_name(const std::string& text);
/// What a name is, for people.
inline constexpr const char* kNameHelp = "names begin with a letter and hold letters, digits, `_` and `-`, at most 64 characters";
/// A number for people: at most six digits, no trailing zeros.
std::string short_number(double value);

}  // namespace morula::scenarios
