#include "core/contact/surface_traction.h"

namespace morula {
namespace {

struct PiecewiseForm : TractionLaw {
  static PiecewiseForm of(const SurfaceTraction& law) { return {piecewise_form(law)}; }
};

}  // namespace

const TractionFunctions* piecewise_traction() { return traction_functions<PiecewiseForm>(); }

}  // namespace morula
