#include "cbm/builtin.h"

#include "cbm/laws/hertz.h"
#include "cbm/laws/jkr.h"

namespace morula::cbm {
namespace {

LawParameter young_parameter() {
  return {.name = "young",
          .quantity = "pressure",
          .unit = "kPa",
          .fallback = 0.45,
          .minimum = 1e-4,
          .maximum = 1e4,
          .source = "Galle 2005, doi:10.1529/biophysj.104.041459",
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

std::vector<ContactLawEntry> contact_laws() { return {hertz_entry(), jkr_entry()}; }

}  // namespace morula::cbm
