#pragma once
#include "cbm/laws/table.h"

namespace morula::cbm {

/// A law of cells under tension that adhere, in round numbers: breaks at −0.2 R*, touches at 0, rests near 0.38 R*.
inline PairTable example_table() {
  constexpr PairTableKnot kKnots[] = {{-0.2, -0.30, 0.5}, {-0.1, -0.28, 1.2}, {0.0, -0.22, 1.8}, {0.2, -0.11, 2.9},
                                      {0.4, 0.01, 4.0},   {0.7, 0.24, 5.8},   {1.0, 0.52, 7.9}};
  return PairTable::through(kKnots, 0.0).value();
}

}  // namespace morula::cbm
