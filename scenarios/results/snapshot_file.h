#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/parallel/comm.h"
#include "core/result.h"
#include "fields/field.h"
#include "scenarios/results/snapshot.h"

namespace morula::scenarios {

/// A snapshot in results.h5.
struct SnapshotEntry {
  std::size_t index = 0;  ///< 0, 1, 2, ... in the order of time
  double time = 0.0;      ///< [s]
  std::uint64_t cells = 0;
};

/// Collective. Adds one moment to results.h5 (made if missing) as group `snapshots/NNNNNN`, cells sorted by id over all ranks.
///
/// `local` holds this rank's cells, shells, nodes and the topologies they use; of its `fields` only the names are read (and the
/// number must be that of `fields`): the values come from this rank's bricks. Snapshots at this time or later, left from before a restart, are replaced.
/// When the process is killed or the disk is full, the file holds all earlier snapshots.
Status append_snapshot(const std::filesystem::path& path, const Snapshot& local, std::span<const fields::Field> fields, const Comm& comm);

/// Collective. Takes the snapshots later than `time` out of the file; after a restart from a checkpoint of that time. A missing file is fine.
Status truncate_snapshots(const std::filesystem::path& path, double time, const Comm& comm);

/// The group of a snapshot in the file: `snapshots/000012`. Their numbers have no gaps.
[[nodiscard]] std::string snapshot_group(std::size_t index);

/// What is in the file. Also while a run writes it or after it was killed.
Result<std::vector<SnapshotEntry>> list_snapshots(const std::filesystem::path& path);

/// One moment, whole, on this process.
Result<Snapshot> read_snapshot(const std::filesystem::path& path, std::size_t index);

}  // namespace morula::scenarios
