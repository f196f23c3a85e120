#include "core/mesh/vtk_file.h"

#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "core/mesh/surface_bytes.h"
#include "core/mesh/text_words.h"
#include "core/mesh/vtk_words.h"

namespace morula {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWriteAgain = "it is truncated or damaged; write it again";

/// Lists of nodes, one after the other: cell c has nodes[first[c]] … nodes[first[c + 1] − 1].
struct CellLists {
  std::vector<std::int64_t> nodes;
  std::vector<std::size_t> first{0};

  [[nodiscard]] std::size_t size() const { return first.size() - 1; }
  [[nodiscard]] std::span<const std::int64_t> of(std::size_t cell) const {
    return std::span(nodes).subspan(first[cell], first[cell + 1] - first[cell]);
  }
};

/// Numbers of VTK's cell types that are surfaces or nothing at all.
enum CellType : std::int64_t {
  kVertex = 1,
  kPolyVertex = 2,
  kLine = 3,
  kPolyLine = 4,
  kTriangle = 5,
  kTriangleStrip = 6,
  kPolygon = 7,
  kPixel = 8,
  kQuad = 9,
  kPolyhedron = 42
};

class VtkParser {
 public:
  VtkParser(const fs::path& file, std::string_view content, double scale) : file_(file), words_(file, content), scale_(scale) {}

  Result<LabelledMesh> run() {
    MORULA_TRY(read_header());
    for (std::string_view keyword = words_.word(); !keyword.empty(); keyword = words_.word()) MORULA_TRY(read_block(keyword));
    MORULA_TRY(assemble());
    return std::move(out_);
  }

 private:
  Status read_header();
  Status read_block(std::string_view keyword);
  Status read_points();
  Result<CellLists> read_cells();
  Status read_array(std::string_view keyword);
  Status read_field();
  Status skip_strings(std::size_t rows, std::size_t width);
  Status keep(std::string_view name, std::size_t components, std::size_t tuples, std::string_view type);
  Status assemble();
  Status add_cell(std::uint32_t part, std::int64_t type, std::span<const std::int64_t> nodes);
  Status add_polygon(std::uint32_t part, std::span<const std::int64_t> nodes);
  Status add_strip(std::uint32_t part, std::span<const std::int64_t> nodes);
  Result<Triangle> triangle(std::uint32_t part, std::int64_t a, std::int64_t b, std::int64_t c) const;
  [[nodiscard]] Error file_error(const std::string& what, std::string help) const {
    return {ErrorKind::kFile, file_.string() + ": " + what, std::move(help)};
  }

  const fs::path& file_;
  VtkWords words_;
  double scale_;
  LabelledMesh out_;
  bool is_grid_ = false, has_dataset_ = false;
  std::optional<CellLists> vertices_, lines_, polygons_, strips_, cells_;
  std::vector<std::int64_t> types_;
  enum class Where { kNowhere, kPoints, kCells } where_ = Where::kNowhere;
  std::size_t tuples_ = 0;
};

std::string plain_name(std::string_view word) {  // names are written with %20 for a space
  std::string out;
  const auto digit = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : c >= 'A' && c <= 'F' ? c - 'A' + 10 : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
  };
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (word[i] == '%' && i + 2 < word.size() && digit(word[i + 1]) >= 0 && digit(word[i + 2]) >= 0) {
      out += static_cast<char>(16 * digit(word[i + 1]) + digit(word[i + 2]));
      i += 2;
    } else {
      out += word[i];
    }
  }
  return out;
}

Status VtkParser::read_header() {
  const std::string_view first = words_.line();
  if (!first.starts_with("# vtk DataFile Version"))
    return first.find("<?xml") != first.npos || first.find("<VTKFile") != first.npos
               ? file_error("is a VTK file in XML", "save it in the legacy format (.vtk)")
               : file_error("is no legacy VTK file", "its first line begins with '# vtk DataFile Version'");
  words_.line();  // title
  const std::string_view form = words_.word();
  if (form != "ASCII" && form != "BINARY") return words_.error(quoted_word(form) + " stands where ASCII or BINARY should", kWriteAgain);
  words_.set_binary(form == "BINARY");
  return {};
}

Status VtkParser::read_block(std::string_view keyword) {
  if (keyword == "DATASET") {
    const std::string_view kind = words_.word();
    if (kind != "POLYDATA" && kind != "UNSTRUCTURED_GRID")
      return words_.error("a data set of the kind " + quoted_word(kind) + " holds no surfaces",
                          "POLYDATA and UNSTRUCTURED_GRID can be read");
    is_grid_ = kind == "UNSTRUCTURED_GRID";
    has_dataset_ = true;
    return {};
  }
  if (keyword == "METADATA") {
    words_.skip_to_empty_line();
    return {};
  }
  if (keyword == "FIELD") return read_field();
  if (!has_dataset_) return words_.error(quoted_word(keyword) + " stands where DATASET should", kWriteAgain);
  if (keyword == "POINTS") return read_points();
  for (auto& [name, lists] : {std::pair("VERTICES", &vertices_), std::pair("LINES", &lines_), std::pair("POLYGONS", &polygons_),
                              std::pair("TRIANGLE_STRIPS", &strips_), std::pair("CELLS", &cells_)}) {
    if (keyword != name) continue;
    MORULA_TRY_ASSIGN(*lists, read_cells());
    return {};
  }
  if (keyword == "CELL_TYPES") {
    MORULA_TRY_ASSIGN(const std::size_t n, words_.count("the number of cells"));
    MORULA_TRY_ASSIGN(types_, words_.wholes(n, "int"));
    return {};
  }
  if (keyword == "CELL_DATA" || keyword == "POINT_DATA") {
    where_ = keyword == "CELL_DATA" ? Where::kCells : Where::kPoints;
    MORULA_TRY_ASSIGN(tuples_, words_.count("the number of tuples"));
    return {};
  }
  return read_array(keyword);
}

Status VtkParser::read_points() {
  MORULA_TRY_ASSIGN(const std::size_t n, words_.count("the number of points"));
  const std::string_view type = words_.word();
  MORULA_TRY_ASSIGN(const std::vector<double> numbers, words_.numbers(n, 3, type));
  out_.mesh.position.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d p = Vec3d{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]} * scale_;
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      return file_error("point " + std::to_string(i) + " has a coordinate that is not finite", "coordinates must be finite numbers");
    out_.mesh.position.push_back(p);
  }
  return {};
}

/// `n size` and the lists, each with its length first; from version 5.1 on, offsets and nodes in two arrays.
Result<CellLists> VtkParser::read_cells() {
  MORULA_TRY_ASSIGN(const std::size_t n, words_.count("the number of cells"));
  MORULA_TRY_ASSIGN(const std::size_t size, words_.count("the size of the list of cells"));
  CellLists out;
  if (words_.peek() == "OFFSETS") {
    words_.word();
    MORULA_TRY_ASSIGN(const auto offsets, words_.wholes(n, words_.word()));
    if (words_.word() != "CONNECTIVITY") return words_.error("CONNECTIVITY is missing after OFFSETS", kWriteAgain);
    MORULA_TRY_ASSIGN(out.nodes, words_.wholes(size, words_.word()));
    out.first.clear();
    for (const std::int64_t offset : offsets) {
      if (offset < 0 || static_cast<std::size_t>(offset) > size ||
          (!out.first.empty() && static_cast<std::size_t>(offset) < out.first.back()))
        return words_.error("an offset of a cell lies outside the list of nodes", kWriteAgain);
      out.first.push_back(static_cast<std::size_t>(offset));
    }
    if (out.first.empty()) out.first.push_back(0);
    return out;
  }
  MORULA_TRY_ASSIGN(const auto numbers, words_.wholes(size, "int"));
  std::size_t at = 0;
  for (std::size_t cell = 0; cell < n; ++cell) {
    if (at >= size || numbers[at] < 0 || static_cast<std::size_t>(numbers[at]) > size - at - 1)
      return words_.error("the list of cells ends inside cell " + std::to_string(cell), kWriteAgain);
    const auto length = static_cast<std::size_t>(numbers[at++]);
    out.nodes.insert(out.nodes.end(), numbers.begin() + static_cast<std::ptrdiff_t>(at),
                     numbers.begin() + static_cast<std::ptrdiff_t>(at + length));
    out.first.push_back(out.nodes.size());
    at += length;
  }
  return out;
}

Status VtkParser::skip_strings(std::size_t rows, std::size_t width) {
  if (words_.is_binary()) return words_.error("arrays of strings in a binary file cannot be read", "write the file without them");
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t i = 0; i < width; ++i)
      if (words_.word().empty()) return words_.error("the file ends before the strings that are announced", kWriteAgain);
  return {};
}

/// An array of the present section; arrays of the whole data set are passed over.
Status VtkParser::keep(std::string_view name, std::size_t components, std::size_t tuples, std::string_view type) {
  if (type == "string") return skip_strings(tuples, components);
  MORULA_TRY_ASSIGN(std::vector<double> values, words_.numbers(tuples, components, type == "bit" ? "unsigned_char" : type));
  MeshArray array{plain_name(name), components, std::move(values)};
  if (where_ == Where::kCells) out_.part_arrays.push_back(std::move(array));
  if (where_ == Where::kPoints) out_.point_arrays.push_back(std::move(array));
  return {};
}

Status VtkParser::read_field() {
  words_.word();  // its name
  MORULA_TRY_ASSIGN(const std::size_t arrays, words_.count("the number of arrays"));
  for (std::size_t a = 0; a < arrays; ++a) {
    while (words_.peek() == "METADATA") words_.skip_to_empty_line();
    const std::string_view name = words_.word();
    MORULA_TRY_ASSIGN(const std::size_t components, words_.count("the number of components"));
    MORULA_TRY_ASSIGN(const std::size_t tuples, words_.count("the number of tuples"));
    const std::string_view type = words_.word();
    MORULA_TRY(keep(name, components, tuples, type));
  }
  return {};
}

Status VtkParser::read_array(std::string_view keyword) {
  if (keyword == "SCALARS") {
    const std::string_view name = words_.word(), type = words_.word(), width = words_.word_in_line();
    const auto components = width.empty() ? std::optional<long long>(1) : parse_whole(width);
    if (!components || *components < 1) return words_.error(quoted_word(width) + " is no number of components", kWriteAgain);
    if (words_.peek() == "LOOKUP_TABLE") words_.word(), words_.word();
    return keep(name, static_cast<std::size_t>(*components), tuples_, type);
  }
  for (const auto& [word, components] :
       {std::pair("VECTORS", 3u), std::pair("NORMALS", 3u), std::pair("TENSORS", 9u), std::pair("TENSORS6", 6u),
        std::pair("GLOBAL_IDS", 1u), std::pair("PEDIGREE_IDS", 1u), std::pair("EDGE_FLAGS", 1u)}) {
    if (keyword != word) continue;
    const std::string_view name = words_.word(), type = words_.word();
    return keep(name, components, tuples_, type);
  }
  if (keyword == "TEXTURE_COORDINATES" || keyword == "COLOR_SCALARS") {
    const std::string_view name = words_.word();
    MORULA_TRY_ASSIGN(const std::size_t components, words_.count("the number of components"));
    const std::string_view type = keyword == "TEXTURE_COORDINATES" ? words_.word() : words_.is_binary() ? "unsigned_char" : "float";
    return keep(name, components, tuples_, type);
  }
  if (keyword == "LOOKUP_TABLE") {
    words_.word();  // its name
    MORULA_TRY_ASSIGN(const std::size_t size, words_.count("the size of a lookup table"));
    const auto table = words_.numbers(size, 4, words_.is_binary() ? "unsigned_char" : "float");
    return table.ok() ? Status{} : Status(table.error());
  }
  return words_.error(quoted_word(keyword) + " is not known",
                      "fewer or more numbers follow than are announced, or this is no legacy VTK file");
}

Result<Triangle> VtkParser::triangle(std::uint32_t part, std::int64_t a, std::int64_t b, std::int64_t c) const {
  const auto points = static_cast<std::int64_t>(out_.mesh.position.size());
  for (const std::int64_t node : {a, b, c})
    if (node < 0 || node >= points)
      return file_error("cell " + std::to_string(part) + " names point " + std::to_string(node) + ", which does not exist",
                        points == 0 ? "the file holds no points" : "the points are 0 to " + std::to_string(points - 1));
  return Triangle{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)};
}

Status VtkParser::add_polygon(std::uint32_t part, std::span<const std::int64_t> nodes) {
  if (nodes.size() < 3)
    return file_error("a face of cell " + std::to_string(part) + " has only " + std::to_string(nodes.size()) + " points",
                      "a face has at least three");
  for (std::size_t c = 2; c < nodes.size(); ++c) {
    MORULA_TRY_ASSIGN(const Triangle face, triangle(part, nodes[0], nodes[c - 1], nodes[c]));
    out_.mesh.faces.push_back(face);
    out_.part.push_back(part);
  }
  return {};
}

Status VtkParser::add_strip(std::uint32_t part, std::span<const std::int64_t> nodes) {
  for (std::size_t c = 2; c < nodes.size(); ++c) {
    const bool odd = c % 2 != 0;  // every second triangle is turned
    MORULA_TRY_ASSIGN(const Triangle face, triangle(part, nodes[odd ? c - 1 : c - 2], nodes[odd ? c - 2 : c - 1], nodes[c]));
    out_.mesh.faces.push_back(face);
    out_.part.push_back(part);
  }
  return {};
}

Status VtkParser::add_cell(std::uint32_t part, std::int64_t type, std::span<const std::int64_t> nodes) {
  switch (type) {
    case kVertex:
    case kPolyVertex:
    case kLine:
    case kPolyLine:
      return {};
    case kTriangle:
    case kPolygon:
    case kQuad:
      return add_polygon(part, nodes);
    case kTriangleStrip:
      return add_strip(part, nodes);
    case kPixel:
      if (nodes.size() != 4) return file_error("cell " + std::to_string(part) + " is a pixel without four points", kWriteAgain);
      return add_polygon(part, std::array{nodes[0], nodes[1], nodes[3], nodes[2]});
    case kPolyhedron: {
      out_.is_closed[part] = 1;
      const Error ends = file_error("the faces of cell " + std::to_string(part) + " do not fit its length", kWriteAgain);
      if (nodes.empty() || nodes[0] < 0) return ends;
      std::size_t at = 1;
      for (std::int64_t face = 0; face < nodes[0]; ++face) {
        if (at >= nodes.size() || nodes[at] < 0 || static_cast<std::size_t>(nodes[at]) > nodes.size() - at - 1) return ends;
        const auto corners = static_cast<std::size_t>(nodes[at]);
        MORULA_TRY(add_polygon(part, nodes.subspan(at + 1, corners)));
        at += corners + 1;
      }
      return at == nodes.size() ? Status{} : Status(ends);
    }
    default:
      return file_error("cell " + std::to_string(part) + " has the VTK cell type " + std::to_string(type) + ", which is no surface",
                        "polyhedra (42), polygons (7), triangles (5), quadrilaterals (9) and strips (6) can be read");
  }
}

/// Faces from the lists of cells; a cell's number is its place in VERTICES, LINES, POLYGONS, TRIANGLE_STRIPS, or in CELLS.
Status VtkParser::assemble() {
  if (!has_dataset_) return file_error("holds no data set", kWriteAgain);
  std::size_t total = 0;
  for (const auto* lists : {&vertices_, &lines_, &polygons_, &strips_, &cells_})
    if (*lists) total += (*lists)->size();
  out_.part_count = static_cast<std::uint32_t>(total);
  out_.is_closed.assign(total, 0);
  std::uint32_t part = 0;
  const auto add_all = [&](const std::optional<CellLists>& lists, auto type_of) -> Status {
    if (!lists) return {};
    for (std::size_t i = 0; i < lists->size(); ++i, ++part) MORULA_TRY(add_cell(part, type_of(i), lists->of(i)));
    return {};
  };
  if (is_grid_) {
    if (cells_ && types_.size() != cells_->size())
      return file_error(std::to_string(cells_->size()) + " cells have " + std::to_string(types_.size()) + " cell types", kWriteAgain);
    MORULA_TRY(add_all(cells_, [&](std::size_t i) { return types_[i]; }));
  } else {
    MORULA_TRY(add_all(vertices_, [](std::size_t) { return kVertex; }));
    MORULA_TRY(add_all(lines_, [](std::size_t) { return kLine; }));
    MORULA_TRY(add_all(polygons_, [](std::size_t) { return kPolygon; }));
    MORULA_TRY(add_all(strips_, [](std::size_t) { return kTriangleStrip; }));
  }
  if (out_.mesh.faces.empty()) return file_error("holds no faces", "a surface needs polygons or polyhedra");
  const auto fits = [&](const std::vector<MeshArray>& arrays, std::size_t count, const char* what) -> Status {
    for (const MeshArray& array : arrays)
      if (array.count() != count)
        return file_error("array '" + array.name + "' has " + std::to_string(array.count()) + " values for " + std::to_string(count) + what,
                          kWriteAgain);
    return {};
  };
  MORULA_TRY(fits(out_.part_arrays, total, " cells"));
  return fits(out_.point_arrays, out_.mesh.position.size(), " points");
}

}  // namespace

Result<LabelledMesh> parse_vtk(const fs::path& file, std::string_view content, double scale) {
  return VtkParser(file, content, scale).run();
}

Result<LabelledMesh> read_vtk(const fs::path& file, double scale) {
  MORULA_TRY_ASSIGN(const std::string content, read_surface_bytes(file));
  return parse_vtk(file, content, scale);
}

}  // namespace morula
