#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/own_keys.h"
#include "core/random/philox.h"
#include "core/vec3.h"
#include "coupling/own_values.h"

namespace morula {

class CellView;

/// What behaviours ask of the cell in a step, beside its own cycle. Several behaviours of a type write one after the other, in the order of the
/// registry.
struct CellWish {
  bool die = false;        ///< begin to die at the end of this step
  bool divide = false;     ///< at the end of this step, whatever its volume; shells of a type that wait do so until they are spheres
  double growth = 1.0;     ///< factor of its rate of growth; 0: it does not grow
  double cycle = 1.0;      ///< factor of the rate at which the phases of its cycle pass
  double volume = 1.0;     ///< factor of its target volume in this step
  double migration = 1.0;  ///< factor of the speed of its persistent walk
  std::optional<Vec3d> polarity = {};  ///< its direction; of a type that has one
};

/// The step that a behaviour acts in.
struct CellStep {
  const CellView& cell;     ///< as it is at the start of the step
  double dt = 0.0;          ///< length [s]
  std::span<double> state;  ///< the behaviour's own variables of this cell, to be changed; in the order of Behaviour::variables
  Random random;            ///< of the behaviour's own stream
  std::uint64_t number;     ///< of the step

  /// Two uniform numbers in (0, 1) of this cell and step; another pair for each `draw`. The same on any threads and ranks, and after a restart.
  [[nodiscard]] RandomPair uniform(std::uint64_t draw = 0) const;
  /// Two independent standard normal numbers.
  [[nodiscard]] RandomPair normal(std::uint64_t draw = 0) const;
  /// Whether an event of a Poisson process of this rate [1/s] falls into the step: with probability 1 − e^(−rate·dt), whatever the steps.
  [[nodiscard]] bool happens(double rate, std::uint64_t draw = 0) const;
};

/// What a cell does in a step. Called by several threads at once, for different cells.
using Behave = std::function<void(const CellStep&, CellWish&)>;

/// A number of a cell that a behaviour keeps from step to step: in checkpoints, snapshots and the state hash, with it between ranks. 0 at first.
struct BehaviourVariable {
  const char* name = "";
  const char* unit = "1";
  bool shared = false;  ///< daughters share it by volume; else both have their mother's
};

/// A behaviour of cells: what there is to say about it, its section of a cell type in the study, and what makes it act.
struct Behaviour {
  LawInfo info;     ///< its parameters have the names of keys
  KeySpec section;  ///< under the cell type; several behaviours may share one
  /// Where one that must be given is given, the behaviour acts; without such a key, where its section stands in the study.
  std::vector<OwnKey> keys{};
  std::vector<BehaviourVariable> variables{};
  bool looks_at_body = false;  ///< needs volume, areas, pressure and centre of the body, which are found at the start of each step
  std::optional<RandomStream> stream{};  ///< of its random numbers; none: one that follows from info.name
  Behave (*build)(const OwnValues& values) = nullptr;
  /// What is wrong with the values; null: nothing can be.
  std::optional<LawProblem> (*judge)(const OwnValues& values) = nullptr;
  /// Why a cell dies of it, for events; null: the title.
  std::string (*reason)(const OwnValues& values, const std::string& type) = nullptr;
  /// With these values it never does anything; null: it may always.
  bool (*never_acts)(const OwnValues& values) = nullptr;
  const char* awaited = "what cells do by themselves";  ///< while it may act, a run at rest goes on for this
};

/// A behaviour as the cells of one type have it.
struct CellBehaviour {
  CellBehaviour(std::shared_ptr<const Behaviour> what, OwnValues values, const std::string& type);

  std::shared_ptr<const Behaviour> what;
  OwnValues values;
  Behave act;
  std::string reason;
  RandomStream stream;

  [[nodiscard]] bool may_act() const { return what->never_acts == nullptr || !what->never_acts(values); }
};

/// The behaviours that Morula brings this way, in the order in which they act.
std::vector<std::shared_ptr<const Behaviour>> builtin_behaviours();
std::shared_ptr<const Behaviour> starvation();

}  // namespace morula
