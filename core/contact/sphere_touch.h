#pragma once
#include <cstdint>
#include <span>

#include "core/contact/surface_pair.h"

namespace morula {

/// Of the forces of one pair on a surface, Σ (x − center) ⊗ f: at these of its nodes, and of energies by area, which are tensions [nN·µm].
[[nodiscard]] SymMat3<double> virial_about(const Vec3d& center, const PairBody& surface, std::span<const std::uint16_t> nodes,
                                           const PairGradient& gradient);

}  // namespace morula
