#pragma once
#include <memory>
#include <vector>

#include "core/result.h"
#include "fields/field_spec.h"
#include "fields/layout.h"
#include "fields/reaction.h"

namespace morula::fields {

/// The reactions of one field, ready for the loops over its bricks: law by law, the coefficients looked up once.
class FieldReactions {
 public:
  explicit FieldReactions(const FieldSpec& spec);

  /// Σ λ of the reactions that are of first order in the volume; they are left to the stencil of diffusion [1/s].
  [[nodiscard]] double first_order() const { return first_order_; }
  /// Whether what they take is linear in the concentrations, cells apart.
  [[nodiscard]] bool volume_is_linear() const { return in_volume_.empty(); }
  /// By cell type: whether its cells take part in any; types beyond the end do not.
  [[nodiscard]] const std::vector<bool>& types_that_act() const { return types_that_act_; }

  /// Takes from `rate` [mM/s] what all but those of first order take in a brick of these sinks, and writes what each sink took [amol/s] where
  /// `taken` is not null. Returns what the reactions in the volume took [amol/s].
  double add_rates(std::span<const Sink> sinks, std::span<const double> c, double voxel_volume, double* rate, double* taken) const;
  /// Adds the slopes that the implicit method works with, of all but those of first order [1/s].
  void add_slopes(std::span<const Sink> sinks, std::span<const double> c, double voxel_volume, double* slope) const;
  /// A bound of the slope in the volume, of all but those of first order, for concentrations up to `highest` [1/s].
  [[nodiscard]] double steepest_in_volume(double highest) const;
  /// The same of one sink [µm³/s].
  [[nodiscard]] double steepest_of_sink(const Sink& sink, double highest) const;

 private:
  struct InVolume {
    std::shared_ptr<const Reaction> what;
    ReactionCoefficients coefficients{};
  };
  /// One law for all types that have it.
  struct OfCells {
    std::shared_ptr<const Reaction> what;
    std::vector<TypeCoefficients> of_type;  ///< by cell type, as many as types_that_act_
  };
  void add_cell_reaction(const FieldReaction& reaction, std::size_t types);

  double first_order_ = 0.0;
  std::vector<InVolume> in_volume_;
  std::vector<OfCells> of_cells_;
  std::vector<bool> types_that_act_;
};

/// What is wrong with the values of the reactions of a field, if anything: out of the range of a key, or as the reaction itself judges.
Status check_reactions(const FieldSpec& spec);

}  // namespace morula::fields
