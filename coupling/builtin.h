#pragma once
#include <vector>

#include "core/law_info.h"

namespace morula {

/// What acts between surfaces in contact, as the law reference describes it: the traction, and the adhesion and friction of a pair.
std::vector<LawInfo> surface_contact_laws();

/// Loads from outside as the law reference describes them, by the names of their kinds in a study; their functions are in coupling/loads.h.
std::vector<LawInfo> load_laws();

}  // namespace morula
