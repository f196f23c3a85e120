#pragma once
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "cbm/laws/pair_law.h"
#include "core/law_info.h"
#include "core/law_values.h"

namespace morula::cbm {

struct SphereParameters;
struct PairBlock;
struct PairContact;
class PairTable;

/// Coefficients of the contact of two materials, in the order of the members of the law's struct.
using PairCoefficients = std::array<double, 4>;

/// A sphere law at one overlap, and whether the pair is attached after a step that ended there.
struct PairOutcome {
  ContactResponse<double> response;
  bool attached_next = false;
};

/// A law of contact of two spheres: what there is to say about it, how a study makes it, and the loops, which are instantiated in the law's own
/// file by make_sphere_law() of cbm/pair_loop.h.
struct SphereLaw {
  LawInfo info;                    ///< its parameters have the names of the values `young`, `poisson`, `adhesion` and of the law's own keys
  std::string word;                ///< of `cbm.law` in a study
  std::string doc;                 ///< what it is, after the word and a colon
  std::vector<KeySpec> own{};      ///< keys of its own
  bool of_small_contacts = false;  ///< asks for contacts that are small against the sphere (cbm/sphere_range.h)

  std::shared_ptr<const PairTable> table{};  ///< of a law that is a table (cbm/laws/table.h)
  std::shared_ptr<const SphereLaw>
      elsewhere{};  ///< stands in for this law in contacts with obstacles and with spheres of other laws; null: none

  /// Of two spheres, or of one and a rigid body (null); adhesion W [nN/µm].
  PairCoefficients (*couple)(const SphereParameters& a, const SphereParameters* b, double adhesion) = nullptr;
  /// Overlap at which a pair of this effective radius [µm] carries no load [µm]; null: 0.
  double (*rest_overlap)(const PairContact& contact, double reduced_radius) = nullptr;
  /// Largest gap at which a pair still pulls [µm]; null: 0.
  double (*reach)(const PairContact& contact, double reduced_radius) = nullptr;
  /// Overlaps at which the force of a pair, its energy or the slope of its stiffness jumps by design [µm]; null: none.
  std::vector<double> (*jumps)(const PairContact& contact, double reduced_radius) = nullptr;

  // from the law's struct
  void (*evaluate)(PairBlock& block) = nullptr;
  PairOutcome (*respond)(const PairContact& contact, double reduced_radius, double overlap, bool attached) = nullptr;
};

/// Overlaps over the radius of the smaller sphere, δ/R, that a law was fitted to; without ends where it was not fitted.
struct OverlapRange {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool has_ends() const {
    return least > -std::numeric_limits<double>::infinity() || most < std::numeric_limits<double>::infinity();
  }
};

/// Contact of two materials: their law and its coefficients. The law is kept alive by the parameters of the spheres.
struct PairContact {
  const SphereLaw* law = nullptr;
  PairCoefficients coefficient{};
  OverlapRange fitted{};
};

/// The laws of contact that every program has: of spheres that say nothing else, and of two spheres whose laws differ.
std::shared_ptr<const SphereLaw> jkr_law();
std::shared_ptr<const SphereLaw> hertz_law();

}  // namespace morula::cbm
