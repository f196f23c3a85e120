#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/parallel/comm.h"
#include "core/result.h"
#include "fields/field.h"
#include "results/snapshot.h"

namespace morula::scenarios {

/// What results.h5 says of its run as a whole.
struct ResultsHead {
  std::string study, title;
  std::uint64_t seed = 0;
  std::string source_study, resolved_study;   ///< the texts of both files
  std::vector<Snapshot::Obstacle> obstacles;  ///< where they are at time 0
};

/// Collective. Makes results.h5 with what the root's `head` says (attributes of the root group, the study, the surfaces of obstacles). A
/// file that is there already is left as it is.
Status begin_results(const std::filesystem::path& path, const ResultsHead& head, const Comm& comm);

/// A snapshot in results.h5.
struct SnapshotEntry {
  std::size_t index = 0;  ///< 0, 1, 2, ... in the order of time
  double time = 0.0;      ///< [s]
  std::uint64_t cells = 0;
};

/// Collective. Adds one moment to results.h5 (made if missing) as group `snapshots/NNNNNN`, cells sorted by id over all ranks.
///
/// `local` holds this rank's cells, shells, nodes and the topologies they use; of its `fields` only the names are read (and the number must
/// be that of `fields`): the values come from this rank's bricks. Of its obstacles names and offsets are written. Snapshots at this time or
/// later, left from before a restart, are replaced. When the process is killed or the disk is full, the file holds all earlier snapshots.
Status append_snapshot(const std::filesystem::path& path, const Snapshot& local, std::span<const fields::Field> fields, const Comm& comm);

/// Collective. Takes the snapshots later than `time` out of the file; after a restart from a checkpoint of that time. A missing file is fine.
Status truncate_snapshots(const std::filesystem::path& path, double time, const Comm& comm);

/// Collective. Puts the root's series (CSV text as in series.csv, with one description by column) and events (JSON lines) into the file as
/// columns, `series/` and `events/`, in the place of those that are there. truncate_snapshots takes them out again.
Status write_results_tables(const std::filesystem::path& path, const std::string& series_csv, const std::string& event_lines,
                            const std::map<std::string, std::string>& descriptions, const Comm& comm);
/// The group of a snapshot in the file: `snapshots/000012`. Their numbers have no gaps.
[[nodiscard]] std::string snapshot_group(std::size_t index);

/// What is in the file. Also while a run writes it or after it was killed.
Result<std::vector<SnapshotEntry>> list_snapshots(const std::filesystem::path& path);

/// How many snapshots a file has.
struct SnapshotCounts {
  std::uint64_t all = 0;
  std::uint64_t earlier = 0;  ///< than the time asked for: the first so many
};
/// Snapshots earlier than `time` [s], `with_equal` those at it too. Reads the times of the later ones only: a run asks at each output.
Result<SnapshotCounts> count_snapshots(const std::filesystem::path& path, double time, bool with_equal);

/// One moment, whole, on this process. kFile for a file of another schema.
Result<Snapshot> read_snapshot(const std::filesystem::path& path, std::size_t index);
/// All moments, likewise.
Result<std::vector<Snapshot>> read_snapshots(const std::filesystem::path& path);

}  // namespace morula::scenarios
