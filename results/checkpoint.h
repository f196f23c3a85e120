#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/mesh/topology.h"
#include "core/parallel/comm.h"
#include "core/result.h"
#include "coupling/observables/measures.h"
#include "coupling/tissue.h"
#include "results/hdf5_reader.h"
#include "results/text_lengths.h"

namespace morula::scenarios {

/// Version of the layout of a checkpoint. A file of another version is refused.
inline constexpr std::uint32_t kCheckpointFormat = 7;

/// What a checkpoint holds besides the state.
struct CheckpointInfo {
  std::string run_name;
  std::string study_hash;      ///< SHA-256 of the resolved study
  double wall_time = 0.0;      ///< spent on the run so far [s]
  std::string morula_version;  ///< filled by write_checkpoint
  std::uint32_t warned = 0;    ///< what the run has warned of once and will not again; bits of the run loop
  Interval interval{};         ///< since the last output
  TextLengths texts{};
};

struct LoadedCheckpoint {
  Tissue tissue;
  CheckpointInfo info;
};

/// Collective. The Tissue written down: rows and bodies sorted by CellId over all ranks, fields by brick number, clock, ledger; every dataset with units and a checksum.
/// Written aside and renamed, so that `path` is the old file or the whole new one, also when the disk is full (kResources) or the process is killed.
Status write_checkpoint(const std::filesystem::path& path, const Tissue& tissue, const CheckpointInfo& info, const Comm& comm);

/// Collective. Checks every byte, then reads. Works on any number of ranks: rank r of p gets the r-th of p equal stretches of the
/// cells in the order of their ids (then put in canonical order) and of the bricks; the caller distributes them by place.
/// Errors: kFile for a damaged file, kInput for another format version or a model with other types, fields or obstacles.
Result<LoadedCheckpoint> read_checkpoint(const std::filesystem::path& path, const Model& model, ShapeLibrary& shapes, const Comm& comm);

/// Whether this program reads the file's format; if not, kInput with a message that names both versions.
Status check_checkpoint_version(const std::filesystem::path& path, const Hdf5Reader& file);

/// Number of voxels of a brick: kBrick along each axis, fewer at the high faces.
std::size_t brick_voxel_count(const fields::Grid& grid, std::int64_t brick);

}  // namespace morula::scenarios
