// In the place of isotropic_remeshing.cpp in a build without code under the GPL (MORULA_WITH_GPL=OFF).
#include "core/mesh/isotropic_remeshing.h"

namespace morula {

bool has_isotropic_remeshing() { return false; }

std::optional<TriangleMesh> isotropic_remeshing(const TriangleMesh&, double, int) { return std::nullopt; }

}  // namespace morula
