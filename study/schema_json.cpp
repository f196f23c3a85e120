#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/numbers/unit_conversion.h"
#include "study/catalogue.h"
#include "study/key_range.h"

namespace morula::scenarios {
namespace {

using Json = nlohmann::ordered_json;

/// A number with its unit, which may begin with one over something: `10 1/h`. Not a number alone, of which the end could be taken for a unit.
constexpr const char* kQuantityPattern =
    "^(?![+-]?[0-9.]+([eE][+-]?[0-9]+)?$)[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?( ?[^0-9 .].*| +[0-9]+ */.+)$";

Json description_of(const Declaration& d) {
  std::string text = d.spec.doc;
  const auto quantity = describe(d.spec.quantity);
  const bool number = d.kind == Declaration::Kind::kQuantity || d.kind == Declaration::Kind::kVector ||
                      d.kind == Declaration::Kind::kVectors || d.kind == Declaration::Kind::kQuantities;
  if (number && d.spec.quantity != Quantity::kNumber) text += " (" + std::string(quantity.name) + " with its unit)";
  if (*d.spec.source) text += " Source: " + std::string(d.spec.source) + ".";
  return text;
}

/// A number with its unit is a string; plain numbers and fractions may be numbers.
Json quantity_schema(const KeySpec& key) {
  Json choices = Json::array();
  if (key.quantity == Quantity::kNumber) {
    Json number{{"type", "number"}};
    const KeyRange range = range_of(key);
    number[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
    number[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
    choices.push_back(number);
  } else {
    if (key.quantity == Quantity::kFraction) choices.push_back({{"type", "number"}});
    choices.push_back({{"type", "string"}, {"pattern", kQuantityPattern}});
  }
  for (const Special& special : key.specials) choices.push_back({{"const", special.word}});
  return choices.size() == 1 ? choices[0] : Json{{"anyOf", choices}};
}

Json words_schema(const KeySpec& key) {
  if (key.words.empty()) return {{"type", "string"}};
  Json words = Json::array();
  for (const std::string& word : key.words) words.push_back(word);
  for (const auto& synonym : key.synonyms) words.push_back(synonym.first);
  return {{"enum", words}};
}

/// A number, or a text: with a unit, or a word.
Json any_quantity_schema() { return {{"anyOf", Json::array({{{"type", "number"}}, {{"type", "string"}}})}}; }

Json whole_schema(const KeySpec& key) {
  Json schema{{"type", "integer"}, {"minimum", key.low}, {"maximum", key.high}};
  if (!key.words.empty()) {
    Json numbers = Json::array();
    for (const std::string& word : key.words) numbers.push_back(std::stoi(word));
    schema = {{"enum", numbers}};
  }
  if (key.specials.empty()) return schema;
  Json choices = Json::array({schema});
  for (const Special& special : key.specials) choices.push_back({{"const", special.word}});
  return {{"anyOf", choices}};
}

/// `takes_back`: within something that may be like another, of which any key can be taken back by `default`.
Json schema_of(const Declaration& declaration, bool takes_back);

Json section_schema(const Declaration& section, bool takes_back) {
  takes_back = takes_back ||
               std::ranges::any_of(section.children, [](const Declaration& child) { return std::string_view(child.spec.name) == "like"; });
  Json schema{{"type", "object"}, {"properties", Json::object()}};
  Json required = Json::array();
  for (const Declaration& child : section.children) {
    schema["properties"][child.spec.name] = schema_of(child, takes_back);
    if (child.spec.required) required.push_back(child.spec.name);
    if (!child.suffix.empty()) schema["patternProperties"]["^[A-Za-z_][A-Za-z0-9_-]*" + child.suffix + "$"] = schema_of(child, takes_back);
  }
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  if (!section.spec.shorthand) return schema;
  for (const Declaration& child : section.children)
    if (child.spec.name == std::string(section.spec.shorthand)) return {{"anyOf", Json::array({schema_of(child, takes_back), schema})}};
  return schema;
}

Json vector_schema(const KeySpec& key) {
  KeySpec component = key;
  component.specials.clear();
  Json list{{"type", "array"}, {"items", quantity_schema(component)}, {"minItems", 3}, {"maxItems", 3}};
  if (key.specials.empty()) return list;
  Json choices = Json::array({list});
  for (const Special& special : key.specials) choices.push_back({{"const", special.word}});
  return {{"anyOf", choices}};
}

Json bare_schema(const Declaration& d, bool takes_back) {
  using Kind = Declaration::Kind;
  switch (d.kind) {
    case Kind::kQuantity:
      return quantity_schema(d.spec);
    case Kind::kWhole:
      return whole_schema(d.spec);
    case Kind::kWord:
      return words_schema(d.spec);
    case Kind::kText:
      return {{"type", "string"}};
    case Kind::kComparison:
      return {{"type", "string"}, {"pattern", "^[^<>]+[<>][^<>]+$"}};
    case Kind::kFlag:
      return {{"type", "boolean"}};
    case Kind::kVector:
      return vector_schema(d.spec);
    case Kind::kVectors:
      return {{"anyOf", Json::array({vector_schema(d.spec), {{"type", "array"}, {"items", vector_schema(d.spec)}, {"minItems", 1}}})}};
    case Kind::kWords:
      return {{"type", "array"}, {"items", words_schema(d.spec)}};
    case Kind::kOneOrMore:
      return {{"anyOf", Json::array({words_schema(d.spec), {{"type", "array"}, {"items", words_schema(d.spec)}, {"minItems", 1}}})}};
    case Kind::kAnyQuantity:
      return any_quantity_schema();
    case Kind::kAnyQuantities:
      return {{"type", "array"}, {"items", any_quantity_schema()}};
    case Kind::kQuantities:
      return {{"type", "object"}, {"additionalProperties", quantity_schema(d.spec)}};
    case Kind::kNamed:
      return {{"type", "object"}, {"additionalProperties", section_schema(d, takes_back)}};
    case Kind::kList:
      return {{"type", "array"}, {"items", section_schema(d, takes_back)}};
    case Kind::kGroup:
      return section_schema(d, takes_back);
  }
  return Json::object();
}

Json schema_of(const Declaration& d, bool takes_back) {
  Json schema = bare_schema(d, takes_back);
  if (takes_back && !d.spec.required) {
    if (!schema.contains("anyOf")) schema = {{"anyOf", Json::array({schema})}};
    schema["anyOf"].push_back({{"const", "default"}});
  }
  schema["description"] = description_of(d);
  if (d.spec.fallback && *d.spec.fallback) schema["default"] = d.spec.fallback;
  if (*d.spec.example) schema["examples"] = Json::array({d.spec.example});
  return schema;
}

}  // namespace

std::string study_json_schema(const Laws& laws) {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Morula study"}};
  const Declaration root = study_declarations(laws);
  schema.update(section_schema(root, false));
  return schema.dump(2) + "\n";
}

}  // namespace morula::scenarios
