#pragma once
#include <filesystem>
#include <string>

#include "core/result.h"

namespace morula {

/// The bytes of a file of a surface. Errors (kFile): missing, a folder, unreadable, empty.
Result<std::string> read_surface_bytes(const std::filesystem::path& file);

}  // namespace morula
