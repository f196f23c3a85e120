#include "scenarios/measures/theory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "results/series_reader.h"
#include "scenarios/library/library.h"

namespace morula::scenarios {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A table that lies beside a library study.
SeriesTable table(const char* study, const std::string& file) {
  for (const TemplateFile& one : find_template(study)->files)
    if (one.path == file) {
      auto read = parse_series(one.content, file);
      EXPECT_TRUE(read.ok()) << read.error().message;
      if (read.ok()) return *read;
    }
  ADD_FAILURE() << "no " << file << " beside " << study;
  return {};
}

TEST(Theory, OfTheDoubletIsItsTable) {
  const SeriesTable t = table("doublet", "doublet_equilibrium.csv");
  const auto at = [&](const char* name, std::size_t i) { return t.find(name)->values[i]; };
  ASSERT_EQ(t.rows(), 10u);
  for (std::size_t i = 0; i < t.rows(); ++i) {
    const theory::Cap cap = theory::doublet(at("W_over_T", i), 1.0);
    EXPECT_NEAR(cap.angle / kDegree, at("contact_angle_deg", i), 5.1e-3);
    EXPECT_NEAR(cap.radius, at("cap_radius_over_R0", i), 5.1e-6);
    EXPECT_NEAR(cap.contact_radius, at("contact_radius_over_R0", i), 5.1e-6);
    EXPECT_NEAR(2.0 * cap.height, at("doublet_length_over_R0", i), 1.1e-5);
    EXPECT_NEAR(cap.contact_part, at("contact_fraction_of_cell_surface", i), 5.1e-6);
    EXPECT_NEAR(cap.pressure, at("pressure_times_R0_over_T", i), 5.1e-6);
  }
}

/// What is near is known in closed form for two balls that touch, where the gap at the angle α is R (√(5 − 4 cos α) − 1), and for two halves of a ball,
/// where it is the chord 2 R sin(β/2) from the line of contact; without a gap it is the contact.
TEST(Theory, OfWhatIsNearerThanAGapIsExactForBallsThatTouchAndForHalvesOfABall) {
  for (const double gap : {0.01, 0.1, 0.5}) {
    EXPECT_NEAR(theory::part_nearer_than(theory::cap_of_angle(1.0), gap), 0.5 * (1.0 - 0.25 * (5.0 - (1.0 + gap) * (1.0 + gap))), 1e-12);
    const theory::Cap half = theory::cap_of_angle(0.0);
    const double beyond = 2.0 * std::asin(0.5 * gap / half.radius);
    EXPECT_NEAR(theory::part_nearer_than(half, gap), (1.0 + 2.0 * std::sin(beyond)) / 3.0, 1e-12);
  }
  const theory::Cap cap = theory::doublet(1.0, 1.0);
  EXPECT_NEAR(theory::part_nearer_than(cap, 0.0), cap.contact_part, 1e-12);
  // A wedge that opens by 2θ: a gap g is g/sin 2θ beside the line, g/(a sin θ cos θ) of the contact, to the first order.
  const theory::Cap flat = theory::doublet(0.2, 1.0);
  EXPECT_NEAR(theory::part_nearer_than(flat, 1e-4) / flat.contact_part - 1.0,
              1e-4 / (flat.contact_radius * std::sin(flat.angle) * std::cos(flat.angle)), 2e-6);
}

TEST(Theory, OfSpreadingIsItsTable) {
  const SeriesTable t = table("spreading", "spreading_equilibrium.csv");
  const auto at = [&](const char* name, std::size_t i) { return t.find(name)->values[i]; };
  for (std::size_t i = 0; i < t.rows(); ++i) {
    const theory::Cap cap = theory::on_plane(at("W_over_T", i), 1.0);
    EXPECT_NEAR(180.0 - cap.angle / kDegree, at("contact_angle_deg", i), 5.1e-3);  // the table's angle is the one inside the cell
    EXPECT_NEAR(cap.contact_radius, at("contact_radius_over_R0", i), 5.1e-6);
    EXPECT_NEAR(cap.height, at("height_over_R0", i), 5.1e-6);
    EXPECT_NEAR(cap.pressure, at("pressure_times_R0_over_T", i), 5.1e-6);
  }
}

TEST(Theory, OfTheStretcherIsItsTable) {
  const SeriesTable t = table("optical_stretcher", "stretcher_small_strain.csv");
  const auto at = [&](const char* name, std::size_t i) { return t.find(name)->values[i]; };
  ASSERT_GT(t.rows(), 30u);
  for (std::size_t i = 0; i < t.rows(); ++i) {
    const theory::Stretch s =
        theory::stretched_sphere(1e-3 * at("peak_stress_Pa", i), 6.0, 0.2, at("poisson_2d", i), 1e3 * at("active_tension_N_per_m", i), 2.5);
    EXPECT_NEAR(s.axial, at("axial_strain", i), 1e-5);
    EXPECT_NEAR(s.transverse, at("transverse_strain", i), 1e-5);
  }
}

TEST(Theory, OfThePressedDropBalancesItsEquator) {  // a cut at the equator: F = p π b² − 2π b γ
  for (const double height : {1.9, 1.5, 1.0, 0.5}) {
    const theory::PressedDrop d = theory::pressed_drop(height);
    EXPECT_NEAR(d.force, std::numbers::pi * d.equator * (d.pressure * d.equator - 2.0), 1e-9) << height;
  }
}

TEST(Theory, OfThePressedDropEndsInASphereAndInAPancake) {
  EXPECT_NEAR(theory::pressed_drop(2.0).force, 0.0, 1e-12);
  EXPECT_LT(theory::pressed_drop(1.999).force, 0.02);
  // Flat: rims are half circles of radius h/2, p = γ (2/h + about 1/b), b from the volume; the curvature of the rim in plan is the smaller.
  const double h = 0.1;
  const theory::PressedDrop flat = theory::pressed_drop(h);
  EXPECT_NEAR(flat.equator, std::sqrt(4.0 / (3.0 * h)), 0.02 * flat.equator);
  EXPECT_NEAR(flat.pressure, 2.0 / h + 1.0 / flat.equator, 0.02 * flat.pressure);
}

/// dE/dh = −F at held volume: the energy γ A of the drop found from its own profile.
TEST(Theory, OfThePressedDropDoesTheWorkOfItsSurface) {
  // A = ∮: by the virial of a closed surface under tension and pressure with plates at ±h/2: 3 p V − 2 γ A = F h
  const auto area = [](double h) {
    const theory::PressedDrop d = theory::pressed_drop(h);
    return 0.5 * (3.0 * d.pressure * 4.0 / 3.0 * std::numbers::pi - d.force * h);
  };
  for (const double h : {1.8, 1.4, 1.0}) {
    const double slope = (area(h + 1e-3) - area(h - 1e-3)) / 2e-3;
    EXPECT_NEAR(-slope, theory::pressed_drop(h).force, 2e-4) << h;
  }
}

TEST(Theory, OfMaugisGoesFromDmtToJkr) {  // dcm.md T7.1
  const double table[][2] = {{0.01, 1.998}, {0.1, 1.951}, {0.5, 1.718}, {1.0, 1.601}, {2.0, 1.535}, {5.0, 1.506}};
  for (const auto& [lambda, pull] : table) EXPECT_NEAR(theory::maugis_pull_off(lambda), pull, 6e-4) << lambda;
}

/// Computed independently (radius 6 µm); with a pipette that is thin against the cell, 2γ (1/Rp − 1/R).
TEST(CriticalAspiration, IsThatOfAHemisphere) {
  EXPECT_NEAR(theory::critical_aspiration(0.1, 2.5, 6.0), 0.046326, 1e-6);
  EXPECT_NEAR(theory::critical_aspiration(0.1, 4.0, 6.0), 0.015460, 1e-6);
  EXPECT_NEAR(theory::critical_aspiration(0.4, 2.0, 6.0), 0.265943, 1e-6);
  EXPECT_NEAR(theory::critical_aspiration(1.0, 0.01, 6.0), 2.0 * (100.0 - 1.0 / 6.0), 1e-6);
}

}  // namespace
}  // namespace morula::scenarios
