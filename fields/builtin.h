#pragma once
#include <memory>
#include <vector>

#include "core/law_info.h"
#include "fields/reaction.h"

namespace morula::fields {

/// The laws of concentrations that are no reactions, as the law reference describes them.
std::vector<LawInfo> field_laws();

/// The reactions that Morula brings, each in a file of fields/reactions/.
std::vector<std::shared_ptr<const Reaction>> builtin_reactions();

}  // namespace morula::fields
