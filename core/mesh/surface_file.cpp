#include "core/mesh/surface_file.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>

#include "core/mesh/surface_bytes.h"
#include "core/mesh/text_words.h"
#include "core/mesh/vtk_file.h"
#include "core/mesh/weld_nodes.h"
#include "core/space/space.h"

namespace morula {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

constexpr std::size_t kStlHeader = 84;  ///< 80 bytes of anything and the number of faces
constexpr std::size_t kStlFace = 50;    ///< normal, three corners, two bytes of attributes

Error file_error(const fs::path& file, const std::string& what, std::string help) {
  return {ErrorKind::kFile, file.string() + ": " + what, std::move(help)};
}
Error line_error(const fs::path& file, std::size_t line, const std::string& what, std::string help) {
  return {ErrorKind::kFile, file.string() + ":" + std::to_string(line) + ": " + what, std::move(help)};
}

std::string quoted(std::string_view word) {
  std::string out = "'";
  for (const char c : word.substr(0, 40)) out += std::isprint(static_cast<unsigned char>(c)) ? c : '?';
  return out + "'";
}

Result<double> coordinate(const fs::path& file, const TextWords& words, std::string_view word) {
  if (word.empty()) return line_error(file, words.line(), "a coordinate is missing", "every node has three coordinates");
  const auto value = parse_number(word);
  if (!value) return line_error(file, words.line(), quoted(word) + " is not a number", "every node has three coordinates");
  if (!std::isfinite(*value))
    return line_error(file, words.line(), "the coordinate " + quoted(word) + " is not finite", "coordinates must be finite numbers");
  return *value;
}

bool finite(const Vec3d& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

Result<TriangleMesh> finished(const fs::path& file, TriangleMesh mesh, const SurfaceFileOptions& options) {
  if (mesh.faces.empty()) return file_error(file, "holds no faces", "a surface needs triangles");
  Box box;
  for (Vec3d& p : mesh.position) {
    p *= options.scale;
    if (!finite(p)) return file_error(file, "a coordinate is too large for this scale", "check the scale");
    box.include(p);
  }
  return with_welded_nodes(mesh, options.weld * norm(box.size()));
}

/// Faces of a text, and the `solid` or object that each belongs to.
struct Parsed {
  TriangleMesh mesh;
  std::vector<std::uint32_t> part;
};

Result<Parsed> parse_text_stl(const fs::path& file, std::string_view content) {
  TriangleMesh mesh;
  std::vector<std::uint32_t> part;
  std::uint32_t solids = 0;
  TextWords words(content);
  const auto expect = [&](std::string_view wanted) -> Status {
    const std::string_view word = words.next();
    if (word == wanted) return {};
    if (word.empty()) return line_error(file, words.line(), "the file ends in the middle of a face", "it is truncated; write it again");
    return line_error(file, words.line(), quoted(word) + " stands where '" + std::string(wanted) + "' should",
                      "every facet is a triangle: facet normal, outer loop, three vertex lines, endloop, endfacet");
  };
  bool in_solid = false;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "solid" || word == "endsolid") {
      in_solid = word == "solid";
      solids += in_solid;
      words.skip_line();  // its name
      continue;
    }
    if (!in_solid || word != "facet")
      return line_error(file, words.line(), quoted(word) + " stands where 'facet' or 'endsolid' should", "this is no STL text");
    MORULA_TRY(expect("normal"));
    for (int axis = 0; axis < 3; ++axis) {
      // Normals are often nonsense (NaN for thin faces) and never used: the order of the corners counts.
      const std::string_view component = words.next();
      if (!parse_number(component))
        return line_error(file, words.line(), quoted(component) + " is not a number", "a normal has three components");
    }
    MORULA_TRY(expect("outer"));
    MORULA_TRY(expect("loop"));
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (int corner = 0; corner < 3; ++corner) {
      MORULA_TRY(expect("vertex"));
      Vec3d p;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        MORULA_TRY_ASSIGN(p[axis], coordinate(file, words, words.next()));
      }
      mesh.position.push_back(p);
    }
    MORULA_TRY(expect("endloop"));
    MORULA_TRY(expect("endfacet"));
    mesh.faces.push_back({first, first + 1, first + 2});
    part.push_back(solids - 1);
  }
  if (in_solid) return line_error(file, words.line(), "the file ends without 'endsolid'", "it is truncated; write it again");
  return Parsed{std::move(mesh), std::move(part)};
}

Result<TriangleMesh> parse_binary_stl(const fs::path& file, std::string_view content) {
  TriangleMesh mesh;
  const std::size_t count = (content.size() - kStlHeader) / kStlFace;
  mesh.position.reserve(3 * count);
  mesh.faces.reserve(count);
  for (std::size_t f = 0; f < count; ++f) {
    float corners[9];
    std::memcpy(corners, content.data() + kStlHeader + f * kStlFace + 3 * sizeof(float), sizeof corners);
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (int c = 0; c < 3; ++c) {
      mesh.position.push_back({corners[3 * c], corners[3 * c + 1], corners[3 * c + 2]});
      if (!finite(mesh.position.back()))
        return file_error(
            file,
            "face " + std::to_string(f) + " (byte " + std::to_string(kStlHeader + f * kStlFace) + ") has a coordinate that is not finite",
            "coordinates must be finite numbers");
    }
    mesh.faces.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// Node number of one corner of an OBJ face, given how many nodes have been read so far.
Result<std::uint32_t> obj_node(const fs::path& file, std::size_t line, std::string_view corner, std::size_t nodes) {
  const auto index = parse_whole(corner.substr(0, corner.find('/')));
  if (!index) return line_error(file, line, quoted(corner) + " is not a node", "a face lists nodes as i, i/t, i//n or i/t/n");
  const auto count = static_cast<long long>(nodes);
  if (*index == 0 || *index > count || *index < -count)
    return line_error(file, line, "node " + std::to_string(*index) + " does not exist",
                      std::to_string(nodes) + " nodes come before this line; they count from 1, or from -1 backwards");
  return static_cast<std::uint32_t>(*index > 0 ? *index - 1 : count + *index);
}

bool passed_over(std::string_view keyword) {
  constexpr std::string_view kKeywords[] = {"vt", "vn",     "vp",     "g",          "o",         "s",   "mg",    "usemtl",   "mtllib",  "l",
                                            "p",  "usemap", "maplib", "shadow_obj", "trace_obj", "lod", "bevel", "c_interp", "d_interp"};
  return std::ranges::find(kKeywords, keyword) != std::end(kKeywords);
}

Result<Parsed> parse_obj(const fs::path& file, std::string_view content) {
  TriangleMesh mesh;
  std::vector<std::uint32_t> object, group;
  std::uint32_t objects = 0, groups = 0;
  TextWords words(content);
  while (words.next_line()) {
    const std::string_view keyword = words.next_in_line();
    objects += keyword == "o";
    groups += keyword == "g";
    if (keyword.empty() || keyword.starts_with('#') || passed_over(keyword)) continue;
    if (keyword == "v") {
      Vec3d p;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        MORULA_TRY_ASSIGN(p[axis], coordinate(file, words, words.next_in_line()));
      }
      mesh.position.push_back(p);
    } else if (keyword == "f") {
      std::vector<std::uint32_t> corners;
      for (auto word = words.next_in_line(); !word.empty() && !word.starts_with('#'); word = words.next_in_line()) {
        MORULA_TRY_ASSIGN(const std::uint32_t node, obj_node(file, words.line(), word, mesh.position.size()));
        corners.push_back(node);
      }
      if (corners.size() < 3)
        return line_error(file, words.line(), "a face has only " + std::to_string(corners.size()) + " nodes", "a face has at least three");
      for (std::size_t c = 2; c < corners.size(); ++c) mesh.faces.push_back({corners[0], corners[c - 1], corners[c]});
      object.resize(mesh.faces.size(), objects);
      group.resize(mesh.faces.size(), groups);
    } else {
      return line_error(file, words.line(), quoted(keyword) + " is not known", "only polygons (v, f) can be read; is this an OBJ file?");
    }
  }
  return Parsed{std::move(mesh), objects > 0 ? std::move(object) : std::move(group)};
}

/// Parts numbered without gaps, in increasing order.
LabelledMesh with_dense_parts(TriangleMesh mesh, std::vector<std::uint32_t> part) {
  LabelledMesh out;
  std::vector<std::uint32_t> used(part);
  std::ranges::sort(used);
  used.erase(std::ranges::unique(used).begin(), used.end());
  for (std::uint32_t& p : part) p = static_cast<std::uint32_t>(std::ranges::lower_bound(used, p) - used.begin());
  out.mesh = std::move(mesh);
  out.part = std::move(part);
  out.part_count = static_cast<std::uint32_t>(used.size());
  out.is_closed.assign(used.size(), 1);
  return out;
}

}  // namespace

namespace {

Result<Parsed> parse_stl(const fs::path& file, std::string_view content) {
  std::uint32_t announced = 0;
  if (content.size() >= kStlHeader) std::memcpy(&announced, content.data() + kStlHeader - sizeof announced, sizeof announced);
  const std::size_t binary_size = kStlHeader + kStlFace * std::size_t{announced};
  const bool is_text = content.find('\0') == std::string_view::npos && TextWords(content).next() == "solid";
  if (content.size() >= kStlHeader && content.size() == binary_size) {
    MORULA_TRY_ASSIGN(TriangleMesh mesh, parse_binary_stl(file, content));
    const std::size_t faces = mesh.faces.size();
    return Parsed{std::move(mesh), std::vector<std::uint32_t>(faces, 0)};
  }
  if (is_text) return parse_text_stl(file, content);
  if (content.size() < kStlHeader || content.find('\0') == std::string_view::npos)
    return file_error(file, "is no STL file", "it neither begins with 'solid' nor has the size of a binary STL");
  return file_error(file,
                    "announces " + std::to_string(announced) + " faces, which take " + std::to_string(binary_size) + " bytes, but has " +
                        std::to_string(content.size()),
                    "it is truncated, or no STL file; write it again");
}

std::string lower_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace

Result<TriangleMesh> read_stl(const fs::path& file, const SurfaceFileOptions& options) {
  MORULA_TRY_ASSIGN(const std::string content, read_surface_bytes(file));
  MORULA_TRY_ASSIGN(Parsed parsed, parse_stl(file, content));
  return finished(file, std::move(parsed.mesh), options);
}

Result<TriangleMesh> read_obj(const fs::path& file, const SurfaceFileOptions& options) {
  MORULA_TRY_ASSIGN(const std::string content, read_surface_bytes(file));
  if (content.find('\0') != std::string::npos) return file_error(file, "is binary, not an OBJ text", "write it as Wavefront OBJ");
  MORULA_TRY_ASSIGN(Parsed parsed, parse_obj(file, content));
  return finished(file, std::move(parsed.mesh), options);
}

Result<TriangleMesh> read_surface(const fs::path& file, const SurfaceFileOptions& options) {
  const std::string ending = lower_ending(file);
  if (ending == ".stl") return read_stl(file, options);
  if (ending == ".obj") return read_obj(file, options);
  return file_error(file, "its ending tells no known format", "surfaces are read from .stl and .obj files");
}

Result<LabelledMesh> read_labelled_mesh(const fs::path& file, double scale) {
  const std::string ending = lower_ending(file);
  if (ending == ".vtk") return read_vtk(file, scale);
  if (ending != ".stl" && ending != ".obj")
    return file_error(file, "its ending tells no known format", "cells are read from .vtk (legacy), .stl and .obj files");
  MORULA_TRY_ASSIGN(const std::string content, read_surface_bytes(file));
  const bool is_obj = ending == ".obj";
  if (is_obj && content.find('\0') != std::string::npos) return file_error(file, "is binary, not an OBJ text", "write it as Wavefront OBJ");
  MORULA_TRY_ASSIGN(Parsed parsed, is_obj ? parse_obj(file, content) : parse_stl(file, content));
  if (parsed.mesh.faces.empty()) return file_error(file, "holds no faces", "a surface needs triangles");
  for (Vec3d& p : parsed.mesh.position) {
    p *= scale;
    if (!finite(p)) return file_error(file, "a coordinate is too large for this scale", "check the scale");
  }
  LabelledMesh out = with_dense_parts(std::move(parsed.mesh), std::move(parsed.part));
  out.has_indices = is_obj;
  return out;
}

Status write_stl(const fs::path& file, const TriangleMesh& mesh) {
  std::string content(kStlHeader + kStlFace * mesh.faces.size(), '\0');
  constexpr std::string_view kHeader = "binary STL, coordinates in micrometres";
  kHeader.copy(content.data(), kHeader.size());
  const auto count = static_cast<std::uint32_t>(mesh.faces.size());
  std::memcpy(content.data() + kStlHeader - sizeof count, &count, sizeof count);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3d corner[3] = {mesh.position[mesh.faces[f][0]], mesh.position[mesh.faces[f][1]], mesh.position[mesh.faces[f][2]]};
    const Vec3d across = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double length = norm(across);
    const Vec3d normal = length > 0.0 ? across / length : Vec3d{};
    float numbers[12];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      numbers[axis] = static_cast<float>(normal[axis]);
      for (std::size_t c = 0; c < 3; ++c) numbers[3 + 3 * c + axis] = static_cast<float>(corner[c][axis]);
    }
    std::memcpy(content.data() + kStlHeader + f * kStlFace, numbers, sizeof numbers);
  }

  const fs::path aside = file.string() + ".part";
  std::error_code error;
  {
    std::ofstream stream(aside, std::ios::binary | std::ios::trunc);
    if (!stream) return file_error(file, "cannot be written", "check that the folder exists and may be written");
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    stream.close();
    if (!stream) {
      fs::remove(aside, error);
      return Error{ErrorKind::kResources, file.string() + ": could not be written to its end", "is the disk full?"};
    }
  }
  fs::rename(aside, file, error);
  if (!error) return {};
  const std::string reason = error.message();
  fs::remove(aside, error);
  return file_error(file, "cannot be put in place: " + reason, "check that the folder may be written and the name is no folder");
}

}  // namespace morula
