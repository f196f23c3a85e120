#pragma once
#include <filesystem>
#include <vector>

#include "core/result.h"
#include "results/snapshot.h"
#include "study/study.h"

namespace morula::scenarios {

/// All snapshots of a run. kFile when there is none.
Result<std::vector<Snapshot>> all_snapshots(const std::filesystem::path& run);

/// Two-dimensional Young modulus Y = 2k/√3 of the springs of a type [nN/µm], and its Poisson ratio 1/3.
double spring_modulus(const CellType& type);

}  // namespace morula::scenarios
