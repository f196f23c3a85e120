#pragma once
#include <memory>

#include "coupling/simulation.h"
#include "study/initial/make_tissue.h"

namespace morula::scenarios::test {

/// The simulation of a study at time 0, on one thread.
inline Result<std::unique_ptr<Simulation>> simulation_of(const Study& study) {
  ShapeLibrary shapes;
  MORULA_TRY_ASSIGN(InitialTissue initial, make_tissue(study, shapes, Comm()));
  return Simulation::create(study.model, std::move(initial.tissue), Comm(), 1);
}

}  // namespace morula::scenarios::test
