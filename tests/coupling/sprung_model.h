#pragma once
#include <gtest/gtest.h>

#include "coupling/face_marks.h"
#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula::test {

/// Cells whose faces towards the origin springs and dampers hold near their mean sphere.
inline Model sprung_model() {
  Model model = clusters_model();
  model.mark_names = {"apical"};
  FaceMark rule;
  rule.axis_from = FaceMark::Axis::kTowardPoint;
  rule.angle = 1.0;
  model.marks = {rule};
  model.apical_springs = {{.name = "inner", .mark = 0, .stiffness = 0.3, .friction = 0.2}};
  return model;
}

/// How far a cell of the model goes along x in 300 s that a force of 0.5 nN pushes [µm].
inline double way_of_a_pushed_cell(Model model) {
  CellLoad load;
  load.force = {0.5, 0, 0};
  model.loads = {load};
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{11, 0, 0}}, {BodyKind::kShell});
  mark_new_shells(model, tissue);
  auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
  const Vec3d from = simulation->centers()[0];
  while (simulation->tissue().clock.time < 300.0)
    if (const auto step = simulation->step(300.0); !step.ok()) {
      ADD_FAILURE() << step.error().message;
      break;
    }
  return simulation->centers()[0].x - from.x;
}

}  // namespace morula::test
