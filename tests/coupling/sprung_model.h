#pragma once
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

}  // namespace morula::test
