#include "cbm/crowded_area.h"

#include <cmath>
#include <string>

#include "core/numbers/number_text.h"

namespace morula::cbm {
namespace {

Error refused(const char* what, double before, double after) {
  return Error{ErrorKind::kInput,
               std::string(what) + ", but it goes from " + number_text("%.6g", before) + " to " + number_text("%.6g", after),
               "both are contact areas over the surface of a cell, as {pairs: 60 %, cells: 68 %}"};
}

}  // namespace

Result<CrowdedArea> CrowdedArea::through(std::span<const CrowdedKnot> knots) {
  if (knots.empty()) return Error{ErrorKind::kInput, "a curve of contact areas needs at least one knot", "leave it out"};
  CrowdedKnot before;
  for (const CrowdedKnot& knot : knots) {
    if (!(knot.pairs > before.pairs) || !std::isfinite(knot.pairs))
      return refused("the part that pairs say must be above 0 and increase", before.pairs, knot.pairs);
    if (!(knot.cells >= 0.0) || !std::isfinite(knot.cells))
      return refused("the part of the cells must not be negative", before.cells, knot.cells);
    before = knot;
  }
  CrowdedArea out;
  out.knots_.assign(knots.begin(), knots.end());
  return out;
}

double CrowdedArea::at(double pairs) const noexcept {
  if (empty()) return pairs;
  const CrowdedKnot &first = knots_.front(), &last = knots_.back();
  if (pairs <= first.pairs) return pairs * first.cells / first.pairs;
  if (pairs >= last.pairs) return pairs * last.cells / last.pairs;
  std::size_t k = 0;
  while (pairs > knots_[k + 1].pairs) ++k;
  const CrowdedKnot &a = knots_[k], &b = knots_[k + 1];
  return a.cells + (pairs - a.pairs) / (b.pairs - a.pairs) * (b.cells - a.cells);
}

LawInfo crowded_area_law() {
  return {.name = "crowded_area",
          .title = "Contact area among many neighbours, as it is told",
          .equation = "A = S h(Σ_j A_ij/S), S = 4πR²; h straight between the knots of the file; forces are those of pairs and of packing",
          .source = "contact areas of shells in random packings, beside those of spheres in their place (decision 0071)",
          .parameters = {given_by_study("pairs_first", "fraction", "1", "First Σ_j A_ij/S of the curve: two cells at rest."),
                         given_by_study("pairs_last", "fraction", "1", "Last Σ_j A_ij/S of the curve."),
                         given_by_study("cells_last", "fraction", "1", "A/S of cells there.")}};
}

}  // namespace morula::cbm
