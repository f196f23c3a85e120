#include "app/estimate_text.h"

#include "app/words.h"
#include "core/numbers/number_text.h"
#include "scenarios/run/progress.h"

namespace morula::app {

Result<std::string> estimate_text(const scenarios::Study& study, int ranks) {
  MORULA_TRY_ASSIGN(const scenarios::Estimate estimate, scenarios::estimate(study));
  std::string out = "  cells   " + std::to_string(estimate.cells) + " at the start (" + (study.model.swaps.any() ? "up to " : "") +
                    count_words(static_cast<std::uint64_t>(estimate.shells), "shell", "shells") + ")";
  if (estimate.cells_at_end > static_cast<double>(estimate.cells))
    out += ", about " + number_text(estimate.cells_at_end < 1e7 ? "%.0f" : "%.3g", estimate.cells_at_end) + " at " +
           scenarios::time_text(study.time.end);
  out += "\n  nodes   " + std::to_string(estimate.nodes) + "\n";
  if (estimate.voxels > 0) out += "  voxels  " + std::to_string(estimate.voxels) + "\n";
  out += "  memory  about " + bytes_words(estimate.memory) + "\n";
  const scenarios::WallRange wall{estimate.wall.low / ranks, estimate.wall.high / ranks};
  const std::string time =
      wall.high < 10.0 ? number_text("%.1f", wall.low) + "–" + number_text("%.1f", wall.high) + " s" : scenarios::duration_text(wall);
  out += "  time    " + time + " on " + count_words(static_cast<std::uint64_t>(ranks), "core", "cores") + "\n";
  return out;
}

}  // namespace morula::app
