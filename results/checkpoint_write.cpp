#include <algorithm>
#include <array>
#include <type_traits>

#include "results/build_info.h"
#include "results/checkpoint.h"
#include "results/file_io.h"
#include "results/hdf5_plan.h"
#include "results/parcels.h"
#include "results/shape_table.h"
#include "results/state_fields.h"

namespace morula::scenarios {
namespace {

/// Flat arrays of this rank's stretch of the sorted cells.
struct SortedCells {
  std::vector<FullRow> rows;
  cbm::Spheres spheres;
  std::vector<std::uint32_t> partner_count;
  std::vector<CellId> partners;
  std::vector<std::uint32_t> shape;
  dcm::Shells shells;
  std::vector<std::uint8_t> has_nucleus;                 ///< by shell
  std::vector<Vec3d> nucleus;                            ///< of those that have one
  std::vector<std::uint8_t> has_nuclear_shell;           ///< by shell
  std::vector<std::uint32_t> nuclear_shape;              ///< of those that have one
  dcm::Shells nuclei;                                    ///< likewise
  std::vector<std::uint32_t> mark_count, contact_count;  ///< by shell
  std::vector<std::uint8_t> mark;
  std::vector<float> contact;
};

/// What a shell and a nucleus that is one have alike.
void pack_shell(const dcm::Shells& s, std::size_t shell, const ShapeNumbers& numbers, ByteWriter& out) {
  const std::uint32_t node = s.first_node[shell], edge = s.first_edge[shell];
  const std::uint32_t nodes = s.first_node[shell + 1] - node, edges = s.first_edge[shell + 1] - edge;
  out.put(numbers.by_pointer.at(s.shape[shell].get()));
  out.put(s.type[shell]);
  out.put(s.reference_volume[shell]);
  out.put(s.rest_volume[shell]);
  out.put(nodes);
  out.put(edges);
  out.put_all(std::span(s.position).subspan(node, nodes));
  out.put_all(std::span(s.velocity).subspan(node, nodes));
  out.put_all(std::span(s.rest_length).subspan(edge, edges));
}

void unpack_shell(ByteReader& in, std::vector<std::uint32_t>& shape, dcm::Shells& out) {
  shape.push_back(in.get<std::uint32_t>());
  out.type.push_back(in.get<std::uint16_t>());
  out.reference_volume.push_back(in.get<double>());
  out.rest_volume.push_back(in.get<double>());
  const auto nodes = in.get<std::uint32_t>(), edges = in.get<std::uint32_t>();
  in.get_all(nodes, out.position);
  in.get_all(nodes, out.velocity);
  in.get_all(edges, out.rest_length);
}

Parcels pack_cells(const Tissue& tissue, const ShapeNumbers& numbers) {
  Parcels parcels;
  ByteWriter out;
  std::size_t sphere = 0, shell = 0;
  for (std::size_t i = 0; i < tissue.cells.size(); ++i) {
    const FullRow row = tissue.cells.full(i);
    out.clear();
    out.put(row);
    if (row.body == BodyKind::kSphere) {
      const cbm::Spheres& s = tissue.spheres;
      out.put(s.position[sphere]);
      out.put(s.radius[sphere]);
      out.put(s.type[sphere]);
      out.put(s.velocity[sphere]);
      const std::span<const CellId> partners = s.attached[sphere];  // sorted
      out.put(static_cast<std::uint32_t>(partners.size()));
      out.put_all(partners);
      ++sphere;
    } else {
      const dcm::Shells& s = tissue.shells;
      pack_shell(s, shell, numbers, out);
      const std::size_t nuclear = tissue.nuclei.of_shell(shell);
      out.put(std::uint8_t{nuclear < tissue.nuclei.size()});
      if (nuclear < tissue.nuclei.size()) pack_shell(tissue.nuclei.shells, nuclear, numbers, out);
      const Vec3d* nucleus = s.nucleus_of(shell);
      out.put(std::uint8_t{nucleus != nullptr});
      if (nucleus != nullptr) out.put(*nucleus);
      const dcm::FaceState& face = s.faces_of(shell);
      out.put(static_cast<std::uint32_t>(face.mark.size()));
      out.put(static_cast<std::uint32_t>(face.contact.size()));
      out.put_all(std::span(face.mark));
      out.put_all(std::span(face.contact));
      ++shell;
    }
    parcels.add(row.id.bits(), out.bytes());
  }
  return parcels;
}

SortedCells unpack_cells(const Parcels& parcels) {
  SortedCells out;
  for (std::size_t i = 0; i < parcels.size(); ++i) {
    ByteReader in(parcels.bytes(i));
    out.rows.push_back(in.get<FullRow>());
    if (out.rows.back().body == BodyKind::kSphere) {
      out.spheres.position.push_back(in.get<Vec3d>());
      out.spheres.radius.push_back(in.get<double>());
      out.spheres.type.push_back(in.get<std::uint16_t>());
      out.spheres.velocity.push_back(in.get<Vec3f>());
      out.partner_count.push_back(in.get<std::uint32_t>());
      in.get_all(out.partner_count.back(), out.partners);
    } else {
      unpack_shell(in, out.shape, out.shells);
      out.has_nuclear_shell.push_back(in.get<std::uint8_t>());
      if (out.has_nuclear_shell.back() != 0) unpack_shell(in, out.nuclear_shape, out.nuclei);
      out.has_nucleus.push_back(in.get<std::uint8_t>());
      if (out.has_nucleus.back() != 0) out.nucleus.push_back(in.get<Vec3d>());
      out.mark_count.push_back(in.get<std::uint32_t>());
      out.contact_count.push_back(in.get<std::uint32_t>());
      in.get_all(out.mark_count.back(), out.mark);
      in.get_all(out.contact_count.back(), out.contact);
    }
  }
  return out;
}

void add_shells(StoragePlan& plan, const std::string& group, const std::vector<std::uint32_t>& shape, const dcm::Shells& shells) {
  plan.add(group + "shape", "1", shape);
  plan.add(group + "type", "1", shells.type);
  plan.add(group + "reference_volume", "um^3", shells.reference_volume);
  plan.add(group + "rest_volume", "um^3", shells.rest_volume);
  plan.add(group + "position", "um", shells.position);
  plan.add(group + "velocity", "um/s", shells.velocity);
  plan.add(group + "rest_length", "um", shells.rest_length);
}

void add_cells(StoragePlan& plan, const SortedCells& cells, const Comm& comm) {
  for_each_row_field([&](const std::string& name, const char* units, auto member) {
    std::vector<std::remove_cvref_t<decltype(cells.rows.front().*member)>> column;
    for (const FullRow& row : cells.rows) column.push_back(row.*member);
    plan.add("cells/" + name, units, column);
  });
  plan.add("spheres/position", "um", cells.spheres.position);
  plan.add("spheres/radius", "um", cells.spheres.radius);
  plan.add("spheres/type", "1", cells.spheres.type);
  plan.add("spheres/velocity", "um/s", cells.spheres.velocity);
  plan.add("spheres/partner_count", "1", cells.partner_count);
  plan.add("spheres/partners", "1", cells.partners);
  add_shells(plan, "shells/", cells.shape, cells.shells);
  if (comm.any(!cells.nuclear_shape.empty())) {
    plan.add("shells/has_nuclear_shell", "1", cells.has_nuclear_shell);
    add_shells(plan, "nuclear_shells/", cells.nuclear_shape, cells.nuclei);
  }
  if (comm.any(!cells.nucleus.empty())) {
    plan.add("shells/has_nucleus", "1", cells.has_nucleus);
    plan.add("shells/nucleus", "um", cells.nucleus);
  }
  if (!comm.any(!cells.mark.empty() || !cells.contact.empty())) return;
  plan.add("shells/mark_count", "1", cells.mark_count);
  plan.add("shells/mark", "1", cells.mark);
  plan.add("shells/face_contact_count", "1", cells.contact_count);
  plan.add("shells/face_contact", "1", cells.contact);
}

Status add_field(StoragePlan& plan, const std::string& group, const fields::Field& field, const Comm& comm) {
  Parcels bricks;
  for (std::size_t b = 0; b < field.owned_bricks.size(); ++b)
    bricks.add(static_cast<std::uint64_t>(field.owned_bricks[b]), std::as_bytes(std::span(field.concentration[b])));
  const Parcels sorted = sort_over_ranks(bricks, comm);
  std::vector<std::int64_t> numbers;
  std::vector<double> values;
  bool sizes_right = true;
  for (std::size_t b = 0; b < sorted.size(); ++b) {
    numbers.push_back(static_cast<std::int64_t>(sorted.key(b)));
    const std::size_t count = sorted.bytes(b).size() / sizeof(double);
    sizes_right = sizes_right && numbers.back() < field.grid.brick_count() && count == brick_voxel_count(field.grid, numbers.back());
    ByteReader(sorted.bytes(b)).get_all(count, values);
  }
  const std::int64_t total = comm.sum(static_cast<std::int64_t>(numbers.size()));
  if (!comm.all(sizes_right) || total != field.grid.brick_count())
    return Error{ErrorKind::kInternal, "the bricks of " + group + " do not make its grid (" + std::to_string(total) + " bricks)", ""};
  plan.add_value(group + "/low", "um", field.grid.box.low);
  plan.add_value(group + "/high", "um", field.grid.box.high);
  plan.add_value(group + "/voxels", "1", field.grid.voxels);
  plan.add_value(group + "/bricks", "1", field.grid.bricks);
  plan.add_value(group + "/next_step", "s", field.next_step);
  plan.add(group + "/brick", "1", numbers);
  plan.add(group + "/concentration", "mM", values);
  return {};
}

void add_globals(StoragePlan& plan, const Tissue& tissue, const CheckpointInfo& info) {
  plan.add_value("format_version", "1", kCheckpointFormat);
  plan.add_text("info/morula_version", build_info().version);
  plan.add_text("info/run_name", info.run_name);
  plan.add_text("info/study_hash", info.study_hash);
  plan.add_value("info/wall_time", "s", info.wall_time);
  plan.add_value("info/warned", "1", info.warned);
  plan.add_value("info/events_length", "1", info.texts.events);
  plan.add_value("info/log_length", "1", info.texts.log);
  plan.add_value("info/field_count", "1", static_cast<std::uint32_t>(tissue.fields.size()));
  for_each_clock_field(
      [&](const std::string& name, const char* units, auto member) { plan.add_value("clock/" + name, units, tissue.clock.*member); });
  for_each_ledger_field(
      [&](const std::string& name, const char* units, auto member) {
        plan.add_value("ledger/" + name, units, std::to_array(tissue.ledger.*member));
      },
      [&](const std::string& name, const char* units, auto member) { plan.add_value("ledger/" + name, units, tissue.ledger.*member); });
  plan.add_from_root("obstacles/offset", "um", std::span<const Vec3d>(tissue.obstacle_offset));
  if (tissue.lumens.empty()) return;
  for_each_lumen_field([&](const std::string& name, const char* units, auto member) {
    std::vector<double> column;
    for (const LumenState& lumen : tissue.lumens) column.push_back(lumen.*member);
    plan.add_from_root("lumens/" + name, units, std::span<const double>(column));
  });
}

}  // namespace

std::size_t brick_voxel_count(const fields::Grid& grid, std::int64_t brick) {
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t along = brick % grid.bricks[axis];
    brick /= grid.bricks[axis];
    count *= static_cast<std::size_t>(std::min<std::int64_t>(fields::Grid::kBrick, grid.voxels[axis] - along * fields::Grid::kBrick));
  }
  return count;
}

Status write_checkpoint(const std::filesystem::path& path, const Tissue& tissue, const CheckpointInfo& info, const Comm& comm) {
  StoragePlan plan(comm);
  add_globals(plan, tissue, info);
  auto shapes = tissue.shells.shape;
  shapes.insert(shapes.end(), tissue.nuclei.shells.shape.begin(), tissue.nuclei.shells.shape.end());
  const ShapeNumbers numbers = add_shapes(plan, shapes, comm);
  const SortedCells cells = unpack_cells(sort_over_ranks(pack_cells(tissue, numbers), comm));
  add_cells(plan, cells, comm);
  for (std::size_t f = 0; f < tissue.fields.size(); ++f) MORULA_TRY(add_field(plan, "fields/" + std::to_string(f), tissue.fields[f], comm));
  return create_file(path, std::move(plan), comm);
}

}  // namespace morula::scenarios
