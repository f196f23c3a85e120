#include "coupling/cell_record.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "core/mesh/shape_bytes.h"

namespace morula {
namespace {

/// What a shell and a nucleus that is one have alike.
ShellRecord shell_out_of(const dcm::Shells& shells, std::size_t i) {
  const auto nodes = [&](const auto& array) {
    return std::vector(array.begin() + shells.first_node[i], array.begin() + shells.first_node[i + 1]);
  };
  return {shells.shape[i],
          shells.reference_volume[i],
          shells.rest_volume[i],
          nodes(shells.position),
          nodes(shells.velocity),
          std::vector(shells.rest_length.begin() + shells.first_edge[i], shells.rest_length.begin() + shells.first_edge[i + 1]),
          shells.faces_of(i)};
}

void put_into(dcm::Shells& shells, const ShellRecord& body, std::uint16_t type) {
  shells.shape.push_back(body.shape);
  shells.type.push_back(type);
  shells.reference_volume.push_back(body.reference_volume);
  shells.rest_volume.push_back(body.rest_volume);
  shells.position.insert(shells.position.end(), body.position.begin(), body.position.end());
  shells.velocity.insert(shells.velocity.end(), body.velocity.begin(), body.velocity.end());
  shells.rest_length.insert(shells.rest_length.end(), body.rest_length.begin(), body.rest_length.end());
  shells.first_node.push_back(static_cast<std::uint32_t>(shells.position.size()));
  shells.first_edge.push_back(static_cast<std::uint32_t>(shells.rest_length.size()));
  shells.nucleus.push_back(body.nucleus);
  if (!body.face.empty()) shells.faces_of(shells.size() - 1) = body.face;
}

}  // namespace

Vec3d CellRecord::center() const { return sphere ? sphere->position : volume_centroid(shell->shape->topology->faces(), shell->position); }

std::vector<CellRecord> take_apart(Tissue& tissue) {
  std::vector<CellRecord> out;
  out.reserve(tissue.cells.size());
  auto& shells = tissue.shells;
  auto& spheres = tissue.spheres;
  std::size_t next_shell = 0, next_sphere = 0;
  for (std::size_t k = 0; k < tissue.cells.size(); ++k) {
    CellRecord& record = out.emplace_back();
    record.row = tissue.cells.full(k);
    const CellRow& row = record.row;
    if (row.body == BodyKind::kShell) {
      const std::size_t i = next_shell++;
      record.shell = shell_out_of(std::as_const(shells), i);
      if (const Vec3d* nucleus = shells.nucleus_of(i)) record.shell->nucleus = *nucleus;
      if (const std::size_t n = tissue.nuclei.of_shell(i); n < tissue.nuclei.size())
        record.shell->nuclear_shell = shell_out_of(std::as_const(tissue.nuclei.shells), n);
    } else {
      const std::size_t i = next_sphere++;
      const auto partners = spheres.attached[i];
      record.sphere =
          SphereRecord{spheres.position[i], spheres.radius[i], spheres.velocity[i], cbm::Partners(partners.begin(), partners.end())};
    }
  }
  tissue.cells = {};
  tissue.shells = {};
  tissue.nuclei = {};
  tissue.spheres = {};
  return out;
}

void put_together(Tissue& tissue, std::vector<CellRecord> cells) {
  std::vector<std::size_t> sorted(cells.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) { return before(cells[a].row, cells[b].row); });
  auto& shells = tissue.shells;
  auto& spheres = tissue.spheres;
  tissue.cells.rows.reserve(cells.size());
  const auto is_sphere = [](const CellRecord& cell) { return cell.sphere.has_value(); };
  const auto sphere_count = static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), is_sphere));
  spheres.position.reserve(sphere_count);
  spheres.radius.reserve(sphere_count);
  spheres.type.reserve(sphere_count);
  spheres.velocity.reserve(sphere_count);
  std::size_t partners = 0;
  for (const CellRecord& cell : cells) partners += cell.sphere ? cell.sphere->attached.size() : 0;
  spheres.attached.reserve(sphere_count, partners);
  for (const std::size_t place : sorted) {
    CellRecord& cell = cells[place];
    cell.row.body = cell.shell ? BodyKind::kShell : BodyKind::kSphere;
    tissue.cells.push_back(cell.row);
    if (cell.shell) {
      put_into(shells, *cell.shell, cell.row.type);
      if (cell.shell->nuclear_shell) {
        put_into(tissue.nuclei.shells, *cell.shell->nuclear_shell, cell.row.type);
        tissue.nuclei.owner.push_back(static_cast<std::uint32_t>(shells.size() - 1));
      }
    } else {
      SphereRecord& body = *cell.sphere;
      spheres.position.push_back(body.position);
      spheres.radius.push_back(body.radius);
      spheres.type.push_back(cell.row.type);
      spheres.velocity.push_back(body.velocity);
      spheres.attached.push_back(body.attached);
    }
  }
}

ShellRecord spherical_shell(std::shared_ptr<const ReferenceShape> shape, const Vec3d& center, double volume, double reference_volume) {
  ShellRecord body;
  const double scale = std::cbrt(volume);  // the reference shape encloses 1
  body.position.reserve(shape->position.size());
  for (const Vec3d& p : shape->position) body.position.push_back(center + p * scale);
  body.velocity.assign(shape->position.size(), Vec3f{});
  body.rest_length.reserve(shape->edge_length.size());
  for (const double length : shape->edge_length) body.rest_length.push_back(length * scale);
  body.reference_volume = reference_volume;
  body.rest_volume = volume;
  body.shape = std::move(shape);
  return body;
}

void place_nucleus(ShellRecord& shell, const CellType& type, ShapeLibrary& shapes) {
  const dcm::InteriorParameters& interior = type.interior;
  shell.nucleus.reset();
  shell.nuclear_shell.reset();
  if (!interior.has_nucleus()) return;
  const Vec3d center = volume_centroid(shell.shape->topology->faces(), shell.position);
  if (interior.has_rigid_nucleus()) {
    shell.nucleus = center;
    return;
  }
  const double volume = interior.nucleus_fraction * shell.rest_volume;
  ShellRecord nucleus = spherical_shell(shapes.icosphere(interior.nucleus_nodes).value(), center, volume,
                                        dcm::nucleus_reference_volume(volume, shell.rest_volume, interior.nucleus_shell, type.shell));
  if (!shell.velocity.empty()) {  // it comes along with its cell
    Vec3f mean;
    for (const Vec3f& v : shell.velocity) mean += v;
    std::fill(nucleus.velocity.begin(), nucleus.velocity.end(), mean * (1.0f / static_cast<float>(shell.velocity.size())));
  }
  shell.nuclear_shell = std::move(nucleus);
}

namespace {

template <class T>
void append(std::vector<std::byte>& out, const T* items, std::size_t count) {
  const auto* bytes = reinterpret_cast<const std::byte*>(items);  // NOLINT: plain data
  out.insert(out.end(), bytes, bytes + count * sizeof(T));
}

/// Reads plain data from the front of a byte range.
struct Reader {
  std::span<const std::byte> rest;

  template <class T>
  T one() {
    T out;
    std::memcpy(static_cast<void*>(&out), rest.data(), sizeof(T));
    rest = rest.subspan(sizeof(T));
    return out;
  }
  template <class T>
  std::vector<T> many(std::size_t count) {
    std::vector<T> out(count);
    if (count != 0) std::memcpy(static_cast<void*>(out.data()), rest.data(), count * sizeof(T));
    rest = rest.subspan(count * sizeof(T));
    return out;
  }
};

void append_shell(const ShellRecord& body, std::vector<std::byte>& out) {
  append_shape(*body.shape, out);
  append(out, &body.reference_volume, 1);
  append(out, &body.rest_volume, 1);
  append(out, body.position.data(), body.position.size());
  append(out, body.velocity.data(), body.velocity.size());
  append(out, body.rest_length.data(), body.rest_length.size());
  const std::uint8_t nuclei[2] = {body.nucleus.has_value(), body.nuclear_shell.has_value()};
  append(out, nuclei, 2);
  if (body.nucleus) append(out, &*body.nucleus, 1);
  const std::uint32_t marks[2] = {static_cast<std::uint32_t>(body.face.mark.size()), static_cast<std::uint32_t>(body.face.contact.size())};
  append(out, marks, 2);
  append(out, body.face.mark.data(), body.face.mark.size());
  append(out, body.face.contact.data(), body.face.contact.size());
  if (body.nuclear_shell) append_shell(*body.nuclear_shell, out);
}

ShellRecord read_shell(Reader& reader, ShapeLibrary& shapes) {
  ShellRecord body;
  body.shape = read_shape(reader.rest, shapes);
  const std::uint32_t nodes = body.shape->topology->node_count();
  body.reference_volume = reader.one<double>();
  body.rest_volume = reader.one<double>();
  body.position = reader.many<Vec3d>(nodes);
  body.velocity = reader.many<Vec3f>(nodes);
  body.rest_length = reader.many<double>(body.shape->edge_length.size());
  const bool rigid = reader.one<std::uint8_t>() != 0, shell = reader.one<std::uint8_t>() != 0;
  if (rigid) body.nucleus = reader.one<Vec3d>();
  const auto marks = reader.one<std::uint32_t>(), contacts = reader.one<std::uint32_t>();
  body.face.mark = reader.many<std::uint8_t>(marks);
  body.face.contact = reader.many<float>(contacts);
  if (shell) body.nuclear_shell = read_shell(reader, shapes);
  return body;
}

}  // namespace

void append_bytes(const CellRecord& cell, std::vector<std::byte>& out) {
  append(out, &cell.row, 1);
  if (cell.sphere) {
    const SphereRecord& body = *cell.sphere;
    const std::uint64_t count = body.attached.size();
    append(out, &body.position, 1);
    append(out, &body.radius, 1);
    append(out, &body.velocity, 1);
    append(out, &count, 1);
    append(out, body.attached.data(), body.attached.size());
  } else {
    append_shell(*cell.shell, out);
  }
}

std::vector<CellRecord> read_records(std::span<const std::byte> bytes, ShapeLibrary& shapes) {
  std::vector<CellRecord> out;
  Reader reader{bytes};
  while (!reader.rest.empty()) {
    CellRecord& cell = out.emplace_back();
    cell.row = reader.one<FullRow>();
    if (cell.row.body == BodyKind::kSphere) {
      SphereRecord body;
      body.position = reader.one<Vec3d>();
      body.radius = reader.one<double>();
      body.velocity = reader.one<Vec3f>();
      body.attached = reader.many<CellId>(reader.one<std::uint64_t>());
      cell.sphere = std::move(body);
    } else {
      cell.shell = read_shell(reader, shapes);
    }
  }
  return out;
}

}  // namespace morula
