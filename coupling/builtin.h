#pragma once
#include <vector>

#include "core/law_info.h"

namespace morula {

/// What acts between surfaces in contact beside the law of the traction (coupling/surface_law.h), as the law reference describes it.
std::vector<LawInfo> surface_contact_terms();

/// What acts on surfaces and cells by themselves: regions of tension, cavities, springs, fluctuations, protrusion, directed friction;
/// their functions are in coupling/face_regions.h, lumens.h, protrusion.h and mechanics/.
std::vector<LawInfo> active_laws();

}  // namespace morula
