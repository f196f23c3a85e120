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
constexpr double kRound = 0.02;  // difference of the two largest moments, as a part, below which no axis is the longest

std::shared_ptr<const DivisionAxis> make_axis(DivisionAxis axis) { return std::make_shared<const DivisionAxis>(std::move(axis)); }

/// What is left of a direction across an axis.
Vec3d across(const Vec3d& axis, const Vec3d& direction) {
  const double length2 = norm2(axis);
  return length2 > 0.0 ? direction - axis * (dot(axis, direction) / length2) : Vec3d{};
}

/// The longest axis of something with these moments; of a disc any that lies in it, of a ball none.
Vec3d longest_axis(const SymMat3<double>& moments, const Vec3d& random) {
  const PrincipalAxes axes(moments);
  const auto are_alike = [&](int k, int l) { return axes.moment[l] > (1.0 - kRound) * axes.moment[k]; };
  if (!are_alike(0, 1)) return dot(axes.axis[0], random) < 0.0 ? -axes.axis[0] : axes.axis[0];  // either end
  return are_alike(0, 2) ? Vec3d{} : across(axes.axis[2], random);
}

std::shared_ptr<const DivisionAxis> long_axis() {
  return make_axis({.info = {.name = "long",
                             .title = "Along the longest axis of a shell; of a sphere, of its place among those that it touches",
                             .equation = "u: eigenvector of the largest eigenvalue of Σ_T A_T (x_T − x̄)(x_T − x̄)ᵀ; of a sphere of "
                                         "Σ_j (x_j − x)(x_j − x)ᵀ; where the two largest differ by less than 2 %, "
                                         "any across the third; none where all three are alike",
                             .source = "Hertwig 1884; Minc, Burgess & Chang 2011, doi:10.1016/j.cell.2011.01.016; of spheres choice of "
                                       "this project",
                             .parameters = {}},
                    .spheres_look_at_neighbours = true,
                    .of = [](const CellAtDivision& cell, const Vec3d& random) {
                      if (cell.surface.topology != nullptr)
                        return longest_axis(second_moments(cell.surface.position, cell.surface.topology->faces()), random);
                      SymMat3<double> moments;
                      for (const Vec3d& d : cell.around.neighbours) moments += outer(1.0, d);
                      return cell.around.neighbours.empty() ? Vec3d{} : longest_axis(moments, random);
                    }});
}

OwnKey direction_key() {
  return {OwnKey::Kind::kDirection,
          {.name = "direction", .doc = "Direction of the axes `fixed` and `across_direction`.", .required = true, .example = "[0, 0, 1]"}};
}

std::shared_ptr<const DivisionAxis> fixed_axis() {
  return make_axis({.info = {.name = "fixed",
                             .title = "Along a direction of the laboratory",
                             .equation = "u = direction",
                             .source = "choice of this project",
                             .parameters = {}},
                    .keys = {direction_key()},
                    .of = [](const CellAtDivision& cell, const Vec3d&) { return cell.type.axis_own.vector("direction"); }});
}

std::shared_ptr<const DivisionAxis> across_direction_axis() {
  return make_axis(
      {.info = {.name = "across_direction",
                .title = "Across a direction of the laboratory: within a layer whose normal it is",
                .equation = "u = (I − n nᵀ/n²) r, n = direction, r uniform on the sphere",
                .source = "choice of this project",
                .parameters = {}},
       .keys = {direction_key()},
       .of = [](const CellAtDivision& cell, const Vec3d& random) { return across(cell.type.axis_own.vector("direction"), random); }});
}

std::shared_ptr<const DivisionAxis> along_surface_axis() {
  return make_axis({.info = {.name = "along_surface",
                             .title = "Along the tissue's surface, of cells that lie at it; of others, and of single cells, random",
                             .equation = "u = (I − n nᵀ) r, n: middle of the directions in which the cell lies at the surface (region "
                                         "`surface`), r uniform on the sphere",
                             .source = "choice of this project; empty cones: Marrone et al. 2010, doi:10.1016/j.jcp.2010.01.019",
                             .parameters = {}},
                    .looks_at_surface = true,
                    .of = [](const CellAtDivision& cell, const Vec3d& random) { return across(cell.around.surface_normal, random); }});
}

std::shared_ptr<const DivisionAxis> along_geometry_axis() {
  return make_axis(
      {.info = {.name = "along_geometry",
                .title = "Along the surface of an obstacle, where it is nearest to the cell's centre",
                .equation = "u = (I − n nᵀ/n²) r, n = s − x, s the nearest point of the obstacle's surface, r uniform on the sphere",
                .source = "choice of this project",
                .parameters = {}},
       .keys = {{OwnKey::Kind::kObstacle,
                 {.name = "geometry", .doc = "Of the axis `along_geometry`: the obstacle.", .required = true, .example = "plate"}}},
       .of = [](const CellAtDivision& cell, const Vec3d& random) { return across(cell.around.to_geometry, random); }});
}

std::shared_ptr<const DivisionAxis> gradient_axis() {
  return make_axis({.info = {.name = "gradient",
                             .title = "Along the gradient of a field",
                             .equation = "u = ∇c, over six points a radius away from the cell's centre",
                             .source = "choice of this project",
                             .parameters = {}},
                    .keys = {{OwnKey::Kind::kField,
                              {.name = "field", .doc = "Of the axis `gradient`: the field.", .required = true, .example = "oxygen"}}},
                    .of = [](const CellAtDivision& cell, const Vec3d&) { return cell.around.gradient; }});
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
  return {random_axis(),          long_axis(),          fixed_axis(),          across_direction_axis(), polarity_axis(),
          across_polarity_axis(), along_surface_axis(), along_geometry_axis(), gradient_axis()};
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
