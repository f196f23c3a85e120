#pragma once
#include <span>
#include <vector>

#include "coupling/mechanics/node_friction.h"
#include "coupling/mechanics/shell_system.h"
#include "coupling/mechanics/term.h"

namespace morula {

/// Membrane, bending, volume and own friction of the owned shells, in lanes (dcm.md §4).
///
/// The first of all terms: what it finds becomes the force of the shells' nodes, to which all others add. Its part of the matrix is the
/// shells' own (operator_part()), which takes up what other terms have given to the Assembly: build() comes after all of them.
class Membranes : public Term {
 public:
  /// `nodes`: the friction that single nodes have beside the shells' own. What a node feels of the medium is drawn as a whole.
  Membranes(const Model& model, const NodeFriction& nodes) : shells_(model), nodes_(nodes) {}

  void bodies_changed(const World& world) override;
  void evaluate(const World& world, Forces& out) override;
  [[nodiscard]] std::optional<StepFault> fault(const World& world) const override;
  void begin_step(const World& world, StepStart& start) override;
  void add_friction(const World& world, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) override;
  void add_noise(const World& world, const Noise& noise, std::span<Vec3d> force) const override;
  void drop_matrix() override { shells_.drop_matrix(); }
  [[nodiscard]] std::size_t memory() const override { return shells_.memory(); }

  /// The shells' part of the matrix with what all terms couple within a shell.
  void build(const World& world, double dt, const Assembly& assembly, const EdgeBlockSource& edges);
  [[nodiscard]] OperatorPart& operator_part() { return shells_; }

  /// What is in the shells that is no cytosol, by shell, for the present positions; empty: nothing. Before evaluate(), in measure() of others.
  void set_held(std::span<const dcm::HeldVolume> held) { held_ = held; }
  /// Volumes, pressures and energies by shell, as evaluate() found them.
  [[nodiscard]] const dcm::ShellMechanics& found() const { return shells_.forces(); }
  [[nodiscard]] const ShellSystem& shells() const { return shells_; }

 private:
  ShellSystem shells_;
  const NodeFriction& nodes_;
  std::span<const dcm::HeldVolume> held_;
};

}  // namespace morula
