#pragma once
#include <filesystem>
#include <vector>

#include "core/result.h"
#include "report/pictures/image.h"

namespace morula::scenarios {

/// The image as the bytes of a PNG file (8-bit RGB, no time stamp: the same image gives the same bytes).
Result<std::vector<std::uint8_t>> encode_png(const Image& image);

/// The bytes of encode_png() to a file.
Status write_png(const std::vector<std::uint8_t>& png, const std::filesystem::path& path);

}  // namespace morula::scenarios
