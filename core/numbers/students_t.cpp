#include "core/numbers/students_t.h"

#include <boost/math/distributions/students_t.hpp>

namespace morula {

double students_t_95(double freedom) { return boost::math::quantile(boost::math::students_t(freedom), 0.975); }

}  // namespace morula
