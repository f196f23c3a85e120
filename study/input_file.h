#pragma once
#include <filesystem>
#include <string>

#include "study/diagnostics.h"

namespace morula::scenarios {

/// Whether a file that a study names can be read at all: it is there, a regular file (a pipe or device could hold us up for ever) and not larger than
/// `max_bytes`. Else E601, E602 or E603 at `place`.
bool check_input_file(const std::filesystem::path& path, const std::string& shown_name, std::uintmax_t max_bytes, const Place& place,
                      Diagnostics& diagnostics);

}  // namespace morula::scenarios
