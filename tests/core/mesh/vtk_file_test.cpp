#include "core/mesh/vtk_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "core/mesh/mesh_check.h"
#include "core/mesh/topology.h"

namespace morula {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A tetrahedron with corners at the origin and at 1 along the axes, outwards: volume 1/6.
const std::string kPoints = "POINTS 4 float\n0 0 0 1 0 0\n0 1 0 0 0 1\n";
const std::string kPolygons = "POLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

std::string polydata(const std::string& rest) { return "# vtk DataFile Version 4.2\na title\nASCII\nDATASET POLYDATA\n" + rest; }
std::string grid(const std::string& rest) { return "# vtk DataFile Version 4.2\na title\nASCII\nDATASET UNSTRUCTURED_GRID\n" + rest; }

LabelledMesh parsed(const std::string& content, double scale = 1.0) {
  auto mesh = parse_vtk("a.vtk", content, scale);
  EXPECT_TRUE(mesh.ok()) << mesh.error().message;
  return mesh.ok() ? std::move(mesh).value() : LabelledMesh{};
}

std::string failure(const std::string& content) {
  const auto mesh = parse_vtk("a.vtk", content, 1.0);
  if (mesh.ok()) {
    ADD_FAILURE() << "the file was accepted";
    return "";
  }
  EXPECT_EQ(mesh.error().kind, ErrorKind::kFile);
  EXPECT_FALSE(mesh.error().help.empty());
  return mesh.error().message;
}

double volume(const LabelledMesh& mesh) { return enclosed_volume(mesh.mesh.faces, mesh.mesh.position, {}); }

/// Big-endian bytes of numbers.
template <class T>
std::string bytes(std::initializer_list<T> numbers) {
  std::string out;
  for (const T number : numbers) {
    char raw[sizeof(T)];
    std::memcpy(raw, &number, sizeof(T));
    out.append(std::make_reverse_iterator(raw + sizeof(T)), std::make_reverse_iterator(raw));
  }
  return out;
}

TEST(VtkFile, ReadsPolygonsWithTheirArraysPassingOverMetadata) {
  const LabelledMesh mesh = parsed(polydata(kPoints + "METADATA\nINFORMATION 1\nNAME X LOCATION Y\nDATA 2 1 2\n\n" + kPolygons +
                                            "CELL_DATA 4\nSCALARS cell%20id int 1\nLOOKUP_TABLE default\n7 7 8 8\n"
                                            "FIELD FieldData 1\npressure 1 4 double\n1 2 3 4e-1\nMETADATA\nINFORMATION 0\n\n"
                                            "POINT_DATA 4\nVECTORS v float\n0 0 0 1 1 1 2 2 2 3 3 3\n"));
  EXPECT_DOUBLE_EQ(volume(mesh), 1.0 / 6.0);
  EXPECT_THAT(mesh.part, ElementsAre(0, 1, 2, 3));
  ASSERT_EQ(mesh.part_arrays.size(), 2u);
  EXPECT_EQ(mesh.part_arrays[0].name, "cell id");
  EXPECT_THAT(mesh.part_arrays[0].values, ElementsAre(7, 7, 8, 8));
  EXPECT_DOUBLE_EQ(mesh.part_arrays[1].values[3], 0.4);
  ASSERT_EQ(mesh.point_arrays.size(), 1u);
  EXPECT_EQ(mesh.point_arrays[0].components, 3u);
}

TEST(VtkFile, ReadsPolyhedraAndScalesThem) {
  const LabelledMesh mesh = parsed(grid(kPoints + "CELLS 1 18\n17 4  3 0 2 1  3 0 1 3  3 0 3 2  3 1 2 3\nCELL_TYPES 1\n42\n"), 2.0);
  EXPECT_DOUBLE_EQ(volume(mesh), 8.0 / 6.0);
  EXPECT_EQ(mesh.part_count, 1u);
  EXPECT_TRUE(mesh.is_closed[0]);
  EXPECT_THAT(mesh.part, ElementsAre(0, 0, 0, 0));
}

TEST(VtkFile, ReadsOffsetsOfVersionFive) {
  const LabelledMesh mesh = parsed("# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\n" + kPoints +
                                   "POLYGONS 5 12\nOFFSETS vtktypeint64\n0 3 6 9 12\nCONNECTIVITY vtktypeint64\n0 2 1 0 1 3 0 3 2 1 2 3\n");
  EXPECT_DOUBLE_EQ(volume(mesh), 1.0 / 6.0);
}

TEST(VtkFile, ReadsBinaryPolygonsAndArraysBigEndian) {
  const std::string content =
      "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 4 double\n" + bytes<double>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
      "\nPOLYGONS 4 16\n" + bytes<std::int32_t>({3, 0, 2, 1, 3, 0, 1, 3, 3, 0, 3, 2, 3, 1, 2, 3}) +
      "\nCELL_DATA 4\nFIELD FieldData 3\nid 1 4 short\n" + bytes<std::int16_t>({-1, 2, 300, 4}) + "\np 1 4 float\n" +
      bytes<float>({0.5f, -1.5f, 2.0f, 3.0f}) + "\nbig 1 4 unsigned_char\n" + bytes<std::uint8_t>({1, 2, 3, 255}) + "\n";
  const LabelledMesh mesh = parsed(content);
  EXPECT_DOUBLE_EQ(volume(mesh), 1.0 / 6.0);
  EXPECT_THAT(mesh.part_arrays[0].values, ElementsAre(-1, 2, 300, 4));
  EXPECT_THAT(mesh.part_arrays[1].values, ElementsAre(0.5, -1.5, 2.0, 3.0));
  EXPECT_THAT(mesh.part_arrays[2].values, ElementsAre(1, 2, 3, 255));
  EXPECT_THAT(failure(content.substr(0, 120)), HasSubstr("announced here"));
}

TEST(VtkFile, SplitsPolygonsIntoFansAndTurnsEverySecondTriangleOfAStrip) {
  // A box of quadrilaterals, one of them a pixel; and the faces of a tetrahedron as a strip and a triangle.
  const std::string corners = "POINTS 8 float\n0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n";
  const LabelledMesh box =
      parsed(grid(corners + "CELLS 6 30\n4 0 3 2 1 4 4 5 7 6 4 0 1 5 4 4 1 2 6 5 4 2 3 7 6 4 3 0 4 7\nCELL_TYPES 6\n9 8 7 9 9 9\n"));
  EXPECT_DOUBLE_EQ(volume(box), 1.0);
  EXPECT_TRUE(check_mesh(box.mesh.position, box.mesh.faces).empty());
  const LabelledMesh strip = parsed(
      polydata(kPoints + "LINES 1 3\n2 0 1\nTRIANGLE_STRIPS 1 7\n6 0 2 1 3 0 2\nCELL_DATA 2\nSCALARS s int\nLOOKUP_TABLE default\n5 6\n"));
  EXPECT_TRUE(check_mesh(strip.mesh.position, strip.mesh.faces).empty());
  EXPECT_THAT(strip.part, ElementsAre(1, 1, 1, 1)) << "the line is cell 0";
}

TEST(VtkFile, CountsThatDoNotFitASizeAreNoSmallNumbers) {
  // 6148914691236517206 × 3 and 4611686018427387904 × 4 are 2 and 0 in 64 bits.
  for (const std::string& text :
       {polydata("POINTS 6148914691236517206 float\n0 0\n"),
        polydata(kPoints + kPolygons + "CELL_DATA 4611686018427387904\nSCALARS a float 4\nLOOKUP_TABLE default\n"),
        polydata(kPoints + kPolygons + "FIELD f 1\na 4 4611686018427387904 float\n1\n"),
        polydata(kPoints + kPolygons + "LOOKUP_TABLE t 4611686018427387904\n1\n"),
        polydata(kPoints + "POLYGONS 9223372036854775807 9223372036854775807\n3 0 1 2\n"),
        polydata(kPoints + kPolygons + "FIELD f 1\na 9223372036854775807 9223372036854775807 string\nx\n")})
    EXPECT_THAT(failure(text), HasSubstr("the file ends")) << text;
}

TEST(VtkFile, NamesWhatIsWrongAndWhere) {
  EXPECT_THAT(failure("<?xml version=\"1.0\"?>\n<VTKFile>"), HasSubstr("XML"));
  EXPECT_THAT(failure(std::string("\x7f\x45\x00\x01\xff", 5)), HasSubstr("is no legacy VTK file"));
  EXPECT_THAT(failure("# vtk DataFile Version 4.2\nt\nTEXT\n"), HasSubstr("a.vtk:3: 'TEXT'"));
  EXPECT_THAT(failure("# vtk DataFile Version 4.2\nt\nASCII\nDATASET STRUCTURED_POINTS\n"), HasSubstr("holds no surfaces"));
  EXPECT_THAT(failure(polydata(kPoints)), HasSubstr("holds no faces"));
  EXPECT_THAT(failure(polydata("POINTS 4 float\n0 0 0 1 0 0\n0 1 0 0 0 nan\n" + kPolygons)),
              HasSubstr("point 3 has a coordinate that is not finite"));
  EXPECT_THAT(failure(polydata("POINTS 4 float\n0 0 0 1 0 0\n0 1 0 0 0 x\n" + kPolygons)), HasSubstr("a.vtk:7: 'x' is not a number"));
  EXPECT_THAT(failure(polydata("POINTS 5 float\n0 0 0 1 0 0\n0 1 0 0 0 1\n" + kPolygons)), HasSubstr("'POLYGONS' is not a number"));
  EXPECT_THAT(failure(polydata("POINTS 99999999999 float\n0 0 0")), HasSubstr("announced here"));
  EXPECT_THAT(failure(polydata("POINTS -1 float\n0 0 0")), HasSubstr("'-1' stands where the number of points should be"));
  EXPECT_THAT(failure(polydata(kPoints + "POLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 4\n")),
              HasSubstr("names point 4, which does not exist"));
  EXPECT_THAT(failure(polydata(kPoints + "POLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 0 3 2\n4 1 2 3\n")), HasSubstr("ends inside cell 3"));
  EXPECT_THAT(failure(polydata(kPoints + "POLYGONS 1 3\n2 0 1\n")), HasSubstr("has only 2 points"));
  EXPECT_THAT(failure(grid(kPoints + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n")), HasSubstr("the VTK cell type 10"));
  EXPECT_THAT(failure(grid(kPoints + "CELLS 1 5\n4 0 1 2 3\n")), HasSubstr("0 cell types"));
  EXPECT_THAT(failure(grid(kPoints + "CELLS 1 6\n5 2 3 0 1 2\nCELL_TYPES 1\n42\n")), HasSubstr("do not fit its length"));
  EXPECT_THAT(failure(polydata(kPoints + kPolygons + "CELL_DATA 3\nSCALARS s int\nLOOKUP_TABLE default\n1 2 3\n")),
              HasSubstr("3 values for 4 cells"));
  EXPECT_THAT(failure(polydata(kPoints + kPolygons + "17 18\n")), HasSubstr("'17' is not known"));
}

}  // namespace
}  // namespace morula
