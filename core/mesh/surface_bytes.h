#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/result.h"

namespace morula {

/// The largest file of a surface that is read [bytes]: some ten million faces, and few enough that their number and that of the nodes fit 32 bits.
inline constexpr std::uintmax_t kMaxSurfaceBytes = std::uintmax_t{1} << 30;

/// The bytes of a file of a surface. Errors (kFile): missing, no regular file (a folder, pipe or device: never waited for), larger than
/// kMaxSurfaceBytes, unreadable, empty.
Result<std::string> read_surface_bytes(const std::filesystem::path& file);

}  // namespace morula
