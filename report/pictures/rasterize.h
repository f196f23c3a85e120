#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "report/pictures/camera.h"

namespace morula::scenarios {

/// What is seen through each pixel.
struct PixelBuffer {
  static constexpr std::int32_t kNothing = -1;
  static constexpr std::uint32_t kNoFace = ~std::uint32_t{0};

  int width = 0, height = 0;
  std::vector<float> depth;                      ///< towards the eye; −infinity where nothing is seen [µm]
  std::vector<std::int32_t> surface;             ///< 2 × cell number, + 1 on a cut face; nuclei are numbered after the cells; kNothing
  std::vector<std::int16_t> normal_x, normal_y;  ///< of the unit normal in the view frame × 32767 (its z is positive)
  std::vector<std::uint32_t> face;               ///< that is seen, among those of all shells; kNoFace on spheres and where cells are cut

  PixelBuffer(int width_, int height_);
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  void put(std::size_t i, float depth_um, std::int32_t surface_, const Vec3d& normal, std::uint32_t face_ = kNoFace) {
    depth[i] = depth_um;
    surface[i] = surface_;
    normal_x[i] = static_cast<std::int16_t>(normal.x * 32767.0);
    normal_y[i] = static_cast<std::int16_t>(normal.y * 32767.0);
    face[i] = face_;
  }
};

/// Draw all cells of the snapshot as the camera sees them: spheres exact in each pixel, shells with normals interpolated over their
/// faces, the nearest surface wins.
///
/// With a cut plane, what lies on the side of its normal is removed and the faces of the cut are closed: each pixel of the plane
/// belongs to the shell whose cross-section covers it, else to the sphere with the smallest power distance |x − c|² − R², if that is
/// negative; two overlapping spheres meet in a straight line (the radical plane, Aurenhammer 1987, doi:10.1137/0216006).
/// A nucleus is seen where the plane cuts it and its cell. The plane's normal must point towards the eye.
///
/// The result does not depend on the number of threads.
void rasterize(const Snapshot& snapshot, const Camera& camera, const std::optional<CutPlane>& cut, PixelBuffer& pixels);

}  // namespace morula::scenarios
