#include "core/mesh/shape_bytes.h"

#include <algorithm>
#include <cstring>

namespace morula {
namespace {

template <class T>
void put(std::vector<std::byte>& out, std::span<const T> items) {
  const auto bytes = std::as_bytes(items);
  out.insert(out.end(), bytes.begin(), bytes.end());
}
template <class T>
void put(std::vector<std::byte>& out, const T& item) {
  put(out, std::span(&item, 1));
}

template <class T>
std::vector<T> take(std::span<const std::byte>& bytes, std::size_t count) {
  std::vector<T> out(count);
  if (count > 0) std::memcpy(static_cast<void*>(out.data()), bytes.data(), count * sizeof(T));
  bytes = bytes.subspan(count * sizeof(T));
  return out;
}

}  // namespace

void append_shape(const ReferenceShape& shape, std::vector<std::byte>& out) {
  put(out, shape.icosphere_nodes);
  if (shape.icosphere_nodes != 0) return;
  put(out, shape.topology->hash());
  put(out, shape.topology->node_count());
  put(out, shape.topology->face_count());
  put(out, shape.topology->edge_count());
  put(out, shape.topology->faces());
  put(out, std::span<const Vec3d>(shape.position));
  for (const auto* numbers : {&shape.edge_length, &shape.face_area, &shape.hinge_angle}) put(out, std::span<const double>(*numbers));
}

std::shared_ptr<const ReferenceShape> read_shape(std::span<const std::byte>& bytes, ShapeLibrary& library) {
  if (const std::uint32_t nodes = take<std::uint32_t>(bytes, 1)[0]; nodes != 0) return library.icosphere(nodes).value();
  const auto hash = take<std::uint64_t>(bytes, 1)[0];
  const auto counts = take<std::uint32_t>(bytes, 3);
  auto faces = take<Triangle>(bytes, counts[1]);
  ReferenceShape shape;
  shape.position = take<Vec3d>(bytes, counts[0]);
  shape.edge_length = take<double>(bytes, counts[2]);
  shape.face_area = take<double>(bytes, counts[1]);
  shape.hinge_angle = take<double>(bytes, counts[2]);
  auto known = library.find(hash, [&](const ReferenceShape& other) {
    return std::ranges::equal(other.topology->faces(), faces) && other.position == shape.position &&
           other.edge_length == shape.edge_length && other.face_area == shape.face_area && other.hinge_angle == shape.hinge_angle;
  });
  if (known) return known;
  shape.topology = Topology::build(counts[0], std::move(faces)).value();
  return library.adopt(std::make_shared<const ReferenceShape>(std::move(shape)));
}

}  // namespace morula
