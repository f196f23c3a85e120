#include "cbm/builtin.h"

#include "cbm/laws/hertz.h"
#include "cbm/laws/jkr.h"
#include "cbm/sphere_range.h"

namespace morula::cbm {
namespace {

LawParameter young_parameter() {
  return {.name = "young",
          .quantity = "pressure",
          .unit = "kPa",
          .fallback = 1.5,
          .minimum = 1e-4,
          .maximum = 1e4,
          .source = "3 K (1 - 2 nu) with K = 2.5 kPa of shells",
          .doc = "Young's modulus of the cell as a whole."};
}

LawParameter poisson_parameter() {
  return {.name = "poisson",
          .quantity = "number",
          .unit = "1",
          .fallback = 0.4,
          .minimum = 0.0,
          .maximum = 0.5,
          .source = "Galle 2005, doi:10.1529/biophysj.104.041459",
          .doc = "Poisson's ratio of the cell as a whole."};
}

LawParameter adhesion_parameter() {
  return {.name = "adhesion",
          .quantity = "tension",
          .unit = "nN/µm",
          .fallback = 0.0,
          .minimum = 0.0,
          .maximum = 10.0,
          .source = "choice of this project",
          .doc = "Adhesion energy W per contact area of the pair; 0 gives Hertz contact."};
}

ContactLawEntry hertz_entry() {
  return {.info = {.name = "hertz",
                   .title = "Hertz contact",
                   .equation = "F = (4/3) E* √R* δ^(3/2) for δ > 0, a = √(R*δ)",
                   .source = "Hertz 1882, doi:10.1515/crll.1882.92.156",
                   .parameters = {young_parameter(), poisson_parameter()}},
          .build = [](std::span<const double> v) { return ContactMaterial::elastic(v[0], v[1], v[0], v[1], 0.0); },
          .respond = [](const PairLaw<double>& law, double overlap, bool) { return hertz_contact(law, overlap); },
          .jumps = [](const PairLaw<double>&) { return std::vector<double>{}; }};
}

ContactLawEntry jkr_entry() {
  return {.info = {.name = "jkr",
                   .title = "Johnson–Kendall–Roberts adhesive contact",
                   .equation = "F = 4E*a³/(3R*) − √(8πWE*a³), δ = a²/R* − √(2πWa/E*); touches at δ = 0, breaks at δ = −0.75 X, "
                               "X = (π²W²R*/E*²)^(1/3)",
                   .source = "Johnson, Kendall & Roberts 1971, doi:10.1098/rspa.1971.0141",
                   .parameters = {young_parameter(), poisson_parameter(), adhesion_parameter()}},
          .build = [](std::span<const double> v) { return ContactMaterial::elastic(v[0], v[1], v[0], v[1], v[2]); },
          .respond = [](const PairLaw<double>& law, double overlap, bool attached) { return contact_response(law, overlap, attached); },
          .jumps = [](const PairLaw<double>& law) { return std::vector<double>{kBreakOverlap * law.length}; }};
}

}  // namespace

LawInfo jkr_range_law() {
  return {.name = "jkr_range",
          .title = "Range of the JKR law",
          .equation = "a_0/R ≲ 0.4 at rest, a_0 = (9πWR*²/(2E*))^(1/3), δ_0 = a_0²/(3R*); twelve contacts cover 3 (a_0/R)² of the surface",
          .source = "small strains: Johnson 1985, Contact Mechanics, ch. 5; the limit is a choice of this project",
          .parameters = {given_by_study("contact_ratio", "number", "1", "a_0/R of two cells of the type."),
                         given_by_study("overlap_ratio", "number", "1", "δ_0/(2R)."),
                         given_by_study("covered", "number", "1", "Part of the surface that twelve such contacts cover.")}};
}

std::vector<ContactLawEntry> contact_laws() { return {hertz_entry(), jkr_entry()}; }

}  // namespace morula::cbm
