#pragma once
#include <vector>

#include "core/law_info.h"

namespace morula {

/// All behaviours of cells as the law reference describes them; their functions are in the files of this folder.
std::vector<LawInfo> behaviour_laws();

}  // namespace morula
