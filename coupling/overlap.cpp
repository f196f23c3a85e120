#include "coupling/overlap.h"

#include <algorithm>

#include "core/contact/contact_layer.h"
#include "coupling/mechanics/scene.h"

namespace morula {
namespace {

/// How deep the nucleus of an owned shell lies within its cortex; 0 where it has none [µm].
double nuclear_overlap(const Mechanics& mechanics, std::uint32_t shell) {
  const auto nuclear = mechanics.nucleus_of(shell);
  return nuclear ? nuclear->overlap : mechanics.interior_of(shell).overlap;
}

}  // namespace

Extreme deepest_overlap(Simulation& simulation) {
  const auto& contacts = simulation.mechanics().contacts();
  const auto bodies = simulation.mechanics().scene().bodies();
  Extreme out;
  for (const SurfacePair& pair : contacts.pairs()) {
    const bool surfaces = pair.rigid || (bodies[pair.a].shape == BodyShape::kSurface && bodies[pair.b].shape == BodyShape::kSurface);
    if (!surfaces || pair.overlap <= 0.0) continue;
    out.offer(pair.overlap, pair.rigid ? bodies[pair.a].id : std::min(bodies[pair.a].id, bodies[pair.b].id));
  }
  for (std::uint32_t s = 0; s < simulation.mechanics().scene().owned_shells(); ++s) {
    if (const double overlap = nuclear_overlap(simulation.mechanics(), s); overlap > 0.0) out.offer(overlap, bodies[s].id);
  }
  return out;
}

std::vector<CellId> too_deep(const Mechanics& mechanics, std::span<const CellId> these, double depth) {
  const auto bodies = mechanics.scene().bodies();
  std::vector<CellId> out;
  const auto offer = [&](CellId id) {
    if (std::binary_search(these.begin(), these.end(), id)) out.push_back(id);
  };
  for (const SurfacePair& pair : mechanics.contacts().pairs()) {
    const bool surfaces = pair.rigid || (bodies[pair.a].shape == BodyShape::kSurface && bodies[pair.b].shape == BodyShape::kSurface);
    if (!surfaces || !(pair.overlap > depth)) continue;
    offer(bodies[pair.a].id);
    if (!pair.rigid) offer(bodies[pair.b].id);
  }
  for (std::uint32_t s = 0; s < mechanics.scene().owned_shells(); ++s)
    if (nuclear_overlap(mechanics, s) > depth) offer(bodies[s].id);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace morula
