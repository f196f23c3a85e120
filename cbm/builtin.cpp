#include "cbm/builtin.h"

#include "cbm/laws/springs.h"

namespace morula::cbm {

std::vector<std::shared_ptr<const SphereLaw>> sphere_laws() {
  return {jkr_law(), hertz_law(), linear_law(), quadratic_law(), logarithmic_law()};
}

LawInfo jkr_range_law() {
  return {.name = "jkr_range",
          .title = "Range of the JKR law",
          .equation = "a_0/R ≲ 0.4 at rest, a_0 = (9πWR*²/(2E*))^(1/3), δ_0 = a_0²/(3R*); twelve contacts cover 3 (a_0/R)² of the surface",
          .source = "small strains: Johnson 1985, Contact Mechanics, ch. 5; the limit is a choice of this project",
          .parameters = {given_by_study("contact_ratio", "number", "1", "a_0/R of two cells of the type."),
                         given_by_study("overlap_ratio", "number", "1", "δ_0/(2R)."),
                         given_by_study("covered", "number", "1", "Part of the surface that twelve such contacts cover.")}};
}

}  // namespace morula::cbm
