#include "coupling/observables/measures.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/ball.h"
#include "core/contact/contact_layer.h"
#include "coupling/loads/grips.h"
#include "coupling/mechanics/scene.h"
#include "coupling/swaps.h"
#include "coupling/tissue_middle.h"

namespace morula {
namespace {

/// The winner over all ranks.
Extreme over_ranks(const Extreme& mine, const Comm& comm) {
  const auto* bytes = reinterpret_cast<const std::byte*>(&mine);  // NOLINT: plain data
  const auto all = comm.gather_to_all(std::span(bytes, sizeof mine));
  Extreme out;
  for (std::size_t at = 0; at < all.size(); at += sizeof(Extreme)) {
    Extreme one;
    std::memcpy(static_cast<void*>(&one), all.data() + at, sizeof one);
    if (one.cell.valid()) out.offer(one.value, one.cell);
  }
  return out;
}

/// Longest edge over the mean one, of the shell of this rank that has most of it and no elasticity that would hold its surface together.
Extreme most_drawn_out(const Model& model, const Tissue& tissue) {
  Extreme out;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    const CellRow& row = tissue.cells.rows[body.row];
    if (!body.is_shell || dcm::has_elastic_surface(model.types[row.type].shell)) continue;
    const std::span<const Vec3d> x = tissue.shells.nodes(body.number);
    double longest = 0.0, sum = 0.0;
    for (const Edge& edge : tissue.shells.topology(body.number).edges()) {
      const double length = norm(x[edge.j] - x[edge.i]);
      longest = std::max(longest, length), sum += length;
    }
    out.offer(longest * static_cast<double>(tissue.shells.topology(body.number).edges().size()) / sum, row.id);
  }
  return out;
}

/// Volume that the cell's row, its reference_excess and its inner pressure ask for, beside the present one of a nucleus that is a shell [µm³].
double volume_by_law(const Cells& cells, std::size_t i, const CellType& type, double inner_pressure,
                     const std::optional<NucleusState>& nucleus, bool is_newborn) {
  const CellRow& row = cells.rows[i];
  const double excess = std::exp(cells.optional.reference_excess[i]);
  if (row.body == BodyKind::kSphere) return row.target_volume * excess;
  const double volume =
      free_reference_volume(is_newborn ? row.birth_volume : row.target_volume, type, cells.deviation(i, type, Trait::kTension)) * excess *
      std::exp(-inner_pressure / type.shell.bulk_modulus);
  return nucleus ? nucleus->volume + (1.0 - type.interior.nucleus_fraction) * volume : volume;
}

/// The same at a moment of a run. A shell that was born within the last step has the V0 of its birth until the next.
double law_of_cell(const Simulation& simulation, const BodyOfRow& owned, double inner_pressure, const std::optional<NucleusState>& nucleus,
                   double volume) {
  const Tissue& tissue = simulation.tissue();
  const CellRow& row = tissue.cells.rows[owned.row];
  const auto law = [&](bool is_newborn) {
    return volume_by_law(tissue.cells, owned.row, simulation.model().types[row.type], inner_pressure, nucleus, is_newborn);
  };
  const double now = law(false);
  if (!owned.is_shell || !row.parent.valid() || row.birth_time <= tissue.clock.time - simulation.model().step.max_step) return now;
  const double at_birth = law(true);
  return std::abs(volume - at_birth) < std::abs(volume - now) ? at_birth : now;
}

/// How near the nuclei that are shells have come to their cortex. Collective.
double least_clearance(const Simulation& simulation) {
  const Tissue& tissue = simulation.tissue();
  double least = 1e300;
  for (std::size_t n = 0; n < tissue.nuclei.size(); ++n) {
    dcm::NucleusView view;
    view.cell_topology = &tissue.shells.topology(tissue.nuclei.owner[n]);
    view.cell = tissue.shells.nodes(tissue.nuclei.owner[n]);
    view.nucleus = tissue.nuclei.shells.nodes(n);
    least = std::min(least, dcm::nucleus_clearance(view));
  }
  least = simulation.comm().min(least);
  return least < 1e300 ? least : Measures::kNone;
}

double highest_on_faces(const fields::FieldSpec& spec) {
  double highest = 0.0;
  for (const auto& axis : spec.boundary)
    for (const fields::FaceCondition& face : axis) highest = std::max(highest, face.value);
  return highest;
}

void measure_fields(const Simulation& simulation, Measures& out) {
  const Tissue& tissue = simulation.tissue();
  const Comm& comm = simulation.comm();
  for (std::size_t f = 0; f < tissue.fields.size(); ++f) {
    const fields::Field& field = tissue.fields[f];
    double least = 1e300;
    for (const auto& brick : field.concentration)
      for (const double c : brick) least = std::min(least, c);
    out.least_field.push_back(comm.min(least));
    const double amount = fields::total_amount(field, comm);
    out.mean_field.push_back(amount / (field.grid.voxel_volume() * static_cast<double>(field.grid.voxel_count())));
    const FieldLedger& l = tissue.ledger.fields[f];
    const double residual = amount - l.start + l.taken + l.decayed - l.in;
    double scale = std::max({std::abs(amount), std::abs(l.start), std::abs(l.taken), std::abs(l.decayed), std::abs(l.in)});
    // What faces with a course once gave may all have gone again: nothing is left that its rounding could be compared with.
    if (const fields::FieldSpec& spec = simulation.model().fields[f]; !spec.course.empty())
      scale = std::max(scale, highest_on_faces(spec) * field.grid.voxel_volume() * static_cast<double>(field.grid.voxel_count()));
    out.field_balance.push_back(scale > 0.0 ? std::abs(residual) / scale : 0.0);
  }
}

/// Spheres against the calibrated range of their type's packing curve. Collective.
void measure_packing(Simulation& simulation, Measures& out) {
  const Model& model = simulation.model();
  if (std::all_of(model.types.begin(), model.types.end(), [](const CellType& type) { return type.sphere.packing.empty(); })) return;
  const std::vector<double> packing = simulation.mechanics().packing();
  Extreme most;
  for (const BodyOfRow& body : bodies_of(simulation.tissue().cells)) {
    if (body.is_shell) continue;
    const CellRow& row = simulation.tissue().cells.rows[body.row];
    const double here = packing[body.number], last = model.types[row.type].sphere.packing.last();
    if (last == 0.0) continue;
    most.offer(here / last, row.id);
    out.packed_beyond += here > last;
  }
  out.packed_beyond = simulation.comm().sum(out.packed_beyond);
  most = over_ranks(most, simulation.comm());
  out.packing = most.value;
  out.packing_cell = most.cell;
}

enum Sum {
  kVolume,
  kVolumeX,
  kVolumeY,
  kVolumeZ,
  kVolumeSquare,
  kPressure,
  kShellPressure,
  kInnerPressure,
  kContactArea,
  kLawVolume,
  kOutside,
  kSums
};

/// What is found by walking the cells of this rank once.
struct OverCells {
  OrderFreeSum sum[kSums];
  Extreme pressure, volume_error;
  std::vector<std::int64_t> of_type;
  double most_outside = 0.0;         ///< of the spheres
  std::int64_t spheres_outside = 0;  ///< of the range of their laws
};

/// Adds one cell; `from`: its centre from middle_of().
void add_cell(Simulation& simulation, const BodyValues& values, const AsBalls& balls, const BodyOfRow& owned, const Vec3d& from,
              OverCells& to) {
  const Tissue& tissue = simulation.tissue();
  const std::size_t body = owned.place(tissue.shells.size());
  const CellRow& row = tissue.cells.rows[owned.row];
  const auto nucleus = owned.is_shell ? simulation.mechanics().nucleus_of(static_cast<std::uint32_t>(owned.number)) : std::nullopt;
  const double volume = values.volume[body], p = values.pressure[body], inner = values.inner_pressure[body];
  const double r = ball_radius(volume), law = law_of_cell(simulation, owned, inner, nucleus, volume);
  to.sum[kVolume].add(volume);
  to.sum[kVolumeX].add(volume * from.x);
  to.sum[kVolumeY].add(volume * from.y);
  to.sum[kVolumeZ].add(volume * from.z);
  to.sum[kVolumeSquare].add(volume * (norm2(from) + 0.6 * r * r));
  to.sum[kPressure].add(p);
  if (owned.is_shell) to.sum[kShellPressure].add(p);
  if (owned.is_shell) to.sum[kInnerPressure].add(inner);
  to.sum[kContactArea].add(values.contact_area[body]);
  to.sum[kLawVolume].add(law);
  if (!owned.is_shell) {
    const double outside = balls.outside_law[body];
    to.sum[kOutside].add(outside);
    to.most_outside = std::max(to.most_outside, outside);
    to.spheres_outside += outside > 1.0;
  }
  to.pressure.offer(p, row.id);
  to.volume_error.offer(std::abs(volume - law) / law, row.id);
  ++to.of_type[row.type];
}

/// Of the cells' volumes. Collective.
Vec3d middle_of(const Space& space, const Tissue& tissue, const BodyValues& values, std::span<const Vec3d> center, const Comm& comm) {
  if (!space.any_periodic()) return space.box.center();
  std::vector<double> volume(center.size());
  for (const BodyOfRow& owned : bodies_of(tissue.cells)) volume[owned.row] = values.volume[owned.place(tissue.shells.size())];
  return tissue_middle(space, center, volume, comm).at;
}

/// Numbers and extremes over all ranks. Collective.
void count_all(const Tissue& tissue, OverCells& cells, const Comm& comm, Measures& out) {
  out.spheres = comm.sum(static_cast<std::int64_t>(tissue.spheres.size()));
  out.shells = comm.sum(static_cast<std::int64_t>(tissue.shells.size()));
  out.nodes = comm.sum(static_cast<std::int64_t>(tissue.shells.node_count()));
  out.cells = out.spheres + out.shells;
  out.of_type = std::move(cells.of_type);
  for (std::int64_t& count : out.of_type) count = comm.sum(count);
  out.pressure = over_ranks(cells.pressure, comm);
  out.volume_error = over_ranks(cells.volume_error, comm);
  if (const double most = comm.max(cells.most_outside); out.spheres > 0) out.most_outside = most;
  out.spheres_outside = comm.sum(cells.spheres_outside);
}

/// Means over the cells from sums over all ranks, where there is a cell. Returns their common centroid, from the middle of the domain [µm].
Vec3d set_means(const double (&total)[kSums], Measures& out) {
  const auto cells = static_cast<double>(out.cells), shells = static_cast<double>(out.shells);
  if (out.spheres > 0) out.mean_outside = total[kOutside] / static_cast<double>(out.spheres);
  const Vec3d mean = Vec3d{total[kVolumeX], total[kVolumeY], total[kVolumeZ]} * (1.0 / total[kVolume]);
  out.total_volume = total[kVolume];
  out.spheroid_radius = std::sqrt(5.0 / 3.0 * std::max(0.0, total[kVolumeSquare] / total[kVolume] - norm2(mean)));
  out.mean_pressure = total[kPressure] / cells;
  if (out.shells > 0) out.shell_pressure = total[kShellPressure] / shells;
  if (out.shells > 0) out.inner_pressure = total[kInnerPressure] / shells;
  out.mean_contact_area = total[kContactArea] / cells;
  out.total_volume_error = std::abs(total[kVolume] - total[kLawVolume]) / total[kLawVolume];
  return mean;
}

/// How far the farthest point of a cell is whose centre is there [µm].
double far_side(const Tissue& tissue, const BodyOfRow& body, const Vec3d& there, const Vec3d& center) {
  if (!body.is_shell) return norm(there) + tissue.spheres.radius[body.number];
  const std::uint32_t first = tissue.shells.first_node[body.number], last = tissue.shells.first_node[body.number + 1];
  double most2 = 0.0;
  for (std::uint32_t i = first; i < last; ++i) most2 = std::max(most2, norm2(tissue.shells.position[i] - center + there));
  return std::sqrt(most2);
}

}  // namespace

Measures measure(Simulation& simulation) {
  const BodyValues values = simulation.values();
  const AsBalls balls = simulation.mechanics().as_balls(simulation.tissue());
  const Tissue& tissue = simulation.tissue();
  const Model& model = simulation.model();
  const Comm& comm = simulation.comm();
  const std::vector<Vec3d> center = simulation.centers();
  const Vec3d middle = middle_of(model.space, tissue, values, center, comm);
  const auto from_middle = [&](const BodyOfRow& owned) { return model.space.nearest_image(center[owned.row] - middle); };
  Measures out;
  out.time = tissue.clock.time;
  const Vec3d edges = model.space.box.size();
  out.box_volume = edges.x * edges.y * edges.z;
  out.lumens = tissue.lumens;
  out.lumens.resize(model.lumens.size());
  OverCells over;
  over.of_type.assign(model.types.size(), 0);
  for (const BodyOfRow& owned : bodies_of(tissue.cells)) add_cell(simulation, values, balls, owned, from_middle(owned), over);
  double total[kSums];
  comm.sum(over.sum, total);
  count_all(tissue, over, comm, out);
  out.overlap = over_ranks(deepest_overlap(simulation), comm);
  if (out.spheres > 0 && out.shells > 0) out.drawn_out = over_ranks(most_drawn_out(model, tissue), comm);
  measure_fields(simulation, out);
  const auto is_outside = [&](const Vec3d& c) { return !model.space.box.contains(model.space.wrapped(c)); };
  if (!model.fields.empty()) out.outside_fields = comm.sum(static_cast<std::int64_t>(std::ranges::count_if(center, is_outside)));
  measure_packing(simulation, out);
  const auto range = simulation.mechanics().contacts_beyond_range();
  out.sphere_contacts = comm.sum(range.contacts);
  out.contacts_beyond = comm.sum(range.beyond);
  if (std::any_of(model.types.begin(), model.types.end(), [](const CellType& type) { return type.interior.has_nuclear_shell(); }))
    out.nucleus_clearance = least_clearance(simulation);
  out.obstacle_force = simulation.mechanics().obstacle_forces(tissue);
  out.energy = simulation.mechanics().known_energy(tissue);
  out.grip_force = grip_forces(model, tissue, comm);
  if (out.cells == 0) {  // nothing is said of cells where there are none
    out.spheroid_radius = out.largest_extent = out.mean_pressure = out.mean_contact_area = Measures::kNone;
    return out;
  }
  const Vec3d mean = set_means(total, out);
  double extent = 0.0;
  for (const BodyOfRow& body : bodies_of(tissue.cells))
    extent = std::max(extent, far_side(tissue, body, from_middle(body) - mean, center[body.row]));
  out.largest_extent = comm.max(extent);
  return out;
}

void Interval::add(const StepOutcome& outcome) {
  ++steps;
  time += outcome.mechanics.step;
  newton += static_cast<std::uint64_t>(outcome.mechanics.newton);
  linear += static_cast<std::uint64_t>(outcome.mechanics.linear_iterations);
  retries += static_cast<std::uint64_t>(outcome.retries);
  worst_overlap = std::max(worst_overlap, outcome.mechanics.overlap);
}

}  // namespace morula
