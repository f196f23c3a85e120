#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "coupling/cell_view.h"
#include "coupling/mechanics/as_balls.h"
#include "coupling/tissue.h"

namespace morula {

struct Interval;
struct Laws;
struct Measures;
class Simulation;

/// Numbers over all cells of all ranks: the same bits on any number of ranks and threads. All functions are collective.
///
/// A cell whose value is not a number is left out; where none is left the result is 0.
class CellsAtOutput {
 public:
  using Value = std::function<double(const CellView&)>;

  explicit CellsAtOutput(Simulation& simulation) : simulation_(simulation) {}

  [[nodiscard]] double sum(const Value& value) const;
  [[nodiscard]] double mean(const Value& value) const;
  [[nodiscard]] double largest(const Value& value) const;
  [[nodiscard]] double smallest(const Value& value) const;

 private:
  /// function(value) for every cell of this rank that has one.
  void visit(const Value& value, const std::function<void(double)>& function) const;

  Simulation& simulation_;
  mutable std::shared_ptr<const BodiesNow> bodies_;  ///< looked at once, by the first that asks
  mutable std::shared_ptr<const AsBalls> balls_;     ///< likewise
};

/// What a column of series.csv is computed from. The same on every rank.
struct Moment {
  const Measures& measures;
  const Interval& interval;
  const Clock& clock;
  const Ledger& ledger;
  const CellsAtOutput& cells;
};

/// A column of series.csv.
struct Observable {
  std::string name;
  std::string unit;                            ///< "1" for a number
  std::string doc;                             ///< one sentence
  std::function<double(const Moment&)> value;  ///< called by all ranks
};

/// All observables that a run of this model has, family by family.
std::vector<Observable> observables(const Model& model, const Laws& laws);
/// Their names.
std::vector<std::string> observable_names(const Model& model, const Laws& laws);
/// The observables of any model: with one of every thing that has observables, under a name in angle brackets, such as `mean_<field>`.
std::vector<Observable> observables_of_any_model(const Laws& laws);

/// Those that Morula brings: one function for each file of this folder.
std::vector<Observable> tissue_observables(const Model& model);
std::vector<Observable> box_observables(const Model& model);
std::vector<Observable> type_observables(const Model& model);
std::vector<Observable> phase_observables(const Model& model);
std::vector<Observable> obstacle_observables(const Model& model);
std::vector<Observable> lumen_observables(const Model& model);
std::vector<Observable> grip_observables(const Model& model);
std::vector<Observable> field_observables(const Model& model);

}  // namespace morula
