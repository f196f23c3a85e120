#pragma once
#include <string>
#include <vector>

#include "scenarios/measures/measure.h"

namespace morula::scenarios {

/// A cell that a grip draws off another cell or an obstacle, while the grip goes back.
struct PulledContact {
  bool on_obstacle = false;
  double adhesion = 0.0, range = 0.0, speed = 0.0;  ///< W [nN/µm]; range of the contact [µm]; of the grip [µm/s]
  std::vector<double> time, way, pull;              ///< [s], way since the grip turned [µm], pull on the contact [nN]
  double peak_time = 0.0, peak = 0.0;               ///< when the pull is largest [s], F* [nN]
  double left = 0.0;                                ///< largest force in the last three outputs over F*
};

/// What a grip with a way pulls off. It ends with its last way in its direction. The partner is the cell that the nearest grip at rest
/// holds, where one is within two diameters; else the obstacle that the cell sticks to most. The pull of a pair is the force of the grip
/// at rest, which holds a cell that hardly moves (that of the moving one contains the drag of its cell); of a cell on an obstacle it is the
/// moving grip's, less the drag of a ball at its speed. Nothing where the grip is not seen going back in more than three outputs. kFile.
Result<std::optional<PulledContact>> pulled_contact(FinishedRun& run, const CellLoad& load);

/// Pressure in the cell when the pull is largest [kPa]; no number where no snapshot shows it. kFile.
Result<double> pressure_at_peak(FinishedRun& run, const CellLoad& load, const PulledContact& pulled);

/// Radius of a ball of the cell's volume in the last snapshot [µm]; no number where the cell is not there. kFile.
Result<double> radius_at_end(FinishedRun& run, const CellLoad& load);

/// Contact radius in the last snapshot before separation [µm]; 0 where the cell touches nothing since the grip turned. kFile.
Result<double> last_contact_radius(FinishedRun& run, const CellLoad& load, const PulledContact& pulled);

/// Columns of series.csv that it reads.
std::vector<std::string> pulled_contact_columns(const Study& study, const CellLoad& load);

}  // namespace morula::scenarios
