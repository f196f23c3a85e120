#include "study/given_keys.h"

namespace morula::scenarios {
namespace {

class FindGiven final : public Section {
 public:
  FindGiven(const Laws& laws, std::string prefix, std::vector<GivenKey>& out) : Section(laws), prefix_(std::move(prefix)), out_(out) {}

  void quantity(const KeySpec& key, Given<double>& v) override { add(key, v); }
  void whole(const KeySpec& key, Given<std::uint64_t>& v) override { add(key, v); }
  void word(const KeySpec& key, Given<std::string>& v) override { add(key, v); }
  void text(const KeySpec& key, Given<std::string>& v) override { add(key, v); }
  void flag(const KeySpec& key, Given<bool>& v) override { add(key, v); }
  void vector(const KeySpec& key, Given<Vec3d>& v) override { add(key, v); }
  void vectors(const KeySpec& key, Given<std::vector<Vec3d>>& v) override { add(key, v); }
  void words(const KeySpec& key, Given<std::vector<std::string>>& v) override { add(key, v); }
  void suffixed(const char*, const KeySpec& prefix_key, Given<std::string>& prefix, const KeySpec& key, Given<double>& value) override {
    add(prefix_key, prefix);
    add(key, value);
  }
  void quantities(const KeySpec& key, std::vector<Named<Given<double>>>& items) override {
    for (const auto& item : items) out_.push_back({prefix_ + key.name + "." + item.name, item.place});
  }
  void group(const KeySpec& key, bool&, const std::function<void(Section&)>& describe) override {
    FindGiven inner(laws(), prefix_ + key.name + ".", out_);
    describe(inner);
  }

 protected:
  void named_items(const KeySpec& key, const Container& items) override { walk(key, items); }
  void listed_items(const KeySpec& key, const Container& items) override { walk(key, items); }

 private:
  template <class T>
  void add(const KeySpec& key, const Given<T>& value) {
    if (value.given) out_.push_back({prefix_ + key.name, value.place});
  }
  void walk(const KeySpec& key, const Container& items) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      FindGiven inner(laws(), prefix_ + key.name + "." + items.name(i) + ".", out_);
      items.describe(inner, i);
    }
  }

  std::string prefix_;
  std::vector<GivenKey>& out_;
};

}  // namespace

std::vector<GivenKey> keys_written_in(const Laws& laws, const std::function<void(Section&)>& describe) {
  std::vector<GivenKey> out;
  FindGiven section(laws, "", out);
  describe(section);
  return out;
}

}  // namespace morula::scenarios
