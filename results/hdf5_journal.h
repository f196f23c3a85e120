#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "core/result.h"
#include "results/hdf5_overlay.h"

namespace morula::scenarios {

/// Changes to the existing part of a file, on disk beside it before they are made, so that a process killed in between can be made good.
struct Journal {
  std::uint64_t new_length = 0;  ///< of the file, when all is done
  std::vector<Overlay::Range> ranges;
};

/// `results.h5` -> `results.h5.journal`
[[nodiscard]] std::filesystem::path journal_path(const std::filesystem::path& file);
/// Writes and syncs the journal.
Status write_journal(const std::filesystem::path& file, const Journal& journal);
/// The journal beside the file if it is there and whole (it ends with a hash of itself); a part of one is as none.
std::optional<Journal> read_journal(const std::filesystem::path& file);
/// Makes the journal's changes and removes it.
Status apply_journal(const std::filesystem::path& file, const Journal& journal);

}  // namespace morula::scenarios
