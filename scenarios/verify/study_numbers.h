#pragma once
#include <vector>

#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {

/// Numbers that are found as a user finds them: the text of a study is read and run, and its results are read back from the files. Spheres that push
/// each other, a chain of them, a walk, growth, an exchange of bodies, and fields in a slab and around a ball.
void add_study_numbers(std::vector<ReferenceNumber>& out);

}  // namespace morula::scenarios
