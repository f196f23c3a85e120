#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/law_info.h"
#include "core/law_values.h"
#include "core/own_keys.h"
#include "fields/layout.h"

namespace morula::fields {

/// Coefficients of a reaction, in the order of the members of the law's struct.
using ReactionCoefficients = std::array<double, 4>;

/// The coefficients of one type of cells; types that do not take part in a reaction have `acts` false.
struct TypeCoefficients {
  bool acts = false;
  ReactionCoefficients value{};
};

/// One brick as a reaction of cells sees it.
struct CellReactionBlock {
  std::span<const Sink> sinks;
  const TypeCoefficients* of_type = nullptr;  ///< by cell type
  const double* concentration = nullptr;      ///< by voxel of the brick [mM]
  double voxel_volume = 0.0;                  ///< [µm³]
};

/// A reaction of one concentration c, by cells or in the whole volume: what there is to say about it, how a study writes it, and its loops, which are
/// instantiated in the law's own file by make_reaction() of fields/reaction_loop.h.
///
/// A reaction takes substance away at a rate that follows from c where it happens: [amol/s] of each cell, or [mM/s] in the volume. One that makes
/// substance takes a negative amount.
struct Reaction {
  enum class Where : std::uint8_t { kVolume, kCells };

  LawInfo info;     ///< its parameters have the names of keys
  KeySpec section;  ///< of a field; of a reaction of cells, a map from cell types to its keys
  /// Numbers, flags and words. The coefficients follow from their values.
  std::vector<OwnKey> keys{};
  Where where = Where::kVolume;
  bool bare = false;  ///< in the volume: its one key, which has the name of the section, stands in the field itself
  /// What it takes is proportional to c, in the volume. It is then part of the operator of diffusion: its rate is exact in the integrator's matrix and
  /// costs nothing.
  bool first_order = false;
  ReactionCoefficients (*coefficients)(const LawValues& values) = nullptr;
  /// What is wrong with values that lie in their ranges; null: nothing can be.
  std::optional<LawProblem> (*judge)(const LawValues& values) = nullptr;
  /// Of cells: the values with which cells that are dying go on; null: they do nothing.
  LawValues (*of_dying)(const LawValues& values) = nullptr;
  /// With these values it never does anything; null: it always may.
  bool (*never_acts)(const LawValues& values) = nullptr;

  // from the law's struct
  double (*taken)(const ReactionCoefficients& coefficients, double c) = nullptr;
  double (*slope)(const ReactionCoefficients& coefficients, double c) = nullptr;
  double (*steepest)(const ReactionCoefficients& coefficients, double highest) = nullptr;
  /// Of cells: takes from `rate` [mM/s] by voxel, and adds to `taken` [amol/s] by sink where that is not null.
  void (*add_rates_of_cells)(const CellReactionBlock& block, double* rate, double* taken) = nullptr;
  void (*add_slopes_of_cells)(const CellReactionBlock& block, double* slope) = nullptr;
  /// In the volume: takes from `rate` [mM/s] of these voxels; returns the sum of what it took.
  double (*add_rates)(const ReactionCoefficients& coefficients, std::span<const double> c, double* rate) = nullptr;
  void (*add_slopes)(const ReactionCoefficients& coefficients, std::span<const double> c, double* slope) = nullptr;
};

}  // namespace morula::fields
