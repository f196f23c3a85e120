// Membrane laws against closed formulae (dcm.md §2, T2.1–T2.4) and the published numbers of that page.
#include <gtest/gtest.h>

#include "dcm/derived_parameters.h"
#include "dcm/growth.h"
#include "dcm/laws/edge_damper.h"
#include "dcm/laws/edge_spring.h"
#include "tests/dcm/flat_sheet.h"

namespace morula::dcm::testing {
namespace {

constexpr double kSheet = 0.2;                                // E h of Table 1 [nN/µm]
const double kShear = sheet_shear_modulus(1.0, kSheet, 0.5);  // E h/3

struct Law {
  const char* name;
  LawStrength shear;
  double published[2];                         ///< tension at λ = 1.1 and 1.3 (T2.1)
  double digits;                               ///< half a unit of their last digit
  double (*tension)(double G, double lambda);  ///< its formula
};

const Law kLaws[] = {{"neo_hooke",
                      shell_law("neo_hooke").strength(),
                      {0.029035, 0.052855},
                      5e-7,
                      [](double G, double l) { return G * (1.0 - std::pow(l, -6.0)); }},
                     // the page gives 0.255121 at λ = 1.3, its formula 0.2551206
                     {"skalak",
                      shell_law("skalak").strength(),
                      {0.051437, 0.255121},
                      5e-7,
                      [](double G, double l) { return G * ((l * l - 1.0) + l * l * (std::pow(l, 4.0) - 1.0)); }},
                     {"stvk", shell_law("st_venant_kirchhoff").strength(), {0.0420, 0.1380}, 5e-5, [](double G, double l) {
                        return 3.0 * G * (l * l - 1.0);
                      }}};

/// An icosphere with nodes and rest lengths at R = 6.
Shells sphere_of_nodes(std::uint32_t nodes) {
  Shells shells = one_shell(nodes);
  const double scale = 6.0 / morula::norm(shells.position[0]);
  for (Vec3d& x : shells.position) x *= scale;
  for (double& length : shells.rest_length) length *= scale;
  return shells;
}

TEST(MembraneLaws, HaveThePublishedTensionUnderEquibiaxialStretch) {  // T2.1, formulae and numbers
  for (const Law& law : kLaws) {
    EXPECT_NEAR(law.tension(kShear, 1.1), law.published[0], law.digits) << law.name;
    EXPECT_NEAR(law.tension(kShear, 1.3), law.published[1], law.digits) << law.name;
    const Shells shells = sphere_of_nodes(162);
    ShellParameters p = nothing();
    law.shear.in(p) = kShear;
    for (const double stretch : {0.85, 0.95, 1.1, 1.3}) {
      std::vector<Vec3d> x = shells.position;
      for (Vec3d& v : x) v *= stretch;
      const auto at = mechanics(shells, {p}, x);
      const double area = geometry_of(shells, make_shell_blocks(shells), x).area[0];
      // −x·F = 2 T A: exact, since every face has the same stretch
      EXPECT_NEAR(-dot(x, at.force) / (2.0 * area), law.tension(kShear, stretch), 1e-13) << law.name << " at " << stretch;
    }
  }
}

TEST(MembraneLaws, HoldThePressureOfAnInflatedSphere) {  // T2.1: p λR/2 within 1.4 % (162 nodes), 0.35 % (642)
  for (const Law& law : kLaws) {
    double errors[2];
    for (int level = 0; level < 2; ++level) {
      Shells shells = sphere_of_nodes(level == 0 ? 162 : 642);
      ShellParameters p = nothing(), pressure = nothing();
      law.shear.in(p) = kShear;
      pressure.bulk_modulus = 1.0;
      std::vector<Vec3d> x = shells.position;
      for (Vec3d& v : x) v *= 1.1;
      const auto pull = mechanics(shells, {p}, x);
      shells.reference_volume[0] = pull.volume[0] * std::exp(1.0);  // unit pressure: force is ∂V/∂x
      const auto push = mechanics(shells, {pressure}, x);
      const double laplace = -dot(pull.force, push.force) / dot(push.force, push.force);
      errors[level] = laplace * 1.1 * 6.0 / 2.0 / law.published[0] - 1.0;
    }
    // the published tension of St Venant–Kirchhoff has three digits
    const double rounding = law.digits / law.published[0];
    EXPECT_LE(std::abs(errors[0]), 0.014 + rounding) << law.name;
    EXPECT_LE(std::abs(errors[1]), 0.0035 + rounding) << law.name;
  }
}

TEST(MembraneLaws, HaveYoungModulusAndPoissonRatioOfTheSheet) {  // T2.2: 1 % strain, T/ε = E h ± 1 %, lateral −ν ± 0.01
  const Shells sheet = flat_sheet();
  for (const Law& law : kLaws) {
    for (const double poisson : {0.0, 0.2, 0.4, 0.5}) {
      ShellParameters p = nothing();
      law.shear.in(p) = sheet_shear_modulus(1.0, kSheet, poisson);
      set_area_ratio(p, sheet_area_ratio(poisson));
      const auto moduli = uniaxial_moduli(sheet, p);
      EXPECT_NEAR(moduli.young / kSheet, 1.0, 0.01) << law.name << ", ν = " << poisson;
      EXPECT_NEAR(moduli.poisson, poisson, 0.01) << law.name;
    }
  }
}

TEST(MembraneLaws, OfSpringsHaveThePoissonRatioOneThird) {  // T2.2; Seung & Nelson 1988
  ShellParameters p = nothing();
  p.spring_stiffness = spring_stiffness(1.0, kSheet);
  const auto moduli = uniaxial_moduli(flat_sheet(), p);
  EXPECT_NEAR(moduli.young / kSheet, 1.0, 0.01);
  EXPECT_NEAR(moduli.poisson, 1.0 / 3.0, 0.01);
}

TEST(MembraneLaws, OfSpringsWithAreaHaveThePoissonRatioAskedFor) {  // dcm.md §2a: k = 0.15396, K_a = 0.06667 for ν = ½
  const auto half = springs_with_area(1.0, kSheet, 0.5);
  EXPECT_NEAR(half.spring_stiffness, 0.15396, 5e-6);
  EXPECT_NEAR(half.area_modulus, 0.06667, 5e-6);
  for (const double poisson : {1.0 / 3.0, 0.4, 0.5}) {
    const auto both = springs_with_area(1.0, kSheet, poisson);
    ShellParameters p = nothing();
    p.spring_stiffness = both.spring_stiffness;
    p.local_area_modulus = both.area_modulus;
    const auto moduli = uniaxial_moduli(flat_sheet(), p);
    EXPECT_NEAR(moduli.young / kSheet, 1.0, 0.01) << poisson;
    EXPECT_NEAR(moduli.poisson, poisson, 0.01);
  }
}

TEST(MembraneLaws, OfSpringsHaveTheLatticeTensionUnderEquibiaxialStretch) {  // dcm.md §2a: τ = √3 k (1 − L0/L)
  ShellParameters p = nothing();
  p.spring_stiffness = 0.173205;
  const Shells sheet = flat_sheet();
  const double h = 1e-5, stretch = 1.1;
  const double slope = (sheet_energy(sheet, p, stretch + h, stretch + h) - sheet_energy(sheet, p, stretch - h, stretch - h)) / (2.0 * h);
  EXPECT_NEAR(slope / (2.0 * stretch), std::sqrt(3.0) * 0.173205 * (1.0 - 1.0 / stretch), 1e-9);  // dW/dλ = 2 λ τ
}

TEST(MembraneLaws, FeelNoRotation) {  // T2.4: rotation by 1 rad, |F| < 1e-12
  const Shells shells = one_shell(162);
  const double c = std::cos(1.0), s = std::sin(1.0);
  std::vector<Vec3d> x = shells.position;
  for (Vec3d& v : x) v = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
  for (const Law& law : kLaws) {
    ShellParameters p = nothing();
    law.shear.in(p) = kShear;
    for (const Vec3d& f : mechanics(shells, {p}, x).force) EXPECT_LT(morula::norm(f), 1e-12) << law.name;
  }
}

TEST(AreaElasticity, PullsWithItsModulusTimesTheExcess) {  // τ = K (A − A0)/A0, local and global alike where all faces are alike
  const Shells shells = one_shell(162);
  std::vector<Vec3d> x = shells.position;
  for (Vec3d& v : x) v *= 1.1;
  const double area = geometry_of(shells, make_shell_blocks(shells), x).area[0];
  for (const auto modulus : {&ShellParameters::local_area_modulus, &ShellParameters::global_area_modulus}) {
    ShellParameters p = nothing();
    p.*modulus = 0.3;
    const auto at = mechanics(shells, {p}, x);
    EXPECT_NEAR(-dot(x, at.force) / (2.0 * area), 0.3 * 0.21, 1e-13);
    EXPECT_NEAR(at.energy[0], 0.5 * 0.3 * 0.21 * 0.21 * area / 1.21, 1e-11);
  }
}

TEST(AreaElasticity, OfTheWholeSurfaceLetsAreaFlowFromFaceToFace) {
  Shells shells = one_shell(162);
  std::vector<Vec3d> x = shells.position;
  x[7] += Vec3d{0.3, -0.2, 0.1};
  const double before = geometry_of(shells, make_shell_blocks(shells), shells.position).area[0];
  const double after = geometry_of(shells, make_shell_blocks(shells), x).area[0];
  ShellParameters local = nothing(), global = nothing();
  local.local_area_modulus = global.global_area_modulus = 1.0;
  EXPECT_NEAR(mechanics(shells, {global}, x).energy[0], 0.5 * (after - before) * (after - before) / before, 1e-13);
  EXPECT_GT(mechanics(shells, {local}, x).energy[0], 10.0 * mechanics(shells, {global}, x).energy[0]);
}

TEST(Growth, LeavesNoStressInAnyMembrane) {  // T13.1: energy below 1e-8 of Eh·A after doubling; metric × s^{2/3}, A0 × s^{2/3}
  for (const char* law : {"neo_hooke", "st_venant_kirchhoff", "skalak", "local_area", "global_area"}) {
    Shells shells = one_shell(162);
    ShellParameters p = nothing();
    shell_law(law).strength().in(p) = kSheet;
    set_rest_volume(shells, 0, 2.0 * sphere_volume(6.0));
    for (Vec3d& x : shells.position) x *= 1.2599210498948732;
    const auto at = mechanics(shells, {p}, shells.position);
    EXPECT_LT(std::abs(at.energy[0]), 1e-8 * kSheet * 452.389);
    EXPECT_LT(norm(at.force), 1e-10);
  }
}

TEST(StVenantKirchhoff, IsAtFaultOutsideItsRangeAndNamesTheFace) {
  const Shells shells = one_shell(162);
  ShellParameters p = nothing();
  shell_law("st_venant_kirchhoff").strength().in(p) = kShear;
  const auto stretched = [&](double by) {
    std::vector<Vec3d> x = shells.position;
    for (Vec3d& v : x) v *= by;
    return mechanics(shells, {p}, x).fault[0];
  };
  EXPECT_FALSE(stretched(0.81));
  EXPECT_FALSE(stretched(1.29));
  EXPECT_EQ(stretched(0.79).kind, ShellFaultKind::kStretch);
  EXPECT_EQ(stretched(1.31).kind, ShellFaultKind::kStretch);
  EXPECT_EQ(describe(stretched(1.31)).substr(0, 34), "st_venant_kirchhoff: face 0 is str");
  std::vector<Vec3d> x = shells.position;
  const Triangle t = shells.topology(0).faces()[100];
  x[t[0]] += 0.5 * (x[t[0]] - 0.5 * (x[t[1]] + x[t[2]]));
  const auto fault = mechanics(shells, {p}, x).fault[0];
  ASSERT_EQ(fault.kind, ShellFaultKind::kStretch);
  const Triangle& named = shells.topology(0).faces()[fault.element];
  EXPECT_NE(std::find(named.begin(), named.end(), t[0]), named.end());
  p.sheets = {{shell_law("neo_hooke").sheet, {kShear, 1.0}}};
  EXPECT_FALSE(stretched(1.4)) << "a neo-Hookean membrane holds there";
}

TEST(KelvinVoigtEdge, CreepsTowardsItsLengthUnderAStepForce) {  // T2.3: L − L0 = (f/k)(1 − e^{−t/τ}), τ = γ_int/k = 0.57735 s; ± 1 %
  const EdgeSpring<double> spring{0.173205};
  const EdgeDamper<double> damper{0.1};
  const double tau = 0.1 / 0.173205, force = 0.01, rest = 1.8, dt = tau / 200.0;
  EXPECT_NEAR(tau, 0.57735, 5e-6);
  const Vec3d direction = normalized(Vec3d{1.0, -2.0, 0.5});
  double length = rest;
  for (int step = 1; step <= 600; ++step) {
    // along the edge: γ_int L̇ = f − slope of the spring
    const double friction = morula::dot(direction, damper.friction(direction) * direction);
    length += dt * (force - spring.slope(length, rest)) / friction;
    const double exact = force / 0.173205 * (1.0 - std::exp(-step * dt / tau));
    EXPECT_NEAR((length - rest) / exact, 1.0, 0.01);
  }
}

TEST(Turnover, LetsTheTensionOfAHeldSpringDecayExponentially) {
  Shells shells = one_shell(162);
  ShellParameters p = nothing();
  p.spring_stiffness = 0.173205;
  p.turnover_rate = 1.0 / 300.0;
  for (Vec3d& x : shells.position) x *= 1.1;
  const auto before = mechanics(shells, {p}, shells.position).force;
  turn_over(shells, std::vector{p}, 450.0);
  const auto after = mechanics(shells, {p}, shells.position).force;
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_LE(morula::norm(after[i] - std::exp(-1.5) * before[i]), 1e-14);
}

TEST(Turnover, DoesNotDependOnHowTimeIsCutIntoSteps) {
  const std::vector<ShellParameters> types = [] {
    std::vector<ShellParameters> t(2, nothing());
    t[0].turnover_rate = 0.01;
    return t;
  }();
  Shells once = rough_shells(), often = rough_shells();
  turn_over(once, types, 100.0);
  for (int k = 0; k < 1000; ++k) turn_over(often, types, 0.1);
  const Shells before = rough_shells();
  for (std::size_t s = 0; s < once.size(); ++s) {
    for (std::uint32_t k = once.first_edge[s]; k < once.first_edge[s + 1]; ++k) {
      EXPECT_NEAR(often.rest_length[k], once.rest_length[k], 1e-12);
      EXPECT_EQ(once.rest_length[k] == before.rest_length[k], once.type[s] == 1) << "type 1 has no turnover";
    }
  }
}

TEST(Turnover, EndsWithoutStressWhateverTheStep) {
  Shells shells = rough_shells();
  std::vector<ShellParameters> types(2, nothing());
  for (ShellParameters& p : types)
    p.turnover_rate = 1.0, p.sheets = {{shell_law("neo_hooke").sheet, {0.1, 1.0}}}, p.spring_stiffness = 0.2, p.local_area_modulus = 0.1,
    p.global_area_modulus = 0.1;
  turn_over(shells, types, 1e6);
  EXPECT_LE(norm(mechanics(shells, types, shells.position).force), 1e-10);
}

}  // namespace
}  // namespace morula::dcm::testing
