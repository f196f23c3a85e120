#include "study/own_section.h"

#include <algorithm>

#include "core/cell_id_text.h"
#include "core/numbers/joined.h"
#include "study/declare.h"

namespace morula::scenarios {
namespace {

using Kind = OwnKey::Kind;

void declare_key(Section& s, const OwnKey& key, const std::string& name, draft::OwnSection& own, bool must);

void declare_keys(Section& s, const std::vector<OwnKey>& keys, const std::string& within, draft::OwnSection& own, bool must) {
  for (const OwnKey& key : keys) declare_key(s, key, within + key.spec.name, own, must);
}

void declare_key(Section& s, const OwnKey& key, const std::string& name, draft::OwnSection& own, bool must) {
  KeySpec spec = key.spec;
  spec.required = spec.required && must;
  switch (key.kind) {
    case Kind::kQuantity:
      return s.quantity(spec, own.numbers[name]);
    case Kind::kFlag:
      return s.flag(spec, own.flags[name]);
    case Kind::kWord:
      return s.word(spec, own.texts[name]);
    case Kind::kVector:
    case Kind::kDirection:
      return s.vector(spec, own.vectors[name]);
    case Kind::kField:
    case Kind::kMark:
    case Kind::kObstacle:
    case Kind::kCells:
      return s.text(spec, own.texts[name]);
    case Kind::kCellIds:
      return s.one_or_more(spec, own.lists[name]);
    case Kind::kCourse:
      spec.not_empty = true;
      return s.list(spec, own.courses[name], spec.quantity == Quantity::kLength ? &declare_distance_point : &declare_course_point);
    case Kind::kGroup:
      spec.optional_section = true;
      return s.group(spec, own.groups[name], [&](Section& inner) { declare_keys(inner, key.keys, name + ".", own, true); });
    case Kind::kFieldValue:
      break;
  }
}

/// Place and whether a key is given.
struct Where {
  bool given = false;
  const Place* place = nullptr;
  const std::string* text = nullptr;
};

Where find(const draft::OwnSection& own, const std::string& name) {
  const auto in = [&name](const auto& map) -> Where {
    const auto at = map.find(name);
    return at != map.end() ? Where{at->second.given, &at->second.place, &at->second.text} : Where{};
  };
  for (const Where& where : {in(own.numbers), in(own.texts), in(own.flags), in(own.vectors), in(own.lists)})
    if (where.place != nullptr) return where;
  return {};
}

}  // namespace

void declare_own_keys(Section& s, const std::vector<OwnKey>& keys, draft::OwnSection& own, bool must) {
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (keys[k].kind == Kind::kField && k + 1 < keys.size() && keys[k + 1].kind == Kind::kFieldValue) {
      KeySpec field = keys[k].spec, value = keys[k + 1].spec;
      field.required = value.required = false;  // may be given as one; who builds the thing looks for both
      s.suffixed(("_" + std::string(value.name)).c_str(), field, own.texts[field.name], value, own.numbers[value.name]);
      ++k;
    } else {
      declare_key(s, keys[k], keys[k].spec.name, own, must);
    }
  }
}

void declare_own_keys(Section& s, const std::vector<const std::vector<OwnKey>*>& all, draft::OwnSection& own, bool must) {
  std::vector<std::string> declared;
  for (const std::vector<OwnKey>* keys : all) {
    std::vector<OwnKey> fresh = *keys;
    std::erase_if(fresh, [&](const OwnKey& key) { return std::ranges::find(declared, key.spec.name) != declared.end(); });
    for (const OwnKey& key : fresh) declared.emplace_back(key.spec.name);
    declare_own_keys(s, fresh, own, must);
  }
}

std::vector<std::string> missing_keys(const std::vector<OwnKey>& keys, const draft::OwnSection& own) {
  std::vector<std::string> out;
  for (const OwnKey& key : keys)
    if (key.spec.required && !find(own, key.spec.name).given) out.emplace_back(key.spec.name);
  return out;
}

std::string example_of(const std::vector<OwnKey>& keys, const std::vector<std::string>& names) {
  std::string out;
  for (const OwnKey& key : keys)
    if (key.spec.example != nullptr && std::ranges::find(names, key.spec.name) != names.end())
      out += (out.empty() ? "" : ", ") + std::string(key.spec.name) + ": " + key.spec.example;
  return out.empty() ? out : "for example `" + out + "`";
}

namespace {

/// Reads the values of keys, one by one, and notes whether all could be read.
class ReadValues {
 public:
  ReadValues(BuildContext& context, const draft::OwnSection& own) : c_(context), own_(own) {}

  void read(const std::vector<OwnKey>& keys, const std::string& within) {
    for (const OwnKey& key : keys) read(key, within + key.spec.name);
  }
  [[nodiscard]] std::optional<OwnValues> values() && {
    if (!sound_) return std::nullopt;
    return std::move(out_);
  }

 private:
  void read(const OwnKey& key, const std::string& name) {
    switch (key.kind) {
      case Kind::kQuantity:
      case Kind::kFieldValue:
        return number(name);
      case Kind::kFlag:
        if (const auto* given = entry(own_.flags, name)) out_.set(name, given->value ? 1.0 : 0.0);
        return;
      case Kind::kWord:
        return word(key, name);
      case Kind::kVector:
        return vector(name);
      case Kind::kDirection:
        return direction(key, name);
      case Kind::kField:
        return named(name, &find_field);
      case Kind::kMark:
        return named(name, &find_mark);
      case Kind::kObstacle:
        return named(name, &find_obstacle);
      case Kind::kCells:
        return named(name, &find_cells);
      case Kind::kCellIds:
        return ids(name);
      case Kind::kCourse:
        return course(name);
      case Kind::kGroup:
        if (const auto* given = entry(own_.groups, name)) {
          out_.set(name, *given ? 1.0 : 0.0);
          if (*given) read(key.keys, name + ".");
        }
    }
  }
  void number(const std::string& name) {
    const auto* given = entry(own_.numbers, name);
    if (given != nullptr && is_known(*given)) out_.set(name, given->value);
  }
  /// Nothing where the section was no map, so that none of its keys was read; that has been told.
  template <class Map>
  const typename Map::mapped_type* entry(const Map& map, const std::string& name) {
    const auto at = map.find(name);
    sound_ = sound_ && at != map.end();
    return at != map.end() ? &at->second : nullptr;
  }
  /// What is given and could not be read has been told.
  template <class T>
  bool is_known(const Given<T>& given) {
    sound_ = sound_ && (given.known() || !given.given);
    return given.known();
  }
  void word(const OwnKey& key, const std::string& name) {
    const auto* given = entry(own_.texts, name);
    if (given == nullptr || !is_known(*given)) return;
    const auto at = std::ranges::find(key.spec.words, given->value);
    if (at != key.spec.words.end()) out_.set(name, static_cast<double>(at - key.spec.words.begin()));
  }
  void vector(const std::string& name) {
    const auto* given = entry(own_.vectors, name);
    if (given != nullptr && is_known(*given)) out_.set_vector(name, given->value);
  }
  void direction(const OwnKey& key, const std::string& name) {
    const auto* given = entry(own_.vectors, name);
    if (given == nullptr || !is_known(*given)) return;
    if (norm2(given->value) > 0.0) return out_.set_vector(name, normalized(given->value));
    c_.diagnostics.error(302, given->place, "'" + std::string(key.spec.name) + "' has no direction", "for example `[1, 0, 0]`");
    sound_ = false;
  }
  void named(const std::string& name, int (*find)(BuildContext&, const std::string&, const Place&)) {
    const auto* given = entry(own_.texts, name);
    if (given == nullptr || !is_known(*given)) return;
    const int number = find(c_, given->value, given->place);
    sound_ = sound_ && number >= 0;
    out_.set(name, number);
    out_.set_name(name, given->value);
  }
  void ids(const std::string& name) {
    const auto* given = entry(own_.lists, name);
    if (given == nullptr || !is_known(*given)) return;
    std::vector<CellId> found;
    for (const std::string& text : given->value) {
      if (const auto id = cell_id_of(text)) {
        found.push_back(*id);
        continue;
      }
      c_.diagnostics.error(114, given->place, "'" + text + "' is not the id of a cell",
                           "for example 17, or \"17.01\" for the second daughter of its first daughter");
      sound_ = false;
    }
    out_.set_ids(name, std::move(found));
  }
  void course(const std::string& name) {
    const auto* points = entry(own_.courses, name);
    if (points == nullptr || points->empty()) return;
    TimeCourse found = build_course(c_, *points);
    sound_ = sound_ && !found.empty();
    out_.set_course(name, std::move(found));
  }

  BuildContext& c_;
  const draft::OwnSection& own_;
  OwnValues out_;
  bool sound_ = true;
};

}  // namespace

std::optional<OwnValues> own_values(BuildContext& c, const std::vector<OwnKey>& keys, const draft::OwnSection& own) {
  ReadValues reading(c, own);
  reading.read(keys, "");
  return std::move(reading).values();
}

void tell_problem(BuildContext& c, const LawProblem& problem, const draft::OwnSection& own, const Place& otherwise) {
  const Where where = find(own, problem.key);
  std::string what = problem.what;
  if (const std::size_t gap = what.find("{}"); where.text != nullptr && gap != std::string::npos) what.replace(gap, 2, *where.text);
  c.diagnostics.error(problem.code, where.place != nullptr ? *where.place : otherwise, what, problem.help);
}

std::vector<std::string> given_keys(const std::vector<OwnKey>& keys, const draft::OwnSection& own) {
  std::vector<std::string> out;
  for (const OwnKey& key : keys)
    if (find(own, key.spec.name).given) out.emplace_back(key.spec.name);
  return out;
}

Place place_of_key(const draft::OwnSection& own, const std::string& key) {
  const Where where = find(own, key);
  return where.place != nullptr ? *where.place : Place{};
}

void leave_away(draft::OwnSection& own, const std::string& key) {
  const auto clear = [&key](auto& map) {
    if (const auto at = map.find(key); at != map.end()) at->second.text.clear();
  };
  clear(own.numbers), clear(own.texts), clear(own.flags), clear(own.vectors), clear(own.lists);
}

void tell_without_effect(BuildContext& c, const std::string& key, const draft::OwnSection& own, const std::string& help) {
  if (const Where where = find(own, key); where.place != nullptr)
    c.diagnostics.error(515, *where.place, "'" + key + "' has no effect here", help);
}

bool check_choice(BuildContext& c, const std::vector<OwnKey>& chosen, const std::vector<const std::vector<OwnKey>*>& all,
                  const draft::OwnSection& own, const Given<std::string>& word) {
  const auto has = [](const std::vector<OwnKey>& keys, const std::string& name) {
    return std::ranges::any_of(keys, [&](const OwnKey& key) { return name == key.spec.name; });
  };
  std::vector<std::string> told;
  for (const std::vector<OwnKey>* keys : all)
    for (const OwnKey& key : *keys) {
      const Where where = find(own, key.spec.name);
      const bool is_default = where.given && key.spec.fallback != nullptr && *where.text == key.spec.fallback;
      if (!where.given || is_default || has(chosen, key.spec.name) || std::ranges::find(told, key.spec.name) != told.end()) continue;
      told.emplace_back(key.spec.name);
      tell_without_effect(c, key.spec.name, own, "it has none with `" + word.value + "`");
    }
  const std::vector<std::string> missing = missing_keys(chosen, own);
  if (!missing.empty()) c.diagnostics.error(103, word.place, "`" + word.value + "` needs " + listed(missing), example_of(chosen, missing));
  return missing.empty();
}

bool has_required_keys(const std::vector<OwnKey>& keys, const draft::OwnSection& own) {
  const auto required = [](const OwnKey& key) { return key.spec.required; };
  return std::ranges::none_of(keys, required) ||
         std::ranges::any_of(keys, [&](const OwnKey& key) { return key.spec.required && find(own, key.spec.name).given; });
}

}  // namespace morula::scenarios
