#pragma once
#include <array>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "core/simd/lane.h"

namespace morula::dcm {

template <int W>
struct BlockState;
template <int W>
struct Assembly;
template <class Real>
struct MembraneStress;
template <class Real>
struct MembraneModuli;

/// Coefficients of a law of the strain of a face, in the order of the members of its struct: the strength first, 0 where it does not act.
using SheetCoefficients = std::array<double, 4>;

/// The functions of a law of the strain of a face (a sheet) that the loops over the faces of a block call, for W shells at once. They are
/// instantiated in the law's own file, by sheet_law() of dcm/sheet_loops.h.
template <int W>
struct SheetFunctions {
  using Real = Lane<double, W>;
  using Float = Lane<float, W>;

  /// The loops of a block in which this is the only sheet. `area`: modulus of the area of every face, or null.
  void (*add_forces)(BlockState<W>& state, const Real* coefficients, const Real* area) = nullptr;
  void (*assemble)(Assembly<W>& assembly, const Float* coefficients, const Float* area) = nullptr;

  /// One face of a block with several sheets: adds to `out`, or takes the larger excess.
  void (*add_stress)(const Real* coefficients, const Real& trace, const Real& det, MembraneStress<Real>& out) = nullptr;
  void (*add_excess)(const Real* coefficients, const Real& trace, const Real& det, Real& out) = nullptr;
  void (*add_stress_float)(const Float* coefficients, const Float& trace, const Float& det, MembraneStress<Float>& out) = nullptr;
  void (*add_moduli)(const Float* coefficients, const Float& trace, const Float& det, MembraneModuli<Float>& out) = nullptr;
};

/// A law of the strain of a face as the loops know it. Two shells have the same law when they point to the same one.
struct SheetLaw {
  std::string name;                                      ///< of the law
  std::string limit;                                     ///< what a face beyond its range is told to be: "is stretched beyond 0.8 to 1.3"
  double (*excess)(double trace, double det) = nullptr;  ///< > 0 outside the range of the law; null: it holds everywhere
  std::size_t coefficient_count = 0;
  std::tuple<SheetFunctions<1>, SheetFunctions<4>, SheetFunctions<8>> functions;

  template <int W>
  [[nodiscard]] const SheetFunctions<W>& in_lanes() const {
    return std::get<SheetFunctions<W>>(functions);
  }
};

/// A sheet of a shell: its law and the law's coefficients.
struct Sheet {
  std::shared_ptr<const SheetLaw> law;
  SheetCoefficients coefficient{};

  friend bool operator==(const Sheet&, const Sheet&) = default;
};

}  // namespace morula::dcm
