#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "results/checkpoint.h"

namespace morula::scenarios {

/// Collective. Writes the next `cp_NNNNNN.h5` into the folder (made if missing) and then removes all but the two newest. Returns its path.
Result<std::filesystem::path> save_checkpoint(const std::filesystem::path& folder, const Tissue& tissue, const CheckpointInfo& info,
                                              const Comm& comm);

/// The checkpoints in a folder, newest first.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& folder);

struct RestoredCheckpoint {
  LoadedCheckpoint checkpoint;
  std::filesystem::path path;
  std::vector<std::string> warnings;             ///< which newer ones were damaged and what is used in their stead
  std::vector<std::filesystem::path> damaged{};  ///< those newer ones
};

/// Collective. Loads the newest checkpoint that is whole. A damaged one is passed over, and a warning says so. One of another
/// format version is refused. kFile when there is none that can be used.
Result<RestoredCheckpoint> load_newest_checkpoint(const std::filesystem::path& folder, const Model& model, ShapeLibrary& shapes,
                                                  const Comm& comm);

/// Collective. The path of the newest whole checkpoint and the warnings, without loading it.
struct GoodCheckpoint {
  std::filesystem::path path;
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> damaged{};
};
Result<GoodCheckpoint> newest_good_checkpoint(const std::filesystem::path& folder, const Comm& comm);

}  // namespace morula::scenarios
