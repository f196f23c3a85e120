#include "coupling/mechanics/body_factors.h"

#include <bit>
#include <cstdint>

namespace morula {
namespace {

bool any_varies(const Model& model, Trait trait) { return !model.types.empty() && model.types.front().traits.variable_of(trait); }

}  // namespace

std::vector<double> factors_of_bodies(const World& world, Trait trait) {
  if (!any_varies(world.model, trait)) return {};
  const Scene& scene = world.scene;
  std::vector<std::uint64_t> bits(scene.bodies().size());
  for (const BodyOfRow& body : bodies_of(world.tissue.cells)) {
    const CellType& type = world.model.types[world.tissue.cells.rows[body.row].type];
    const std::size_t place = body.is_shell ? body.number : scene.first_sphere() + body.number;
    bits[place] = std::bit_cast<std::uint64_t>(1.0 + world.tissue.cells.deviation(body.row, type, trait));
  }
  scene.exchange_bodies(bits);
  std::vector<double> out;
  out.reserve(bits.size());
  for (const std::uint64_t b : bits) out.push_back(std::bit_cast<double>(b));
  return out;
}

std::vector<double> deviations_of_shells(const Model& model, const Cells& cells, Trait trait) {
  std::vector<double> out;
  if (!any_varies(model, trait)) return out;
  for (const BodyOfRow& body : bodies_of(cells))
    if (body.is_shell) out.push_back(cells.deviation(body.row, model.types[cells.rows[body.row].type], trait));
  return out;
}

}  // namespace morula
