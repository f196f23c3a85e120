#include "coupling/behaviours/division_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/numbers/principal_axis.h"
#include "core/random/philox.h"
#include "coupling/behaviours/draw.h"
#include "coupling/cells.h"
#include "coupling/model.h"

namespace morula {
namespace {

constexpr double kTiltOfAttempt = 0.2;  // [rad]
constexpr double kLeastShare = 0.1;

std::shared_ptr<const DivisionAxis> make_axis(DivisionAxis axis) { return std::make_shared<const DivisionAxis>(std::move(axis)); }

/// The longest axis of a surface; zero where the two largest moments differ by less than two parts in a hundred.
Vec3d longest_axis(const SurfaceView& surface) {
  constexpr double kRound = 0.02;
  SymMat3<double> m = second_moments(surface.position, surface.topology->faces());
  const Vec3d u = largest_eigenvector(m);
  const double largest = dot(u, m * u);
  m += -largest * outer(1.0, u);
  const Vec3d v = largest_eigenvector(m);
  return dot(v, m * v) > (1.0 - kRound) * largest ? Vec3d{} : u;
}

/// What is left of a direction across an axis.
Vec3d across(const Vec3d& axis, const Vec3d& direction) {
  const double length2 = norm2(axis);
  return length2 > 0.0 ? direction - axis * (dot(axis, direction) / length2) : Vec3d{};
}

std::shared_ptr<const DivisionAxis> long_axis() {
  return make_axis({.info = {.name = "long",
                             .title = "Along the longest axis of a shell",
                             .equation = "u: eigenvector of the largest eigenvalue of Σ_T A_T (x_T − x̄)(x_T − x̄)ᵀ",
                             .source = "Hertwig 1884; Minc, Burgess & Chang 2011, doi:10.1016/j.cell.2011.01.016",
                             .parameters = {}},
                    .needs_shell = true,
                    .of = [](const CellAtDivision& cell, const Vec3d& random) {
                      const Vec3d axis = cell.surface.topology != nullptr ? longest_axis(cell.surface) : Vec3d{};
                      return dot(axis, random) < 0.0 ? -axis : axis;  // either end
                    }});
}

std::shared_ptr<const DivisionAxis> fixed_axis() {
  return make_axis({.info = {.name = "fixed",
                             .title = "Along a direction of the laboratory",
                             .equation = "u = direction",
                             .source = "choice of this project",
                             .parameters = {given_by_study("direction", "direction", "1", "Of the axis.")}},
                    .needs_direction = true,
                    .of = [](const CellAtDivision& cell, const Vec3d&) { return cell.type.division_direction; }});
}

std::shared_ptr<const DivisionAxis> across_direction_axis() {
  return make_axis({.info = {.name = "across_direction",
                             .title = "Across a direction of the laboratory: within a layer whose normal it is",
                             .equation = "u = (I − n nᵀ/n²) r, n = direction, r uniform on the sphere",
                             .source = "choice of this project",
                             .parameters = {given_by_study("direction", "direction", "1", "Normal of the layer.")}},
                    .needs_direction = true,
                    .of = [](const CellAtDivision& cell, const Vec3d& random) { return across(cell.type.division_direction, random); }});
}

std::shared_ptr<const DivisionAxis> polarity_axis() {
  return make_axis({.info = {.name = "polarity",
                             .title = "Along the polarity of the cell",
                             .equation = "u = P",
                             .source = "choice of this project",
                             .parameters = {}},
                    .needs_polarity = true,
                    .of = [](const CellAtDivision& cell, const Vec3d&) { return cell.row.polarity; }});
}

std::shared_ptr<const DivisionAxis> across_polarity_axis() {
  return make_axis({.info = {.name = "across_polarity",
                             .title = "Across the polarity of the cell: its daughters lie side by side",
                             .equation = "u = (I − P Pᵀ/P²) r, r uniform on the sphere",
                             .source = "choice of this project",
                             .parameters = {}},
                    .needs_polarity = true,
                    .of = [](const CellAtDivision& cell, const Vec3d& random) { return across(cell.row.polarity, random); }});
}

/// A unit vector turned by an angle with this cosine, to the side that `turn` (0 to 1) says.
Vec3d tilted(const Vec3d& axis, double cosine, double turn) {
  Vec3d first, second;
  frame_about(axis, first, second);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), phi = 2.0 * std::numbers::pi * turn;
  return normalized(axis * cosine + first * (sine * std::cos(phi)) + second * (sine * std::sin(phi)));
}

}  // namespace

std::shared_ptr<const DivisionAxis> random_axis() {
  static const auto axis = make_axis({.info = {.name = "random",
                                               .title = "Any direction, uniform on the sphere",
                                               .equation = "u = r, r uniform on the sphere",
                                               .source = "Van Liedekerke et al.",
                                               .parameters = {}},
                                      .of = [](const CellAtDivision&, const Vec3d& random) { return random; }});
  return axis;
}

std::vector<std::shared_ptr<const DivisionAxis>> builtin_division_axes() {
  return {random_axis(), long_axis(), fixed_axis(), across_direction_axis(), polarity_axis(), across_polarity_axis()};
}

Vec3d division_axis(const CellAtDivision& cell, std::uint32_t seed, std::uint64_t attempt) {
  const CellState& row = cell.row;
  const Vec3d random = Random(seed, RandomStream::kDivisionAxis).direction(row.id, row.draws + attempt);
  const Vec3d chosen = cell.type.axis->of(cell, random);
  if (!(norm2(chosen) > 0.0) || chosen == random) return random;
  const double spread = cell.type.axis_spread + kTiltOfAttempt * static_cast<double>(attempt);
  if (!(spread > 0.0)) return normalized(chosen);
  const auto [u, turn] = Random(seed, RandomStream::kDivisionTilt).uniform(row.id, row.draws + attempt);
  const double kappa = 1.0 / (spread * spread);
  return tilted(normalized(chosen), 1.0 + std::log(u + (1.0 - u) * std::exp(-2.0 * kappa)) / kappa, turn);
}

double division_share(const CellAtDivision& cell, std::uint32_t seed) {
  std::uint64_t index = 0;
  const double drawn = draw_truncated(cell.type.division_share, Random(seed, RandomStream::kDivisionShare), cell.row.id, index);
  return std::clamp(drawn, kLeastShare, 1.0 - kLeastShare);
}

}  // namespace morula
