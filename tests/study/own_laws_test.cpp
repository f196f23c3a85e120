// Laws that a program adds to the registry before it reads a study: their words and keys are part of the study, and the model has them.
#include <gmock/gmock.h>

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

ReadOptions with_own_laws() {
  auto laws = std::make_shared<Laws>(*builtin_laws());
  laws->shells.push_back(hardening_sheet());
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

}  // namespace
}  // namespace morula::scenarios::test
