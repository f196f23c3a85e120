// The laws of shells in the implicit step: a doublet relaxes with each of them, and turnover is part of the step.
#include <gtest/gtest.h>

#include "coupling/simulation.h"
#include "dcm/builtin.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

using namespace test;

struct Case {
  const char* name;
  dcm::LawStrength strength;
  double value;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class EveryElasticLaw : public testing::TestWithParam<Case> {};

TEST_P(EveryElasticLaw, LetsADoubletSpreadWithoutGainOfEnergy) {
  Model model = clusters_model(0.1);
  model.types[0].shell.spring_stiffness = 0.0;
  GetParam().strength.in(model.types[0].shell) = GetParam().value;
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{0, 0, 0}, {12.0, 0, 0}}, {BodyKind::kShell, BodyKind::kShell});
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  const std::vector<Vec3d> none(Mechanics::external_size(tissue));
  double energy = 1e300;
  int newton = 0;
  for (int step = 0; step < 60; ++step) {
    const auto report = mechanics.step(tissue, 2.0, none);
    ASSERT_TRUE(report.ok()) << report.error().what;
    EXPECT_LE(report->energy, energy + 1e-9) << "step " << step;
    energy = report->energy;
    newton += report->newton;
  }
  EXPECT_GT(mechanics.values(tissue).contact_area[0], 8.0);
  EXPECT_LE(newton, 90) << "the stiffness is good for 1.5 Newton iterations a step";
}

INSTANTIATE_TEST_SUITE_P(Laws, EveryElasticLaw,
                         testing::Values(Case{"neo_hooke", dcm::shell_law("neo_hooke").strength(), 0.0667},
                                         Case{"stvk", dcm::shell_law("st_venant_kirchhoff").strength(), 0.0667},
                                         Case{"skalak", dcm::shell_law("skalak").strength(), 0.0667},
                                         Case{"local_area", &dcm::ShellParameters::local_area_modulus, 0.2},
                                         Case{"global_area", &dcm::ShellParameters::global_area_modulus, 5.0},
                                         Case{"helfrich", &dcm::ShellParameters::helfrich_rigidity, 0.01},
                                         Case{"bulk_viscosity", &dcm::ShellParameters::bulk_viscosity, 100.0},
                                         Case{"isotropic_damper", &dcm::ShellParameters::isotropic_damping, 0.05}),
                         [](const auto& one) { return one.param.name; });

/// Elongation (length over width) of a free neo-Hookean cell without tension, 20 min after it was stretched to 1.2 and held there for
/// an hour.
double elongation_after_hold(double turnover_rate) {
  Model model = clusters_model(0.0);
  dcm::ShellParameters& p = model.types[0].shell;
  p.spring_stiffness = p.hinge_stiffness = p.tension = p.shape_stiffness = 0.0;
  p.sheets = {{dcm::shell_law("neo_hooke").sheet, {0.0667, 1.0}}};
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  for (Vec3d& x : tissue.shells.position) x = {1.2 * x.x, x.y / std::sqrt(1.2), x.z / std::sqrt(1.2)};
  p.turnover_rate = turnover_rate;
  dcm::turn_over(tissue.shells, std::vector{p}, 3600.0);
  p.turnover_rate = 0.0;
  auto simulation = std::move(Simulation::create(model, std::move(tissue), Comm(), 1)).value();
  while (simulation->tissue().clock.time < 1200.0) EXPECT_TRUE(simulation->step(1200.0).ok());
  double length = 0.0, width = 0.0;
  for (const Vec3d& x : simulation->tissue().shells.position)
    length = std::max(length, std::abs(x.x)), width = std::max(width, std::abs(x.y));
  return length / width;
}

TEST(Turnover, KeepsTheShapeThatACellWasHeldIn) {
  EXPECT_NEAR(elongation_after_hold(0.0), 1.0, 0.03) << "elastic: back to the sphere";
  EXPECT_NEAR(elongation_after_hold(1.0 / 300.0), std::pow(1.2, 1.5), 0.03) << "renewed: the stretched shape is at rest";
}

TEST(Turnover, IsPartOfEveryStep) {
  Model model = clusters_model(0.0);
  model.types[0].shell.turnover_rate = 1.0 / 600.0;
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  for (double& length : tissue.shells.rest_length) length *= 1.1;
  auto simulation = std::move(Simulation::create(model, std::move(tissue), Comm(), 1)).value();
  const auto strain = [&] {  // mean of l0/l − 1
    const dcm::Shells& shells = simulation->tissue().shells;
    double sum = 0.0;
    for (std::size_t k = 0; k < shells.rest_length.size(); ++k) {
      const Edge& edge = shells.topology(0).edges()[k];
      sum += shells.rest_length[k] / norm(shells.position[edge.j] - shells.position[edge.i]) - 1.0;
    }
    return sum / static_cast<double>(shells.rest_length.size());
  };
  while (simulation->tissue().clock.time < 60.0) ASSERT_TRUE(simulation->step(60.0).ok());
  const double before = strain();
  while (simulation->tissue().clock.time < 660.0) ASSERT_TRUE(simulation->step(660.0).ok());
  EXPECT_NEAR(strain() / before, std::exp(-1.0), 0.05);
}

}  // namespace
}  // namespace morula
