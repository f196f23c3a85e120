#pragma once
#include <string>

namespace morula::test {

/// Shells and spheres with every kind of mark, region of tension, cavity, spring and active force: about 20 cells of 42 nodes about a cavity.
[[nodiscard]] std::string active_study();

}  // namespace morula::test
