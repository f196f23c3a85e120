#include "results/exchanges.h"

#include <algorithm>
#include <iterator>
#include <map>

namespace morula::scenarios {

std::vector<EventLine> exchanges_of(std::span<const EventLine> events) {
  std::vector<EventLine> out;
  std::ranges::copy_if(events, std::back_inserter(out), [](const EventLine& event) {
    return event.kind == name_of(EventKind::kPromotion) || event.kind == name_of(EventKind::kDemotion);
  });
  return out;
}

std::vector<double> times_between_exchanges(std::span<const EventLine> exchanges) {
  std::vector<double> out;
  std::map<std::string, double> last;
  for (const EventLine& event : exchanges) {
    const auto [at, fresh] = last.try_emplace(event.cell, event.time);
    if (!fresh) out.push_back(event.time - at->second);
    at->second = event.time;
  }
  return out;
}

}  // namespace morula::scenarios
