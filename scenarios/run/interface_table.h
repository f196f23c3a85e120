#pragma once
#include <optional>
#include <vector>

#include "report/report.h"
#include "results/snapshot.h"
#include "study/study.h"

namespace morula::scenarios {

/// What cells are like in layers on both sides of where spheres and shells meet, and the jump between them; nothing where they do not. `snapshots` of one
/// run, in the order of time: ways are from the first, speeds from the one before the last.
std::optional<ReportTable> interface_table(const Study& study, const std::vector<Snapshot>& snapshots);

}  // namespace morula::scenarios
