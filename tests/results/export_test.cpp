#include <array>
#include <cmath>
#include <map>
#include <regex>
#include <set>

#include "results/export.h"
#include "results/snapshot_file.h"
#include "results/vtk_writer.h"
#include "tests/results/results_support.h"

namespace morula::scenarios {
namespace {

using namespace testing_support;

/// Two shells (a tetrahedron, an icosphere) and a sphere, one field.
Snapshot small_snapshot(ShapeLibrary& library, double time) {
  Snapshot s;
  s.time = time;
  s.type_names = {"a & b", "liver"};
  for (const auto& shape : {tetrahedron(), library.icosphere(42).value()}) {
    Snapshot::Cell cell;
    cell.id = CellId::founder(s.cells.size() + 1).daughter(1);
    cell.body = BodyKind::kShell;
    cell.pressure = 0.25 * static_cast<double>(s.cells.size() + 1);
    s.shells.push_back({static_cast<std::uint32_t>(s.cells.size()), static_cast<std::uint32_t>(s.nodes.size()),
                        shape->topology->node_count(), static_cast<std::uint32_t>(s.topologies.size())});
    s.topologies.emplace_back(shape->topology->faces().begin(), shape->topology->faces().end());
    s.nodes.insert(s.nodes.end(), shape->position.begin(), shape->position.end());
    s.cells.push_back(cell);
  }
  Snapshot::Cell sphere;
  sphere.id = CellId::founder(9);
  sphere.type = 1;
  sphere.centroid = {1, 2, 3};
  sphere.radius = 5.5;
  s.cells.push_back(sphere);
  s.variables.push_back({"concentration/oxygen", "mM", std::vector<double>(s.cells.size(), 0.0)});
  s.variables.back().values.back() = 0.2;
  s.variables.push_back({"amount/oxygen", "amol", std::vector<double>(s.cells.size(), 7.5)});
  s.fields.push_back({"oxygen", {-1, -2, -3}, {0.5, 1, 2}, {2, 3, 1}, {0, 1, 2, 3, 4, 5}});
  return s;
}

/// A strict reader of the XML that we write: tags nest, attributes are quoted, only known entities; calls `element` at each end tag with its text.
struct Element {
  std::string name, text;
  std::map<std::string, std::string> attributes;
};
bool parse_xml(const std::string& xml, std::vector<Element>& done) {
  static const std::regex kAttribute(R"re(^\s+([A-Za-z_]+)="([^"<]*)")re");
  std::size_t at = xml.find("?>");
  if (xml.rfind("<?xml version=\"1.0\"", 0) != 0 || at == std::string::npos) return false;
  at += 2;
  std::vector<Element> open;
  while (at < xml.size()) {
    if (xml[at] != '<') {
      const std::size_t next = std::min(xml.find('<', at), xml.size());
      const std::string text = xml.substr(at, next - at);
      if (open.empty() && text.find_first_not_of(" \n") != std::string::npos) return false;
      if (!open.empty()) open.back().text += text;
      at = next;
      continue;
    }
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return false;
    std::string tag = xml.substr(at + 1, end - at - 1);
    at = end + 1;
    if (tag[0] == '/') {
      if (open.empty() || open.back().name != tag.substr(1)) return false;
      done.push_back(open.back());
      open.pop_back();
      continue;
    }
    const bool closed = tag.back() == '/';
    if (closed) tag.pop_back();
    Element element;
    const std::size_t name_end = tag.find_first_of(" \n");
    element.name = tag.substr(0, name_end);
    std::string rest = name_end == std::string::npos ? "" : tag.substr(name_end);
    for (std::smatch match; std::regex_search(rest, match, kAttribute); rest = match.suffix()) {
      static const std::regex kBareAmpersand("&(?!amp;|lt;|gt;|quot;)");
      if (!element.attributes.emplace(match[1], match[2]).second || std::regex_search(match[2].first, match[2].second, kBareAmpersand))
        return false;
    }
    if (rest.find_first_not_of(" \n") != std::string::npos) return false;
    if (closed)
      done.push_back(element);
    else
      open.push_back(element);
  }
  return open.empty();
}

std::string unbase64(const std::string& text) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  unsigned group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    group = group << 6 | static_cast<unsigned>(kDigits.find(c));
    bits += 6;
    if (bits >= 8) out += static_cast<char>(group >> (bits -= 8));
  }
  return out;
}

template <class T>
std::vector<T> values_of(const std::vector<Element>& elements, const std::string& name) {
  for (const Element& e : elements) {
    const auto label = e.attributes.find("Name");
    if (e.name != "DataArray" || label == e.attributes.end() || label->second != name) continue;
    const std::string bytes = unbase64(e.text);
    std::uint64_t length = 0;
    if (bytes.size() < 8) break;
    std::memcpy(&length, bytes.data(), 8);
    EXPECT_EQ(length, bytes.size() - 8) << name;
    std::vector<T> values(length / sizeof(T));
    std::memcpy(values.data(), bytes.data() + 8, values.size() * sizeof(T));
    return values;
  }
  ADD_FAILURE() << "no array " << name;
  return {};
}

std::set<std::string> array_names(const std::vector<Element>& elements) {
  std::set<std::string> names;
  for (const Element& e : elements)
    if (e.name == "DataArray") names.insert(e.attributes.at("type") + ' ' + e.attributes.at("Name"));
  return names;
}

// RFC 4648, section 10.
TEST(Base64, GivesTheKnownAnswers) {
  const auto encode = [](const std::string& text) { return base64(std::as_bytes(std::span(text))); };
  EXPECT_EQ(encode(""), "");
  EXPECT_EQ(encode("f"), "Zg==");
  EXPECT_EQ(encode("fo"), "Zm8=");
  EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
}

struct Exports : ::testing::Test {
  Comm comm{MPI_COMM_SELF};
  ShapeLibrary library;
  Folder folder{comm};
  std::vector<Element> parsed(const std::string& name) {
    std::vector<Element> elements;
    EXPECT_TRUE(parse_xml(slurp(folder / name), elements)) << name;
    return elements;
  }
};

TEST_F(Exports, ShellsBecomeTrianglesWithTheNumbersOfTheirCells) {
  const Snapshot s = small_snapshot(library, 60.0);
  ASSERT_TRUE(write_vtk(s, folder.path(), 3).ok());
  const auto elements = parsed("shells_000003.vtu");
  const auto points = values_of<double>(elements, "Points");
  ASSERT_EQ(points.size(), 3 * s.nodes.size());
  EXPECT_EQ(points[3 * 5 + 1], s.nodes[5].y);
  const auto corners = values_of<std::int64_t>(elements, "connectivity");
  ASSERT_EQ(corners.size(), 3u * (4 + 80));
  EXPECT_EQ(corners[3 * 4], 4 + std::int64_t{s.topologies[1][0][0]});
  EXPECT_EQ(values_of<std::int64_t>(elements, "offsets").back(), 3 * 84);
  EXPECT_EQ(values_of<std::uint8_t>(elements, "types"), std::vector<std::uint8_t>(84, 5));
  const auto ids = values_of<std::uint64_t>(elements, "cell_id");
  ASSERT_EQ(ids.size(), 84u);
  EXPECT_EQ(ids[3], s.cells[0].id.bits());
  EXPECT_EQ(ids[4], s.cells[1].id.bits());
  EXPECT_EQ(values_of<double>(elements, "pressure [kPa]")[4], 0.5);
}

TEST_F(Exports, SpheresBecomePointsWithRadius) {
  ASSERT_TRUE(write_vtk(small_snapshot(library, 60.0), folder.path(), 0).ok());
  const auto elements = parsed("spheres_000000.vtu");
  EXPECT_EQ(values_of<double>(elements, "Points"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(values_of<double>(elements, "radius [um]"), std::vector<double>{5.5});
  EXPECT_EQ(values_of<double>(elements, "oxygen [mM]"), std::vector<double>{0.2});
  EXPECT_EQ(values_of<std::uint16_t>(elements, "type"), std::vector<std::uint16_t>{1});
}

TEST_F(Exports, FieldsBecomeVoxels) {
  ASSERT_TRUE(write_vtk(small_snapshot(library, 60.0), folder.path(), 0).ok());
  const auto elements = parsed("field_oxygen_000000.vti");
  EXPECT_EQ(values_of<double>(elements, "oxygen [mM]"), (std::vector<double>{0, 1, 2, 3, 4, 5}));
  for (const Element& e : elements) {
    if (e.name == "ImageData") {
      EXPECT_EQ(e.attributes.at("WholeExtent"), "0 2 0 3 0 1");
      EXPECT_EQ(e.attributes.at("Origin"), "-1 -2 -3");
      EXPECT_EQ(e.attributes.at("Spacing"), "0.5 1 2");
    }
  }
}

TEST_F(Exports, FieldDataSaysWhatTheNumbersOfKindsMeanWithoutStrings) {
  ASSERT_TRUE(write_vtk(small_snapshot(library, 60.0), folder.path(), 0).ok());
  std::map<std::string, std::string> numbers;
  for (const Element& e : parsed("shells_000000.vtu")) {
    EXPECT_NE(e.name, "Array") << "meshio reads no arrays of strings";
    if (e.name == "DataArray" && e.attributes.at("format") == "ascii") numbers[e.attributes.at("Name")] = e.text;
  }
  EXPECT_EQ(numbers.at("type liver"), "1");
  EXPECT_EQ(numbers.at("body shell"), "1");
  EXPECT_EQ(numbers.at("phase dying"), "3");
  EXPECT_EQ(numbers.at("TimeValue"), "60");
}

TEST_F(Exports, ObstaclesAreWhereTheyHaveMovedTo) {
  Snapshot s = small_snapshot(library, 60.0);
  s.obstacles = {{"plate", {0, 0, 3}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}};
  ASSERT_TRUE(write_vtk(s, folder.path(), 0).ok());
  const auto elements = parsed("obstacles_000000.vtu");
  EXPECT_EQ(values_of<double>(elements, "Points"), (std::vector<double>{0, 0, 3, 1, 0, 3, 0, 1, 3}));
  EXPECT_EQ(values_of<std::int32_t>(elements, "obstacle"), std::vector<std::int32_t>{0});
}

TEST_F(Exports, AllArraysAreInEveryFileAlsoInAnEmptyOne) {
  Snapshot empty = small_snapshot(library, 0.0);
  empty.cells.clear();
  empty.shells.clear();
  empty.nodes.clear();
  empty.topologies.clear();
  ASSERT_TRUE(write_vtk(empty, folder.path(), 0).ok());
  ASSERT_TRUE(write_vtk(small_snapshot(library, 60.0), folder.path(), 1).ok());
  EXPECT_EQ(array_names(parsed("shells_000000.vtu")), array_names(parsed("shells_000001.vtu")));
  EXPECT_EQ(array_names(parsed("spheres_000000.vtu")), array_names(parsed("spheres_000001.vtu")));
  EXPECT_GT(array_names(parsed("shells_000001.vtu")).size(), 12u);
}

TEST_F(Exports, OfARunHaveCollectionsWithAllTimesFromTheStart) {
  for (const double time : {0.0, 60.0, 120.0}) {
    Snapshot s = small_snapshot(library, time);
    ASSERT_TRUE(append_snapshot(folder / "results.h5", s, std::vector<fields::Field>{make_field(0, comm, 1)}, comm).ok());
  }
  const auto count = export_snapshots(folder / "results.h5", folder / "vtk", ExportFormat::kVtk, {});
  ASSERT_TRUE(count.ok()) << count.error().message;
  EXPECT_EQ(*count, 3u);
  for (const std::string stem : {"shells", "spheres", "field_oxygen"}) {
    std::vector<Element> elements = parsed("vtk/" + stem + ".pvd");
    std::vector<std::string> times;
    for (const Element& e : elements) {
      if (e.name != "DataSet") continue;
      times.push_back(e.attributes.at("timestep"));
      EXPECT_FALSE(parsed("vtk/" + e.attributes.at("file")).empty());
    }
    EXPECT_EQ(times, (std::vector<std::string>{"0", "60", "120"})) << stem;
  }
  const auto some = export_snapshots(folder / "results.h5", folder / "csv", ExportFormat::kCsv, {2, 0.0, 1e9});
  ASSERT_TRUE(some.ok());
  EXPECT_EQ(*some, 2u);
  EXPECT_EQ(export_snapshots(folder / "results.h5", folder / "csv", ExportFormat::kCsv, {1, 500.0, 1e9}).error().kind, ErrorKind::kInput);
}

TEST_F(Exports, CsvHasUnitsInTheHeaderAndOneLineACell) {
  const std::string csv = cells_as_csv(small_snapshot(library, 0.0));
  const std::string header = csv.substr(0, csv.find('\n'));
  EXPECT_EQ(header,
            "id,parent,type,body,phase,x [um],y [um],z [um],volume [um^3],area [um^2],pressure [kPa],"
            "inner_pressure [kPa],stress_xx [kPa],stress_xy [kPa],stress_xz [kPa],stress_yy [kPa],stress_yz [kPa],stress_zz [kPa],"
            "contact_area [um^2],age [s],radius [um],oxygen [mM],amount of oxygen [amol]");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_NE(csv.find("\n9,0,liver,sphere,growing,1,2,3,"), std::string::npos) << csv;
  const auto commas = std::count(header.begin(), header.end(), ',');
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas) << line;
}

TEST_F(Exports, StlEnclosesTheCellsVolume) {
  const Snapshot s = small_snapshot(library, 0.0);
  const auto volume_of = [&](std::ptrdiff_t cell, std::uint32_t faces) {
    const std::string stl = surfaces_as_stl(s, library, cell).value();
    std::uint32_t count = 0;
    std::memcpy(&count, stl.data() + 80, 4);
    EXPECT_EQ(count, faces);
    EXPECT_EQ(stl.size(), 84 + 50 * std::size_t{count});
    double volume = 0.0;
    for (std::uint32_t f = 0; f < count; ++f) {
      std::array<float, 12> v;
      std::memcpy(v.data(), stl.data() + 84 + 50 * f, 48);
      const Vec3d a{v[3], v[4], v[5]}, b{v[6], v[7], v[8]}, c{v[9], v[10], v[11]};
      volume += dot(a, cross(b, c)) / 6.0;
    }
    return volume;
  };
  EXPECT_NEAR(volume_of(0, 4), 1.0, 1e-6);  // a reference shape has volume 1
  EXPECT_NEAR(volume_of(1, 80), 1.0, 1e-6);
  const double ball = 4.0 / 3.0 * std::acos(-1.0) * std::pow(5.5, 3);
  EXPECT_NEAR(volume_of(2, 320), ball, 0.04 * ball);  // inscribed with 162 nodes
  EXPECT_NEAR(volume_of(-1, 404), ball + 2.0, 0.04 * ball);
}

}  // namespace
}  // namespace morula::scenarios
