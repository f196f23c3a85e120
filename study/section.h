#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/key_spec.h"
#include "core/vec3.h"
#include "coupling/laws.h"
#include "study/diagnostics.h"
#include "study/given.h"
#include "study/plain_keys.h"
#include "study/quantity_reader.h"

namespace morula::scenarios {

class Section;

/// How a section reaches the things of a map or list that it does not know by type.
struct Container {
  std::function<std::size_t()> size;
  std::function<std::string(std::size_t)> name;
  std::function<void(const std::string& name, const Place&)> add;
  std::function<void(Section&, std::size_t)> describe;
};

/// A thing with a name given by the user, such as a cell type.
template <class T>
struct Named {
  std::string name;
  Place place;
  T content;
};

/// One section of the study as its declaration sees it. The declaration (declare.h) calls these functions once for each key; reading, listing
/// and writing are three implementations, so that a key is declared in one place only.
class Section {
 public:
  explicit Section(const Laws& laws) : laws_(laws) {}
  Section(const Section&) = delete;
  Section& operator=(const Section&) = delete;
  virtual ~Section() = default;

  /// The laws that a study may name; their own keys are declared with those of the section.
  [[nodiscard]] const Laws& laws() const { return laws_; }

  virtual void quantity(const KeySpec& key, Given<double>& value) = 0;
  virtual void whole(const KeySpec& key, Given<std::uint64_t>& value) = 0;
  virtual void word(const KeySpec& key, Given<std::string>& value) = 0;                ///< one of key.words
  virtual void text(const KeySpec& key, Given<std::string>& value) = 0;                ///< any text
  virtual void flag(const KeySpec& key, Given<bool>& value) = 0;                       ///< true or false
  virtual void vector(const KeySpec& key, Given<Vec3d>& value) = 0;                    ///< [x, y, z]
  virtual void vectors(const KeySpec& key, Given<std::vector<Vec3d>>& value) = 0;      ///< list of [x, y, z]; one alone is a list of one
  virtual void words(const KeySpec& key, Given<std::vector<std::string>>& value) = 0;  ///< list of words; key.words empty: any
  /// As words(), where a bare word stands for a list of one.
  virtual void one_or_more(const KeySpec& key, Given<std::vector<std::string>>& value) { words(key, value); }
  /// A number whose unit depends on another key, such as a limit of a measure; the text is kept.
  virtual void any_quantity(const KeySpec& key, Given<std::string>& value) { text(key, value); }
  virtual void any_quantities(const KeySpec& key, Given<std::vector<std::string>>& value) { words(key, value); }
  /// A comparison `subject > quantity` or `subject < quantity`; the text is kept, its meaning depends on the subject.
  virtual void comparison(const KeySpec& key, Given<std::string>& value) { text(key, value); }
  /// `<prefix><suffix>: value` with a prefix of the user's choice, such as `oxygen_below: 0.02 mM`: the same as `prefix_key: prefix` and
  /// `key: value`.
  virtual void suffixed(const char* suffix, const KeySpec& prefix_key, Given<std::string>& prefix, const KeySpec& key,
                        Given<double>& value) = 0;
  // Keys that go as they are into what is built.
  template <class Target>
  void quantity(const KeySpec& key, PlainKeys<Target>& keys, double Target::*member) {
    quantity(key, keys.of(key.name, member));
  }
  template <class Target>
  void whole(const KeySpec& key, PlainKeys<Target>& keys, std::uint64_t Target::*member) {
    whole(key, keys.of(key.name, member));
  }
  template <class Target>
  void flag(const KeySpec& key, PlainKeys<Target>& keys, bool Target::*member) {
    flag(key, keys.of(key.name, member));
  }
  /// A section within this one; `present` says whether the file has it (a default section is described, too).
  virtual void group(const KeySpec& key, bool& present, const std::function<void(Section&)>& describe) = 0;

  /// A map from the user's names to sections.
  template <class T>
  void named(const KeySpec& key, std::vector<Named<T>>& items, std::type_identity_t<std::function<void(Section&, T&)>> describe) {
    named_items(key, {[&items] { return items.size(); }, [&items](std::size_t i) { return items[i].name; },
                      [&items](const std::string& name, const Place& place) {
                        items.push_back({name, place, T{}});
                      },
                      [&items, describe = std::move(describe)](Section& section, std::size_t i) { describe(section, items[i].content); }});
  }
  /// A list of sections.
  template <class T>
  void list(const KeySpec& key, std::vector<Named<T>>& items, void (*describe)(Section&, T&)) {
    listed_items(key, {[&items] { return items.size(); }, [](std::size_t i) { return std::to_string(i); },
                       [&items](const std::string& name, const Place& place) {
                         items.push_back({name, place, T{}});
                       },
                       [&items, describe](Section& section, std::size_t i) { describe(section, items[i].content); }});
  }
  /// A map from the user's names to quantities.
  virtual void quantities(const KeySpec& key, std::vector<Named<Given<double>>>& items) = 0;

 protected:
  virtual void named_items(const KeySpec& key, const Container& items) = 0;
  virtual void listed_items(const KeySpec& key, const Container& items) = 0;

 private:
  const Laws& laws_;
};

}  // namespace morula::scenarios
