#pragma once
#include <filesystem>
#include <vector>

#include "report/run_plots.h"
#include "results/run_record.h"
#include "scenarios/measures/single_cell.h"

namespace morula::scenarios {

/// A cell pulled at two poles, at one moment.
struct Pulled {
  double time = 0.0;                              ///< [s]
  double force = 0.0;                             ///< at each end [nN]
  double axial = 0.0, transverse = 0.0;           ///< diameters [µm]
  double area_change = 0.0, volume_change = 0.0;  ///< relative to the first state
};

/// All states of the first cell of a load that pulls.
struct PulledCell {
  std::size_t type = 0;
  bool red_cell = false;  ///< the biconcave shape
  bool hookean = false;   ///< its membrane is a net of springs
  std::uint32_t nodes = 0;
  std::vector<Pulled> at_rest;   ///< at the holds of the load's course; the first is the unloaded one
  std::vector<Pulled> recovery;  ///< every snapshot after the load's last corner, where the course ends at 0
};

/// One entry for each load that pulls, in the order of the study.
Result<std::vector<PulledCell>> pulled_cells(const Study& study, const std::filesystem::path& run);

/// Criteria of the red blood cell (physics/scenarios.md S2.2 to S2.5) against the points of Mills et al. 2004, the static solution on the same
/// mesh and the recoveries of Hochmuth et al. 1979.
void judge_red_cell(const PulledCell& cell, const PulledCell* other_law, std::vector<Verdict>& out);

/// A recovery held against measured ones: the time axis is scaled (one viscosity) so that the curve fits the first measured cell best.
struct RecoveryFit {
  double scale = 0.0;    ///< of our times
  double largest = 0.0;  ///< difference of length/width from any of the measured points
};
RecoveryFit fit_recovery(const std::vector<Pulled>& recovery);

std::vector<NamedPlot> plot_red_cells(const std::vector<PulledCell>& cells);

}  // namespace morula::scenarios
