#include "fields/field_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "fields/brick_cg.h"
#include "fields/brick_operator.h"
#include "fields/brick_vector.h"
#include "fields/halo.h"
#include "fields/layout.h"
#include "fields/multigrid.h"

namespace morula::fields {

struct FieldSolver::Workspace {
  BufferPool pool;
  std::vector<double> unknowns;
};

FieldSolver::FieldSolver() : workspace_(std::make_unique<Workspace>()) {}
FieldSolver::~FieldSolver() = default;
FieldSolver::FieldSolver(FieldSolver&&) noexcept = default;
FieldSolver& FieldSolver::operator=(FieldSolver&&) noexcept = default;

double IntervalReport::balance_error() const {
  double passed = std::fabs(taken) + std::fabs(decayed);
  for (const auto& axis : inflow) passed += std::fabs(axis[0]) + std::fabs(axis[1]);
  const double scale = std::max({std::fabs(amount_before), std::fabs(amount_after), passed});
  return scale > 0.0 ? std::fabs(residual) / scale : std::fabs(residual);
}

Status check(const FieldSpec& spec) {
  const auto wrong = [&](const std::string& what, const std::string& help) {
    return Error{ErrorKind::kInput, "field '" + spec.name + "': " + what, help};
  };
  const auto negative = [](double x) { return !(x >= 0.0) || !std::isfinite(x); };
  if (negative(spec.diffusion))
    return wrong("the diffusion coefficient is negative or not a number", "give 0 or more, such as 2000 um^2/s");
  if (!(spec.relative_tolerance > 0.0) || !(spec.relative_tolerance < 1.0))
    return wrong("the relative tolerance is not between 0 and 1", "1e-4 is usual");
  for (const auto& axis : spec.boundary)
    for (const auto& face : axis)
      if (!std::isfinite(face.value)) return wrong("a boundary value is not a number", "");
  return check_reactions(spec);
}

namespace {

/// The largest concentration that matters: on the faces, and now; of what once was there a trace.
double concentration_scale(const Field& field, const FieldSpec& spec, double interval, const Comm& comm) {
  constexpr double kTrace = 1e-9;
  double scale = kTrace * std::fabs(spec.initial);
  for (const auto& axis : spec.boundary)
    for (const auto& face : axis)
      if (face.kind == FaceCondition::Kind::kValue) scale = std::max({scale, std::fabs(face.value), std::fabs(face.at(interval))});
  for (const auto& brick : field.concentration)
    for (const double c : brick) scale = std::max(scale, std::fabs(c));
  return comm.max(scale);
}

/// What reactions make in an interval at most, nothing being lost: the concentration that matters where there is nothing yet [mM].
double what_arises(const Field& field, const Layout& layout, const FieldReactions& reactions, double interval, const Comm& comm) {
  double most = 0.0;
  std::vector<double> rate;
  for (std::size_t b = 0; b < layout.bricks(); ++b) {
    rate.assign(field.concentration[b].size(), 0.0);
    const auto sinks = std::span(layout.sinks).subspan(layout.first_sink[b], layout.first_sink[b + 1] - layout.first_sink[b]);
    reactions.add_rates(sinks, field.concentration[b], field.grid.voxel_volume(), rate.data(), nullptr);
    for (const double r : rate) most = std::max(most, r);
  }
  return comm.max(most) * interval;
}

/// The slowest mode of the field: π²D/L² between two faces with a value, a quarter of it with one, else decay alone [1/s].
double slowest_rate(const Grid& grid, const FieldSpec& spec, double decay, const Space& space) {
  double rate = decay;
  const Vec3d size = grid.box.size();
  for (std::size_t a = 0; a < 3; ++a) {
    if (space.periodic(static_cast<int>(a))) continue;
    const int held = (spec.boundary[a][0].kind == FaceCondition::Kind::kValue) + (spec.boundary[a][1].kind == FaceCondition::Kind::kValue);
    const double mode = std::numbers::pi * std::numbers::pi * spec.diffusion / (size[a] * size[a]);
    rate += held == 2 ? mode : held == 1 ? 0.25 * mode : 0.0;
  }
  return rate;
}

/// Sums over all ranks of what the unknowns hold besides concentrations.
void collect_amounts(const Layout& layout, const std::vector<double>& unknowns, const Comm& comm, IntervalReport& report) {
  std::array<OrderFreeSum, Layout::kAmountsPerBrick> local;
  for (std::size_t b = 0; b < layout.bricks(); ++b)
    for (std::size_t k = 0; k < Layout::kAmountsPerBrick; ++k) local[k].add(unknowns[layout.amounts_at(b) + k]);
  std::array<double, Layout::kAmountsPerBrick> total{};
  comm.sum(local, total);
  for (std::size_t side = 0; side < kSides; ++side) report.inflow[side / 2][side % 2] = total[side];
  report.decayed = total[Layout::kDecayed];
}

void collect_extremes(const Field& field, const Comm& comm, IntervalReport& report) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& brick : field.concentration)
    for (const double c : brick) {
      low = std::min(low, c);
      high = std::max(high, c);
    }
  report.minimum = comm.min(low);
  report.maximum = comm.max(high);
}

/// The integrated concentrations become those of the field; their largest change [mM].
double take_over(Field& field, const Layout& layout, std::span<const double> unknowns, const Comm& comm) {
  double change = 0.0;
  for (std::size_t b = 0; b < layout.bricks(); ++b)
    for (std::size_t v = 0; v < field.concentration[b].size(); ++v) {
      double& concentration = field.concentration[b][v];
      change = std::max(change, std::fabs(unknowns[layout.offset[b] + v] - concentration));
      concentration = unknowns[layout.offset[b] + v];
    }
  return comm.max(change);
}

double sum_of(std::span<const double> values, const Comm& comm) {
  OrderFreeSum sum;
  for (const double v : values) sum.add(v);
  return comm.sum(sum);
}

Status check_input(const Field& field, std::span<const CellSource> cells, const Comm& comm) {
  enum : std::int64_t { kGood, kWrongCell, kWrongOwner };
  std::int64_t fault = owns_its_bricks(field, comm.rank()) ? kGood : kWrongOwner;
  for (const auto& cell : cells)
    if (!std::isfinite(norm2(cell.center)) || !(cell.radius >= 0.0) || !(cell.radius < 10.0 * norm(field.grid.box.size())))
      fault = std::max<std::int64_t>(fault, kWrongCell);
  fault = comm.max(fault);
  if (fault == kWrongOwner)
    return Error{ErrorKind::kInternal, "a rank does not own the bricks of a field that the list of owners gives to it", ""};
  if (fault == kWrongCell) return Error{ErrorKind::kInternal, "a cell has no finite position or radius when the fields are integrated", ""};
  return {};
}

}  // namespace

Result<IntervalReport> FieldSolver::advance(Field& field, const FieldSpec& spec, const Space& space, std::span<const CellSource> cells,
                                            double interval, const Comm& comm, std::span<double> taken, std::span<double> seen,
                                            const std::function<bool()>& give_up) {
  MORULA_TRY(check(spec));
  MORULA_TRY(check_input(field, cells, comm));
  IntervalReport report;
  report.amount_before = total_amount(field, comm);
  if (!std::isfinite(report.amount_before))
    return Error{ErrorKind::kPhysics, "field '" + spec.name + "' holds a value that is not a number", ""};

  const CellExchange exchange(field, space, cells, comm);
  const FieldReactions reactions(spec);
  Layout layout = layout_of(field, exchange.sinks(reactions.types_that_act()));
  layout.sinks_anywhere = comm.any(!layout.sinks.empty());
  Halo<double> halo(field, layout, space, comm);
  BrickOperator op(field.grid, spec, reactions, layout, halo);

  IntegrationSettings settings;
  settings.interval = interval;
  settings.first_step = field.next_step;
  settings.relative_tolerance = spec.relative_tolerance;
  double scale = concentration_scale(field, spec, interval, comm);
  if (scale == 0.0) scale = what_arises(field, layout, reactions, interval, comm);  // else no error at all would be allowed
  settings.absolute_tolerance = std::max(1e-3 * spec.relative_tolerance * scale, 1e-30);
  settings.largest_rate = comm.max(op.largest_rate(scale));
  settings.method = cheaper_method(interval, settings.largest_rate, slowest_rate(field.grid, spec, reactions.first_order(), space));
  std::optional<Multigrid> multigrid;
  if (settings.method == Method::kImplicit && is_worth_multigrid(interval, settings.largest_rate))
    settings.multigrid = &multigrid.emplace(field, spec, layout, space, comm);
  settings.give_up = give_up;

  auto& unknowns = workspace_->unknowns;
  unknowns.assign(layout.unknowns(), 0.0);
  for (std::size_t b = 0; b < layout.bricks(); ++b)
    std::copy(field.concentration[b].begin(), field.concentration[b].end(),
              unknowns.begin() + static_cast<std::ptrdiff_t>(layout.offset[b]));
  if (interval > 0.0) {
    const BrickVectorSpace vectors{&layout, &comm, &workspace_->pool};
    auto work = integrate(op, vectors, settings, unknowns);
    if (!work.ok()) {
      work.error().message = "field '" + spec.name + "': " + work.error().message;
      return std::move(work).error();
    }
    report.work = *work;
    field.next_step = report.work.next_step;
  }
  const double change = take_over(field, layout, unknowns, comm);
  report.change = change > 0.0 ? change / scale : 0.0;
  exchange.give_back(field, layout, std::span(unknowns).subspan(layout.sinks_at()), comm, taken, seen);
  collect_amounts(layout, unknowns, comm, report);
  collect_extremes(field, comm, report);
  report.taken = sum_of(taken.first(cells.size()), comm);
  report.amount_after = total_amount(field, comm);
  report.residual = (report.amount_after - report.amount_before) + report.taken + report.decayed - report.total_inflow();
  return report;
}

Status sample(const Field& field, const Space& space, std::span<const CellSource> cells, const Comm& comm, std::span<double> seen) {
  MORULA_TRY(check_input(field, cells, comm));
  const CellExchange exchange(field, space, cells, comm);
  std::vector<double> nothing(cells.size());
  exchange.give_back(field, layout_of(field, {}), {}, comm, nothing, seen);
  return {};
}

}  // namespace morula::fields
