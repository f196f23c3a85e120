#pragma once
#include "tests/coupling/tissue_fixture.h"

namespace morula::test {

/// Cells of tension 0.5 that stick to each other by W/2γ = `strength`, with steps that may take many iterations: the contact line decides.
inline Model patient_doublet(double strength, double range) {
  Model model = clusters_model(strength);  // W = 2 γ w with γ = 0.5
  model.contact.range = range;
  model.contact.repulsion = 100.0;
  model.contact.points_per_face = 3;
  model.step.max_newton = 8;
  model.step.newton_stop = 0.1;
  model.step.initial_step = 0.1;
  model.step.max_displacement = 1.0;
  return model;
}

}  // namespace morula::test
