#pragma once
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include "coupling/cells.h"
#include "coupling/mechanics/as_balls.h"
#include "coupling/mechanics/told.h"
#include "coupling/model.h"

namespace morula {

/// What the bodies of a rank are at present positions.
struct BodiesNow {
  BodyValues values;          ///< by place (BodyOfRow::place)
  std::vector<Vec3d> center;  ///< by row
};

/// A cell at one moment, as observables and behaviours see it: its row, and what its body is at present positions.
class CellView {
 public:
  CellView(const Cells& cells, std::size_t row, const CellType& type, double time) : cells_(&cells), row_(row), type_(&type), time_(time) {}

  /// What the body is; `place` is that of the body among all of the rank (BodyOfRow::place).
  void set_body(const BodyValues& values, std::size_t place, const Vec3d& centre) {
    center = centre;
    volume = values.volume[place];
    area = values.area[place];
    contact_area = values.contact_area[place];
    pressure = values.pressure[place];
    stress = values.stress[place];
    stressed_volume = values.stressed_volume[place];
    inner_pressure = values.inner_pressure[place];
  }

  /// What it is as a ball; `place` as in set_body().
  void set_ball(const AsBalls& balls, std::size_t place) {
    outside_law = balls.outside_law[place];
    packing = balls.packing[place];
  }

  /// What its pressure leaves of its volume: a shell's own, of a sphere V exp(−p/K_V), but where its ball follows the water in it [µm³].
  [[nodiscard]] double pressed_volume() const { return row().body == BodyKind::kShell || type_->osmosis.acts() ? volume : stressed_volume; }
  /// Id, type, phase, target volume, pressure averaged over the last minute.
  [[nodiscard]] const CellRow& row() const { return cells_->rows[row_]; }
  [[nodiscard]] const CellType& type() const { return *type_; }
  [[nodiscard]] double time() const { return time_; }                    ///< [s]
  [[nodiscard]] double age() const { return time_ - row().birth_time; }  ///< [s]
  [[nodiscard]] bool is_dying() const { return row().phase == Phase::kDying; }
  [[nodiscard]] double since_death() const { return time_ - cells_->optional.death_time[row_]; }  ///< of a dying cell [s]
  [[nodiscard]] Vec3d polarity() const { return cells_->optional.polarity[row_]; }
  /// What it sees in a field of the model [mM].
  [[nodiscard]] double concentration(std::size_t field) const { return cells_->variables[concentration_of(field)].values[row_]; }
  /// What it has taken from a field since its birth and from its mother [amol].
  [[nodiscard]] double amount(std::size_t field) const { return cells_->variables[amount_of(field)].values[row_]; }
  /// A variable of the model by name, such as that of a behaviour, "exhaustion/load"; 0 where there is none.
  [[nodiscard]] double variable(std::string_view name) const {
    for (const VariableColumn& variable : cells_->variables)
      if (variable.what.name == name) return variable.values[row_];
    return 0.0;
  }

  /// Name of the phase of its cycle; empty where its type has none, and of a cell that dies.
  [[nodiscard]] std::string_view phase_name() const {
    const std::vector<CyclePhase>& phases = type().cycle.phases;
    if (phases.empty() || is_dying()) return {};
    const auto phase = static_cast<std::size_t>(variable(kPhaseVariable));
    return phase < phases.size() ? std::string_view(phases[phase].name) : std::string_view(kQuiescentPhase);
  }

  // Of its body. Behaviours have these only where they ask for them (Behaviour::looks_at_body).
  Vec3d center{};                ///< centroid of its volume [µm]
  double volume = 0.0;           ///< [µm³]
  double area = 0.0;             ///< of its surface [µm²]
  double contact_area = 0.0;     ///< of it in contact [µm²]
  double pressure = 0.0;         ///< now: −tr σ/3 of what neighbours, obstacles and loads exert on it [kPa]
  SymMat3<double> stress{};      ///< σ, what they exert on it (BodyValues) [kPa]
  double stressed_volume = 0.0;  ///< V of this stress [µm³]
  double inner_pressure = 0.0;   ///< −K_V ln(V/V0) of a shell; of a sphere its pressure [kPa]
  double outside_law = std::numeric_limits<double>::quiet_NaN();  ///< as a ball (AsBalls), where somebody asks for it; else no number
  double packing = std::numeric_limits<double>::quiet_NaN();      ///< φ as a ball, likewise

 private:
  const Cells* cells_;
  std::size_t row_;
  const CellType* type_;
  double time_;
};

}  // namespace morula
