#pragma once
#include <span>
#include <vector>

#include "results/run_record.h"

namespace morula::scenarios {

/// The exchanges of bodies among events, in their order.
[[nodiscard]] std::vector<EventLine> exchanges_of(std::span<const EventLine> events);
/// For how long cells kept a body before they exchanged it once more, of exchanges in the order of time [s].
[[nodiscard]] std::vector<double> times_between_exchanges(std::span<const EventLine> exchanges);

}  // namespace morula::scenarios
