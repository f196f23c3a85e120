#include "study/initial/make_tissue.h"

#include "coupling/cell_variables.h"
#include "study/initial/place_cells.h"

namespace morula::scenarios {

Result<InitialTissue> make_tissue(const Study& study, ShapeLibrary& shapes, const Comm& comm, int threads) {
  InitialTissue out;
  MORULA_TRY_ASSIGN(PlacedCells placed, place_cells(study, threads));
  if (!placed.problems.empty()) {  // the check has told them, but of very many cells
    const PlaceProblem& first = placed.problems.front();
    return Error{ErrorKind::kInput, first.text + " [E" + std::to_string(first.code) + "]", first.help};
  }
  out.notes = std::move(placed.notes);
  const std::vector<PlacedCell>& all = placed.cells;
  const auto share = [&](int rank) { return all.size() * static_cast<std::size_t>(rank) / static_cast<std::size_t>(comm.size()); };
  std::vector<CellRecord> mine;
  for (std::size_t i = share(comm.rank()); i < share(comm.rank() + 1); ++i) {
    MORULA_TRY_ASSIGN(CellRecord record, with_body(all[i], study.model, shapes));
    mine.push_back(std::move(record));
  }
  out.tissue.cells.declare(cell_variables(study.model));  // founders have their place in the phases of the cycle
  put_together(out.tissue, std::move(mine));
  out.tissue.clock.next_step = study.model.step.initial_step;
  out.tissue.clock.capped = study.model.step.start_cap > 0.0;
  return out;
}

}  // namespace morula::scenarios
