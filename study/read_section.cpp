#include "study/read_section.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <string_view>

#include "core/numbers/decimal_number.h"
#include "core/numbers/joined.h"
#include "study/key_range.h"

namespace morula::scenarios {
namespace {

std::string quoted(const std::string& text) { return "'" + text + "'"; }

std::string example_of(const KeySpec& key) { return *key.example ? "for example `" + std::string(key.example) + "`" : ""; }

bool is_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

const Special* find_special(const KeySpec& key, const std::string& text) {
  for (const Special& special : key.specials)
    if (text == special.word) return &special;
  return nullptr;
}

}  // namespace

bool is_name(const std::string& text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  if (text.empty() || text.size() > 64 || !letter(text[0])) return false;
  return std::all_of(text.begin(), text.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '-'; });
}

std::string ReadSection::shown_name(const KeySpec& key) const {
  return short_for_.empty() || key.name != short_key_ ? key.name : short_for_;
}

std::string ReadSection::shown(const KeySpec& key) const { return quoted(shown_name(key)); }

const Node::Entry* ReadSection::take(const KeySpec& key) {
  declared_.emplace_back(key.name);
  if (!node_) return nullptr;
  for (const Node::Entry& entry : node_->entries)
    if (entry.key == key.name) return &entry;
  if (key.required && !node_->cut_off)
    diagnostics_.error(103, place_, "key " + shown(key) + " is missing in " + (path_.empty() ? "the study" : "`" + path_ + "`"),
                       *key.example ? "write for example `" + std::string(key.name) + ": " + key.example + "`" : key.doc);
  return nullptr;
}

void ReadSection::wrong_shape(const KeySpec& key, const Node& node, const char* expected) {
  static constexpr const char* kFound[] = {"nothing", "a single value", "a list", "a map"};
  diagnostics_.error(104, node.place, shown(key) + " must be " + expected + ", but here is " + kFound[static_cast<int>(node.kind)],
                     example_of(key));
}

const Node* ReadSection::scalar(const KeySpec& key, Node& storage, bool& given) {
  given = false;
  if (const Node::Entry* entry = take(key)) {
    given = true;
    if (entry->value.kind == Node::Kind::kScalar) return &entry->value;
    if (entry->value.kind == Node::Kind::kNull)
      diagnostics_.error(104, entry->key_place, shown(key) + " has no value", example_of(key));
    else
      wrong_shape(key, entry->value, "a single value");
    return nullptr;
  }
  if (!key.fallback) return nullptr;
  storage.kind = Node::Kind::kScalar;
  storage.text = key.fallback;
  storage.place = place_;
  return &storage;
}

bool ReadSection::read_number(const KeySpec& key, const Node& node, double& value) {
  if (const Special* special = find_special(key, node.text)) {
    value = special->value;
    return true;
  }
  const auto read = read_quantity(units_, node.text, key.quantity, shown_name(key), key.example, node.place, diagnostics_);
  if (!read) return false;
  if (const KeyRange range = range_of(key); !range.holds(*read)) {
    diagnostics_.error(302, node.place, shown(key) + " is " + node.text + ", but must be " + range_words(key) + range.reason_against(*read),
                       example_of(key));
    return false;
  }
  value = *read;
  return true;
}

void ReadSection::quantity(const KeySpec& key, Given<double>& value) {
  Node storage;
  const Node* node = scalar(key, storage, value);
  if (node && read_number(key, *node, value.value)) value.text = node->text;
}

void ReadSection::whole(const KeySpec& key, Given<std::uint64_t>& value) {
  Node storage;
  const Node* node = scalar(key, storage, value);
  if (!node) return;
  const std::string& text = node->text;
  if (const Special* special = find_special(key, text)) {
    value.value = special->value < 1.8e19 ? static_cast<std::uint64_t>(special->value) : std::numeric_limits<std::uint64_t>::max();
    value.text = text;
    return;
  }
  if (!is_digits(text)) {
    if (is_not_finite_word(text))
      diagnostics_.error(301, node->place, shown(key) + " is not a finite number: '" + text + "'", example_of(key));
    else if (text.starts_with('-') && is_digits(std::string_view(text).substr(1)) && key.words.empty())
      diagnostics_.error(302, node->place, shown(key) + " is " + text + ", but must be " + range_words(key), example_of(key));
    else
      diagnostics_.error(109, node->place, shown(key) + " must be a whole number, but is '" + text + "'", example_of(key));
    return;
  }
  if (text.size() > 1 && text[0] == '0') {
    diagnostics_.error(304, node->place, shown(key) + " begins with a zero: '" + text + "' could be meant as octal", "leave the zero away");
    return;
  }
  std::uint64_t number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool allowed = key.words.empty() || std::find(key.words.begin(), key.words.end(), text) != key.words.end();
  if (!allowed) {
    diagnostics_.error(302, node->place, shown(key) + " is " + text + ", but must be one of " + joined(key.words), example_of(key));
  } else if (code != std::errc() || !range_of(key).holds(static_cast<double>(number))) {
    diagnostics_.error(302, node->place, shown(key) + " is " + text + ", but must be " + range_words(key), example_of(key));
  } else {
    value.value = number;
    value.text = text;
  }
}

void ReadSection::word(const KeySpec& key, Given<std::string>& value) {
  Node storage;
  const Node* node = scalar(key, storage, value);
  if (!node) return;
  std::string text = node->text;
  for (const auto& [other, meant] : key.synonyms)
    if (text == other) text = meant;
  if (std::find(key.words.begin(), key.words.end(), text) == key.words.end()) {
    diagnostics_.error(108, node->place, shown(key) + " cannot be '" + node->text + "'", suggest(node->text, key.words));
    return;
  }
  value.value = value.text = text;
}

void ReadSection::text(const KeySpec& key, Given<std::string>& value) {
  Node storage;
  const Node* node = scalar(key, storage, value);
  if (!node) return;
  if (value.given && node->text.empty()) {
    diagnostics_.error(104, node->place, shown(key) + " is empty", example_of(key));
    return;
  }
  value.value = value.text = node->text;
}

void ReadSection::flag(const KeySpec& key, Given<bool>& value) {
  Node storage;
  const Node* node = scalar(key, storage, value);
  if (!node) return;
  if (node->text != "true" && node->text != "false") {
    diagnostics_.error(108, node->place, shown(key) + " cannot be '" + node->text + "'", "allowed: true, false");
    return;
  }
  value.value = node->text == "true";
  value.text = node->text;
}

bool ReadSection::vector_items(const KeySpec& key, const Node& node, Vec3d& value, std::string& text) {
  if (node.kind != Node::Kind::kList) {
    wrong_shape(key, node, "a list [x, y, z]");
    return false;
  }
  if (node.items.size() != 3) {
    diagnostics_.error(303, node.place, shown(key) + " has " + std::to_string(node.items.size()) + " numbers, but needs 3: [x, y, z]",
                       example_of(key));
    return false;
  }
  KeySpec component = key;  // an example of one number, not of the list
  std::string one = key.example;
  one = one.substr(one.find_first_not_of("["), one.find(',') - one.find_first_not_of("["));
  component.example = one.c_str();
  bool good = true;
  text = "[";
  for (std::size_t i = 0; i < 3; ++i) {
    if (node.items[i].kind != Node::Kind::kScalar) {
      wrong_shape(component, node.items[i], "a list of three numbers");
      good = false;
      continue;
    }
    good = read_number(component, node.items[i], value[i]) && good;
    text += (i ? ", " : "") + yaml_scalar(node.items[i].text);
  }
  text += "]";
  return good;
}

void ReadSection::vector(const KeySpec& key, Given<Vec3d>& value) {
  const Node::Entry* entry = take(key);
  value.given = entry != nullptr;
  value.place = entry ? entry->value.place : place_;
  if (!entry && !key.fallback) return;
  Node storage;
  const Node* node = entry ? &entry->value : &storage;
  if (!entry) {  // a default is written as in a file, and read the same way
    Diagnostics none;
    storage = parse_document(std::make_shared<const SourceText>("default", key.fallback), none);
  }
  if (node->kind == Node::Kind::kScalar) {
    if (const Special* special = find_special(key, node->text)) {
      value.value = {special->value, special->value, special->value};
      value.text = node->text;
      return;
    }
  }
  std::string text;
  if (vector_items(key, *node, value.value, text)) value.text = text;
}

void ReadSection::vectors(const KeySpec& key, Given<std::vector<Vec3d>>& value) {
  const Node::Entry* entry = take(key);
  value.given = entry != nullptr;
  value.place = entry ? entry->value.place : place_;
  if (!entry) return;
  if (entry->value.kind != Node::Kind::kList || entry->value.items.empty()) {
    wrong_shape(key, entry->value, "[x, y, z], or a list of these");
    return;
  }
  KeySpec item = key;
  item.example = "[0 um, 0 um, 0 um]";
  std::string all = "[";
  bool good = true;
  const std::vector<Node>& items = entry->value.items;
  const bool is_one = std::ranges::all_of(items, [](const Node& node) { return node.kind == Node::Kind::kScalar; });
  for (const Node& node : is_one ? std::span(&entry->value, 1) : std::span(items)) {
    Vec3d v{};
    std::string text;
    good = vector_items(item, node, v, text) && good;
    all += (all.size() > 1 ? ", " : "") + text;
    value.value.push_back(v);
  }
  if (good) value.text = all + "]";
}

void ReadSection::word_items(const KeySpec& key, const Node& node, Given<std::vector<std::string>>& value) {
  std::string all = "[";
  for (const Node& item : node.items) {
    if (item.kind != Node::Kind::kScalar) {
      wrong_shape(key, item, "a list of words");
    } else if (!key.words.empty() && std::find(key.words.begin(), key.words.end(), item.text) == key.words.end()) {
      diagnostics_.error(108, item.place, shown(key) + " cannot hold '" + item.text + "'", suggest(item.text, key.words));
    } else {
      all += (all.size() > 1 ? ", " : "") + yaml_scalar(item.text);
      value.value.push_back(item.text);
    }
  }
  value.text = all + "]";
}

void ReadSection::words(const KeySpec& key, Given<std::vector<std::string>>& value) {
  const Node::Entry* entry = take(key);
  value.given = entry != nullptr;
  value.place = entry ? entry->value.place : place_;
  if (!entry && !key.fallback) return;
  Node storage;
  if (!entry) {
    Diagnostics none;
    storage = parse_document(std::make_shared<const SourceText>("default", key.fallback), none);
  }
  const Node& node = entry ? entry->value : storage;
  if (node.kind != Node::Kind::kList) {
    wrong_shape(key, node, "a list of words");
    return;
  }
  word_items(key, node, value);
}

void ReadSection::one_or_more(const KeySpec& key, Given<std::vector<std::string>>& value) {
  const Node::Entry* entry = take(key);
  value.given = entry != nullptr;
  value.place = entry ? entry->value.place : place_;
  if (!entry) return;
  Node list = entry->value;
  if (list.kind == Node::Kind::kScalar) {
    list.kind = Node::Kind::kList;
    list.items = {entry->value};
  }
  if (list.kind != Node::Kind::kList || list.items.empty()) {
    wrong_shape(key, entry->value, "a word or a list of words");
    return;
  }
  word_items(key, list, value);
}

}  // namespace morula::scenarios
