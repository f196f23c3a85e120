#pragma once
#include "core/law_info.h"

/// The keys of a sphere that more than one law reads.
namespace morula::cbm::keys {

inline KeySpec young() {
  return {.name = "young",
          .doc = "Young's modulus of the sphere.",
          .quantity = Quantity::kPressure,
          .fallback = "1.5 kPa",
          .low = 0.0,
          .high = 1e4,
          .low_open = true,
          .example = "1.5 kPa",
          .source =
              "3 K (1 - 2 nu) with the bulk modulus K = 2.5 kPa of shells (Van Liedekerke et al. 2020, "
              "doi:10.1007/s10237-019-01204-7): one material in both bodies, and a contact radius of 0.40 R at 1e-4 J/m^2"};
}
inline KeySpec poisson() {
  return {.name = "poisson",
          .doc = "Poisson ratio of the sphere.",
          .fallback = "0.4",
          .low = 0.0,
          .high = 0.5,
          .example = "0.4",
          .source = "Galle et al. 2005, doi:10.1529/biophysj.104.041459"};
}
inline KeySpec adhesion() {
  return {.name = "adhesion",
          .doc =
              "Adhesion energy W per contact area of the pair, by name of a cell type or obstacle; holds for both bodies. Give a pair "
              "once. `others`: all cell types and obstacles that neither side names. Pairs without either have 1e-4 J/m^2 between cells "
              "and 1e-5 J/m^2 with obstacles.",
          .quantity = Quantity::kTension,
          .low = 0.0,
          .high = 100.0,
          .example = "{hepatocyte: 1e-4 J/m^2, capsule: 1e-6 J/m^2}",
          .source = "Van Liedekerke et al., Table 1"};
}

/// The moduli, which every law of elastic spheres takes.
inline std::vector<LawKey> elastic() { return {{"cbm", young()}, {"cbm", poisson()}}; }

/// The same as parameters of a law.
inline std::vector<LawParameter> elastic_parameters() {
  return {given_by_study("young", "pressure", "kPa", "Young's modulus of the cell as a whole."),
          given_by_study("poisson", "number", "1", "Poisson's ratio of the cell as a whole.")};
}

}  // namespace morula::cbm::keys
