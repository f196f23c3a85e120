#include "coupling/surface_law.h"

#include <cmath>
#include <numbers>

#include "core/numbers/number_text.h"

namespace morula {
namespace {

/// Part of the range over which a traction that jumps in theory rises or falls.
constexpr double kFlank = 0.1;

SurfaceTraction with_repulsion(const LawValues& v) {
  SurfaceTraction law;
  law.adhesion = v("adhesion"), law.range = v("range"), law.repulsion = v("repulsion");
  return law;
}

std::vector<LawParameter> range_and_repulsion() {
  return {given_by_study("range", "length", "µm", "Range c of the attraction."),
          given_by_study("repulsion", "pressure per length", "kPa/µm", "Stiffness k_r of the repulsion.")};
}

KeySpec modulus() {
  return {.name = "modulus",
          .doc = "Reduced modulus E* of what lies behind both surfaces, 1/E* = sum of (1 - nu^2)/E; for maugis_dugdale.",
          .quantity = Quantity::kPressure,
          .low = 0.0,
          .high = 1e6,
          .low_open = true,
          .example = "20 kPa"};
}

SurfaceTraction build_maugis(const LawValues& v) {
  SurfaceTraction law = with_repulsion(v);
  law.coefficient = {kFlank, 1.0 - kFlank, v("modulus") * std::sqrt(v("curvature")) / std::numbers::pi};
  return law;
}

SurfaceTraction build_falling(const LawValues& v) {
  SurfaceTraction law = with_repulsion(v);
  law.coefficient = {kFlank, kFlank, 0.0};
  return law;
}

/// Contact bears the pressure p of a cell: an elastic repulsion gives way by (π √R p/E*)² (decision 0018).
std::optional<LawProblem> judge_maugis(const LawValues& v) {
  const double curvature = v("curvature"), pressure = v("pressure"), modulus = v("modulus");
  const double least = std::numbers::pi * pressure / std::sqrt(curvature * v("overlap"));
  if (modulus >= least) return std::nullopt;
  const double depth = std::pow(std::numbers::pi * pressure / modulus, 2) / curvature;
  return LawProblem{517, "modulus",
                    "cells under their own pressure sink into each other by about " +
                        number_text("%.6g", std::round(depth * 100.0) / 100.0) + " um: modulus {} is that of soft bodies",
                    "at least " + number_text("%.6g", std::ceil(least * 10.0) / 10.0) + " kPa keeps the overlap below `limits.overlap`"};
}

}  // namespace

std::shared_ptr<const SurfaceLaw> tent_law() {
  static const auto law = std::make_shared<const SurfaceLaw>(SurfaceLaw{
      .info = {.name = "traction",
               .title = "Traction that rises and falls",
               .equation = "U(g) per area: −W + ½ω g² (g < c/2), −½ω (c − g)² (g < c), ω = 4W/c²; for g < 0 instead −W + ½ k_r g²",
               .source = "choice of this project: the work of separation is exactly W; integrated over each face",
               .parameters = range_and_repulsion()},
      .word = "traction",
      .doc = "rises to the middle of the range and falls again",
      .build = &with_repulsion});
  return law;
}

std::shared_ptr<const SurfaceLaw> maugis_dugdale_law() {
  static const auto law = std::make_shared<const SurfaceLaw>(SurfaceLaw{
      .info = {.name = "maugis_dugdale",
               .title = "Constant adhesive stress, elastic repulsion",
               .equation =
                   "σ = W/(0.9 c) (0.1 c < g < 0.9 c), linear to 0 at g = 0 and g = c; p = E*/(π √R) √|g| (g < 0), 1/R = 1/R_a + 1/R_b",
               .source = "Odenthal et al. 2013, doi:10.1371/journal.pcbi.1003267, as a local traction (decision 0018); Maugis 1992, "
                         "doi:10.1016/0021-9797(92)90285-T",
               .parameters = {given_by_study("range", "length", "µm", "Range c of the attraction."),
                              given_by_study("modulus", "pressure", "kPa", "Reduced modulus E* of what lies behind both surfaces.")},
               .keys = {{"contact.pairs[]", modulus()}}},
      .word = "maugis_dugdale",
      .doc = "constant over the range (but for a tenth at each end), with the repulsion of two elastic bodies",
      .own = {modulus()},
      .has_repulsion = false,
      .build = &build_maugis,
      .judge = &judge_maugis});
  return law;
}

std::shared_ptr<const SurfaceLaw> falling_law() {
  static const auto law = std::make_shared<const SurfaceLaw>(
      SurfaceLaw{.info = {.name = "falling",
                          .title = "Traction that falls from contact",
                          .equation = "σ = 2W/c · (c − g)/(0.9 c) (0.1 c < g < c), linear to 0 at g = 0; p = k_r |g| (g < 0)",
                          .source = "after Cuvelier et al. 2023: W and a short range instead of a pressure by curvature (decision 0018)",
                          .parameters = range_and_repulsion()},
                 .word = "falling",
                 .doc = "highest at contact, falls over the range",
                 .build = &build_falling});
  return law;
}

std::vector<std::shared_ptr<const SurfaceLaw>> surface_laws() { return {tent_law(), maugis_dugdale_law(), falling_law()}; }

}  // namespace morula
