#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/numbers/unit_conversion.h"
#include "scenarios/measures/finished_run.h"
#include "scenarios/measures/shape_measures.h"

namespace morula::scenarios {

/// What a measure is taken of, found in the study: indices into the model, −1 where there is none.
struct Subject {
  int type = -1;
  int partner = -1;  ///< of a pair: a material, cell types before obstacles
  int load = -1, obstacle = -1, field = -1;
  std::string cell;  ///< id of a cell; empty: not by id
  std::string text;  ///< for people: "left and right"; empty: the run as a whole
};

/// Which things a measure is taken of.
enum class MeasureOf {
  kRun,      ///< the run as a whole
  kCells,    ///< cells of a type, one cell, or all
  kField,    ///< a field as the cells of a type see it
  kPair,     ///< two cell types that touch, one cell of each; of one type: two cells of it
  kContact,  ///< as kPair, or the cells of a type on an obstacle
  kLoad,
  kObstacle,
};

/// A value that a measure has found.
struct Sample {
  double time = 0.0;   ///< [s]
  double value = 0.0;  ///< in internal units
  std::string cell;    ///< id of the cell; empty where it is of no single one
};

/// A named measure of a finished run. Declared in a file of its own, one line in measures(): reader, judge, plots, `explain` and docs walk
/// the list.
struct Measure {
  std::string name;   ///< "cap.angle"
  std::string title;  ///< for people, in the text of a criterion and on an axis: "contact angle"
  std::string doc;    ///< what it is, in one sentence
  std::string formula, source;
  Quantity quantity = Quantity::kNumber;
  MeasureOf of = MeasureOf::kRun;
  bool of_a_course = false;  ///< one value of several moments, from the first to the last of them
  /// What else the things must have, as the message of an error: "needs a grip"; null: nothing.
  std::function<Status(const Study&, const Subject&)> fits{};
  /// Columns of series.csv that it reads; null: none. A run writes them whatever `output.series` says.
  std::function<std::vector<std::string>(const Study&, const Subject&)> columns{};
  /// Its values at these moments, in the order of time; none where there is nothing to measure. Errors: kFile.
  std::function<Result<std::vector<Sample>>(FinishedRun&, const Subject&, const Moments&)> take{};
};

/// Whether a cell is one of those that a subject of kCells or kField means.
bool is_meant(const Snapshot::Cell& cell, const Subject& subject);

/// Whether some cell that is meant may ever be a shell; of a contact those of its first type. What it says is the message of an error.
Status needs_shells(const Study& study, const Subject& subject);

/// A measure of each cell by itself, of what a snapshot holds. `shell` is null for cells that are spheres; a value that is no number:
/// nothing there.
using OfCell = double (*)(const Snapshot&, const Snapshot::Cell&, const ShellView* shell);
Measure cell_measure(std::string name, std::string title, std::string doc, Quantity quantity, OfCell value, std::string formula = "");

/// The value that a function of one snapshot finds, at each of the moments; nothing where it finds none.
using OfSnapshot = std::function<std::optional<double>(const Study&, const Snapshot&, const Subject&)>;
std::function<Result<std::vector<Sample>>(FinishedRun&, const Subject&, const Moments&)> by_snapshot(OfSnapshot value);

/// The value that a function makes of a row of some columns of series.csv, at each of the moments; nothing where a column is missing.
using OfRow = std::function<double(double time, const std::vector<double>& row)>;
Result<std::vector<Sample>> by_row(FinishedRun& run, const std::vector<std::string>& columns, const Moments& moments, const OfRow& value);

/// The two shells of a pair, of its first material first; nothing where there are not exactly these.
struct PairOfShells {
  ShellView first, second;
};
std::optional<PairOfShells> shells_of_pair(const Snapshot& snapshot, const Subject& pair);

}  // namespace morula::scenarios
