#pragma once
#include "core/vec3.h"

namespace morula {

/// How far a body is from the balance of its forces with what stands outside the tissue.
struct OutsideBalance {
  Vec3d missing;               ///< Σ b − Σ C v over its points: forces less what the outside resists [nN]
  SymMat3<double> resistance;  ///< Σ C: friction with the medium; friction of obstacles; Δt times stiffness of what holds it [nN·s/µm]
};

}  // namespace morula
