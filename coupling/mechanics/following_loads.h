#pragma once
#include <cstdint>
#include <vector>

#include "coupling/loads/load.h"
#include "coupling/mechanics/term.h"

namespace morula {

/// Loads that follow the surface of a cell (Load::energy), with their strengths of the step's end: a pressure on all of it, E = ∫ p dV.
///
/// As a dead load, such a pressure would be one of the step's start while the pressure of the cell, which bears it, is that of its end: each
/// turn of a face would leave a difference of both, which no tension holds back where it is larger than tension over the length of an edge. It
/// has no part in the matrix, as the pressure of the cell has none beside that of the volume: what acts on faces is the difference of both,
/// which the tension bears.
class FollowingLoads : public Term {
 public:
  /// Whether they act in the next step.
  void set_on(bool on) { on_ = on; }

  void begin_step(const World& world, StepStart& start) override;
  void add_outside(const Way& way, double dt, std::span<Vec3d> out, OrderFreeSum& work) override;

 private:
  /// One load on one shell.
  struct Loaded {
    const CellLoad* load;
    const ReferenceShape* shape;
    double strength;
    std::uint32_t first, count;  ///< points
    double energy;               ///< at the start of the step [fJ]

    [[nodiscard]] LoadedShell at(std::span<const Vec3d> all) const { return {*shape, all.subspan(first, count), {}, strength}; }
  };

  std::vector<Loaded> loaded_;  ///< of the step
  int threads_ = 1;
  bool on_ = false;
};

}  // namespace morula
