#include "coupling/behaviours/pressure_filter.h"

#include <cmath>

namespace morula {

double averaged_pressure(double averaged, double now, double dt, double time_constant) {
  return averaged - std::expm1(-dt / time_constant) * (now - averaged);
}

}  // namespace morula
