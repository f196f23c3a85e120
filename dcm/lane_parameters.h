#pragma once
#include <array>
#include <cmath>
#include <span>

#include "core/mesh/lane_surface.h"
#include "dcm/shells.h"

namespace morula::dcm {

/// A number of every lane: `get(shell)` for the shell in each lane.
template <class T, int W, class Get>
Lane<T, W> by_lane(const LaneBlock& block, const Get& get) {
  Lane<T, W> out(T(0));
  for (int lane = 0; lane < W; ++lane) out.set(lane, static_cast<T>(get(block.member[lane])));
  return out;
}

/// A parameter of every lane, from the type of the shell in it.
template <class T, int W>
Lane<T, W> parameter(const LaneBlock& block, const Shells& shells, const ShellMaterials& materials, double ShellParameters::*member) {
  return by_lane<T, W>(block, [&](std::uint32_t shell) { return materials.of(shells, shell).*member; });
}

/// Whether any shell of a block has this law.
template <int W>
bool any_has(const LaneBlock& block, const Shells& shells, const ShellMaterials& materials, double ShellParameters::*strength) {
  for (int lane = 0; lane < W; ++lane)
    if (materials.of(shells, block.member[lane]).*strength > 0.0) return true;
  return false;
}

/// 1 of shells with a law of the strain of faces, 0 of those without, whose rest lengths may form no triangle: a loop that takes all lanes alike strains
/// these by nothing (rest_squares()), or what is not a number would come through a strength of zero.
template <class T, int W>
Lane<T, W> strained_lanes(const LaneBlock& block, const Shells& shells, const ShellMaterials& materials) {
  return by_lane<T, W>(block, [&](std::uint32_t shell) { return strains_faces(materials.of(shells, shell)) ? 1.0 : 0.0; });
}

/// An array of the reference shapes as lanes; read once when all shells of the block share one shape.
template <class T, int W>
class ShapeArray {
 public:
  ShapeArray(const LaneBlock& block, const Shells& shells, std::vector<double> ReferenceShape::*member) {
    for (int lane = 0; lane < W; ++lane) {
      array_[lane] = (shells.shape[block.member[lane]].get()->*member).data();
      same_ = same_ && array_[lane] == array_[0];
    }
  }
  Lane<T, W> operator[](std::size_t i) const noexcept {
    if (same_) return Lane<T, W>(static_cast<T>(array_[0][i]));
    Lane<T, W> out(T(0));
    for (int lane = 0; lane < W; ++lane) out.set(lane, static_cast<T>(array_[lane][i]));
    return out;
  }

 private:
  std::array<const double*, W> array_{};
  bool same_ = true;
};

}  // namespace morula::dcm
