#include "coupling/observables/observable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/parallel/order_free_sum.h"
#include "coupling/laws.h"
#include "coupling/simulation.h"

namespace morula {

void CellsAtOutput::visit(const Value& value, const std::function<void(double)>& function) const {
  if (!bodies_) bodies_ = std::make_shared<const BodiesNow>(BodiesNow{simulation_.values(), simulation_.centers()});
  if (!balls_) balls_ = std::make_shared<const AsBalls>(simulation_.mechanics().as_balls(simulation_.tissue()));
  const Tissue& tissue = simulation_.tissue();
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    CellView cell(tissue.cells, body.row, simulation_.model().types[tissue.cells.rows[body.row].type], tissue.clock.time);
    cell.set_body(bodies_->values, body.place(tissue.shells.size()), bodies_->center[body.row]);
    cell.set_ball(*balls_, body.place(tissue.shells.size()));
    if (const double here = value(cell); !std::isnan(here)) function(here);
  }
}

double CellsAtOutput::sum(const Value& value) const {
  OrderFreeSum out;
  visit(value, [&out](double here) { out.add(here); });
  return simulation_.comm().sum(out);
}

double CellsAtOutput::mean(const Value& value) const {
  OrderFreeSum out;
  std::int64_t count = 0;
  visit(value, [&](double here) { out.add(here), ++count; });
  const double total = simulation_.comm().sum(out);
  count = simulation_.comm().sum(count);
  return count > 0 ? total / static_cast<double>(count) : 0.0;
}

double CellsAtOutput::largest(const Value& value) const {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  double out = kNone;
  visit(value, [&out](double here) { out = std::max(out, here); });
  out = simulation_.comm().max(out);
  return out == kNone ? 0.0 : out;
}

double CellsAtOutput::smallest(const Value& value) const {
  const double out = largest([&value](const CellView& cell) { return -value(cell); });
  return out == 0.0 ? 0.0 : -out;
}

std::vector<Observable> observables(const Model& model, const Laws& laws) {
  std::vector<Observable> out;
  for (const Observables& family : laws.observables)
    for (Observable& one : family(model)) out.push_back(std::move(one));
  return out;
}

std::vector<std::string> observable_names(const Model& model, const Laws& laws) {
  std::vector<std::string> out;
  for (const Observable& one : observables(model, laws)) out.push_back(one.name);
  return out;
}

std::vector<Observable> observables_of_any_model(const Laws& laws) {
  Model model;
  for (auto& faces : model.space.boundary) faces = {BoundaryKind::kPeriodic, BoundaryKind::kPeriodic};
  model.types.emplace_back().name = "<cell type>";
  model.types[0].interior.nucleus_fraction = 0.1;
  model.types[0].interior.nucleus_nodes = 162;
  model.types[0].cycle.phases = {{.name = "<phase>"}};
  model.obstacles.emplace_back().name = "<obstacle>";
  model.lumens.emplace_back().name = "<cavity>";
  model.loads.emplace_back().name = "<grip>";
  model.loads[0].what = grip_load();
  model.fields.emplace_back().name = "<field>";
  std::vector<Observable> out = observables(model, laws);
  model.space.boundary = {};  // some columns are of domains with faces only
  for (Observable& one : observables(model, laws))
    if (std::ranges::none_of(out, [&](const Observable& other) { return other.name == one.name; })) out.push_back(std::move(one));
  return out;
}

}  // namespace morula
