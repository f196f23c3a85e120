#pragma once
#include <string>
#include <vector>

namespace morula::scenarios {

/// The name of a curve, written beside its end.
struct LineEnd {
  std::string name;
  int color = 0;
  double y = 0.0;   ///< where the line ends [px, down]
  double at = 0.0;  ///< where the name stands [px, down]
};

/// Moves names apart until they are `gap` or more from one another and within `top` and `bottom`, each as little as that allows (pools of
/// neighbours around their mean), in the order of their lines. False where a name would stand more than `farthest` from its line.
bool place_line_ends(std::vector<LineEnd>& ends, double top, double bottom, double gap, double farthest);

}  // namespace morula::scenarios
