#pragma once
#include "scenarios/measures/shape_measures.h"

namespace morula::scenarios {

/// Area of a shell that bears the friction of a contact [µm²]: ∫ φ(g) dA over its faces, g the gap, φ the part of the friction that acts there, 1 up
/// to half the range c and falling smoothly to 0 at c (dcm.md §1). Each face is taken in 16 equal parts weighed at their centroids, which errs by less than
/// 5e-3; the few points by face of the contact layer err by some per cent. The area that is told ends at half the range instead (decision 0026): it is
/// what touches and not what rubs.

/// On a plane that looks towards z, at this height [µm].
double bearing_area_on_plane(const ShellView& shell, double height, double range);

/// Between two shells, the mean of both sides; g is the distance to the nearest face of the other.
double bearing_area_between(const ShellView& a, const ShellView& b, double range);

}  // namespace morula::scenarios
