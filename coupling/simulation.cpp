#include "coupling/simulation.h"

#include <algorithm>
#include <cmath>

#include "core/ball.h"
#include "core/parallel/pack.h"
#include "core/parallel/threads.h"
#include "coupling/behaviours/life.h"
#include "coupling/behaviours/migration.h"
#include "coupling/behaviours/osmosis.h"
#include "coupling/behaviours/pressure_filter.h"
#include "coupling/cell_record.h"
#include "coupling/changing_box.h"
#include "coupling/face_marks.h"
#include "coupling/mechanics/contact_setup.h"
#include "coupling/neighbourhoods.h"
#include "coupling/still_to_come.h"
#include "coupling/swaps.h"
#include "dcm/growth.h"
#include "fields/interval_control.h"

namespace morula {
namespace {

/// Time over which V0 (or a sphere's volume) goes back to that of a free cell after a swap: about ten mechanical relaxation times [s].
constexpr double kEasing = 600.0;

}  // namespace

Simulation::Simulation(Model model, Tissue tissue, const Comm& comm, int threads)
    : model_(std::move(model)), box_of_study_(model_.space.box), tissue_(std::move(tissue)), comm_(comm), threads_(threads) {
  model_.space.box = box_at(box_of_study_, model_.box_volume, tissue_.clock.time);
}

Result<std::unique_ptr<Simulation>> Simulation::create(Model model, Tissue tissue, const Comm& comm, int threads) {
  std::unique_ptr<Simulation> out(new Simulation(std::move(model), std::move(tissue), comm, threads));
  MORULA_TRY_ASSIGN(auto obstacles, contact_obstacles(out->model_));
  out->tissue_.obstacle_offset.resize(obstacles.size());
  out->tissue_.cells.declare(cell_variables(out->model_));
  out->mechanics_ = std::make_unique<Mechanics>(out->model_, std::move(obstacles), out->shapes_, comm, threads);
  if (out->tissue_.fields.empty()) {
    for (std::size_t f = 0; f < out->model_.fields.size(); ++f) {
      const auto& spec = out->model_.fields[f];
      MORULA_TRY_ASSIGN(const auto grid, fields::grid_for(spec, out->model_.space));
      const auto owner = fields::owners_along_curve(grid, comm.size());
      out->tissue_.fields.push_back(fields::uniform_field(grid, spec.initial, owner, comm.rank()));
      out->tissue_.fields.back().time = out->tissue_.clock.time;
      out->tissue_.ledger.fields.push_back({.start = fields::total_amount(out->tissue_.fields.back(), comm)});
      Cells& cells = out->tissue_.cells;
      for (std::size_t i = 0; i < cells.size(); ++i) cells.variables[concentration_of(f)].values.set(i, spec.initial, cells.size());
    }
  }
  out->distribute();
  mark_new_shells(out->model_, out->tissue_);
  return out;
}

void Simulation::distribute() {
  auto timed = mechanics_->timer().scope(Stage::kBalance);
  balance(tissue_, partition_, shapes_, comm_);
  if (comm_.size() > 1)
    for (fields::Field& field : tissue_.fields) {
      std::vector<int> owner(static_cast<std::size_t>(field.grid.brick_count()));
      const Vec3d size = field.grid.spacing() * static_cast<double>(fields::Grid::kBrick);
      for (std::size_t b = 0; b < owner.size(); ++b) {
        const auto place = field.grid.place(static_cast<std::int64_t>(b));
        owner[b] =
            partition_.owner(field.grid.box.low + Vec3d{(place[0] + 0.5) * size.x, (place[1] + 0.5) * size.y, (place[2] + 0.5) * size.z});
      }
      fields::redistribute(field, owner, comm_);
    }
  mechanics_->bodies_changed();
}

void Simulation::carry_to(double time) {
  const Box from = model_.space.box, to = box_at(box_of_study_, model_.box_volume, time);
  if (to.low == from.low) return;
  carry(tissue_, from, to);
  model_.space.box = to;
  mechanics_->bodies_changed();  // its lists hold pairs across the faces of the box with the size that this had
}

double Simulation::longest_step_of_box(double until) const {
  const double now = tissue_.clock.time;
  if (model_.box_volume.at(now) == model_.box_volume.at(until)) return kNever;
  double volume = 0.0;
  for (const CellRow& row : tissue_.cells.rows) volume = std::max(volume, row.target_volume);
  const double radius = ball_radius(comm_.max(volume));
  return longest_carried_step(model_.box_volume, now, until, radius, model_.step.max_displacement * model_.contact.range);
}

std::vector<Vec3d> Simulation::centers() const {
  std::vector<Vec3d> out(tissue_.cells.size());
  std::vector<BodyOfRow> shells;
  for (const BodyOfRow& body : bodies_of(tissue_.cells)) {
    if (body.is_shell)
      shells.push_back(body);
    else
      out[body.row] = center_of(tissue_, body);
  }
  parallel_for(threads_, shells.size(), [&](std::size_t k) { out[shells[k].row] = center_of(tissue_, shells[k]); });
  return out;
}

void Simulation::set_bodies_to_targets(double dt) {
  const double keep = std::exp(-dt / kEasing), time = tissue_.clock.time + dt;
  const auto osmotic = [](const CellType& type) { return type.osmosis.acts(); };
  BodyValues body;
  if (std::any_of(model_.types.begin(), model_.types.end(), osmotic)) body = mechanics_->values(tissue_);
  OptionalColumns& optional = tissue_.cells.optional;
  for (const auto [k, is_shell, number] : bodies_of(tissue_.cells)) {
    CellRow& row = tissue_.cells.rows[k];
    const CellType& type = model_.types[row.type];
    if (const double left = optional.inflation_left[k]; left > 0.0) {
      const double gain = std::min(left, optional.inflation_rate[k] * dt);
      row.target_volume += gain;
      optional.inflation_left.set(k, left - gain);
    }
    double excess = optional.reference_excess[k];
    if (!type.osmosis.acts()) excess *= keep;
    const auto exchange = [&, row_number = k](double volume, std::size_t b) {
      CellState full = tissue_.cells.state(row_number);
      exchange_water(full, type, time, dt, volume, body.area[b], body.inner_pressure[b]);
      excess = full.reference_excess;
    };
    if (is_shell) {
      const double deviation = tissue_.cells.deviation(k, type, Trait::kTension);
      const double free = free_reference_volume(row.target_volume, type, deviation);
      double& reference = tissue_.shells.reference_volume[number];
      if (type.osmosis.acts()) {  // growth brings its water along: what has grown begins at the same concentrations
        const double grown = free * std::exp(excess) / reference;
        exchange(grown * body.volume[number], number);
      }
      if (tissue_.shells.rest_volume[number] != row.target_volume) dcm::set_rest_volume(tissue_.shells, number, row.target_volume);
      reference = free * std::exp(excess);
      if (const std::size_t n = tissue_.nuclei.of_shell(number); n < tissue_.nuclei.size())
        dcm::set_nucleus_target(tissue_.nuclei.shells, n, type.interior, type.shell.tension * (1.0 + deviation), row.target_volume);
    } else {
      if (type.osmosis.acts()) exchange(row.target_volume * std::exp(excess), tissue_.shells.size() + number);
      tissue_.spheres.radius[number] = ball_radius(row.target_volume * std::exp(excess));
    }
    optional.reference_excess.set(k, excess, tissue_.cells.size());
  }
  mechanics_->parameters_changed();
}

std::vector<std::string> Simulation::still_to_come() const { return morula::still_to_come(model_, tissue_, *mechanics_, centers(), comm_); }

void Simulation::average_pressures(double dt) {
  const std::vector<double> pressure = mechanics_->pressures(tissue_);
  for (const BodyOfRow& body : bodies_of(tissue_.cells)) {
    double& average = tissue_.cells.rows[body.row].pressure;
    average = averaged_pressure(average, pressure[body.place(tissue_.shells.size())], dt);
  }
}

std::vector<fields::CellSource> Simulation::field_sources() const {
  const std::vector<Vec3d> center = centers();
  std::vector<fields::CellSource> out;
  for (const BodyOfRow& body : bodies_of(tissue_.cells)) {
    const CellRow& row = tissue_.cells.rows[body.row];
    const auto type = static_cast<std::uint16_t>(row.phase == Phase::kDying ? model_.types.size() + row.type : row.type);
    fields::CellSource& source = out.emplace_back(fields::CellSource{row.id, type, center[body.row]});
    if (body.is_shell) {
      source.faces = tissue_.shells.topology(body.number).faces();
      source.nodes = tissue_.shells.nodes(body.number);
    } else {
      source.radius = tissue_.spheres.radius[body.number];
    }
  }
  return out;
}

Status Simulation::advance_fields(std::span<const std::size_t> due, const std::function<bool()>& give_up, StepOutcome& outcome) {
  if (due.empty()) return {};
  auto timed = timer().scope(Stage::kFields);
  const std::vector<fields::CellSource> sources = field_sources();
  std::vector<double> taken(sources.size()), seen(sources.size());
  for (const std::size_t f : due) {
    fields::Field& field = tissue_.fields[f];
    const double interval = tissue_.clock.time - field.time;
    const fields::FieldSpec spec =
        fields::in_interval(model_.fields[f], field.time, interval);  // all fields are due at the corners of a course
    MORULA_TRY_ASSIGN(auto report, field_solver_.advance(field, spec, model_.space, sources, interval, comm_, taken, seen, give_up));
    field.time = tissue_.clock.time;
    field.interval = fields::next_interval(interval, report.change, spec.interval_tolerance);
    field.way = 0.0;
    OptionalColumn<double>& amount = tissue_.cells.variables[amount_of(f)].values;
    OptionalColumn<double>& concentration = tissue_.cells.variables[concentration_of(f)].values;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      amount.set(i, amount[i] + taken[i], sources.size());
      concentration.set(i, seen[i], sources.size());
    }
    FieldLedger& ledger = tissue_.ledger.fields[f];
    ledger.in += report.total_inflow();
    ledger.taken += report.taken;
    ledger.decayed += report.decayed;
    outcome.fields.push_back(report);
  }
  return {};
}

void Simulation::wrap_cells() {
  if (!model_.space.any_periodic()) return;
  bool moved = false;
  for (const BodyOfRow& body : bodies_of(tissue_.cells)) {
    const std::size_t shell = body.number;
    if (body.is_shell) {
      const auto nodes = tissue_.shells.nodes(shell);
      const Vec3d center = volume_centroid(tissue_.shells.topology(shell).faces(), nodes);
      const Vec3d shift = model_.space.wrapped(center) - center;
      if (norm2(shift) > 1e-6) {
        for (Vec3d& p : nodes) p += shift;
        if (tissue_.shells.nucleus_of(shell) != nullptr) *tissue_.shells.nucleus[shell] += shift;
        if (const std::size_t n = tissue_.nuclei.of_shell(shell); n < tissue_.nuclei.size())
          for (Vec3d& p : tissue_.nuclei.shells.nodes(n)) p += shift;
        moved = true;
      }
    } else {
      Vec3d& p = tissue_.spheres.position[body.number];
      const Vec3d there = model_.space.wrapped(p);
      moved = moved || !(there == p);
      p = there;
    }
  }
  if (moved) mechanics_->cells_replaced();
}

std::vector<Event> Simulation::all_events(std::vector<Event> mine) const {
  const auto earlier = [](const Event& a, const Event& b) {
    if (a.time != b.time) return a.time < b.time;
    if (a.kind != b.kind) return a.kind < b.kind;
    return a.cell < b.cell;
  };
  mine = items_of_all_ranks(mine, comm_);
  std::sort(mine.begin(), mine.end(), earlier);
  return mine;
}

}  // namespace morula
