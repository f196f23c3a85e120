#include <algorithm>
#include <cmath>

#include "coupling/behaviours/shell_division.h"
#include "coupling/face_marks.h"
#include "coupling/lumens.h"
#include "coupling/simulation.h"

namespace morula {
namespace {

/// A step may change the volume of a cavity that keeps its solute by this part: its pressure is that of the step's start.
constexpr double kLumenChange = 0.02;
/// Of the first step: what still changes as much in steps so short jumps, as where a cell comes over the centre from which its walls are seen.
constexpr double kLeastStep = 1e-3;

}  // namespace

void Simulation::renew_lumens(double dt) {
  if (tissue_.lumens.empty()) return;
  const std::vector<LumenState> before = tissue_.lumens;
  measure_lumens(model_, tissue_, comm_);
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (!model_.lumens[k].keeps_solute || !(before[k].volume > 0.0) || !(tissue_.lumens[k].volume > 0.0))
      continue;  // or it was found, or lost
    const double change = std::abs(tissue_.lumens[k].volume / before[k].volume - 1.0);
    if (change <= kLumenChange) continue;
    const double wanted = std::max(dt * std::max(0.2, kLumenChange / change), kLeastStep * model_.step.initial_step);
    tissue_.clock.next_step = std::min(tissue_.clock.next_step, wanted);
  }
}

void Simulation::renew_faces(double dt) {
  renew_lumens(dt);
  renew_surfaces(model_.types, tissue_.cells, tissue_.shells, tissue_.clock.time, dt);
  const bool follow = has_marks_that_follow(model_);
  bool lateral = false;
  for (const CellType& type : model_.types) lateral = lateral || type.regional_tension.eases_contact();
  if (!follow && !lateral) return;
  auto timed = timer().scope(Stage::kBehaviours);
  if (follow) {
    std::vector<std::vector<char>> touched(model_.marks.size());
    for (std::size_t r = 0; r < model_.marks.size(); ++r) {
      if (model_.marks[r].rule != FaceMark::Rule::kTouched) continue;
      std::vector<char> materials(model_.material_count(), 0);
      materials[static_cast<std::size_t>(model_.marks[r].material)] = 1;
      for (const float part : mechanics_->contact_of_faces(tissue_, materials)) touched[r].push_back(part > 0.0f);
    }
    renew_marks(model_, tissue_, touched);
  }
  if (lateral) {
    std::vector<char> cells(model_.material_count(), 0);
    std::fill_n(cells.begin(), model_.types.size(), 1);
    ease_contact(model_, tissue_, mechanics_->contact_of_faces(tissue_, cells), dt);
  }
}

}  // namespace morula
