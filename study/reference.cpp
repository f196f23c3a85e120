#include <algorithm>

#include "core/numbers/joined.h"
#include "core/numbers/unit_conversion.h"
#include "coupling/observables/observable.h"
#include "study/catalogue.h"
#include "study/error_codes.h"
#include "study/key_range.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

using Kind = Declaration::Kind;

bool is_section(const Declaration& d) { return d.kind == Kind::kGroup || d.kind == Kind::kNamed || d.kind == Kind::kList; }

std::string kind_text(const Declaration& d) {
  const KeySpec& key = d.spec;
  std::string words = listed(key.words);
  for (const Special& special : key.specials) words += (words.empty() ? "" : ", ") + std::string("`") + special.word + "`";
  const std::string quantity(describe(key.quantity).name);
  switch (d.kind) {
    case Kind::kQuantity:
      return quantity + (words.empty() ? "" : ", or " + words);
    case Kind::kWhole:
      return "a whole number" + (words.empty() ? "" : ": " + words);
    case Kind::kWord:
      return "one of " + words;
    case Kind::kText:
      return "text";
    case Kind::kFlag:
      return "`true` or `false`";
    case Kind::kVector:
      return "[x, y, z], each " + quantity + (words.empty() ? "" : ", or " + words);
    case Kind::kVectors:
      return "[x, y, z], or a list of these, each " + quantity;
    case Kind::kWords:
      return "a list of words" + (words.empty() ? "" : ": " + words);
    case Kind::kOneOrMore:
      return "a word, or a list of words";
    case Kind::kAnyQuantity:
      return "a number with the unit of the measure";
    case Kind::kAnyQuantities:
      return "a list of numbers with the unit of the measure";
    case Kind::kComparison:
      return "a comparison: `value > quantity` or `value < quantity`";
    case Kind::kQuantities:
      return "a map from names to values, each " + quantity;
    case Kind::kGroup:
      return "a section";
    case Kind::kNamed:
      return "a map from names to sections";
    case Kind::kList:
      return "a list of sections";
  }
  return "";
}

/// Both ends where the key has values with ends.
std::string range_text(const Declaration& d) {
  switch (d.kind) {
    case Kind::kQuantity:
    case Kind::kVector:
    case Kind::kVectors:
    case Kind::kQuantities:
    case Kind::kWhole:
      return d.spec.words.empty() ? range_words(d.spec) : "";
    default:
      return "";
  }
}

std::string explain_key(const Declaration& d) {
  std::string out = d.path + "\n  " + d.spec.doc + "\n";
  out += "  kind:     " + kind_text(d) + "\n";
  if (const std::string range = range_text(d); !range.empty()) out += "  range:    " + range + "\n";
  if (d.spec.required)
    out += "  default:  none, must be given\n";
  else if (d.spec.fallback && *d.spec.fallback)
    out += "  default:  " + std::string(d.spec.fallback) + "\n";
  if (*d.spec.source) out += "  source:   " + std::string(d.spec.source) + "\n";
  if (*d.spec.example) out += "  example:  `" + std::string(d.spec.name) + ": " + d.spec.example + "`\n";
  if (!d.suffix.empty()) out += "  also:     `<field>" + d.suffix + ": " + d.spec.example + "`\n";
  if (d.spec.shorthand) out += "  short:    a bare value stands for `" + std::string(d.spec.shorthand) + "`\n";
  if (is_section(d)) {
    out += "  keys:     ";
    for (std::size_t i = 0; i < d.children.size(); ++i) out += (i ? ", " : "") + std::string(d.children[i].spec.name);
    out += "\n";
  }
  return out;
}

/// Whether a path of a key ends with (or is) what the user typed; the user's own names stand where the path has `<name>`.
bool path_matches(const std::string& path, const std::string& typed) {
  const auto parts = [](const std::string& text) {
    std::vector<std::string> out{""};
    for (const char c : text) {
      if (c == '.')
        out.emplace_back();
      else if (c != '[' && c != ']' && !(c >= '0' && c <= '9' && text.find('[') != std::string::npos))
        out.back() += c;
    }
    return out;
  };
  std::vector<std::string> a = parts(path);
  const std::vector<std::string> b = parts(typed);
  if (!a.empty() && a.back() == "<name>" && (b.size() < a.size() || b.back() != "<name>")) {
    std::vector<std::string> shorter(a.begin(), a.end() - 1);  // a map of sections is also known by its own name
    if (b.size() <= shorter.size() && std::equal(b.rbegin(), b.rend(), shorter.rbegin())) return true;
  }
  if (b.size() > a.size()) return false;
  for (std::size_t i = 1; i <= b.size(); ++i)
    if (a[a.size() - i] != b[b.size() - i] && a[a.size() - i] != "<name>") return false;
  return !(b.size() == 1 && a.back() == "<name>");
}

/// Of a whole path, or null.
const Declaration* find_path(const Declaration& from, const std::string& path) {
  for (const Declaration& child : from.children) {
    if (child.path == path) return &child;
    if (const Declaration* found = find_path(child, path)) return found;
  }
  return nullptr;
}

void explain_matching(const Declaration& from, const std::string& typed, std::string& out) {
  for (const Declaration& child : from.children) {
    if (path_matches(child.path, typed)) out += explain_key(child);
    explain_matching(child, typed, out);
  }
}

void table_of(const Declaration& section, std::string& out) {
  if (!section.path.empty()) {
    out += "\n## `" + section.path + "`\n\n" + section.spec.doc + "\n";
    if (section.spec.shorthand) out += "\nA bare value stands for `" + std::string(section.spec.shorthand) + "`.\n";
  }
  out += "\n| key | what | kind | range | default | source |\n|---|---|---|---|---|---|\n";
  for (const Declaration& child : section.children) {
    const KeySpec& key = child.spec;
    const std::string fallback = key.required ? "required" : key.fallback && *key.fallback ? "`" + std::string(key.fallback) + "`" : "";
    const std::string name = std::string("`") + key.name + "`" + (child.suffix.empty() ? "" : ", or `<field>" + child.suffix + "`");
    out += "| " + name + " | " + key.doc + " | " + kind_text(child) + " | " + range_text(child) + " | " + fallback + " | " + key.source +
           " |\n";
  }
  for (const Declaration& child : section.children)
    if (is_section(child)) table_of(child, out);
}

/// Whether a name is that of an observable, or one whose part in angle brackets the study names: `mean_oxygen` is `mean_<field>`.
bool is_observable(const std::string& pattern, const std::string& typed) {
  const std::size_t open = pattern.find('<'), close = pattern.find('>');
  if (open == std::string::npos || close == std::string::npos) return typed == pattern;
  const std::string before = pattern.substr(0, open), after = pattern.substr(close + 1);
  return typed.size() > before.size() + after.size() && typed.starts_with(before) && typed.ends_with(after);
}

void explain_observables(const std::string& typed, const Laws& laws, std::string& out) {
  for (const Observable& one : observables_of_any_model(laws))
    if (is_observable(one.name, typed)) out += one.name + " [" + one.unit + "]: " + one.doc + "\n  a column of series.csv\n";
}

}  // namespace

std::optional<std::string> explain_study(const std::string& id, const Laws& laws) {
  if (id.size() == 4 && (id[0] == 'E' || id[0] == 'e') && id.find_first_not_of("0123456789", 1) == std::string::npos) {
    const ErrorCode* code = find_error_code(std::stoi(id.substr(1)));
    if (!code) return std::nullopt;
    return "E" + std::to_string(code->code) + ": " + code->title + "\n  " + code->explanation + "\n";
  }
  std::string out;
  if (!id.empty()) {
    const Declaration all = study_declarations(laws);
    const Declaration* const whole = id.find('.') == std::string::npos ? nullptr : find_path(all, id);
    if (whole != nullptr)
      out += explain_key(*whole);
    else
      explain_matching(all, id, out);
    explain_observables(id, laws, out);
  }
  if (out.empty()) return std::nullopt;
  return out;
}

std::string study_reference(const Laws& laws) {
  std::string out =
      "# The study file\n\nGenerated from the declarations of the reader (`study/declare_*.cpp`); do not edit.\n\n"
      "A study is one YAML document. Every number with a dimension carries its unit, such as `2.5 kPa`. Keys that are not listed here are "
      "errors.\n";
  table_of(study_declarations(laws), out);
  out +=
      "\n## Columns of series.csv\n\nThe names that `output.series` knows; in angle brackets what the study names.\n\n"
      "| name | unit | what |\n|---|---|---|\n";
  for (const Observable& one : observables_of_any_model(laws)) out += "| `" + one.name + "` | " + one.unit + " | " + one.doc + " |\n";
  out += "\n## Units\n\nKnown units, with SI prefixes: " + UnitSystem::known_units() + ". Products and powers are written `N s/m^3`.\n";
  out += "\n## Messages\n\n| code | title | meaning |\n|---|---|---|\n";
  for (const ErrorCode& code : error_codes())
    out += "| E" + std::to_string(code.code) + " | " + code.title + " | " + code.explanation + " |\n";
  return out;
}

}  // namespace morula::scenarios
