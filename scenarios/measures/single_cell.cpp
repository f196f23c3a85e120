#include "scenarios/measures/single_cell.h"

#include <numbers>

#include "results/run_files.h"
#include "results/snapshot_file.h"

namespace morula::scenarios {

Result<std::vector<Snapshot>> all_snapshots(const std::filesystem::path& run) {
  const auto file = RunFiles(run).results();
  auto out = read_snapshots(file);
  if (out.ok() && out->empty()) return Error{ErrorKind::kFile, "'" + file.string() + "' holds no snapshot", ""};
  return out;
}

double spring_modulus(const CellType& type) { return 2.0 / std::numbers::sqrt3 * type.shell.spring_stiffness; }

}  // namespace morula::scenarios
