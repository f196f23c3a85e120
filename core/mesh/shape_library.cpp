#include <algorithm>

#include "core/mesh/topology.h"

namespace morula {

std::shared_ptr<const ReferenceShape> ShapeLibrary::adopt(std::shared_ptr<const ReferenceShape> shape) {
  if (shape->icosphere_nodes != 0) return shape;
  std::erase_if(own_, [](const auto& entry) { return entry.second.expired(); });
  const std::uint64_t hash = shape->topology->hash();
  const auto same_faces = [&](const ReferenceShape& other) {
    return std::ranges::equal(other.topology->faces(), shape->topology->faces());
  };
  if (auto known = find(hash, [&](const ReferenceShape& other) {
        return same_faces(other) && other.position == shape->position && other.edge_length == shape->edge_length &&
               other.face_area == shape->face_area && other.hinge_angle == shape->hinge_angle;
      }))
    return known;
  std::shared_ptr<const ReferenceShape> alike = find(hash, same_faces);
  for (const auto& icosphere : icospheres_)
    if (!alike && icosphere && icosphere->topology->hash() == hash && same_faces(*icosphere)) alike = icosphere;
  if (alike && alike->topology != shape->topology) {
    auto with_its_topology = std::make_shared<ReferenceShape>(*shape);
    with_its_topology->topology = alike->topology;
    shape = std::move(with_its_topology);
  }
  own_.emplace(hash, shape);
  return shape;
}

}  // namespace morula
