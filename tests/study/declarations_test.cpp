#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <tuple>

#include "fields/reaction.h"
#include "study/catalogue.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;

/// What the study says, apart from where its text came from.
void expect_same_study(const Study& a, const Study& b) {
  EXPECT_EQ(a.resolved_text, b.resolved_text);
  ASSERT_EQ(a.model.types.size(), b.model.types.size());
  for (std::size_t i = 0; i < a.model.types.size(); ++i) {
    const CellType &s = a.model.types[i], &t = b.model.types[i];
    EXPECT_EQ(s.name, t.name);
    EXPECT_EQ(std::tie(s.radius.mean, s.radius.relative_spread, s.cycles, s.cycle_duration.mean, s.inhibit_pressure, s.apoptosis_time,
                       s.removal_fraction, s.migration.speed, s.medium_friction, s.initial_body, s.shell_nodes),
              std::tie(t.radius.mean, t.radius.relative_spread, t.cycles, t.cycle_duration.mean, t.inhibit_pressure, t.apoptosis_time,
                       t.removal_fraction, t.migration.speed, t.medium_friction, t.initial_body, t.shell_nodes));
    EXPECT_EQ(s.migration.law, t.migration.law);
    for (const OwnKey& key : s.migration.law->keys)
      EXPECT_EQ(s.migration.own(key.spec.name), t.migration.own(key.spec.name)) << key.spec.name;
    EXPECT_TRUE(s.shell == t.shell);
    ASSERT_EQ(s.behaviours.size(), t.behaviours.size());
    for (std::size_t k = 0; k < s.behaviours.size(); ++k) {
      EXPECT_EQ(s.behaviours[k].what, t.behaviours[k].what);
      for (const OwnKey& key : s.behaviours[k].what->keys)
        EXPECT_EQ(s.behaviours[k].values(key.spec.name), t.behaviours[k].values(key.spec.name)) << key.spec.name;
    }
  }
  ASSERT_EQ(a.model.pairs.size(), b.model.pairs.size());
  for (std::size_t i = 0; i < a.model.pairs.size(); ++i) EXPECT_EQ(a.model.pairs[i].adhesion, b.model.pairs[i].adhesion);
  ASSERT_EQ(a.model.obstacles.size(), b.model.obstacles.size());
  for (std::size_t i = 0; i < a.model.obstacles.size(); ++i) EXPECT_EQ(a.model.obstacles[i].position, b.model.obstacles[i].position);
  ASSERT_EQ(a.model.fields.size(), b.model.fields.size());
  for (std::size_t i = 0; i < a.model.fields.size(); ++i) {
    const auto &s = a.model.fields[i].reactions, &t = b.model.fields[i].reactions;
    ASSERT_EQ(s.size(), t.size());
    for (std::size_t k = 0; k < s.size(); ++k) {
      EXPECT_EQ(std::tie(s[k].what, s[k].type), std::tie(t[k].what, t[k].type));
      for (const OwnKey& key : s[k].what->keys) EXPECT_EQ(s[k].values(key.spec.name), t[k].values(key.spec.name)) << key.spec.name;
    }
  }
  ASSERT_EQ(a.model.swaps.triggers.size(), b.model.swaps.triggers.size());
  EXPECT_EQ(a.model.step.max_step, b.model.step.max_step);
  EXPECT_EQ(a.time.output, b.time.output);
  EXPECT_EQ(a.initial.size(), b.initial.size());
}

TEST(ResolvedStudy, ReadsBackToTheSameStudy) {
  for (const std::string& text : {std::string(kGoodStudy), changed("boundary: open", "boundary: {x: periodic, z_low: wall}"),
                                  changed("title: Spheroid", "title: 'quotes \" and: colons # and \\ ü'\nscenario: null_x #"),
                                  changed("mean: 18 h", "mean: 18.123456789012345 h"),
                                  changed("{sphere: {radius: 150 um}, side: inside",
                                          "{plane: {size: 1 mm, center: [0 um, 0 um, -90 um], normal: [0.1, 0.2, 0.3]}, side: outside")}) {
    const auto first = read(text);
    ASSERT_TRUE(first.ok()) << first.error().text();
    const auto second = read(first->resolved_text);
    ASSERT_TRUE(second.ok()) << second.error().text() << first->resolved_text;
    // The comments "# default: source" are gone, because now everything is given.
    std::string without = first->resolved_text;
    for (std::size_t at; (at = without.find("  # default")) != std::string::npos;) without.erase(at, without.find('\n', at) - at);
    EXPECT_EQ(second->resolved_text, without);
    const auto third = read(second->resolved_text);
    ASSERT_TRUE(third.ok());
    expect_same_study(*second, *third);
    EXPECT_EQ(first->model.types[0].cycle_duration.mean, second->model.types[0].cycle_duration.mean);
    EXPECT_EQ(first->title, second->title);
  }
}

/// What nobody gave contradicts nothing, in the resolved study either.
TEST(ResolvedStudy, OfExplicitStepsWarnsOfNothingMore) {
  const auto study = read(changed("step: auto", "step: auto, integrator: explicit_euler"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_THAT(study->warnings.text(), Not(HasSubstr("E510")));
  EXPECT_THAT(warnings_of(study->resolved_text), Not(HasSubstr("E510")));
  EXPECT_THAT(warnings_of(changed("step: auto", "step: 1 ms, integrator: explicit_euler")), Not(HasSubstr("E510")));
  EXPECT_THAT(warnings_of(changed("step: auto", "step: 1 ms") + "numerics: {initial_step: 1 s}\n"), HasSubstr("E510"));
}

TEST(ResolvedStudy, NamesTheCopiesOfItsInputFiles) {
  const Folder folder;
  folder.write("data/cells.csv", "x [um],y [um],z [um],type\n1,2,3,hepatocyte\n");
  const auto first =
      read(changed("{type: hepatocyte, count: 60, fill: sphere, radius: 40 um, as: cbm}", "{csv: data/cells.csv}"), {}, folder.path());
  ASSERT_TRUE(first.ok()) << first.error().text();
  EXPECT_THAT(first->resolved_text, HasSubstr("csv: inputs/cells.csv"));
  std::filesystem::create_directories(folder.path() / "run/inputs");
  for (const InputFile& file : first->input_files) std::filesystem::copy_file(file.path, folder.path() / "run" / file.copy);
  const auto second = read(first->resolved_text, {}, folder.path() / "run");
  ASSERT_TRUE(second.ok()) << second.error().text();
  EXPECT_EQ(second->initial[0].count, 1u);
  EXPECT_THAT(second->resolved_text, HasSubstr("csv: inputs/cells.csv"));
}

TEST(ResolvedStudy, HoldsEveryDefault) {
  const auto study = read(kGoodStudy);
  ASSERT_TRUE(study.ok());
  for (const char* line :
       {"thickness: 200 nm\n", "shrink_time: 8 h  # default", "rigidity: auto  # default", "half_saturation: 0.005 mM  # default",
        "newton: 3  # default: measured: clusters of shells need 1.9 on average\n"})
    EXPECT_THAT(study->resolved_text, HasSubstr(line));
}

TEST(StudyDeclarations, EveryDefaultAndExampleCanBeRead) {
  // A default that could not be read would stop even the good study; here every section is present, so that all are tried.
  const auto study = read(changed("{sphere: {radius: 150 um}, side: inside, motion: fixed}",
                                  "{cylinder: {from: [0 um, 0 um, 0 um], to: [0 um, 0 um, 9 um], radius: 1 um}}\n  a: {plane: {size: 9 "
                                  "um}}\n  b: {box: {size: [9 um, 9 um, 9 um]}}\n"
                                  "  c: {capsule: {from: [0 um, 0 um, 0 um], to: [0 um, 0 um, 9 um], radius: 1 um}}"));
  EXPECT_TRUE(study.ok()) << study.error().text();
  int documented = 0;
  const std::function<void(const Declaration&)> visit = [&](const Declaration& d) {
    for (const Declaration& child : d.children) {
      EXPECT_GT(std::string(child.spec.doc).size(), 4u) << child.path;
      const bool section =
          child.kind == Declaration::Kind::kGroup || child.kind == Declaration::Kind::kNamed || child.kind == Declaration::Kind::kList;
      EXPECT_TRUE(section || *child.spec.example) << child.path << " has no example";
      EXPECT_TRUE(!child.spec.fallback || !*child.spec.fallback || *child.spec.source) << child.path << " has a default without a source";
      ++documented;
      visit(child);
    }
  };
  visit(study_declarations(*builtin_laws()));
  EXPECT_GT(documented, 120);
}

/// Of a section that may be written otherwise, too, what holds its keys.
const nlohmann::json& written_out(const nlohmann::json& schema, const char* type) {
  if (!schema.contains("anyOf")) return schema;
  for (const nlohmann::json& choice : schema.at("anyOf"))
    if (choice.contains("type") && choice.at("type") == type) return choice;
  return schema;
}

void expect_keys(const Declaration& d, const nlohmann::json& schema) {
  if (d.children.empty()) return;
  const nlohmann::json* object = &schema;
  if (d.kind == Declaration::Kind::kNamed) object = &written_out(schema, "object").at("additionalProperties");
  if (d.kind == Declaration::Kind::kList) object = &written_out(schema, "array").at("items");
  object = &written_out(*object, "object");
  EXPECT_EQ(object->at("additionalProperties"), false) << d.path;
  EXPECT_EQ(object->at("properties").size(), d.children.size()) << d.path;
  for (const Declaration& child : d.children) {
    ASSERT_TRUE(object->at("properties").contains(child.spec.name)) << child.path;
    const nlohmann::json& inner = object->at("properties").at(child.spec.name);
    EXPECT_TRUE(inner.contains("description")) << child.path;
    expect_keys(child, inner);
  }
}

TEST(StudyDeclarations, SchemaHoldsEveryKey) {
  const auto schema = nlohmann::json::parse(study_json_schema(*builtin_laws()));
  EXPECT_EQ(schema.at("$schema"), "https://json-schema.org/draft/2020-12/schema");
  expect_keys(study_declarations(*builtin_laws()), schema);
  EXPECT_THAT(schema.at("required").dump(), HasSubstr("cell_types"));
}

/// What `check` takes an editor takes, and what it does not take an editor marks.
TEST(StudyDeclarations, SchemaTakesQuantitiesAsTheyAreWritten) {
  const auto schema = nlohmann::json::parse(study_json_schema(*builtin_laws()));
  const auto& type = schema.at("properties").at("cell_types").at("additionalProperties").at("properties");
  const std::regex quantity(
      type.at("dcm").at("anyOf").at(0).at("properties").at("bulk_modulus").at("anyOf").at(0).at("pattern").get<std::string>());
  for (const char* text : {"2.5 kPa", "2.5kPa", "1e-3 kPa", "-.5 Pa", "10 1/h", "10 1 / h", "1 N s/m^3"})
    EXPECT_TRUE(std::regex_search(text, quantity)) << text;
  for (const char* text : {"2.5", "kPa", "10 5", "", "1e3"}) EXPECT_FALSE(std::regex_search(text, quantity)) << text;
  const auto takes_default = [](const nlohmann::json& key) {
    return std::ranges::any_of(key.at("anyOf"), [](const nlohmann::json& choice) { return choice.value("const", "") == "default"; });
  };
  for (const char* key : {"radius", "cycle", "adhesion", "variation"})
    EXPECT_TRUE(takes_default(type.at(key))) << key << ": of the type that it is `like`";
  EXPECT_EQ(schema.at("properties").at("time").dump().find("\"default\"}"), std::string::npos) << "only there";
}

TEST(StudyDeclarations, ReferenceHoldsEveryKeyAndCode) {
  const std::string reference = study_reference(*builtin_laws());
  for (const char* words : {"## `cell_types.<name>.dcm.cortex`", "| `tension` |", "0.1 mN/m", "| E501 |", "`<field>_below`"})
    EXPECT_THAT(reference, HasSubstr(words));
}

TEST(StudyDeclarations, KeysAndCodesAreExplained) {
  for (const char* id : {"dcm.cortex.tension", "cell_types.hepatocyte.dcm.cortex.tension", "cell_types.<name>.dcm.cortex.tension"}) {
    const auto text = explain_study(id, *builtin_laws());
    ASSERT_TRUE(text) << id;
    EXPECT_THAT(*text, HasSubstr("Active cortical tension"));
    EXPECT_THAT(*text, HasSubstr("0.1 mN/m"));
    EXPECT_THAT(*text, HasSubstr("Hochmuth 2000"));
  }
  EXPECT_THAT(explain_study("E203", *builtin_laws()).value_or(""), HasSubstr("E203: unit of another quantity"));
  for (const char* column : {"outside_fields", "field_balance", "mean_oxygen"})
    EXPECT_THAT(explain_study(column, *builtin_laws()).value_or(""), HasSubstr("a column of series.csv")) << column;
  EXPECT_FALSE(explain_study("E999", *builtin_laws()));
  EXPECT_FALSE(explain_study("cortex.tensoin", *builtin_laws()));
  EXPECT_FALSE(explain_study("", *builtin_laws()));
  EXPECT_TRUE(explain_study("cell_types", *builtin_laws()));
  EXPECT_TRUE(explain_study("initial", *builtin_laws()));
}

/// Whatever the bytes are, the reader gives a study or an error with a place, and never crashes.
void expect_study_or_error(const std::string& text) {
  const auto study = read(text);
  if (study.ok()) return;
  ASSERT_TRUE(study.error().has_errors());
  for (const Diagnostic& d : study.error().list()) {
    ASSERT_TRUE(d.place.source != nullptr) << text;
    ASSERT_FALSE(d.text.empty());
  }
  ASSERT_FALSE(study.error().text().empty());
}

TEST(StudyFuzz, TruncatedStudiesNeverCrash) {
  const std::string good = kGoodStudy;
  for (std::size_t length = 0; length < good.size(); length += 13) expect_study_or_error(good.substr(0, length));
}

TEST(StudyFuzz, MutatedStudiesNeverCrash) {
  std::mt19937 random(20261121);  // a fixed seed: a failure can be repeated
  const std::string pieces = "{}[]:,-#&*!|>'\"%@` \n\t0129eE+.xyz~<?\\";
  for (int trial = 0; trial < 300; ++trial) {
    std::string text = kGoodStudy;
    const int changes = 1 + static_cast<int>(random() % 6);
    for (int k = 0; k < changes; ++k) {
      const std::size_t at = random() % text.size();
      const char piece = pieces[random() % pieces.size()];
      switch (random() % 4) {
        case 0:
          text[at] = piece;
          break;
        case 1:
          text.insert(at, 1, piece);
          break;
        case 2:
          text.erase(at, 1 + random() % 20);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 60));
          break;
      }
    }
    expect_study_or_error(text);
  }
}

}  // namespace
}  // namespace morula::scenarios::test
