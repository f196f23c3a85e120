#pragma once
#include <span>
#include <vector>

#include "report/pictures/projection.h"
#include "report/pictures/rasterize.h"

namespace morula::scenarios {

/// The faces that a cut plane leaves on the cells it goes through, and within them on nuclei that are shells.
class CutFaces {
 public:
  CutFaces() = default;
  CutFaces(const Snapshot& snapshot, const Projection& projection, const CutPlane& cut);

  /// Close the cells in the rows [first, last): spheres by power distance, then shells.
  void draw(int first, int last, std::span<const Disc> spheres, const ClipDepth& clip, PixelBuffer& pixels) const;

 private:
  /// Oriented piece of a shell's outline in the plane [px].
  struct Segment {
    double x0, y0, x1, y1;
  };
  struct Outline {
    std::vector<Segment> segments;  ///< closed loops, in no order
    double low_y, high_y;
    std::int32_t surface;
    std::int32_t within = PixelBuffer::kNothing;  ///< of a nucleus: only where this was drawn
  };
  void add_outline(const Snapshot& snapshot, const Snapshot::Shell& shell, std::span<const Vec3d> nodes, const Projection& projection,
                   const CutPlane& cut, Outline outline);
  void fill(const Outline& outline, int first, int last, const ClipDepth& clip, PixelBuffer& pixels) const;

  std::vector<Outline> outlines_;
  Vec3d normal_;  ///< in the view frame
  double pixels_per_um_ = 1.0;
};

}  // namespace morula::scenarios
