#pragma once
#include <array>

#include "core/contact/traction_law.h"

namespace morula {

/// Eight quadrature points at once.
using TractionLanes = Lane<double, 8>;
using TractionPart = TractionLaw::Part<TractionLanes>;

struct SurfaceTraction;

/// The functions of a form of traction that the loop over quadrature points calls, once for eight points. They are instantiated in the form's own
/// file by traction_functions().
struct TractionFunctions {
  void (*evaluate)(const SurfaceTraction& law, const TractionLanes& gap, TractionPart& attraction, TractionPart& repulsion);
};

/// The form of traction that is rising, flat and falling, with a linear or a Hertz-like repulsion (TractionLaw). Its coefficients are a/c, b/c and κ.
const TractionFunctions* piecewise_traction();

/// Traction of two surfaces: what every law of contact has, and the coefficients of its form. The attraction of any form is proportional to W and
/// ends at the range.
struct SurfaceTraction {
  double adhesion = 0.0;    ///< W [nN/µm]
  double range = 0.5;       ///< c [µm]
  double repulsion = 40.0;  ///< k_r, where the form has it [kPa/µm]
  double cap = 0.0;         ///< depth from which the repulsion grows linearly; 0: none [µm]
  std::array<double, 4> coefficient{0.5, 0.5, 0.0, 0.0};
  const TractionFunctions* form = piecewise_traction();
  bool gives_way = false;  ///< repulsion ½ k_r g² whatever the form says: one of the two is a sphere on its foundation
};

/// `Form::of(law)` makes the form from its coefficients; `attraction(g)` and `repulse(g)` are templates of the number.
template <class Form>
const TractionFunctions* traction_functions() {
  static constexpr TractionFunctions kFunctions{
      [](const SurfaceTraction& law, const TractionLanes& gap, TractionPart& attraction, TractionPart& repulsion) {
        const Form form = Form::of(law);
        attraction = form.attraction(gap);
        if (law.gives_way)
          repulsion = TractionLaw{.repulsion = law.repulsion, .cap = law.cap}.repulse(gap);
        else
          repulsion = form.repulse(gap);
      }};
  return &kFunctions;
}

/// The piecewise form with the coefficients of a law.
inline TractionLaw piecewise_form(const SurfaceTraction& law) {
  return {law.adhesion, law.range, law.repulsion, law.cap, law.coefficient[0], law.coefficient[1], law.coefficient[2]};
}

}  // namespace morula
