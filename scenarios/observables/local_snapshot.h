#pragma once
#include "coupling/simulation.h"
#include "scenarios/results/snapshot.h"

namespace morula::scenarios {

/// This rank's cells as append_snapshot wants them. Collective (the values of bodies are).
Snapshot local_snapshot(Simulation& simulation);

}  // namespace morula::scenarios
