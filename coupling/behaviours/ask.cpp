#include "coupling/behaviours/ask.h"

#include <algorithm>

#include "coupling/cell_view.h"

namespace morula {
namespace {

/// The first variable of a behaviour among those of the cells.
std::size_t first_variable(const Cells& cells, const Behaviour& behaviour) {
  if (behaviour.variables.empty()) return 0;
  const std::string name = behaviour.info.name + "/" + behaviour.variables.front().name;
  const auto at = std::ranges::find_if(cells.variables, [&](const VariableColumn& one) { return one.what.name == name; });
  return static_cast<std::size_t>(at - cells.variables.begin());
}

double factor_of(const std::vector<CellArrest>& arrest, const CellView& cell) {
  double out = 1.0;
  for (const CellArrest& one : arrest) out *= one.of(cell);
  return out;
}

}  // namespace

bool look_at_bodies(std::span<const CellType> types) {
  const auto looks = [](const auto& one) { return one.what->looks_at_body; };
  return std::ranges::any_of(types, [&](const CellType& type) {
    return std::ranges::any_of(type.behaviours, looks) || std::ranges::any_of(type.cycle.arrest, looks) ||
           std::ranges::any_of(type.cycle.phases, [&](const CyclePhase& phase) { return std::ranges::any_of(phase.arrest, looks); });
  });
}

AskBehaviours::AskBehaviours(Cells& cells, std::span<const CellType> types, const LifeStep& step)
    : cells_(cells), types_(types), step_(step) {
  for (const CellType& type : types) {
    auto& first = first_variable_.emplace_back();
    for (const CellBehaviour& one : type.behaviours) {
      first.push_back(first_variable(cells, *one.what));
      for (std::size_t v = 0; v < one.what->variables.size(); ++v) cells.variables[first.back() + v].values.make_room(cells.size());
    }
  }
  if (step.bodies == nullptr) return;
  const auto shells =
      static_cast<std::size_t>(std::ranges::count_if(cells.rows, [](const CellRow& row) { return row.body == BodyKind::kShell; }));
  for (const BodyOfRow& body : bodies_of(cells)) place_.push_back(body.place(shells));
}

Asked AskBehaviours::ask(std::size_t row) {
  Asked out;
  const std::size_t type_number = cells_.rows[row].type;
  const CellType& type = types_[type_number];
  if (type.behaviours.empty() && type.cycle.arrest.empty()) return out;
  const CellView view = look_at(row);
  std::vector<double> state;
  for (std::size_t b = 0; b < type.behaviours.size(); ++b) {
    const CellBehaviour& one = type.behaviours[b];
    const std::size_t first = first_variable_[type_number][b];
    state.clear();
    for (std::size_t v = 0; v < one.what->variables.size(); ++v) state.push_back(cells_.variables[first + v].values[row]);
    const bool dying = out.wish.die;
    one.act({view, step_.dt, state, Random(step_.seed, one.stream), step_.step}, out.wish);
    for (std::size_t v = 0; v < state.size(); ++v) cells_.variables[first + v].values.set(row, state[v]);
    if (out.wish.die && !dying) out.deadly = static_cast<std::uint16_t>(b);
  }
  out.wish.growth *= factor_of(type.cycle.arrest, view);
  return out;
}

double AskBehaviours::phase_rate(std::size_t row, std::size_t phase) const {
  const std::vector<CellArrest>& arrest = types_[cells_.rows[row].type].cycle.phases[phase].arrest;
  return arrest.empty() ? 1.0 : factor_of(arrest, look_at(row));
}

CellView AskBehaviours::look_at(std::size_t row) const {
  CellView view(cells_, row, types_[cells_.rows[row].type], step_.time - step_.dt);
  if (step_.bodies != nullptr) view.set_body(step_.bodies->values, place_[row], step_.bodies->center[row]);
  return view;
}

}  // namespace morula
