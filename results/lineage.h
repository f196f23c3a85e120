#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"

namespace morula::scenarios {

/// How a life ended, as far as a run has gone.
enum class LifeEnd { kAlive, kDivided, kDying, kDied };

/// One cell of a run, from its birth to its end.
struct CellLife {
  std::string id, parent;  ///< as in events.jsonl; a founder has no parent
  std::string type;        ///< name of the cell type
  double birth = 0.0;      ///< before 0 where the study gives founders an age [s]
  double end = 0.0;        ///< of a cell that is still there: time of the last snapshot [s]
  LifeEnd how = LifeEnd::kAlive;
  double birth_volume = 0.0;     ///< target volume; 0: not known, as of founders [µm³]
  double division_volume = 0.0;  ///< of one that divided; 0: not known, or it did not [µm³]
};

/// All cells of a run in the order (founder, generation, place among its sisters), from the founders of its first snapshot and its events. kFile: a file that cannot be read, or events after
/// which other cells live than those of the last snapshot.
Result<std::vector<CellLife>> read_lineage(const std::filesystem::path& results, const std::filesystem::path& events);

/// Table of lives: id, parent, type, birth [s], end [s], how it ended (divided, died, dying, alive), birth volume and division volume [um^3], empty where
/// they are not known.
[[nodiscard]] std::string lineage_csv(std::span<const CellLife> lives);

/// One tree a founder and line in Newick format; branches are as long as the lives [h], nodes have the ids of the cells.
[[nodiscard]] std::string lineage_newick(std::span<const CellLife> lives);

/// Writes lineage.csv and lineage.nwk into a folder that is made. Returns the number of cells.
Result<std::size_t> export_lineage(const std::filesystem::path& results, const std::filesystem::path& events,
                                   const std::filesystem::path& folder);

}  // namespace morula::scenarios
