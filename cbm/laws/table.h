#pragma once
#include <memory>
#include <span>
#include <vector>

#include "cbm/laws/pair_law.h"
#include "cbm/sphere_law.h"
#include "core/result.h"

namespace morula::cbm {

/// A point of the law of two attached spheres, scaled with R*.
struct PairTableKnot {
  bool operator==(const PairTableKnot&) const = default;

  double overlap = 0.0;  ///< δ/R*
  double force = 0.0;    ///< F/R* [nN/µm], > 0 pushes apart
  double area = 0.0;     ///< A/R*²
};

/// Law of two spheres by a table: F = R* f(δ/R*), A = R*² g(δ/R*), U = R*² ∫ f.
///
/// A cell whose surface has a tension and an adhesion per area, and whose volume is kept, has no length of its own but its radius: forces grow
/// with R* at the same δ/R*. (Elastic bodies would have F ∝ R*², and JKR lies between.)
///
/// f and g are monotone cubics through the knots (cbm/monotone_cubic.h), straight beyond the last. The first knot is where an attached pair breaks,
/// under a tension if the law adheres; there the energy is 0, and so it is beyond, as in cbm/laws/jkr.h. A pair that is not attached
/// feels what the law pushes, and not what it pulls, and is attached from the overlap of touch on.
class PairTable {
 public:
  /// touch: δ/R* at which a pair becomes attached. Errors (kInput): fewer than three knots; overlaps that do not increase; forces that do not
  /// increase, or all of one sign; areas that are negative or fall; a touch that is before the break; numbers that are not finite.
  static Result<PairTable> through(std::span<const PairTableKnot> knots, double touch);

  /// The knots and the touch make all of it.
  bool operator==(const PairTable& other) const { return knots_ == other.knots_ && touch_ == other.touch_; }
  [[nodiscard]] std::span<const PairTableKnot> knots() const { return knots_; }
  /// δ/R* at which an attached pair breaks, carries no load, and at which a pair attaches.
  [[nodiscard]] double break_overlap() const { return knots_.front().overlap; }
  [[nodiscard]] double rest_overlap() const { return rest_; }
  [[nodiscard]] double touch_overlap() const { return touch_; }
  [[nodiscard]] bool adheres() const { return knots_.front().force < 0.0; }

  /// F, dF/dδ, A and U of a pair at this overlap [µm], attached or not.
  [[nodiscard]] ContactResponse<double> respond(double reduced_radius, double overlap, bool attached) const noexcept;
  [[nodiscard]] bool attached_next(double reduced_radius, double overlap, bool attached) const noexcept;

 private:
  struct Scaled {
    double force, slope, area, energy;  ///< over R*, 1, R*², R*²
  };
  [[nodiscard]] Scaled at(double ratio) const noexcept;

  std::vector<PairTableKnot> knots_;
  std::vector<double> slope_, area_slope_;  ///< at the knots
  std::vector<double> energy_;              ///< ∫ f from the first knot
  double touch_ = 0.0, rest_ = 0.0, rest_energy_ = 0.0;
};

/// A law of spheres that is this table, between spheres of one type, or of types that have the same table and adhere to each other as each to itself. JKR with the
/// moduli of the spheres stands in for it in contacts with obstacles and with other spheres, which the table says nothing about.
std::shared_ptr<const SphereLaw> table_law(PairTable table);

/// What there is to say about such a law.
LawInfo table_law_info();

}  // namespace morula::cbm
