#pragma once
#include <filesystem>

#include "core/parallel/comm.h"
#include "core/result.h"

namespace morula::scenarios {

/// Collective. Takes a file whose content stops its writer out of the way, with its journal: `results.h5` becomes `results.damaged-1.h5`, or the
/// next number that is free. Returns the new name; empty where nothing was done, because there is no such file or it is not its content that is
/// in the way (a link, a folder, no permission). kFile or kResources when it cannot be renamed.
Result<std::filesystem::path> set_aside(const std::filesystem::path& path, const Comm& comm);

}  // namespace morula::scenarios
