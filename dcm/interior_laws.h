#pragma once
#include <vector>

#include "core/law_info.h"

namespace morula::dcm {

/// The laws of what is inside a shell: nucleus and cytoskeleton (interior.h). The law reference and `morula explain` walk this list.
std::vector<LawInfo> interior_laws();

}  // namespace morula::dcm
