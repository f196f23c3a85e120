#pragma once
#include <vector>

namespace morula {

/// The cells as the balls of their volumes, which is what the laws of spheres know of them (decision 0050), in the order of BodyValues.
///
/// A shell counts as the sphere that it would be at its place once its radius has eased: at its centroid, with its target volume.
struct AsBalls {
  /// The most of: overlap or area of a contact over what its law is for (cbm::part_of_range), and φ over the end of the calibrated range of the
  /// type's packing curve, where it has one. 1: at the end of the range.
  std::vector<double> outside_law;
  std::vector<double> packing;  ///< φ = Σ v_cap/V of the ball, of contacts with other balls and obstacles
  std::vector<double> caps;     ///< of the ball behind the planes of its contacts with other balls and obstacles: φ V [µm³]
};

}  // namespace morula
