// Laws that a program adds to the registry before it reads a study: their words and keys are part of the study, and the model has them.
#include <gmock/gmock.h>

#include "cbm/pair_forces.h"
#include "cbm/pair_loop.h"
#include "coupling/mechanics/contact_setup.h"
#include "dcm/builtin.h"
#include "dcm/sheet_loops.h"
#include "dcm/shell_keys.h"
#include "study/catalogue.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;

/// A sheet whose stress grows with the change of area by a number of its own: W = ½ G [I − 2 − (D − 1) + ½ (1 + h) (D − 1)²].
template <class Real>
struct HardeningSheet {
  Real shear, hardening;

  dcm::MembraneStress<Real> stress(Real trace, Real det) const noexcept {
    const Real excess = det - Real(1.0), half = Real(0.5) * shear;
    return {half * (trace - Real(2.0) - excess + Real(0.5) * (Real(1.0) + hardening) * excess * excess), half,
            half * ((Real(1.0) + hardening) * excess - Real(1.0))};
  }
  dcm::MembraneModuli<Real> moduli(Real /*trace*/, Real /*det*/) const noexcept {
    return {Real(0.0), Real(0.0), Real(0.5) * shear * (Real(1.0) + hardening), Real(0.0)};
  }
};

KeySpec hardening() {
  return {.name = "hardening",
          .doc = "How much faster than linear the sheet stiffens with its area.",
          .fallback = "2",
          .low = 0.0,
          .high = 10.0,
          .example = "3",
          .source = "chosen"};
}

dcm::ShellLaw hardening_sheet() {
  static const auto sheet = dcm::sheet_law<HardeningSheet>("hardening_sheet");
  return {
      .info = {.name = "hardening_sheet",
               .title = "A sheet that hardens",
               .equation = "W = ½ G [I − 2 − (D − 1) + ½ (1 + h) (D − 1)²]",
               .source = "a test",
               .parameters = {given_by_study("shear_modulus", "tension", "nN/µm", "G"), given_by_study("hardening", "number", "1", "h")},
               .keys = dcm::keys::layer({hardening()})},
      .stencil = dcm::LawStencil::kFace,
      .sheet = sheet,
      .words = {{.word = "hardening",
                 .doc = "stiffens with its area",
                 .keys = {hardening()},
                 .resists_area = true,
                 .build =
                     [](const LawValues& v, dcm::ShellParameters& p) {
                       dcm::add_sheet(p, sheet, {dcm::SheetModuli::of(v).shear, v("hardening")});
                     },
                 .stiffness = &dcm::sheet_stiffness}}};
}

/// F = k δ for δ > 0.
template <class Real>
struct LinearSpring {
  Real stiffness;  // k

  cbm::ContactResponse<Real> respond(Real reduced_radius, Real overlap) const noexcept {
    const Real pressed = max(overlap, Real(0.0)), square = reduced_radius * pressed, force = stiffness * pressed;
    return {force, select(overlap > Real(0.0), stiffness, Real(0.0)), sqrt(square), Real(3.14159265358979) * square,
            Real(0.5) * force * pressed};
  }
};

KeySpec spring() {
  return {.name = "stiffness",
          .doc = "Stiffness of the contact of two such spheres.",
          .quantity = Quantity::kTension,
          .fallback = "1 nN/um",
          .low = 0.0,
          .high = 1e4,
          .example = "2 nN/um",
          .source = "chosen"};
}

std::shared_ptr<const cbm::SphereLaw> linear_spring() {
  static const auto law =
      cbm::make_sphere_law<LinearSpring>({.info = {.name = "linear_spring",
                                                   .title = "Linear spring",
                                                   .equation = "F = k δ, 1/k = ½ (1/k_a + 1/k_b)",
                                                   .source = "a test",
                                                   .parameters = {given_by_study("stiffness", "tension", "nN/µm", "k")},
                                                   .keys = {{"cbm", spring()}}},
                                          .word = "linear_spring",
                                          .doc = "force in proportion to the overlap",
                                          .own = {spring()},
                                          .couple = [](const cbm::SphereParameters& a, const cbm::SphereParameters* b, double) {
                                            const double k = a.own("stiffness");
                                            return cbm::PairCoefficients{b != nullptr ? 2.0 / (1.0 / k + 1.0 / b->own("stiffness")) : k};
                                          }});
  return law;
}

/// Attraction that falls linearly from contact, W (1 − g/c)², and a repulsion ½ k g² with a stiffness of its own.
struct LinearAttraction {
  double adhesion, range, stiffness;

  static LinearAttraction of(const SurfaceTraction& law) { return {law.adhesion, law.range, law.coefficient[0]}; }
  template <class Real>
  TractionLaw::Part<Real> attraction(Real g) const noexcept {
    const Real zero(0.0), rest = Real(1.0) - g * Real(1.0 / range);
    const auto within = (g > zero) & (g < Real(range));
    return {select(g <= zero, Real(-adhesion), select(within, Real(-adhesion) * rest * rest, zero)),
            select(within, Real(2.0 * adhesion / range) * rest, zero), zero};
  }
  template <class Real>
  TractionLaw::Part<Real> repulse(Real g) const noexcept {
    const Real zero(0.0), k(stiffness);
    const auto inside = g < zero;
    return {select(inside, Real(0.5) * k * g * g, zero), select(inside, k * g, zero), select(inside, k, zero)};
  }
};

KeySpec pad_stiffness() {
  return {.name = "pad_stiffness",
          .doc = "Stiffness of the repulsion.",
          .quantity = Quantity::kPressurePerLength,
          .low = 0.1,
          .high = 1e5,
          .example = "100 kPa/um"};
}

std::shared_ptr<const SurfaceLaw> linear_attraction() {
  static const auto law = std::make_shared<const SurfaceLaw>(SurfaceLaw{.info = {.name = "linear_attraction",
                                                                                 .title = "Attraction that falls",
                                                                                 .equation = "U = −W (1 − g/c)²",
                                                                                 .source = "a test",
                                                                                 .parameters = {}},
                                                                        .word = "linear_attraction",
                                                                        .doc = "falls from contact",
                                                                        .own = {pad_stiffness()},
                                                                        .has_repulsion = false,
                                                                        .build = [](const LawValues& v) {
                                                                          SurfaceTraction traction;
                                                                          traction.adhesion = v("adhesion"), traction.range = v("range");
                                                                          traction.coefficient = {v("pad_stiffness")};
                                                                          traction.form = traction_functions<LinearAttraction>();
                                                                          return traction;
                                                                        }});
  return law;
}

ReadOptions with_own_laws() {
  auto laws = std::make_shared<Laws>(*builtin_laws());
  laws->shells.push_back(hardening_sheet());
  laws->spheres.push_back(linear_spring());
  laws->surfaces.push_back(linear_attraction());
  ReadOptions options;
  options.laws = std::move(laws);
  return options;
}

const std::string kCortex = "cortex: {young: 1 kPa, thickness: 200 nm, poisson: 0.5, tension: 0.2 mN/m}";

TEST(OwnLaws, OfASheetAreReadWithTheirKeys) {
  const std::string text = changed(kCortex, "cortex: {elastic: hardening, hardening: 4}");
  EXPECT_THAT(errors_of(text), HasSubstr("cannot be 'hardening'"));
  const auto study = read(text, with_own_laws());
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto& shell = study->model.types[0].shell;
  ASSERT_EQ(shell.sheets.size(), 1u);
  EXPECT_EQ(shell.sheets[0].law->name, "hardening_sheet");
  EXPECT_NEAR(shell.sheets[0].coefficient[0], 0.0666667, 1e-6);
  EXPECT_EQ(shell.sheets[0].coefficient[1], 4.0);
  EXPECT_EQ(shell.spring_stiffness, 0.0);
  EXPECT_THAT(study->resolved_text, HasSubstr("hardening: 4"));
  const auto again = read(study->resolved_text, with_own_laws());
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_TRUE(again->model.types[0].shell == shell);
  const auto by_default = read(changed(kCortex, "cortex: {elastic: hardening}"), with_own_laws());
  EXPECT_EQ(by_default->model.types[0].shell.sheets[0].coefficient[1], 2.0);
}

TEST(OwnLaws, AreCheckedAndExplainedAsAllOthers) {
  const ReadOptions own = with_own_laws();
  EXPECT_THAT(errors_of(changed(kCortex, "cortex: {elastic: neo_hooke, hardening: 4}"), own),
              HasSubstr("'hardening' has no effect here [E515]"));
  EXPECT_THAT(errors_of(changed(kCortex, "cortex: {elastic: hardening, hardening: 40}"), own), HasSubstr("[E302]"));
  EXPECT_THAT(errors_of(changed(kCortex, "area: {local: 0.1 mN/m}\n      cortex: {elastic: hardening}"), own), HasSubstr("[E513]"));
  EXPECT_THAT(explain_study("cortex.hardening", *own.laws).value_or(""), HasSubstr("default:  2"));
  EXPECT_THAT(explain_study("cortex.elastic", *own.laws).value_or(""), HasSubstr("hardening: stiffens with its area"));
  EXPECT_FALSE(explain_study("cortex.hardening", *builtin_laws()));
}

TEST(OwnLaws, OfSpheresReachThePairs) {
  const std::string text = changed("cbm: {law: jkr, young: 450 Pa", "cbm: {law: linear_spring, stiffness: 3 nN/um, young: 450 Pa");
  const auto study = read(text, with_own_laws());
  ASSERT_TRUE(study.ok()) << study.error().text();
  const cbm::ContactTable table = sphere_contact_table(study->model);
  const auto found = cbm::evaluate_pair(table.entry(0, 0).contact, {11.5, 0.0, 0.0}, 6.0, 6.0, false, 0.0);
  EXPECT_DOUBLE_EQ(found.force, 1.5);
  EXPECT_DOUBLE_EQ(found.stiffness, 3.0);
  EXPECT_FALSE(found.attached_next);
  EXPECT_THAT(errors_of(changed("cbm: {law: jkr, young", "cbm: {law: jkr, stiffness: 3 nN/um, young"), with_own_laws()),
              HasSubstr("'stiffness' has no effect here"));
}

TEST(OwnLaws, OfSurfacesReachTheTraction) {
  const std::string pairs = "contact: {pairs: [{between: [hepatocyte], law: linear_attraction";
  const auto study = read(changed("geometry:", pairs + ", pad_stiffness: 50 kPa/um}]}\ngeometry:"), with_own_laws());
  ASSERT_TRUE(study.ok()) << study.error().text();
  const SurfaceTraction traction = contact_materials(study->model)[0].law;
  TractionPart attraction, repulsion;
  traction.form->evaluate(traction, TractionLanes(-0.1), attraction, repulsion);
  EXPECT_DOUBLE_EQ(attraction.energy[3], -0.1);
  EXPECT_DOUBLE_EQ(repulsion.slope[3], -5.0);
  traction.form->evaluate(traction, TractionLanes(0.25), attraction, repulsion);
  EXPECT_DOUBLE_EQ(attraction.slope[0], 2.0 * 0.1 / 0.5 * 0.5);
  EXPECT_THAT(errors_of(changed("geometry:", pairs + "}]}\ngeometry:"), with_own_laws()), HasSubstr("needs `pad_stiffness` [E516]"));
}

}  // namespace
}  // namespace morula::scenarios::test
