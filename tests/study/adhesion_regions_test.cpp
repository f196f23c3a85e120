/// Adhesion by marks, friction without common rotations, and self-contact, as the study gives them.
#include <gtest/gtest.h>

#include "coupling/mechanics/contact_setup.h"
#include "scenarios/run/used_laws.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kStudy = R"(schema: 1
study: regions
time: {end: 1 h}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  wall:
    radius: 6 um
    body: shell
    adhesion: {wall: 2e-4 J/m^2, dish: 5e-5 J/m^2, ball: 0 J/m^2}
    dcm: {self_contact: 200 nm, cortex: {tension: 0.3 mN/m, regions: {basal: {tension: 0.4 mN/m}}}}
  ball: {radius: 5 um, body: sphere, adhesion: {ball: 0 J/m^2}}
geometry:
  dish: {plane: {center: [0 um, 0 um, -20 um], normal: [0, 0, 1], size: 50 um}}
marks:
  apical: {types: [wall], cone: {axis: [0, 0, 1], angle: 60 deg}}
  basal: {types: [wall], cone: {axis: [0, 0, -1], angle: 60 deg}}
contact:
  range: 0.5 um
  friction: objective
  pairs:
    - between: [wall, wall]
      regions:
        - {faces: [apical, basal], adhesion: 1e-4 J/m^2}
        - {faces: [apical, any], adhesion: 0 J/m^2}
    - between: [dish, wall]
      regions: [{faces: [any, apical], adhesion: 0 J/m^2}]
initial:
  - {type: wall, at: [[0 um, 0 um, 0 um]]}
  - {type: ball, at: [[30 um, 0 um, 0 um]]}
)";

/// Up to two marks, as bits.
MarkSet marks(int bits) {
  static constexpr std::uint8_t kSets[] = {0, 1, 2, 3};
  return {&kSets[bits], 1};
}

TEST(AdhesionRegions, AreReadAndReachTheLaw) {
  const auto study = test::read(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const std::vector<ContactMaterial> materials = contact_materials(study->model);
  const std::size_t count = contact_material_count(study->model);
  ASSERT_TRUE(materials[0].regional);
  EXPECT_DOUBLE_EQ(materials[0].regional->between(marks(0), marks(0)), 0.2);
  EXPECT_DOUBLE_EQ(materials[0].regional->between(marks(1), marks(2)), 0.1);
  EXPECT_DOUBLE_EQ(materials[0].regional->between(marks(2), marks(1)), 0.1) << "either cell may carry either mark";
  EXPECT_DOUBLE_EQ(materials[0].regional->between(marks(1), marks(1)), 0.0);
  EXPECT_DOUBLE_EQ(materials[0].regional->between(marks(0), marks(1)), 0.0);
  EXPECT_DOUBLE_EQ(materials[0].regional->between(marks(2), marks(2)), 0.2);
  const ContactMaterial &dish = materials[2], &turned = materials[2 * count];
  ASSERT_TRUE(dish.regional && turned.regional);
  EXPECT_DOUBLE_EQ(dish.regional->between(marks(1), marks(0)), 0.0);
  EXPECT_DOUBLE_EQ(dish.regional->between(marks(2), marks(0)), 0.05);
  EXPECT_DOUBLE_EQ(turned.regional->between(marks(0), marks(1)), 0.0);
  EXPECT_FALSE(materials[1].regional) << "no region of wall and ball";
  EXPECT_DOUBLE_EQ(materials[0].self_distance, 0.2);
  EXPECT_NEAR(materials[count + 1].self_distance, 0.25 * 1.5057, 1e-4) << "a quarter of an edge of 320 faces of a ball of 5 um";
  EXPECT_TRUE(contact_settings(study->model, 1).objective_friction);
  const auto again = test::read(study->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->model.pair(0, 0).regions.size(), study->model.pair(0, 0).regions.size());
  EXPECT_TRUE(again->model.contact.objective_friction);
  EXPECT_DOUBLE_EQ(again->model.types[0].self_contact, 0.2);
  int found = 0;
  for (const UsedLaw& use : used_laws(*study))
    found += use.law.name == "regional_adhesion" || use.law.name == "objective_friction" || use.law.name == "self_contact";
  EXPECT_EQ(found, 2 + 1 + 1 + 2) << "methods name them: two rules of the walls, one of the dish, friction and self-contact of both types";
}

TEST(AdhesionRegions, ThatNoFaceHasAreRefusedWithTheirPlace) {
  const auto message = [](const std::string& from, const std::string& to) { return test::errors_of(test::changed(from, to, kStudy)); };
  EXPECT_NE(message("[apical, any], adhesion", "[apicl, any], adhesion").find("there is no mark 'apicl'"), std::string::npos);
  EXPECT_NE(message("[any, apical]", "[apical, any]").find("no face of 'dish' ever carries the mark"), std::string::npos);
  EXPECT_NE(message("[apical, basal]", "[any, any]").find("[E580]"), std::string::npos);
  EXPECT_NE(message("[apical, basal]", "[apical, basal, any]").find("names 3 marks"), std::string::npos);
  EXPECT_NE(message("between: [dish, wall]", "between: [dish, ball]").find("no face of 'ball' ever carries"), std::string::npos);
  EXPECT_NE(message("[apical, basal], adhesion: 1e-4 J/m^2", "[apical, basal], adhesion: -1e-4 J/m^2").find("[E302]"), std::string::npos);
  EXPECT_NE(message("[apical, basal], adhesion: 1e-4 J/m^2", "[apical, basal]").find("adhesion"), std::string::npos);
  EXPECT_NE(message("friction: objective", "friction: wet").find("wet"), std::string::npos);
}

TEST(AdhesionRegions, StrongerThanTheTensionThereAreRefused) {
  const std::string strong = test::changed("adhesion: 1e-4 J/m^2}", "adhesion: 8e-4 J/m^2}", kStudy);
  EXPECT_NE(test::warnings_of(strong).find("581"), std::string::npos) << test::warnings_of(strong);
  const std::string fluid = test::changed("tension: 0.3 mN/m", "elastic: none, tension: 0.3 mN/m", strong);
  EXPECT_NE(test::errors_of(fluid).find("[E581]"), std::string::npos);
  EXPECT_EQ(test::warnings_of(kStudy).find("581"), std::string::npos);
}

TEST(ObjectiveFriction, OfASurfaceWithTooManyFacesIsRefused) {
  const std::string fine = test::changed(
      "geometry:\n", "geometry:\n  wire: {cylinder: {from: [-45 um, 0 um, -30 um], to: [45 um, 0 um, -30 um], radius: 0.2 um}}\n", kStudy);
  EXPECT_NE(test::errors_of(fine).find("[E583]"), std::string::npos);
  EXPECT_TRUE(test::read(test::changed("friction: objective", "friction: simple", fine), {.judge_places = false}).ok());
}

TEST(SelfContact, ThatReachesNeighbouringFacesIsRefused) {
  const auto message = [](const std::string& to) { return test::errors_of(test::changed("self_contact: 200 nm", to, kStudy)); };
  EXPECT_NE(message("self_contact: 1 um").find("[E582]"), std::string::npos);
  EXPECT_NE(message("self_contact: 200 nm, nodes: 2562").find("[E5"), std::string::npos)
      << "edges of 0.45 um: contact.range does not fit, either";
  EXPECT_NE(message("self_contact: 0 um").find("[E302]"), std::string::npos);
  EXPECT_NE(message("self_contact: -1 um").find("[E302]"), std::string::npos);
}

}  // namespace
}  // namespace morula::scenarios
