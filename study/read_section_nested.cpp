#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "study/read_section.h"

namespace morula::scenarios {
namespace {

// Of sections in one map or list: what is more comes from a script gone wrong, and pairs of types would fill the memory.
constexpr std::size_t kMostNamed = 1000, kMostListed = 10000;

}  // namespace

std::string yaml_scalar(const std::string& text) {
  const auto plain_first = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '/'; };
  const auto plain = [&](char c) {
    return plain_first(c) || c == ' ' || c == '.' || c == '+' || c == '-' || c == '^' || c == '%' || c == '*' || c == '<' || c == '>';
  };
  const bool sign_first =
      text.size() > 1 && (text[0] == '-' || text[0] == '.' || text[0] == '+') && std::isdigit(static_cast<unsigned char>(text[1]));
  const bool null_word = text == "null" || text == "Null" || text == "NULL";
  const bool safe = !text.empty() && (plain_first(text[0]) || sign_first) && std::all_of(text.begin(), text.end(), plain) &&
                    text.back() != ' ' && !null_word;
  if (safe) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      char hex[8];
      std::snprintf(hex, sizeof hex, "\\x%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
      out += hex;
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string short_number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

void ReadSection::read_section(const KeySpec& key, const Node& node, const Place& key_place, const std::string& path,
                               const std::function<void(Section&)>& describe) {
  if (node.kind == Node::Kind::kMap) {
    ReadSection section(&node, key_place, path, laws(), units_, diagnostics_);
    describe(section);
    section.finish();
  } else if (key.shorthand && (node.kind == Node::Kind::kScalar || node.kind == Node::Kind::kList)) {
    Node map;
    map.kind = Node::Kind::kMap;
    map.place = node.place;
    map.entries.push_back({key.shorthand, node.place, node});
    ReadSection section(&map, key_place, path, laws(), units_, diagnostics_);
    section.short_key_ = key.shorthand;
    section.short_for_ = key.name;
    describe(section);
    section.finish();
  } else {
    if (node.kind == Node::Kind::kNull)
      diagnostics_.error(104, key_place, "'" + std::string(key.name) + "' has no value",
                         *key.example ? "for example `" + std::string(key.example) + "`" : "");
    else
      wrong_shape(key, node, "a map (`key: value`)");
  }
}

void ReadSection::group(const KeySpec& key, bool& present, const std::function<void(Section&)>& describe) {
  const Node::Entry* entry = take(key);
  present = entry != nullptr;
  if (entry) {
    read_section(key, entry->value, entry->key_place, path_of(key.name), describe);
  } else if (!key.optional_section) {
    ReadSection defaults(nullptr, place_, path_of(key.name), laws(), units_, diagnostics_);
    describe(defaults);
  }
}

void ReadSection::named_items(const KeySpec& key, const Container& items) {
  const Node::Entry* entry = take(key);
  if (!entry) return;
  if (entry->value.kind != Node::Kind::kMap) {
    wrong_shape(key, entry->value, "a map from names to sections");
    return;
  }
  if (entry->value.entries.empty() && key.required)
    diagnostics_.error(104, entry->key_place, "'" + std::string(key.name) + "' is empty", "give at least one");
  std::size_t count = 0;
  for (const Node::Entry& item : entry->value.entries) {
    if (++count > kMostNamed) {
      diagnostics_.error(404, item.key_place, "more than " + std::to_string(kMostNamed) + " entries in " + shown(key), "");
      break;
    }
    const std::string path = path_of(key.name) + "." + item.key;
    if (!is_name(item.key)) diagnostics_.error(112, item.key_place, "'" + item.key + "' cannot be a name", kNameHelp);
    items.add(item.key, item.key_place);
    const std::size_t index = items.size() - 1;
    KeySpec item_key = key;
    item_key.name = item.key.c_str();
    read_section(item_key, item.value, item.key_place, path, [&](Section& section) { items.describe(section, index); });
  }
}

void ReadSection::listed_items(const KeySpec& key, const Container& items) {
  const Node::Entry* entry = take(key);
  if (!entry) return;
  if (entry->value.kind != Node::Kind::kList) {
    wrong_shape(key, entry->value, "a list (`- …`)");
    return;
  }
  if (entry->value.items.empty() && (key.required || key.not_empty))
    diagnostics_.error(104, entry->key_place, "'" + std::string(key.name) + "' is empty",
                       key.required ? "give at least one entry" : "give it entries, or leave it away");
  std::size_t count = 0;
  for (const Node& item : entry->value.items) {
    if (++count > kMostListed) {
      diagnostics_.error(404, item.place, "more than " + std::to_string(kMostListed) + " entries in " + shown(key), "");
      break;
    }
    items.add("", item.place);
    const std::size_t index = items.size() - 1;
    read_section(key, item, item.place, path_of(key.name) + "[" + std::to_string(index) + "]",
                 [&](Section& section) { items.describe(section, index); });
  }
}

void ReadSection::quantities(const KeySpec& key, std::vector<Named<Given<double>>>& items) {
  const Node::Entry* entry = take(key);
  if (!entry) return;
  if (entry->value.kind != Node::Kind::kMap) {
    wrong_shape(key, entry->value, "a map from names to values");
    return;
  }
  for (const Node::Entry& item : entry->value.entries) {
    Given<double> value;
    value.given = true;
    value.place = item.value.place;
    KeySpec item_key = key;
    std::string one = key.example;  // "{a: 1 unit, b: ...}" -> "1 unit"
    const std::size_t colon = one.find(": "), comma = one.find_first_of(",}");
    if (colon != std::string::npos && comma != std::string::npos && comma > colon) one = one.substr(colon + 2, comma - colon - 2);
    item_key.name = item.key.c_str();
    item_key.example = one.c_str();
    if (item.value.kind != Node::Kind::kScalar) {
      wrong_shape(item_key, item.value, "a single value");
    } else if (read_number(item_key, item.value, value.value)) {
      value.text = item.value.text;
      items.push_back({item.key, item.key_place, value});
    }
  }
}

void ReadSection::suffixed(const char* suffix, const KeySpec& prefix_key, Given<std::string>& prefix, const KeySpec& key,
                           Given<double>& value) {
  text(prefix_key, prefix);
  quantity(key, value);
  suffixes_.push_back({suffix, key, &prefix, &value});
}

bool ReadSection::take_suffixed(const Node::Entry& entry) {
  for (const Suffix& s : suffixes_) {
    if (!entry.key.ends_with(s.suffix) || entry.key.size() == s.suffix.size()) continue;
    const std::string prefix = entry.key.substr(0, entry.key.size() - s.suffix.size());
    if (s.prefix->given || s.value->given) {
      diagnostics_.error(111, entry.key_place, "'" + entry.key + "' says the same as another key of `" + path_ + "`", "keep one of them");
      return true;
    }
    KeySpec key = s.value_key;
    key.name = entry.key.c_str();
    *s.prefix = {prefix, prefix, entry.key_place, true};
    s.value->given = true;
    s.value->place = entry.value.place;
    if (entry.value.kind != Node::Kind::kScalar)
      wrong_shape(key, entry.value, "a single value");
    else if (read_number(key, entry.value, s.value->value))
      s.value->text = entry.value.text;
    return true;
  }
  return false;
}

namespace {

/// In `{duration: 18,5 h}` what is behind the comma is a key without a value.
bool is_behind_a_decimal_comma(const Node::Entry& entry) {
  return !entry.key.empty() && std::isdigit(static_cast<unsigned char>(entry.key.front())) != 0 && entry.value.kind == Node::Kind::kNull;
}

}  // namespace

void ReadSection::finish() {
  if (!node_) return;
  const std::string where = path_.empty() ? "the study" : "`" + path_ + "`";
  for (const Node::Entry& entry : node_->entries) {
    if (std::find(declared_.begin(), declared_.end(), entry.key) != declared_.end() || take_suffixed(entry)) continue;
    if (diagnostics_.full())  // a suggestion for each of very many keys would take minutes, and none would be shown
      diagnostics_.error(101, entry.key_place, "", "");
    else
      diagnostics_.error(101, entry.key_place, "unknown key '" + entry.key + "' in " + where,
                         is_behind_a_decimal_comma(entry) ? "numbers have a decimal point, `18.5 h`: a comma begins the next key"
                                                          : suggest(entry.key, declared_));
  }
}

}  // namespace morula::scenarios
