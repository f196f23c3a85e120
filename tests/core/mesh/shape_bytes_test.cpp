#include "core/mesh/shape_bytes.h"

#include <gtest/gtest.h>

#include "core/mesh/icosphere.h"

namespace morula {
namespace {

/// An icosphere whose first node stands out: the faces of the icosphere, another shape.
std::shared_ptr<const ReferenceShape> dented(double by) {
  TriangleMesh mesh = make_icosphere(1);
  mesh.position[0] *= 1.0 + by;
  return make_reference_shape(*Topology::build(42, mesh.faces), mesh.position);
}

std::shared_ptr<const ReferenceShape> sent(const ReferenceShape& shape, ShapeLibrary& to) {
  std::vector<std::byte> bytes;
  append_shape(shape, bytes);
  bytes.push_back(std::byte{7});
  std::span<const std::byte> rest(bytes);
  auto out = read_shape(rest, to);
  EXPECT_EQ(rest.size(), 1u) << "reads exactly what was written";
  return out;
}

TEST(ShapeBytes, CarryAShapeBitForBit) {
  const auto shape = dented(0.2);
  ShapeLibrary there;
  const auto got = sent(*shape, there);
  EXPECT_EQ(got->position, shape->position);
  EXPECT_EQ(got->edge_length, shape->edge_length);
  EXPECT_EQ(got->face_area, shape->face_area);
  EXPECT_EQ(got->hinge_angle, shape->hinge_angle);
  EXPECT_EQ(got->topology->hash(), shape->topology->hash());
  EXPECT_EQ(sent(*shape, there), got) << "a shape that is known is not made again";
}

TEST(ShapeBytes, TellIcospheresByTheirNodes) {
  ShapeLibrary here, there;
  std::vector<std::byte> bytes;
  append_shape(**here.icosphere(162), bytes);
  EXPECT_EQ(bytes.size(), sizeof(std::uint32_t));
  EXPECT_EQ(sent(**here.icosphere(162), there), *there.icosphere(162));
}

TEST(ShapeLibrary, KeepsEqualShapesOnceAndTopologiesOfEqualFaces) {
  ShapeLibrary library;
  const auto icosphere = *library.icosphere(42);
  const auto a = library.adopt(dented(0.2)), again = library.adopt(dented(0.2)), b = library.adopt(dented(0.3));
  EXPECT_EQ(a, again);
  EXPECT_NE(a, b);
  EXPECT_EQ(a->topology, icosphere->topology) << "so that they are computed in the same lanes";
  EXPECT_EQ(a->topology, b->topology);
  EXPECT_EQ(library.adopt(icosphere), icosphere);
}

TEST(ShapeLibrary, ForgetsShapesThatNobodyHas) {
  ShapeLibrary library;
  const std::weak_ptr<const ReferenceShape> gone = library.adopt(dented(0.2));
  EXPECT_TRUE(gone.expired());
  EXPECT_NE(library.adopt(dented(0.2)), nullptr);
}

}  // namespace
}  // namespace morula
