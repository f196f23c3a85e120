#pragma once
#include <string>
#include <utility>
#include <vector>

namespace morula::scenarios {

/// What this program was built from and with: written into run.json, printed by `doctor`.
struct BuildInfo {
  std::string version;                                         ///< of Morula, as `0.1.0`
  std::string git_hash;                                        ///< commit at configuration, or `unknown`
  std::string compiler;                                        ///< name and version
  std::string build_type;                                      ///< as given to CMake, with the target processor
  std::string licence;                                         ///< of the program as it was linked, for people
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version in use
};

[[nodiscard]] BuildInfo build_info();

}  // namespace morula::scenarios
