#include <gmock/gmock.h>

#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kTypes = R"(schema: 1
study: alike
time: {end: 1 h}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  plain:
    radius: 8 um
    friction: {medium: 2e8 N s/m^3}
    adhesion: {plain: 0.2 mJ/m^2, glass: 0.03 mJ/m^2, others: 0 J/m^2}
    dcm: {nodes: 642, bulk_modulus: 2 kPa, cortex: {turnover: 10 min, tension: 0.5 mN/m}}
  stiff: {like: plain, radius: {spread: 5 %}, dcm: {bulk_modulus: 7 kPa, cortex: {tension: 0.6 mN/m}}, adhesion: {stiff: 0.4 mJ/m^2}}
  small: {like: stiff, radius: 4 um}
geometry:
  glass: {plane: {center: [0 um, 0 um, -40 um], normal: [0, 0, 1], size: 90 um}}
initial:
  - {type: small, at: [[0 um, 0 um, 0 um]]}
)";

const CellType& type_of(const Study& study, const std::string& name) {
  for (const CellType& type : study.model.types)
    if (type.name == name) return type;
  throw std::runtime_error(name);
}

TEST(Like, TakesBackWhatTheOtherSays) {
  const std::string cycle = R"(schema: 1
study: alike
time: {end: 1 h}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  stem:
    radius: {mean: 6 um, spread: 3 %}
    cycle: {model: phases, phases: {early: {duration: 2 h}, late: {duration: 1 h}}}
    dcm: {nodes: 162, nucleus: {kind: shell, radius: 2 um, nodes: 42}}
  done: {like: stem, radius: {spread: default}, cycle: {model: none, phases: default}, dcm: {nodes: default, nucleus: default}}
initial:
  - {type: done, at: [[0 um, 0 um, 0 um]]}
)";
  const auto study = read(cycle);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const CellType &stem = type_of(*study, "stem"), &done = type_of(*study, "done");
  EXPECT_TRUE(stem.cycles);
  EXPECT_TRUE(stem.interior.has_nuclear_shell());
  EXPECT_FALSE(done.cycles);
  EXPECT_FALSE(done.interior.has_nuclear_shell());
  EXPECT_EQ(done.radius.mean, 6.0) << "what is beside a key that is taken back stays";
  EXPECT_EQ(done.radius.relative_spread, 0.0);
  std::string kept = cycle;
  kept.replace(kept.find(", phases: default"), 17, "");
  EXPECT_FALSE(read(kept).ok()) << "phases of a type without a cycle";
}

TEST(Like, TakesWhatIsNotSaidKeyByKey) {
  const auto study = read(kTypes);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const CellType &stiff = type_of(*study, "stiff"), &small = type_of(*study, "small");
  EXPECT_EQ(stiff.radius.mean, 8.0) << "a bare value is the mean, to which the spread is added";
  EXPECT_EQ(stiff.radius.relative_spread, 0.05);
  EXPECT_EQ(stiff.medium_friction, 0.2);
  EXPECT_EQ(stiff.shell_nodes, 642u);
  EXPECT_DOUBLE_EQ(stiff.shell.turnover_rate, 1.0 / 600.0);
  EXPECT_DOUBLE_EQ(stiff.shell.tension, 0.6);
  EXPECT_DOUBLE_EQ(stiff.shell.bulk_modulus, 7.0);
  EXPECT_DOUBLE_EQ(type_of(*study, "plain").shell.bulk_modulus, 2.0);
  EXPECT_EQ(small.radius.mean, 4.0);
  EXPECT_EQ(small.radius.relative_spread, 0.05);
  EXPECT_DOUBLE_EQ(small.shell.bulk_modulus, 7.0);
}

TEST(Like, AdhesionIsTheNearestThatIsSaid) {
  const auto study = read(kTypes);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto w = [&](std::uint16_t a, std::uint16_t b) { return study->model.pair(a, b).adhesion; };
  enum : std::uint16_t { kPlain, kStiff, kSmall, kGlass };
  EXPECT_EQ(w(kPlain, kPlain), 0.2);
  EXPECT_EQ(w(kStiff, kStiff), 0.4);
  EXPECT_EQ(w(kPlain, kStiff), 0.0) << "others";
  EXPECT_EQ(w(kSmall, kPlain), 0.0) << "others";
  EXPECT_EQ(w(kSmall, kStiff), 0.4) << "as stiff with stiff";
  EXPECT_EQ(w(kSmall, kSmall), 0.4) << "as stiff with stiff";
  EXPECT_EQ(w(kPlain, kGlass), 0.03);
  EXPECT_EQ(w(kStiff, kGlass), 0.03) << "as plain";
  EXPECT_EQ(w(kSmall, kGlass), 0.03) << "as plain";
}

TEST(Like, IsWrittenOutInTheResolvedStudy) {
  const auto study = read(kTypes);
  ASSERT_TRUE(study.ok());
  EXPECT_THAT(study->resolved_text, AllOf(Not(HasSubstr("like:")), Not(HasSubstr("others:"))));
  const auto again = read(study->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  for (std::size_t k = 0; k < study->model.pairs.size(); ++k) EXPECT_EQ(again->model.pairs[k].adhesion, study->model.pairs[k].adhesion);
  EXPECT_DOUBLE_EQ(type_of(*again, "small").shell.bulk_modulus, 7.0);
}

TEST(Like, RefusesUnknownTypesAndCircles) {
  EXPECT_THAT(errors_of(changed("like: stiff", "like: stif", kTypes)),
              AllOf(HasSubstr("study.yaml:12:17: error: there is no cell type 'stif' [E401]"), HasSubstr("did you mean `stiff`?")));
  EXPECT_THAT(errors_of(changed("like: plain", "like: small", kTypes)),
              HasSubstr("cell types are like each other in a circle: stiff, small, stiff [E656]"));
  EXPECT_THAT(errors_of(changed("like: plain", "like: stiff", kTypes)), HasSubstr("in a circle: stiff, stiff [E656]"));
  EXPECT_THAT(errors_of(changed("plain:", "others:", kTypes)), HasSubstr("[E112]"));
}

TEST(Like, AMistakeOfTheOtherTypeIsToldOnce) {
  const std::string messages = errors_of(changed("turnover: 10 min", "tunrover: 10 min", kTypes));
  std::size_t told = 0;
  for (std::size_t at = 0; (at = messages.find("unknown key 'tunrover' in `cell_types.plain.dcm.cortex`", at)) != std::string::npos; ++at)
    ++told;
  EXPECT_EQ(told, 1u);
  EXPECT_THAT(messages, HasSubstr("study.yaml:10:"));
}

TEST(Like, OthersThatDisagreeAskForThePair) {
  const std::string text = changed("  small: {like: stiff, radius: 4 um}", "  third: {adhesion: {others: 1 mJ/m^2}}", kTypes);
  EXPECT_THAT(errors_of(changed("type: small", "type: third", text)),
              AllOf(HasSubstr("the adhesion of 'plain' and 'third' could be 0 J/m^2 (line 9) or 1 mJ/m^2 (line 12) [E657]"),
                    HasSubstr("name this pair in the `adhesion` of one of them")));
}

}  // namespace
}  // namespace morula::scenarios::test
