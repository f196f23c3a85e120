#pragma once
#include <cstdint>
#include <vector>

#include "cbm/spheres.h"
#include "coupling/cells.h"
#include "coupling/model.h"
#include "dcm/nuclear_shell.h"
#include "dcm/shells.h"
#include "fields/field.h"

namespace morula {

/// Clock and step-size controller: part of the state, so that a restart goes on with the same steps.
struct Clock {
  double time = 0.0;        ///< [s]
  double next_step = 1.0;   ///< step size the controller wants next [s]
  std::uint64_t steps = 0;  ///< done so far
  bool capped = false;      ///< the capped start is still on
};

/// What has become of the substance of a field since time 0.
struct FieldLedger {
  double in = 0.0;       ///< amount that came in through the boundary [amol]
  double taken = 0.0;    ///< amount taken by cells [amol]
  double decayed = 0.0;  ///< amount lost by decay [amol]
  double start = 0.0;    ///< amount in the field at time 0 [amol]
};

/// Sums over the whole run that the report shows.
struct Ledger {
  std::vector<FieldLedger> fields;  ///< by field of the tissue
  std::uint64_t divisions = 0, deaths = 0, promotions = 0, demotions = 0;
  // Common motion (TissueMotion), step by step: what forces from outside and obstacles have done, and the error of the solver.
  Vec3d drift;       ///< of the centre [µm]
  Vec3d rotation;    ///< about the centre [rad]
  double way = 0.0;  ///< mean way of the surfaces [µm]
};

/// A cavity (Lumen) as it was when it was last looked at. The same on every rank.
struct LumenState {
  double looked_at = -1e300;  ///< when its faces were last found [s]
  double amount = 0.0;        ///< of solute, where it is kept [amol]
  double volume = 0.0;        ///< [µm³]
  double pressure = 0.0;      ///< [kPa]
  double area = 0.0;          ///< of its faces [µm²]
  double covered = 0.0;       ///< part of all directions in which there is a wall
  // Of spheres, obstacles and walls that are seen, when it was last looked at:
  double before_others = 0.0;                       ///< volume between the centre and them [µm³]
  double other_directions = 0.0;                    ///< part of all directions in which they are seen
  double wall_x = 0.0, wall_y = 0.0, wall_z = 0.0;  ///< ∫ n dA of them, n out of the cavity [µm²]
  double hidden = 0.0;                              ///< 1: a cell lay over the centre then, and was left out
};

/// A neighbour of a cell that has exchanged its body, until it is told how far it went (coupling/exchange_effects.h). Nothing else depends on it.
struct WatchedNeighbour {
  CellId exchanged, neighbour;
  double since = 0.0;              ///< when the body was exchanged [s]
  std::uint64_t is_promotion = 0;  ///< 1, or 0: a demotion
  double room = 0.0;               ///< of the exchange [µm³]
  Vec3d from{};                    ///< where the neighbour was then [µm]
  double radius = 0.0;             ///< of the neighbour, as a ball [µm]
};

/// All state of a run on this rank: what a checkpoint holds. No hidden state exists elsewhere; workspaces can be rebuilt from it.
struct Tissue {
  Clock clock;
  Ledger ledger;
  Cells cells;
  cbm::Spheres spheres;
  dcm::Shells shells;
  dcm::NuclearShells nuclei;           ///< those that are shells of their own; in no count of cells or shells
  std::vector<Vec3d> obstacle_offset;  ///< how far each obstacle has moved [µm]
  std::vector<fields::Field> fields;
  std::vector<LumenState> lumens;         ///< by lumen of the model
  std::vector<WatchedNeighbour> watched;  ///< by time, exchanged cell and neighbour; the same on every rank
};

}  // namespace morula
