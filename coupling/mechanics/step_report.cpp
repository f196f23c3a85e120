#include "coupling/mechanics/step_report.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/parallel/pack.h"

namespace morula {

StepFault worst_of_all_ranks(StepFault here, const Comm& comm) {
  if (comm.size() == 1) return here;
  struct Found {
    double badness;
    CellId cell;
  };
  const std::vector<Found> all = items_of_all_ranks(std::vector<Found>{{here.badness, here.cell}}, comm);
  const auto worse = [](const Found& a, const Found& b) { return a.badness != b.badness ? a.badness > b.badness : a.cell < b.cell; };
  const auto worst = std::ranges::min_element(all, worse);
  std::vector<std::byte> text(here.what.size());
  std::memcpy(text.data(), here.what.data(), here.what.size());
  comm.broadcast(text, static_cast<int>(worst - all.begin()));
  here.what.assign(reinterpret_cast<const char*>(text.data()), text.size());
  here.cell = worst->cell;
  here.badness = worst->badness;
  return here;
}

}  // namespace morula
