#pragma once

namespace morula {

/// Interior quadrature points of a face: barycentric weights; every point stands for the same part of the area.
struct FaceQuadrature {
  int count;
  double weight[4][3];

  /// 3 points at (2/3, 1/6, 1/6), or 4 centroids of the four sub-triangles.
  static const FaceQuadrature& with_points(int points) noexcept {
    static constexpr double a = 2.0 / 3.0, b = 1.0 / 6.0, c = 1.0 / 3.0;
    static constexpr FaceQuadrature three{3, {{a, b, b}, {b, a, b}, {b, b, a}, {c, c, c}}};
    static constexpr FaceQuadrature four{4, {{a, b, b}, {b, a, b}, {b, b, a}, {c, c, c}}};
    return points == 4 ? four : three;
  }
};

}  // namespace morula
