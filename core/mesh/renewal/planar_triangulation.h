#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/topology.h"
#include "core/result.h"

namespace morula {

/// A point of a plane [µm].
struct PlanePoint {
  double u = 0.0, v = 0.0;
};

/// Constrained Delaunay triangulation of the inside of a simple polygon and of points inside it.
///
/// Ears are clipped first, the best shaped one each time, so that inside and outside are never asked of triangles: a rim that runs
/// straight, where triangles on the line would have no area, is no special case. Points are then put in one by one, and edges turned where
/// the circle through one triangle holds the opposite corner of the other (Lawson 1977). The polygon's sides are never turned. A function
/// of its arguments alone; O(n³) in the corners of the polygon with a small factor (0.1 ms for 35).
class PlanarTriangulation {
 public:
  /// `polygon` counter-clockwise, its points 0 to n − 1. Error (kPhysics): the line crosses itself or encloses nothing.
  static Result<PlanarTriangulation> of_polygon(std::vector<PlanePoint> polygon);

  /// Put a point in; it gets the next number. Points outside of the polygon are left out (false).
  bool insert(const PlanePoint& point);

  [[nodiscard]] std::span<const PlanePoint> points() const { return points_; }
  /// Counter-clockwise.
  [[nodiscard]] std::vector<Triangle> triangles() const;

 private:
  struct Cell {
    std::array<std::uint32_t, 3> corner;
    std::array<std::uint32_t, 3> beyond;  ///< neighbour across the side opposite to each corner, or kNone
  };
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  bool clip_ears(std::uint32_t count);
  void link_cells();
  void relink(std::uint32_t cell, std::uint32_t from, std::uint32_t to);
  [[nodiscard]] bool should_turn(std::uint32_t cell, std::size_t side) const;
  void turn(std::uint32_t cell, std::size_t side);
  void make_delaunay(std::vector<std::uint32_t> cells);
  [[nodiscard]] double twice_area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

  std::vector<PlanePoint> points_;
  std::vector<Cell> cells_;
  double rounding_ = 0.0;  ///< twice an area below which a triangle counts as flat [µm²]
};

}  // namespace morula
