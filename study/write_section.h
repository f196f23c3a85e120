#pragma once
#include <string>

#include "coupling/laws.h"
#include "study/draft.h"

namespace morula::scenarios {

/// The study as YAML with every default written out, in the order of the declarations. Values stand as the user (or the declaration) wrote
/// them, so that reading this text gives the same study bit for bit. Defaults are marked by a comment.
std::string write_study(draft::Study& study, const Laws& laws);

}  // namespace morula::scenarios
