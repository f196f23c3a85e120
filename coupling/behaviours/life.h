#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "coupling/behaviours/phases.h"
#include "coupling/cell_view.h"
#include "coupling/events.h"
#include "coupling/model.h"

namespace morula {

/// The step whose life is lived.
struct LifeStep {
  std::uint32_t seed = 1;
  std::uint64_t step = 0;                 ///< number of the step; keys the random numbers
  double time = 0.0;                      ///< at the end of the step [s]
  double dt = 0.0;                        ///< [s]
  const BodiesNow* bodies = nullptr;      ///< at the start of the step, where behaviours look at them (look_at_bodies())
  std::span<const SensedField> sensed{};  ///< by row: what cells sense of the field that their migration looks at; empty where none does
};

/// What a cell decided in a step.
struct LifeDecision {
  enum class Kind : std::uint8_t {
    kNone,
    kDivide,  ///< it reached its division volume
    kWait,    ///< it did as a shell of a type whose shells wait; said once
    kCannot,  ///< it did, but its lineage has as many generations as an id can name; said once
    kBeginDying,
    kRemove,  ///< a dying cell is gone
    kLeave,   ///< it leaves its cycle for quiescence
    kReturn,  ///< it comes back
  } kind = Kind::kNone;
  double late = 0.0;            ///< time between the event and the end of the step [s]
  std::uint16_t behaviour = 0;  ///< of a death: number of the behaviour of the type that asked for it
};

/// Time after which a shell that found no plane of division looks for others [s].
inline constexpr double kTimeBetweenTries = 600.0;

/// The optional values of a cell that its life is about.
struct LifeValues {
  Vec3d migration_velocity{};  ///< read and written [µm/s]
  double death_time = -1.0;    ///< read and written [s]
  Vec3d polarity{};            ///< read and written
  CyclePlace place{};          ///< read and written, of a type with phases
  SensedField sensed{};        ///< read
  Vec3d walk{};                ///< written: mean of the wanted velocity over the step [µm/s]
};

/// One step in the life of one cell: growth, cycle, death and the wanted velocity, and what its behaviours ask for. Reads and writes this row and its
/// values only, as they were at the beginning of the stage: nothing depends on the order of cells.
///
/// A dying cell shrinks and is removed at last; its behaviours have no say. Any other may begin to die; if it does not, it grows unless it rests or
/// waits. Division at the division volume: a sphere divides, and a shell unless those of its type wait (it then divides if it becomes a sphere
/// later). A shell for which no plane served waits, too, and is to divide whenever the time of the run passes a multiple of kTimeBetweenTries.
///
/// A type without phases divides at its division volume, one with phases at the end of the last. `rate`: factor of the rate at which a phase passes.
LifeDecision live(CellRow& row, LifeValues& values, const CellType& type, const LifeStep& step, const CellWish& wish = {},
                  const PhaseRate& rate = {});

struct DivisionOrder {
  std::size_t row = 0;
  double late = 0.0;  ///< for divide_row() [s]
};

/// What a step of life asks the pipeline to do, in the order of rows.
struct LifeReport {
  std::vector<Event> events;
  std::vector<DivisionOrder> divisions;  ///< rows to replace by their daughters, whose events are told already
  std::vector<std::size_t> removals;     ///< rows to remove
  std::vector<Vec3d> walk;  ///< by row: mean of the velocity that a cell wants over the step [µm/s]; empty where none migrates
};

/// One step in the life of all cells, which are changed in place; divisions and removals are only asked for. types: by row.type.
LifeReport live(Cells& cells, std::span<const CellType> types, const LifeStep& step);

}  // namespace morula
