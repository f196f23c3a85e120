#pragma once
#include "coupling/simulation.h"
#include "results/snapshot.h"

namespace morula::scenarios {

/// The faces of the domain that are walls, as obstacles that never move.
std::vector<Snapshot::Obstacle> domain_walls(const Space& space);

/// All obstacles of a model and the walls of its domain, where they are at time 0.
std::vector<Snapshot::Obstacle> obstacles_at_start(const Model& model);

/// This rank's cells as append_snapshot wants them. Collective (the values of bodies are).
Snapshot local_snapshot(Simulation& simulation);

}  // namespace morula::scenarios
