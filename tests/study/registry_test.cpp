// What every entry of the registry must tell of itself, and that a study can use each as its own example says.
#include <gmock/gmock.h>

#include <set>

#include "coupling/behaviours/behaviour.h"
#include "coupling/loads/load.h"
#include "coupling/model.h"
#include "coupling/observables/observable.h"
#include "coupling/regions/region.h"
#include "fields/reaction.h"
#include "study/catalogue.h"
#include "study/law_faults.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Kind = OwnKey::Kind;

void expect_told(const LawInfo& law, std::set<std::string>& names) {
  EXPECT_TRUE(names.insert(law.name).second) << law.name;
  EXPECT_FALSE(law.title.empty() || law.equation.empty() || law.source.empty()) << law.name;
  for (const LawParameter& parameter : law.parameters) {
    EXPECT_FALSE(parameter.quantity.empty() || parameter.unit.empty()) << law.name << "." << parameter.name;
    EXPECT_TRUE(parameter.doc.ends_with('.')) << law.name << "." << parameter.name;
  }
}

void expect_told(const std::string& whose, const std::vector<OwnKey>& keys) {
  for (const OwnKey& key : keys) {
    const std::string name = whose + "." + key.spec.name;
    EXPECT_TRUE(key.spec.doc.ends_with('.')) << name;
    EXPECT_STRNE(key.spec.example, "") << name;
    EXPECT_FALSE(key.spec.required && key.spec.fallback != nullptr) << name;
    EXPECT_EQ(key.spec.fallback != nullptr, *key.spec.source != '\0') << name << ": a default has a source";
    EXPECT_LE(key.spec.low, key.spec.high) << name;
    EXPECT_EQ(key.kind == Kind::kWord, !key.spec.words.empty()) << name;
    EXPECT_EQ(key.kind == Kind::kGroup, !key.keys.empty()) << name;
    expect_told(name, key.keys);
  }
}

/// The keys of a law are explained, and parameters are keys.
template <class Entry>
void expect_keys(const Entry& entry, const std::string& section) {
  expect_told(entry.info.name, entry.keys);
  for (const LawKey& key : law_keys(section, entry.keys)) {
    const std::string path = key.section + "." + key.spec.name;
    EXPECT_THAT(explain_study(path, *builtin_laws()).value_or(""), HasSubstr(key.spec.doc)) << path;
  }
  for (const LawParameter& parameter : entry.info.parameters)
    EXPECT_TRUE(std::ranges::any_of(entry.keys, [&](const OwnKey& key) { return parameter.name == key.spec.name; }))
        << entry.info.name << "." << parameter.name;
}

TEST(Registry, EveryEntryTellsOfItself) {
  const auto laws = builtin_laws();
  std::set<std::string> names;
  for (const auto& one : laws->behaviours) {
    expect_told(one->info, names);
    expect_keys(*one, one->section.name);
    EXPECT_TRUE(one->build != nullptr) << one->info.name;
    EXPECT_STRNE(one->section.example, "") << one->info.name;
  }
  for (const auto& one : laws->loads) {
    expect_told(one->info, names);
    EXPECT_EQ(one->info.name, one->section.name);
    expect_keys(*one, one->bare ? "loads" : "loads." + one->info.name);
    EXPECT_EQ((one->push != nullptr) + (one->push_cell != nullptr) + (one->hold != nullptr) + (one->hold_center != nullptr), 1)
        << one->info.name;
  }
  names.clear();  // a region may have the name of something else
  for (const auto& one : laws->region_shapes) {
    expect_told(one->info, names);
    expect_keys(*one, "regions");
    EXPECT_EQ((one->distance != nullptr) + (one->counts != CountsContacts::kNo) + (one->of_cell != nullptr), 1)
        << one->info.name << ": one way to say who is in it";
  }
  names.clear();
  for (const auto& one : laws->division_axes) {
    expect_told(one->info, names);
    expect_keys(*one, "cell_types.<name>.cycle");
    EXPECT_NE(one->of, nullptr) << one->info.name;
  }
  names.clear();
  for (const auto& one : laws->reactions) {
    const bool of_cells = one->where == fields::Reaction::Where::kCells;
    expect_told(one->info, names);
    EXPECT_EQ(one->info.name, one->section.name);
    expect_keys(*one, one->bare ? "fields" : "fields.<name>." + one->info.name + (of_cells ? ".<name>" : ""));
    EXPECT_TRUE(one->coefficients != nullptr && one->taken != nullptr) << one->info.name;
    EXPECT_FALSE(one->bare && (of_cells || one->keys.size() != 1)) << one->info.name;
    EXPECT_FALSE(one->first_order && of_cells) << one->info.name;
  }
  for (const auto& one : laws->trigger_values) {
    expect_told(one->info, names);
    EXPECT_STRNE(one->example, "") << one->info.name;
    EXPECT_TRUE(one->of != nullptr) << one->info.name;
  }
}

TEST(Registry, LawsThatCannotBeUsedAreRefused) {
  EXPECT_THAT(law_faults(*builtin_laws()), testing::IsEmpty());
  const auto told = [](const auto& add) {
    auto laws = std::make_shared<Laws>(*builtin_laws());
    add(*laws);
    ReadOptions options;
    options.laws = laws;
    const auto study = read(kGoodStudy, options);
    return study.ok() ? std::string() : study.error().text();
  };
  EXPECT_THAT(told([](Laws&) {}), "");
  const auto twice = [](auto& entries) { entries.push_back(entries.front()); };
  EXPECT_THAT(told([&](Laws& l) { twice(l.spheres); }),
              testing::AllOf(HasSubstr("E692"), HasSubstr("two of `contact of spheres` are called `")));
  EXPECT_THAT(told([&](Laws& l) { twice(l.shells); }), HasSubstr("two of `laws of shells` are called `"));
  EXPECT_THAT(told([&](Laws& l) { twice(l.surfaces); }), HasSubstr("two of `contact of surfaces` are called `"));
  EXPECT_THAT(told([&](Laws& l) { twice(l.behaviours); }), HasSubstr("two of `behaviours` are called `"));
  EXPECT_THAT(told([&](Laws& l) { twice(l.growth); }), HasSubstr("two of `growth` are called `"));
  EXPECT_THAT(told([&](Laws& l) { twice(l.arrest); }), HasSubstr("two of `arrest` are called `"));
  EXPECT_THAT(told([&](Laws& l) { twice(l.division_axes); }), HasSubstr("two of `axes of division` are called `"));
  EXPECT_THAT(told([&](Laws& l) { twice(l.migration); }), HasSubstr("two of `migration` are called `"));
  EXPECT_THAT(told([&](Laws& l) { twice(l.polarity); }), HasSubstr("two of `polarity` are called `"));
  EXPECT_THAT(told([&](Laws& l) { twice(l.loads); }), HasSubstr("two of `loads` are called `"));
  EXPECT_THAT(told([&](Laws& l) { twice(l.region_shapes); }), HasSubstr("two of `shapes of regions` are called `"));
  EXPECT_THAT(told([&](Laws& l) { twice(l.trigger_values); }), HasSubstr("two of `values of triggers` are called `"));
  EXPECT_THAT(told([&](Laws& l) { twice(l.reactions); }), HasSubstr("two of `reactions` are called `"));
  EXPECT_THAT(told([&](Laws& l) { l.loads.push_back(nullptr); }), HasSubstr("one of `loads` is a null pointer"));
  const auto without = [](const auto& entry, const auto& change) {
    auto copy = *entry;
    copy.info.name = "mine";
    change(copy);
    return std::make_shared<const std::remove_const_t<decltype(copy)>>(copy);
  };
  EXPECT_THAT(told([&](Laws& l) { l.behaviours.push_back(without(l.behaviours[0], [](Behaviour& b) { b.build = nullptr; })); }),
              HasSubstr("`mine` of `behaviours` has no `build`"));
  EXPECT_THAT(told([&](Laws& l) { l.loads.push_back(without(body_force_load(), [](Load& b) { b.push_cell = nullptr; })); }),
              HasSubstr("`mine` of `loads` has no `force: push, push_cell, hold or hold_center, just one of them`"));
  const auto column = [&told](const std::string& name) {
    return told([&name](Laws& l) {
      l.observables.emplace_back([name](const Model&) {
        return std::vector<Observable>{{name, "1", "", [](const Moment&) { return 0.0; }}};
      });
    });
  };
  EXPECT_THAT(column("a,b"), HasSubstr("no column of series.csv can be called `a,b [1]`"));
  EXPECT_THAT(column("cell_count"), HasSubstr("two of `observables` are called `cell_count`"));
  EXPECT_EQ(column("mine"), "");
}

TEST(Registry, EveryLawOfMotionTellsOfItself) {
  const auto laws = builtin_laws();
  std::set<std::string> names;
  const auto has = [](const std::vector<OwnKey>& keys, const std::string& name) {
    return std::ranges::any_of(keys, [&](const OwnKey& key) { return name == key.spec.name; });
  };
  for (const auto& one : laws->migration) {
    expect_told(one->info, names);
    expect_told(one->info.name, one->keys);
    EXPECT_TRUE(one->at_birth != nullptr && one->step != nullptr) << one->info.name;
    EXPECT_EQ(one->senses_field, has(one->keys, "field")) << one->info.name;
    for (const LawParameter& parameter : one->info.parameters)
      EXPECT_TRUE(parameter.name == "speed" || has(one->keys, parameter.name)) << one->info.name << "." << parameter.name;
    for (const LawKey& key : law_keys("migration", one->keys))
      EXPECT_THAT(explain_study("migration." + std::string(key.spec.name), *laws).value_or(""), HasSubstr(key.spec.doc)) << key.spec.name;
    EXPECT_THAT(explain_study("migration.law", *laws).value_or(""), HasSubstr(one->info.name + ": " + one->doc));
  }
  EXPECT_EQ(laws->migration.front()->info.name, "persistent_walk") << "the default";
  for (const auto& one : laws->polarity) {
    expect_told(one->info, names);
    expect_keys(*one, "polarity");
    EXPECT_TRUE(one->acts != nullptr && one->turn != nullptr) << one->info.name;
  }
}

TEST(Registry, EveryObservableIsExplained) {
  for (const Observable& one : observables_of_any_model(*builtin_laws()))
    EXPECT_THAT(explain_study(one.name, *builtin_laws()).value_or(""), HasSubstr(one.doc)) << one.name;
}

const std::string kStudy = R"(schema: 1
study: s
time: {end: 1 h}
domain: {size: [200 um, 200 um, 200 um]}
marks: {apical: {types: [cell], cone: {toward: [0 um, 0 um, 100 um], angle: 30 deg}}}
cell_types: {cell: {body: shell, OWN}}
fields: {oxygen: {diffusion: 2e-9 m^2/s, initial: 0.2 mM}}
initial: [{type: cell, at: [[0 um, 0 um, 0 um]], orientation: aligned}]
)";

/// The study with something in the cell type, and more behind all else.
std::string with(const std::string& in_type, const std::string& more = "") {
  return changed("OWN", in_type.empty() ? "radius: 6 um" : in_type, kStudy) + more;
}
std::string load(const std::string& kind, const std::string& value) {
  return with("", "loads: {one: {type: cell, " + kind + ": " + value + "}}\n");
}

/// A study with this value is refused for the value's sake.
void expect_refused(const std::string& text, const std::string& what) {
  const auto study = read(text);
  ASSERT_FALSE(study.ok()) << what;
  EXPECT_THAT(study.error().text(), testing::ContainsRegex("\\[E(2[0-9][0-9]|30[0-9]|10[0-9])\\]")) << what;
}

std::string example_of(const OwnKey& key) {
  if (key.kind == Kind::kObstacle) return std::string(key.spec.name) + ": needle";
  return std::string(key.spec.name) + ": " + (key.kind == Kind::kField ? "oxygen" : key.spec.example);
}

TEST(Registry, EveryLawOfMigrationIsReadAsItsExamplesSay) {
  const auto laws = builtin_laws();
  for (const auto& one : laws->migration) {
    std::string keys = "speed: 2 um/h, law: " + one->info.name;
    for (const OwnKey& key : one->keys) keys += ", " + example_of(key);
    const auto study = read(with("migration: {" + keys + "}"));
    ASSERT_TRUE(study.ok()) << one->info.name << "\n" << study.error().text();
    const auto again = read(study->resolved_text);
    ASSERT_TRUE(again.ok()) << again.error().text();
    for (const Migration& migration : {study->model.types[0].migration, again->model.types[0].migration}) {
      EXPECT_EQ(migration.law, one);
      EXPECT_TRUE(migration.acts());
      EXPECT_EQ(migration.sensed_field(), one->senses_field ? 0 : -1);
      for (const OwnKey& key : one->keys) {
        if (key.kind != Kind::kQuantity) continue;
        EXPECT_EQ(migration.own(key.spec.name), study->model.types[0].migration.own(key.spec.name)) << key.spec.name;
      }
    }
    for (const OwnKey& key : one->keys)
      if (key.kind == Kind::kQuantity)
        expect_refused(with("migration: {law: " + one->info.name + ", " + key.spec.name + ": 3 parsec}"), key.spec.name);
  }
  const auto errors = [](const std::string& migration) { return errors_of(with("migration: {" + migration + "}")); };
  EXPECT_THAT(errors("law: chemotaxis, speed: 2 um/h"),
              AllOf(HasSubstr("`chemotaxis` needs `field` [E103]"), HasSubstr("for example `field: ")));
  EXPECT_THAT(errors("law: chemotaxis, field: oxigen"), HasSubstr("there is no field 'oxigen'"));
  EXPECT_THAT(errors("law: run_and_tumble, persistence: 10 min"), HasSubstr("'persistence' has no effect here [E515]"));
  EXPECT_THAT(errors("run_time: 10 min"), HasSubstr("it has none with `persistent_walk`"));
  EXPECT_THAT(errors("law: walk"), HasSubstr("run_and_tumble"));
}

TEST(Registry, EveryRuleOfPolarityIsReadAsItsExamplesSay) {
  const auto laws = builtin_laws();
  for (const auto& one : laws->polarity) {
    std::string keys;
    for (const OwnKey& key : one->keys) keys += (keys.empty() ? "" : ", ") + example_of(key);
    const auto study = read(with("polarity: {" + keys + "}"));
    ASSERT_TRUE(study.ok()) << one->info.name << "\n" << study.error().text();
    const auto again = read(study->resolved_text);
    ASSERT_TRUE(again.ok()) << again.error().text();
    for (const Polarity& polarity : {study->model.types[0].polarity, again->model.types[0].polarity}) {
      ASSERT_EQ(polarity.rules.size(), 1u) << "the others do not act with their defaults";
      EXPECT_EQ(polarity.rules[0].what, one);
    }
  }
}

TEST(Registry, EveryBehaviourIsReadAsItsExampleSays) {
  const auto laws = builtin_laws();
  for (const auto& one : laws->behaviours) {
    const std::string section = one->section.name;
    const auto study = read(with(section + ": " + one->section.example));
    ASSERT_TRUE(study.ok()) << one->info.name << "\n" << study.error().text();
    ASSERT_EQ(study->model.types[0].behaviours.size(), 1u);
    EXPECT_EQ(study->model.types[0].behaviours[0].what, one);
    const auto again = read(study->resolved_text);
    ASSERT_TRUE(again.ok()) << again.error().text();
    ASSERT_EQ(again->model.types[0].behaviours.size(), 1u);
    for (const OwnKey& key : one->keys) {
      const auto value = [&](const Study& of) { return of.model.types[0].behaviours[0].values(key.spec.name); };
      EXPECT_EQ(value(*again), value(*study)) << key.spec.name;
    }
    for (const OwnKey& key : one->keys)
      if (key.kind == Kind::kQuantity) {
        expect_refused(with(section + ": {" + key.spec.name + ": 3 parsec}"), one->info.name);
        if (key.spec.low == 0.0) expect_refused(with(section + ": {" + key.spec.name + ": -" + key.spec.example + "}"), one->info.name);
      }
  }
}

TEST(Registry, EveryReactionIsReadAsItsExampleSays) {
  const auto laws = builtin_laws();
  for (const auto& one : laws->reactions) {
    const bool of_cells = one->where == fields::Reaction::Where::kCells;
    const std::string name = one->section.name, example = one->section.example;
    const std::string value = of_cells ? "{cell: " + example.substr(example.find(": ") + 2) : example;
    const auto with_reaction = [&](const std::string& what) {
      return changed("initial: 0.2 mM", "initial: 0.2 mM, " + name + ": " + what, with(""));
    };
    const auto study = read(with_reaction(value));
    ASSERT_TRUE(study.ok()) << name << "\n" << study.error().text();
    const auto again = read(study->resolved_text);
    ASSERT_TRUE(again.ok()) << again.error().text();
    for (const Study* of : {&*study, &*again}) {
      const auto& reactions = of->model.fields[0].reactions;
      ASSERT_EQ(reactions.size(), 1u) << name;
      EXPECT_EQ(reactions[0].what, one);
      for (const OwnKey& key : one->keys)
        EXPECT_EQ(reactions[0].values(key.spec.name), study->model.fields[0].reactions[0].values(key.spec.name));
    }
    for (const OwnKey& key : one->keys) {
      if (key.kind != Kind::kQuantity) continue;
      const auto alone = [&](const std::string& text) { return one->bare ? text : "{" + std::string(key.spec.name) + ": " + text + "}"; };
      const auto for_type = [&](const std::string& text) { return of_cells ? "{cell: " + alone(text) + "}" : alone(text); };
      expect_refused(with_reaction(for_type("3 parsec")), name);
      if (key.spec.low == 0.0) expect_refused(with_reaction(for_type("-" + std::string(key.spec.example))), name);
    }
  }
}

TEST(Registry, EveryLoadIsReadAsItsExampleSays) {
  const auto laws = builtin_laws();
  for (const auto& one : laws->loads) {
    const std::string example = one->bare ? one->keys.front().spec.example : one->section.example;
    const auto study = read(load(one->info.name, example));
    ASSERT_TRUE(study.ok()) << one->info.name << "\n" << study.error().text();
    ASSERT_EQ(study->model.loads.size(), 1u);
    EXPECT_EQ(study->model.loads[0].what, one);
    const auto again = read(study->resolved_text);
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ(again->model.loads[0].what, one);
    EXPECT_EQ(again->model.loads[0].size, study->model.loads[0].size);
    EXPECT_EQ(again->model.loads[0].force, study->model.loads[0].force);
    EXPECT_EQ(again->model.loads[0].part, study->model.loads[0].part);
    if (one->bare) continue;
    for (const OwnKey& key : one->keys)
      if (key.kind == Kind::kQuantity)
        expect_refused(load(one->info.name, std::string("{") + key.spec.name + ": 3 parsec}"), one->info.name);
  }
}

TEST(Registry, EveryShapeIsReadAsItsExamplesSay) {
  const auto laws = builtin_laws();
  for (const auto& one : laws->region_shapes) {
    std::string keys;
    for (const OwnKey& key : one->keys) keys += ", " + example_of(key);
    const std::string needle = "geometry: {needle: {sphere: {center: [0 um, 0 um, 20 um], radius: 5 um}}}\n";
    const auto study = read(with("", needle + "coupling: {regions: [{name: core, shape: " + one->info.name + keys + "}]}\n"));
    ASSERT_TRUE(study.ok()) << one->info.name << "\n" << study.error().text();
    const Region& region = study->model.swaps.regions.at(0);
    EXPECT_EQ(region.shape, one);
    if (one->has_border()) {
      EXPECT_LE(one->distance(region, {0.0, 0.0, 0.0}), 0.0) << one->info.name;
    }
    if (std::ranges::any_of(one->keys, [](const OwnKey& key) { return key.spec.required; }))
      expect_refused(with("", "coupling: {regions: [{name: core, shape: " + one->info.name + "}]}\n"), one->info.name);
  }
}

TEST(Registry, EveryTriggerIsReadAsItsExampleSays) {
  const auto laws = builtin_laws();
  for (const auto& one : laws->trigger_values) {
    const std::string up = one->example;
    const bool above = up.find('>') != std::string::npos;
    std::string down = up;
    down[down.find(above ? '>' : '<')] = above ? '<' : '>';
    down.insert(down.find_first_of("0123456789"), above ? "0." : "9");  // 0.1 and 90.05: on the other side
    const auto study = read(with("", "coupling: {triggers: [{promote: " + up + ", demote: " + down + "}]}\n"));
    ASSERT_TRUE(study.ok()) << one->info.name << "\n" << study.error().text();
    EXPECT_EQ(study->model.swaps.triggers.at(0).value, one);
    EXPECT_EQ(study->model.swaps.triggers.at(0).promote_above, above);
  }
}

}  // namespace
}  // namespace morula::scenarios::test
