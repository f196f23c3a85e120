#include <gtest/gtest.h>

#include <numbers>

#include "coupling/mechanics/contact_setup.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kStudy = R"(schema: 1
study: pairs
time: {end: 1 h}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  soft: {radius: 6 um, adhesion: {soft: 1e-4 J/m^2, dish: 2e-5 J/m^2}, dcm: {cortex: {tension: 0.2 mN/m}}}
  hard: {radius: 5 um}
geometry:
  dish: {plane: {center: [0 um, 0 um, -20 um], normal: [0, 0, 1], size: 50 um}}
contact:
  range: 0.5 um
  pairs:
    - {between: [soft, dish], law: maugis_dugdale, range: 0.7 um, modulus: 20 kPa, tangential_friction: 0 N s/m^3}
    - {between: [hard, soft], law: falling, repulsion: 50 kPa/um, normal_friction: 1e9 N s/m^3}
initial:
  - {type: soft, at: [[0 um, 0 um, 0 um]], as: shell}
)";

TEST(ContactPairs, AreReadAndReachTheLaw) {
  const auto study = test::read(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const std::vector<ContactMaterial> materials = contact_materials(study->model);
  const std::size_t count = contact_material_count(study->model);
  const TractionLaw dish = piecewise_form(materials[0 * count + 2].law);
  EXPECT_DOUBLE_EQ(dish.adhesion, 0.02);
  EXPECT_DOUBLE_EQ(dish.range, 0.7);
  EXPECT_DOUBLE_EQ(dish.hertz, 20.0 / (std::numbers::pi * std::sqrt(6.0)));
  EXPECT_DOUBLE_EQ(dish.flat_to, 0.9);
  EXPECT_DOUBLE_EQ(materials[0 * count + 2].friction.tangential, 0.0);
  EXPECT_GT(materials[0 * count + 2].friction.normal, 0.0);
  const TractionLaw mixed = piecewise_form(materials[0 * count + 1].law);
  EXPECT_DOUBLE_EQ(mixed.range, 0.5);
  EXPECT_DOUBLE_EQ(mixed.repulsion, 50.0);
  EXPECT_DOUBLE_EQ(mixed.flat_to, 0.1);
  EXPECT_DOUBLE_EQ(materials[1 * count + 0].friction.normal, 1.0);
  const TractionLaw plain = piecewise_form(materials[0].law);
  EXPECT_DOUBLE_EQ(plain.flat_from, 0.5);
  EXPECT_EQ(plain.hertz, 0.0);
  EXPECT_DOUBLE_EQ(contact_settings(study->model, 1).range, 0.7);
  const auto again = test::read(study->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_DOUBLE_EQ(again->model.pair(0, 2).own("modulus"), 20.0);
  EXPECT_EQ(again->model.pair(1, 0).law, falling_law());
  EXPECT_EQ(again->model.pair(0, 2).tangential_friction, 0.0);
}

TEST(ContactPairs, ThatAdhereStronglyAreFirmer) {
  const auto repulsion = [](const std::string& adhesion, const std::string& tension, const std::string& contact, bool divides) {
    const auto study = test::read(
        "schema: 1\nstudy: firm\ntime: {end: 1 h}\ndomain: {size: [100 um, 100 um, 100 um]}\ncell_types:\n"
        "  a: {radius: 6 um, adhesion: {a: " +
        adhesion + "}, dcm: {cortex: {tension: " + tension + "}}" + (divides ? ", cycle: {duration: 18 h}" : "") + "}\n" + contact +
        "initial:\n  - {type: a, at: [[0 um, 0 um, 0 um]], as: shell}\n");
    EXPECT_TRUE(study.ok()) << study.error().text();
    return study.ok() ? piecewise_form(contact_materials(study->model)[0].law).repulsion : 0.0;
  };
  EXPECT_DOUBLE_EQ(repulsion("0.1 mJ/m^2", "0.1 mN/m", "", true), 100.0);
  EXPECT_DOUBLE_EQ(repulsion("1.4 mJ/m^2", "1 mN/m", "", false), 60.0 * 1.4 / 0.25);
  EXPECT_DOUBLE_EQ(repulsion("0.1 mJ/m^2", "1 mN/m", "", false), 100.0);
  EXPECT_DOUBLE_EQ(repulsion("0.1 mJ/m^2", "1 mN/m", "", true), 60.0 * 2.0 / 0.25);  // the new interface of sisters
  EXPECT_DOUBLE_EQ(repulsion("1.4 mJ/m^2", "1 mN/m", "contact: {repulsion: 120 kPa/um}\n", false), 120.0);
  EXPECT_DOUBLE_EQ(repulsion("1.4 mJ/m^2", "1 mN/m", "contact: {pairs: [{between: [a, a], repulsion: 90 kPa/um}]}\n", false), 90.0);
}

TEST(ContactPairs, ThatContradictThemselvesAreRefusedWithTheirPlace) {
  const auto message = [](const std::string& from, const std::string& to) { return test::errors_of(test::changed(from, to, kStudy)); };
  EXPECT_NE(message(", modulus: 20 kPa", "").find("[E516]"), std::string::npos);
  EXPECT_NE(message("law: falling", "law: falling, modulus: 1 kPa").find("[E515]"), std::string::npos);
  EXPECT_NE(message("modulus: 20 kPa", "modulus: 20 kPa, repulsion: 5 kPa/um").find("[E515]"), std::string::npos);
  EXPECT_NE(message("range: 0.7 um", "range: 0.4 um").find("is below `contact.range`"), std::string::npos);
  EXPECT_NE(message("range: 0.7 um", "range: 2 um").find("[E503]"), std::string::npos);
  EXPECT_NE(message("[soft, dish]", "[soft, dihs]").find("did you mean"), std::string::npos);
  EXPECT_NE(message("[soft, dish]", "[dish]").find("no contact with obstacles"), std::string::npos);
  EXPECT_NE(message("[soft, dish]", "[soft, soft, dish]").find("names 3 materials"), std::string::npos);
  EXPECT_NE(message("[hard, soft]", "[dish, soft]").find("second time"), std::string::npos);
  EXPECT_NE(message("law: falling", "law: hooke").find("hooke"), std::string::npos);
}

/// Spheres meet by the law of `cbm`; what a pair says of surfaces would be left aside.
TEST(ContactPairs, OfSpheresAloneWarnOfWhatIsOfSurfaces) {
  EXPECT_EQ(test::warnings_of(kStudy).find("515"), std::string::npos);
  const std::string spheres = test::changed(", as: shell", "", kStudy), warnings = test::warnings_of(spheres);
  EXPECT_NE(warnings.find("`law` is of surfaces"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("`range` is of surfaces"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("`repulsion` is of surfaces"), std::string::npos) << warnings;
  EXPECT_EQ(warnings.find("_friction` is"), std::string::npos) << warnings;
  const auto objective = [](const std::string& text) { return test::changed("contact:\n", "contact:\n  friction: objective\n", text); };
  EXPECT_NE(test::warnings_of(objective(spheres)).find("`friction: objective` is of surfaces"), std::string::npos);
  EXPECT_EQ(test::warnings_of(objective(kStudy)).find("515"), std::string::npos);
}

TEST(ContactPairs, OfSoftBodiesWarnThatSurfacesSinkIntoEachOther) {
  EXPECT_EQ(test::warnings_of(kStudy).find("517"), std::string::npos);
  const std::string warnings = test::warnings_of(test::changed("modulus: 20 kPa", "modulus: 500 Pa", kStudy));
  EXPECT_NE(warnings.find("517"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("at least"), std::string::npos) << warnings;
}

}  // namespace
}  // namespace morula::scenarios
