#include "study/write_section.h"

#include "study/declare.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

class WriteSection final : public Section {
 public:
  WriteSection(int indent, const Laws& laws) : Section(laws), indent_(static_cast<std::size_t>(indent), ' ') {}

  std::string out;

  void quantity(const KeySpec& key, Given<double>& v) override { line(key, yaml_scalar(v.text), v.known(), v.given); }
  void whole(const KeySpec& key, Given<std::uint64_t>& v) override { line(key, yaml_scalar(v.text), v.known(), v.given); }
  void word(const KeySpec& key, Given<std::string>& v) override { line(key, yaml_scalar(v.text), v.known(), v.given); }
  void text(const KeySpec& key, Given<std::string>& v) override { line(key, yaml_scalar(v.text), v.known(), v.given); }
  void flag(const KeySpec& key, Given<bool>& v) override { line(key, v.text, v.known(), v.given); }
  void vector(const KeySpec& key, Given<Vec3d>& v) override { line(key, v.text, v.known(), v.given); }
  void vectors(const KeySpec& key, Given<std::vector<Vec3d>>& v) override { line(key, v.text, v.known(), v.given); }
  void words(const KeySpec& key, Given<std::vector<std::string>>& v) override { line(key, v.text, v.known(), v.given); }
  void suffixed(const char*, const KeySpec& prefix_key, Given<std::string>& prefix, const KeySpec& key, Given<double>& value) override {
    text(prefix_key, prefix);
    quantity(key, value);
  }
  void quantities(const KeySpec& key, std::vector<Named<Given<double>>>& items) override {
    if (items.empty()) return;
    out += indent_ + key.name + ":\n";
    for (const Named<Given<double>>& item : items)
      out += indent_ + "  " + item.name + ": " + yaml_scalar(item.content.text) + origin(key, item.content.given);
  }
  void group(const KeySpec& key, bool& present, const std::function<void(Section&)>& describe) override {
    if (key.optional_section && !present) return;
    nested(indent_ + key.name + ":\n", key.optional_section ? " {}" : nullptr, describe);
  }

 protected:
  void named_items(const KeySpec& key, const Container& items) override {
    if (items.size() == 0) return;
    out += indent_ + key.name + ":\n";
    for (std::size_t i = 0; i < items.size(); ++i) {
      WriteSection inner(static_cast<int>(indent_.size()) + 4, laws());
      items.describe(inner, i);
      out += indent_ + "  " + items.name(i) + ":" + (inner.out.empty() ? " {}\n" : "\n") + inner.out;
    }
  }
  void listed_items(const KeySpec& key, const Container& items) override {
    if (items.size() == 0) return;
    out += indent_ + key.name + ":\n";
    for (std::size_t i = 0; i < items.size(); ++i) {
      WriteSection inner(static_cast<int>(indent_.size()) + 4, laws());
      items.describe(inner, i);
      if (!inner.out.empty()) inner.out.replace(indent_.size() + 2, 1, "-");
      out += inner.out.empty() ? indent_ + "  - {}\n" : inner.out;
    }
  }

 private:
  /// What follows a value: nothing where the study gave it, else that it is a default and where that comes from.
  static std::string origin(const KeySpec& key, bool given) {
    if (given) return "\n";
    return std::string("  # default") + (*key.source ? ": " : "") + key.source + "\n";
  }
  void line(const KeySpec& key, const std::string& value, bool known, bool given) {
    if (known) out += indent_ + key.name + ": " + value + origin(key, given);
  }
  void nested(const std::string& head, const char* when_empty, const std::function<void(Section&)>& describe) {
    WriteSection inner(static_cast<int>(indent_.size()) + 2, laws());
    describe(inner);
    if (!inner.out.empty())
      out += head + inner.out;
    else if (when_empty)
      out += head.substr(0, head.size() - 1) + when_empty + "\n";
  }

  std::string indent_;
};

}  // namespace

std::string write_study(draft::Study& study, const Laws& laws) {
  WriteSection section(0, laws);
  declare_study(section, study);
  return section.out;
}

}  // namespace morula::scenarios
