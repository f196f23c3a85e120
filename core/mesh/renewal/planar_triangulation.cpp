#include "core/mesh/renewal/planar_triangulation.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace morula {
namespace {

/// Twice an area below which three corners of a polygon count as lying on a line, in units of the rounding error.
constexpr double kFlat = 1e4;

double squared_distance(const PlanePoint& a, const PlanePoint& b) { return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v); }

/// Positive when d lies inside the circle through a, b, c (counter-clockwise); in units of length⁴.
double in_circle(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d) {
  const double au = a.u - d.u, av = a.v - d.v, bu = b.u - d.u, bv = b.v - d.v, cu = c.u - d.u, cv = c.v - d.v;
  const double a2 = au * au + av * av, b2 = bu * bu + bv * bv, c2 = cu * cu + cv * cv;
  return a2 * (bu * cv - cu * bv) - b2 * (au * cv - cu * av) + c2 * (au * bv - bu * av);
}

}  // namespace

double PlanarTriangulation::twice_area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const PlanePoint &p = points_[a], &q = points_[b], &r = points_[c];
  return (q.u - p.u) * (r.v - p.v) - (r.u - p.u) * (q.v - p.v);
}

Result<PlanarTriangulation> PlanarTriangulation::of_polygon(std::vector<PlanePoint> polygon) {
  PlanarTriangulation out;
  out.points_ = std::move(polygon);
  double low_u = 1e300, high_u = -1e300, low_v = 1e300, high_v = -1e300;
  for (const PlanePoint& p : out.points_) {
    low_u = std::min(low_u, p.u), high_u = std::max(high_u, p.u);
    low_v = std::min(low_v, p.v), high_v = std::max(high_v, p.v);
  }
  const double extent = std::max(high_u - low_u, high_v - low_v);
  out.rounding_ = 1e-15 * extent * extent;
  const auto count = static_cast<std::uint32_t>(out.points_.size());
  double enclosed = 0.0;
  for (std::uint32_t k = 2; k < count; ++k) enclosed += out.twice_area(0, k - 1, k);
  if (!(enclosed > kFlat * out.rounding_) || !out.clip_ears(count))
    return Error{ErrorKind::kPhysics, "the line of the cut crosses itself or encloses nothing", "take another plane"};
  out.link_cells();
  std::vector<std::uint32_t> all(out.cells_.size());
  for (std::uint32_t c = 0; c < all.size(); ++c) all[c] = c;
  out.make_delaunay(std::move(all));
  return out;
}

bool PlanarTriangulation::clip_ears(std::uint32_t count) {
  std::vector<std::uint32_t> ring(count);
  for (std::uint32_t n = 0; n < count; ++n) ring[n] = n;
  // Twice the area of the corner at a place of the ring; minus one where another corner lies in it, borders counted as `margin` says.
  const auto ear = [&](std::size_t place, double margin) {
    const std::size_t size = ring.size();
    const std::uint32_t a = ring[(place + size - 1) % size], b = ring[place], c = ring[(place + 1) % size];
    for (const std::uint32_t p : ring)
      if (p != a && p != b && p != c && twice_area(a, b, p) >= margin && twice_area(b, c, p) >= margin && twice_area(c, a, p) >= margin)
        return -1.0;
    return twice_area(a, b, c);
  };
  const auto squares = [&](std::size_t place) {
    const PlanePoint &a = points_[ring[(place + ring.size() - 1) % ring.size()]], &b = points_[ring[place]],
                     &c = points_[ring[(place + 1) % ring.size()]];
    return squared_distance(a, b) + squared_distance(b, c) + squared_distance(c, a);
  };
  while (ring.size() >= 3) {
    std::size_t best = 0;
    double best_quality = 0.0;
    for (std::size_t place = 0; place < ring.size(); ++place)
      if (const double area = ear(place, -rounding_); area > rounding_ && area / squares(place) > best_quality)
        best = place, best_quality = area / squares(place);
    if (!(best_quality > 0.0)) {
      // Rounding may let corners on a straight side stand out by nothing: they are cut off as triangles without area.
      double flattest = kFlat * rounding_;
      for (std::size_t place = 0; place < ring.size(); ++place)
        if (const double area = std::abs(ear(place, kFlat * rounding_)); area <= flattest)
          best = place, best_quality = 1.0, flattest = area;
    }
    if (!(best_quality > 0.0)) return false;
    const std::size_t size = ring.size();
    cells_.push_back({{ring[(best + size - 1) % size], ring[best], ring[(best + 1) % size]}, {kNone, kNone, kNone}});
    if (size == 3) return true;
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return false;
}

void PlanarTriangulation::link_cells() {
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::size_t>> sides;
  for (std::uint32_t c = 0; c < cells_.size(); ++c)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(cells_[c].corner[(k + 1) % 3], cells_[c].corner[(k + 2) % 3]);
      sides.emplace_back(low, high, c, k);
    }
  std::ranges::sort(sides);
  for (std::size_t n = 1; n < sides.size(); ++n) {
    const auto& [low, high, cell, side] = sides[n];
    const auto& [low0, high0, cell0, side0] = sides[n - 1];
    if (low != low0 || high != high0) continue;
    cells_[cell].beyond[side] = cell0;
    cells_[cell0].beyond[side0] = cell;
  }
}

void PlanarTriangulation::relink(std::uint32_t cell, std::uint32_t from, std::uint32_t to) {
  if (cell == kNone) return;
  for (std::uint32_t& neighbour : cells_[cell].beyond)
    if (neighbour == from) {
      neighbour = to;
      return;
    }
}

bool PlanarTriangulation::should_turn(std::uint32_t cell, std::size_t side) const {
  const Cell& here = cells_[cell];
  if (here.beyond[side] == kNone) return false;
  const Cell& there = cells_[here.beyond[side]];
  const std::uint32_t a = here.corner[side], b = here.corner[(side + 1) % 3], c = here.corner[(side + 2) % 3];
  std::uint32_t d = kNone;
  for (const std::uint32_t n : there.corner)
    if (n != b && n != c) d = n;
  const double first = twice_area(a, b, d), second = twice_area(a, d, c);
  if (!(first > rounding_ && second > rounding_)) return false;
  return in_circle(points_[a], points_[b], points_[c], points_[d]) > rounding_ * (std::abs(first) + std::abs(second));
}

/// (a, b, c) and (d, c, b) become (a, b, d) and (a, d, c).
void PlanarTriangulation::turn(std::uint32_t cell, std::size_t side) {
  const std::uint32_t other = cells_[cell].beyond[side];
  const Cell here = cells_[cell], there = cells_[other];
  const std::uint32_t a = here.corner[side], b = here.corner[(side + 1) % 3], c = here.corner[(side + 2) % 3];
  std::size_t apex = 0;
  while (there.corner[apex] == b || there.corner[apex] == c) ++apex;
  const std::uint32_t d = there.corner[apex];
  const std::uint32_t beyond_ca = here.beyond[(side + 1) % 3], beyond_ab = here.beyond[(side + 2) % 3];
  const std::uint32_t beyond_bd = there.beyond[(apex + 1) % 3], beyond_dc = there.beyond[(apex + 2) % 3];
  cells_[cell] = {{a, b, d}, {beyond_bd, other, beyond_ab}};
  cells_[other] = {{a, d, c}, {beyond_dc, beyond_ca, cell}};
  relink(beyond_bd, other, cell);
  relink(beyond_ca, cell, other);
}

void PlanarTriangulation::make_delaunay(std::vector<std::uint32_t> cells) {
  // Turning an edge into the better one of its quadrangle comes to an end; rounding must not keep it going.
  std::size_t left = 100 * points_.size() + 100;
  while (!cells.empty() && left > 0) {
    const std::uint32_t cell = cells.back();
    cells.pop_back();
    for (std::size_t side = 0; side < 3; ++side)
      if (should_turn(cell, side)) {
        const std::uint32_t other = cells_[cell].beyond[side];
        turn(cell, side);
        cells.push_back(other);
        cells.push_back(cell);
        --left;
        break;
      }
  }
}

bool PlanarTriangulation::insert(const PlanePoint& point) {
  points_.push_back(point);
  const auto p = static_cast<std::uint32_t>(points_.size() - 1);
  std::uint32_t found = kNone;
  double deepest = 0.0;
  for (std::uint32_t n = 0; n < cells_.size(); ++n) {
    const auto [a, b, c] = cells_[n].corner;
    const double depth = std::min({twice_area(a, b, p), twice_area(b, c, p), twice_area(c, a, p)});
    if (depth >= 0.0 && (found == kNone || depth > deepest)) found = n, deepest = depth;
  }
  if (found == kNone) {
    points_.pop_back();
    return false;
  }
  const Cell old = cells_[found];
  const auto [a, b, c] = old.corner;
  const auto second = static_cast<std::uint32_t>(cells_.size()), third = second + 1;
  cells_[found] = {{p, b, c}, {old.beyond[0], second, third}};
  cells_.push_back({{p, c, a}, {old.beyond[1], third, found}});
  cells_.push_back({{p, a, b}, {old.beyond[2], found, second}});
  relink(old.beyond[1], found, second);
  relink(old.beyond[2], found, third);
  make_delaunay({found, second, third});
  return true;
}

std::vector<Triangle> PlanarTriangulation::triangles() const {
  std::vector<Triangle> out;
  out.reserve(cells_.size());
  for (const Cell& cell : cells_) out.push_back(cell.corner);
  return out;
}

}  // namespace morula
