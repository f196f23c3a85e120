#pragma once
#include <vector>

#include "core/law_info.h"

namespace morula::fields {

/// The laws of concentrations as the law reference describes them.
std::vector<LawInfo> field_laws();

}  // namespace morula::fields
