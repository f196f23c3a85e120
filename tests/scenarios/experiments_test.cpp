#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "cbm/laws/jkr.h"
#include "results/snapshot_file.h"
#include "scenarios/calibrate/confidence.h"
#include "scenarios/calibrate/packing_geometry.h"
#include "scenarios/experiments/budget.h"
#include "scenarios/experiments/calibration.h"
#include "scenarios/experiments/data_of_runs.h"
#include "scenarios/experiments/found_curves.h"
#include "scenarios/experiments/pressed_spheres.h"
#include "scenarios/run/driver.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kKnots =
    "packing: {law: knots, knots: [{packing: 8 %, pressure: 0 Pa}, {packing: 12 %, pressure: 90 Pa}, {packing: 30 %, pressure: 500 Pa}]}";

/// Spheres of a law that is known stand where the shells of an experiment do.
std::vector<Experiment> experiments_with_spheres(double young, double adhesion, Experiment::Kind kind = Experiment::Kind::kPair) {
  CellMaterial material;
  material.type = "ball";
  material.radius = 5.0;
  material.adhesion = adhesion;
  material.range = 0.5;
  material.shell = "cbm: {law: jkr, young: " + std::to_string(young) + " kPa, poisson: 0.4, " +
                   (kind == Experiment::Kind::kPair ? "packing: none" : kKnots) + "}";
  material.contact = "{range: 0.5 um}";
  std::vector<Experiment> out;
  for (Experiment& e : experiments_for(material, true)) {
    if (e.kind != kind || e.arrangement == calibrate::Arrangement::kRandom) continue;
    for (std::size_t at = 0; (at = e.text.find("as: shell", at)) != std::string::npos;) e.text.replace(at, 9, "as: sphere");
    out.push_back(e);
  }
  return out;
}

ExperimentRequest in(const std::filesystem::path& folder) {
  ExperimentRequest out;
  out.folder = folder;
  return out;
}

/// The user's road of a calibration with a truth that is known: studies are run, their results read, extrapolated to no rate and fitted, and the modulus
/// and the adhesion of the spheres come back. What is held out, cells of other radii, is met as well.
TEST(Experiments, GiveBackTheLawOfSpheres) {
  const test::Folder folder;
  const auto experiments = experiments_with_spheres(0.8, 0.05);
  ASSERT_EQ(experiments.size(), 6u);
  const auto outcomes = run_experiments(experiments, in(folder.path()), Comm());
  ASSERT_TRUE(outcomes.ok());
  const auto data = data_of_runs(experiments, *outcomes);
  ASSERT_TRUE(data.ok()) << data.error().message;
  EXPECT_THAT(data->remarks, testing::IsEmpty());
  ASSERT_GT(data->points.pairs.size(), 100u);
  const auto fit = calibrate::fit(data->points, {});
  ASSERT_TRUE(fit.ok()) << fit.error().message;
  EXPECT_NEAR(fit->parameters.young / 0.8, 1.0, 0.01);
  EXPECT_NEAR(fit->parameters.adhesion / 0.05, 1.0, 0.01);
  const auto pair = cbm::make_pair_law(cbm::ContactMaterial::elastic(0.8, 0.4, 0.8, 0.4, 0.05), 5.0 * 6.5 / 11.5);
  std::size_t held_out = 0;
  for (const auto& point : data->points.pairs) {
    if (!point.held_out || point.overlap < 0.0) continue;
    ++held_out;
    EXPECT_NEAR(point.force, cbm::contact_response(pair, point.overlap, true).force, 0.02 * fit->pull_off(5.0 * 6.5 / 11.5))
        << point.overlap;
  }
  EXPECT_GT(held_out, 20u);
}

/// Spheres of JKR, E 0.8 kPa, W 0.05 nN/µm, that stand where shells would.
CellMaterial material_of_balls() {
  CellMaterial material;
  material.type = "ball";
  material.radius = 5.0;
  material.adhesion = 0.05;
  material.range = 0.5;
  material.friction = {0.1, 2.0, 40.0};
  material.shell = "cbm: {law: jkr, young: 0.8 kPa, poisson: 0.4, packing: none}";
  material.contact = "{range: 0.5 um}";
  return material;
}

/// Spheres of a known friction, which come together by themselves where the shells of an experiment do: their friction comes back.
TEST(Experiments, GiveBackTheFrictionOfSpheres) {
  const test::Folder folder;
  CellMaterial material = material_of_balls();
  std::vector<Experiment> all = experiments_for(material, false), relaxing;
  for (Experiment& e : all)
    if (e.kind == Experiment::Kind::kRelaxation) {
      e.text.replace(e.text.find("as: shell"), 9, "as: sphere");
      relaxing.push_back(e);
    }
  ASSERT_EQ(relaxing.size(), 3u);
  relaxing.resize(1);
  const auto outcomes = run_experiments(relaxing, in(folder.path()), Comm());
  ASSERT_TRUE(outcomes.ok());
  ASSERT_TRUE((*outcomes)[0].done) << (*outcomes)[0].problem;
  const auto pair = relaxation_of_run(relaxing[0], (*outcomes)[0].run);
  ASSERT_TRUE(pair.ok()) << pair.error().message;
  EXPECT_NEAR(pair->medium_friction, 0.1 * 100.0 * std::numbers::pi, 1e-9);
  const auto found = calibrate::fit_approach_friction({*pair}, calibrate::jkr_model(0.8, 0.4, 0.05));
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_NEAR(found->friction, 2.0, 0.06);
  EXPECT_LT(found->misfit, 0.03);
  material.adhesion = 0.0;
  for (const Experiment& e : experiments_for(material)) EXPECT_NE(e.kind, Experiment::Kind::kRelaxation) << "nothing draws them together";
}

/// A fluid cortex gives nodes no hold along the surface: traps that took hold of the nodes would gather them where they pull, and adhesion would draw the
/// cells together between them. Centres of volume are where the traps say, but for F/K of two springs of 20 nN/µm.
TEST(Experiments, HoldFluidCellsAtTheirDistance) {
  const test::Folder folder;
  const auto study = test::read(
      "schema: 1\nstudy: fluid\ntime: {end: 1 h}\ndomain: {size: [80 um, 80 um, 80 um]}\n"
      "cell_types: {drop: {radius: 6 um, adhesion: {drop: 0.1 mN/m}, dcm: {nodes: 162, cortex: {elastic: none, tension: 0.1 mN/m}}}}\n"
      "initial: [{type: drop, at: [[0 um, 0 um, 0 um]]}]\n");
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto material = material_of(*study, "drop");
  ASSERT_TRUE(material.ok());
  const std::vector<Experiment> pair{pair_experiment(*material, "pair", 6.0, 6.0, 0.012)};
  const auto outcomes = run_experiments(pair, in(folder.path()), Comm());
  ASSERT_TRUE(outcomes.ok());
  ASSERT_TRUE((*outcomes)[0].done) << (*outcomes)[0].problem;
  const auto found = pair_of_run(pair[0], (*outcomes)[0].run);
  ASSERT_TRUE(found.ok()) << found.error().message;
  int pulling = 0;
  for (const FoundPair& at : *found) {
    const double inwards = 0.012 * std::min(at.time, 2.0 * pair[0].turn - at.time);  // way of the upper trap, from a gap of 0.5 µm
    EXPECT_NEAR(at.overlap, std::max(inwards - 0.5, -0.8 * 6.0) - at.force / 10.0, 0.02) << at.time;
    pulling += at.force < -0.3 && at.overlap < 0.3 * 6.0;
  }
  EXPECT_GT(pulling, 10) << "cells that adhere pull at overlaps below that at rest";
}

/// Spheres that have a quarter of the friction of the material along their contacts stand where the shells of a pressed cluster do: the factor comes back.
TEST(Experiments, GiveBackTheFrictionAlongTheContactOfSpheres) {
  const test::Folder folder;
  CellMaterial material = material_of_balls();
  std::vector<Experiment> clusters;
  std::vector<std::uint32_t> seeds;
  for (Experiment& e : experiments_for(material)) {
    if (e.kind != Experiment::Kind::kPressed) continue;
    e.text.replace(e.text.find("as: shell"), 9, "as: sphere");
    const std::string law = "cbm: {";
    ASSERT_NE(e.text.find(law), std::string::npos);
    e.text.insert(e.text.find(law) + law.size(), "friction: {along: 0.25}, ");
    clusters.push_back(e);
    seeds.push_back(e.seed);
  }
  ASSERT_EQ(clusters.size(), 3u);
  const auto outcomes = run_experiments(clusters, in(folder.path()), Comm());
  ASSERT_TRUE(outcomes.ok());
  std::vector<calibrate::PressedCluster> found;
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_TRUE((*outcomes)[k].done) << (*outcomes)[k].problem;
    const auto one = pressed_of_run(clusters[k], (*outcomes)[k].run);
    ASSERT_TRUE(one.ok()) << one.error().message;
    EXPECT_EQ(one->part.size(), 61u);
    EXPECT_GT(one->work.back(), 1.0);
    found.push_back(*one);
  }
  material.shell = "dcm: {nodes: 42}";  // of which read() makes spheres
  const auto spheres = PressedSpheres::read(material, seeds, 2);
  ASSERT_TRUE(spheres.ok()) << spheres.error().message;
  TrialLaw law{.sphere = {.young = 0.8, .poisson = 0.4}, .adhesion = material.adhesion, .pair = {}};
  const auto fit = calibrate::fit_friction_along(found, material.friction.along, 1.0,
                                                 [&](std::span<const double> factors) { return spheres->press(law, factors); });
  ASSERT_TRUE(fit.ok()) << fit.error().message;
  EXPECT_NEAR(std::log2(fit->factor), -2.0, 0.15);
  EXPECT_LT(fit->misfit, 0.05);
  material.friction.along = 0.0;
  for (const Experiment& e : experiments_for(material)) EXPECT_NE(e.kind, Experiment::Kind::kPressed) << "nothing to fit";
}

/// Spheres of a known law stand where the shells of clusters do. What a fit makes of them comes to rest at the same distances, and in a pair, a triangle and a tetrahedron, where each pair is
/// free to come to its own rest, that is where JKR has no load. The neighbours of a sphere that becomes a shell are pushed further out by one that is stiffer.
TEST(Experiments, GiveBackWhereClustersOfSpheresRest) {
  const test::Folder folder;
  CellMaterial material = material_of_balls();
  std::vector<Experiment> clusters;
  for (Experiment& e : experiments_for(material)) {
    if (e.kind != Experiment::Kind::kCluster || e.held_out || e.seed > 1) continue;
    for (std::size_t at = 0; (at = e.text.find("as: shell", at)) != std::string::npos;) e.text.replace(at, 9, "as: sphere");
    clusters.push_back(e);
  }
  ASSERT_EQ(clusters.size(), 4u);
  const auto outcomes = run_experiments(clusters, in(folder.path()), Comm());
  ASSERT_TRUE(outcomes.ok());
  std::vector<FoundCluster> found;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto one = cluster_of_run(clusters[k], (*outcomes)[k].run);
    ASSERT_TRUE(one.ok()) << one.error().message;
    EXPECT_LT(one->still, 1e-3 * 5.0) << "at rest";
    found.push_back(*one);
  }
  material.shell = "dcm: {nodes: 42}";  // of which the studies of spheres make spheres
  TrialLaw law{.sphere = {.young = 0.8, .poisson = 0.4}, .adhesion = 0.05, .pair = calibrate::jkr_model(0.8, 0.4, 0.05)};
  const auto spheres = spheres_in_clusters(material, found, law);
  ASSERT_TRUE(spheres.ok()) << spheres.error().message;
  // JKR at no load: a³ = 9πWR*²/(2E*), δ = a²/(3R*), E* of two such spheres 0.8 kPa/(2 · 0.84)
  const double contact = std::cbrt(4.5 * std::numbers::pi * 0.05 * 6.25 / (0.8 / 1.68)), rest = 10.0 - contact * contact / 7.5;
  for (std::size_t k = 0; k < 4; ++k) {
    const RestingCluster& one = (*spheres)[k];
    EXPECT_EQ(one.cells, (std::array<std::size_t, 4>{2, 3, 4, 13}[k]));
    EXPECT_NEAR(one.shells, rest, (k < 3 ? 0.002 : 0.02) * 5.0);  // of thirteen, the middle one bears what outer ones pull inwards
    EXPECT_NEAR(one.error(), 0.0, 1e-3);
    const auto places = calibrate::geometry_of_cluster(found[k].centers, 5.0);
    EXPECT_EQ((calibrate::ClusterPoint{.places = places, .radius = 5.0}.is_pair()), k == 0);
    EXPECT_NEAR(calibrate::pair_pressure(places, 5.0, law.pair), 0.0, 1e-3) << "[kPa]: nothing presses on them";
  }
  const auto way = [&](double stiffness) {
    law.sphere.with_shells = {stiffness, 1.0};
    return way_of_promotion(material, law).value();
  };
  const double soft = way(0.25), stiff = way(2.0);
  EXPECT_GT(stiff, soft + 0.01);
  EXPECT_LT(std::abs(soft), 0.3);
}

/// A study that takes a law from the file of a calibration: two spheres come to rest where JKR with the true E and W has no load, though the shells of the
/// type adhere twice as much; and after a swap of the law to that of the study they do not.
TEST(Experiments, AStudyUsesTheLawThatWasFound) {
  const test::Folder folder;
  const auto experiments = experiments_with_spheres(0.8, 0.05);
  const auto outcomes = run_experiments(experiments, in(folder.path()), Comm());
  ASSERT_TRUE(outcomes.ok());
  const std::string text =
      "schema: 1\nstudy: pair\ntime: {end: 3 h, output: 3 h}\ndomain: {size: [80 um, 80 um, 80 um]}\noutput: {report: false}\n"
      "cell_types: {ball: {radius: 5 um, adhesion: {ball: 0.1 mN/m}, cbm: {law: jkr, packing: none}}}\n"
      "initial: [{type: ball, at: [[-4.9 um, 0 um, 0 um], [4.9 um, 0 um, 0 um]]}]\n";
  Calibration found;
  const auto plain = test::read(text);
  ASSERT_TRUE(plain.ok()) << plain.error().text();
  found.material = material_of(*plain, "ball").value();
  found.data = data_of_runs(experiments, *outcomes).value();
  found.sure.fit = calibrate::fit(found.data.points, {}).value();
  found.data.remarks.push_back("a \"remark\" with\nparts: [of, {YAML");
  std::ofstream(folder.path() / "ball.jkr.yaml") << calibration_text(found);
  const auto distance = [&](const std::string& law, const char* name) {
    const auto study = test::read(test::changed("law: jkr", law, text), {}, folder.path());
    if (!study.ok()) return ADD_FAILURE() << study.error().text(), 0.0;
    RunRequest request;
    request.out = folder.path() / name;
    EXPECT_TRUE(run(*study, request, Comm()).ok());
    const auto last = read_snapshot(folder.path() / name / "results.h5", 1);
    if (!last.ok()) return ADD_FAILURE() << last.error().message, 0.0;
    return norm(last->cells[1].centroid - last->cells[0].centroid);
  };
  // JKR at no load: a³ = 9πWR*²/(2E*), δ = a²/(3R*), E* of two such spheres 0.8 kPa/(2 · 0.84)
  const double modulus = 0.8 / 1.68, contact = std::cbrt(4.5 * std::numbers::pi * 0.05 * 6.25 / modulus);
  const double rest = contact * contact / 7.5;
  EXPECT_NEAR(distance("law: fitted, file: ball.jkr.yaml", "fitted"), 10.0 - rest, 0.02 * rest);
  EXPECT_GT(std::abs(distance("law: jkr, young: 0.8 kPa", "plain") - (10.0 - rest)), 0.1 * rest);
}

/// Packings of adhering spheres that resist packing, whose box shrinks: the pressure of the box is that of the lattice in closed form, from pairs by JKR
/// (twelve neighbours, or eight and six) and the pressure of packing on their planes of contact.
TEST(Experiments, PackingsOfSpheresHaveThePressureOfTheirLattice) {
  const test::Folder folder;
  const auto experiments = experiments_with_spheres(0.8, 0.02, Experiment::Kind::kPacking);
  ASSERT_EQ(experiments.size(), 2u);
  const auto outcomes = run_experiments(experiments, in(folder.path()), Comm());
  ASSERT_TRUE(outcomes.ok());
  const std::vector<cbm::PackingKnot> knots{{0.08, 0.0}, {0.12, 0.09}, {0.30, 0.5}};
  const auto curve = cbm::PackingCurve::through(knots);
  ASSERT_TRUE(curve.ok());
  const auto pair = calibrate::jkr_model(0.8, 0.4, 0.02);
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    ASSERT_TRUE((*outcomes)[e].done) << (*outcomes)[e].problem;
    const auto points = packing_of_run(experiments[e], (*outcomes)[e].run);
    ASSERT_TRUE(points.ok());
    const auto lattice = e == 0 ? calibrate::Arrangement::kFaceCentred : calibrate::Arrangement::kBodyCentred;
    int compared = 0;
    for (const FoundPacking& point : *points) {
      if (point.volume_ratio > 1.1) continue;
      const auto at = calibrate::lattice_geometry(lattice, point.volume_ratio);
      const double expected = calibrate::pair_pressure(at, 5.0, pair) + calibrate::curve_pressure(at, *curve);
      EXPECT_NEAR(point.pressure, expected, 1e-3 * std::max(std::abs(expected), 0.02)) << e << " V/V0 " << point.volume_ratio;
      ++compared;
    }
    EXPECT_GT(compared, 30);
  }
}

/// What is done is not done again, what was broken off goes on, and the points are the same bits.
TEST(Experiments, GoOnWhereTheyWereBrokenOff) {
  const test::Folder folder;
  auto experiments = experiments_with_spheres(0.8, 0.05);
  experiments.resize(3);
  const auto first = run_experiments(experiments, in(folder.path() / "whole"), Comm());
  ASSERT_TRUE(first.ok());
  std::atomic<int> stop{kGoOn};
  int begun = 0;
  ExperimentRequest request = in(folder.path() / "broken");
  request.stop = &stop;
  request.on_note = [&](const std::string&) {
    if (++begun == 2) stop = kStopEarly;  // the second stops at its first step
  };
  const auto stopped = run_experiments(experiments, request, Comm());
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::kStoppedEarly);
  EXPECT_EQ(begun, 2);
  stop = kGoOn;
  begun = -100;
  const auto second = run_experiments(experiments, request, Comm());
  ASSERT_TRUE(second.ok());
  EXPECT_EQ(begun, -100 + 2);  // one was done
  const auto a = data_of_runs(experiments, *first), b = data_of_runs(experiments, *second);
  ASSERT_TRUE(a.ok() && b.ok());
  ASSERT_EQ(a->points.pairs.size(), b->points.pairs.size());
  for (std::size_t i = 0; i < a->points.pairs.size(); ++i) {
    EXPECT_EQ(a->points.pairs[i].force, b->points.pairs[i].force);
    EXPECT_EQ(a->points.pairs[i].overlap, b->points.pairs[i].overlap);
  }
  begun = -100;
  ASSERT_TRUE(run_experiments(experiments, request, Comm()).ok());
  EXPECT_EQ(begun, -100);
}

/// An experiment that cannot be run is told, with its reason, and the others go on.
TEST(Experiments, TellWhatFailed) {
  const test::Folder folder;
  auto experiments = experiments_with_spheres(0.8, 0.05);
  experiments.resize(3);
  experiments[2].text += "nonsense: 1\n";
  const auto outcomes = run_experiments(experiments, in(folder.path()), Comm());
  ASSERT_TRUE(outcomes.ok());
  EXPECT_TRUE((*outcomes)[0].done && (*outcomes)[1].done);
  EXPECT_FALSE((*outcomes)[2].done);
  EXPECT_THAT((*outcomes)[2].problem, testing::HasSubstr("nonsense"));
  const auto data = data_of_runs(experiments, *outcomes);
  ASSERT_TRUE(data.ok());
  EXPECT_THAT(data->remarks, testing::ElementsAre(testing::HasSubstr("nonsense"), testing::HasSubstr("two rates only")));
}

constexpr const char* kStudy = R"(schema: 1
study: two_types
time: {end: 1 h}
domain: {size: [80 um, 80 um, 80 um], boundary: open}
cell_types:
  soft: {radius: 5 um, adhesion: {soft: 2e-4 J/m^2, hard: 0 J/m^2}, dcm: {nodes: 42, cortex: {tension: 0.3 mN/m}}}
  hard: {radius: 6 um, dcm: {cortex: {young: 5 kPa}}}
contact:
  range: 0.6 um
  pairs: [{between: [soft, soft], repulsion: 50 kPa/um}, {between: [soft, hard], repulsion: 70 kPa/um}]
initial: [{type: soft, at: [[0 um, 0 um, 0 um]]}]
)";

TEST(CellMaterial, TakesWhatShellsOfTheTypeRead) {
  const auto study = read_study_text("two.yaml", kStudy, ".");
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto material = material_of(*study, "soft");
  ASSERT_TRUE(material.ok()) << material.error().message;
  EXPECT_DOUBLE_EQ(material->radius, 5.0);
  EXPECT_DOUBLE_EQ(material->adhesion, 0.2);
  EXPECT_DOUBLE_EQ(material->range, 0.6);
  EXPECT_EQ(material->nodes, 42u);
  EXPECT_THAT(material->shell, testing::HasSubstr("tension: 0.3 mN/m"));
  EXPECT_THAT(material->contact, testing::AllOf(testing::HasSubstr("range: 0.6 um"), testing::Not(testing::HasSubstr("pairs"))));
  EXPECT_THAT(material->pair, testing::AllOf(testing::HasSubstr("repulsion: 50 kPa/um"), testing::Not(testing::HasSubstr("70"))));
  for (const Experiment& experiment : experiments_for(*material)) {
    if (experiment.kind != Experiment::Kind::kPair) continue;
    const auto its = read_study_text(experiment.name, experiment.text, ".");
    EXPECT_TRUE(its.ok()) << its.error().text();
  }
  const auto none = material_of(*study, "sof");
  ASSERT_FALSE(none.ok());
  EXPECT_THAT(none.error().help, testing::AllOf(testing::HasSubstr("`soft`"), testing::HasSubstr("`hard`")));
}

TEST(CellMaterial, HasAnotherHashWhereItIsAnother) {
  const auto hash = [](std::string text, const char* from, const char* to) {
    if (const auto at = text.find(from); at != std::string::npos) text.replace(at, std::string(from).size(), to);
    const auto study = read_study_text("two.yaml", text, ".");
    EXPECT_TRUE(study.ok()) << study.error().text();
    return hash_of(*material_of(*study, "soft"));
  };
  const std::string as_it_is = hash(kStudy, "study: two_types", "study: renamed");
  EXPECT_EQ(as_it_is, hash(kStudy, "radius: 6 um", "radius: 7 um"));  // of the other type
  EXPECT_NE(as_it_is, hash(kStudy, "tension: 0.3 mN/m", "tension: 0.31 mN/m"));
  EXPECT_NE(as_it_is, hash(kStudy, "nodes: 42", "nodes: 162"));
  EXPECT_NE(as_it_is, hash(kStudy, "soft: 2e-4 J/m^2", "soft: 2.1e-4 J/m^2"));
  EXPECT_NE(as_it_is, hash(kStudy, "repulsion: 50 kPa/um", "repulsion: 51 kPa/um"));
}

CellMaterial material_of_shells() {
  CellMaterial out;
  out.type = "ball";
  out.radius = 5.0;
  out.adhesion = 0.05;
  out.tension = 0.2;
  out.range = 0.5;
  out.nodes = 162;
  out.shell = "dcm: {nodes: 162}";
  out.contact = "{range: 0.5 um}";
  out.friction = {0.1, 50.0, 50.0};
  return out;
}

TEST(Budget, LeavesOutWhatJudgesFirstAndNeverWhatTheFitNeeds) {
  const auto all = experiments_for(material_of_shells());
  double whole = 0.0;
  for (const Experiment& e : all) whole += expected_seconds(e, 162);
  EXPECT_TRUE(within_budget(all, 162, 1.001 * whole)->left_out.empty());
  std::vector<std::string> order;
  double least = whole;
  for (double budget = whole; budget > 0.0; budget = 0.999 * least) {
    const auto list = within_budget(all, 162, budget);
    if (!list.ok()) {
      EXPECT_EQ(list.error().kind, ErrorKind::kInput);
      EXPECT_THAT(list.error().message, testing::HasSubstr("two cells at two rates alone take about"));
      break;
    }
    EXPECT_LE(list->seconds, budget);
    least = list->seconds;
    order = list->left_out;
    EXPECT_EQ(list->kept.size() + order.size(), all.size());
    EXPECT_EQ(list->kept.front().name, "equal_pair_1");
  }
  const auto is_mixed = [](const std::string& name) { return name.starts_with("mixed_pair"); };
  EXPECT_EQ(std::ranges::count_if(order, is_mixed), 28);
  const auto is_cluster = [](const std::string& name) { return name.starts_with("cluster_of"); };
  EXPECT_EQ(std::ranges::count_if(order, is_cluster), 11);
  for (std::string& name : order)
    if (is_mixed(name))
      name = "mixed_pairs";
    else if (is_cluster(name))
      name = "clusters";
  order.erase(std::unique(order.begin(), order.end()), order.end());
  EXPECT_THAT(order, testing::ElementsAre("packing_fcc", "packing_bcc", "unequal_pair_3", "packing_random_3", "unequal_pair_1",
                                          "unequal_pair_2", "mixed_pairs", "clusters", "pressed_cluster_1", "pressed_cluster_2",
                                          "pressed_cluster_3", "relaxing_pair_1", "relaxing_pair_2", "relaxing_pair_3", "equal_pair_3",
                                          "packing_random_2", "packing_random_1"));
  const auto more_than_162 = [&](std::uint32_t nodes) { return expected_seconds(all.front(), nodes) - expected_seconds(all.front(), 162); };
  EXPECT_GT(more_than_162(642), 0.0);
  EXPECT_NEAR(more_than_162(642) / more_than_162(324), 480.0 / 162.0, 1e-9);  // a run costs something, and each node the same
}

}  // namespace
}  // namespace morula::scenarios
