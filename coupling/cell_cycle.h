#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "coupling/behaviours/arrest.h"
#include "coupling/behaviours/growth_law.h"
#include "coupling/distribution.h"

namespace morula {

/// A phase of the cycle.
struct CyclePhase {
  enum class Length : std::uint8_t {
    kPart,      ///< time.mean times the cycle duration of the cell
    kFixed,     ///< time.mean [s]
    kGaussian,  ///< drawn from `time`, truncated at ±3 deviations and above 0 [s]
    kErlang,    ///< the sum of `stages` exponential times, together time.mean on average [s]
    kSize,      ///< until the cell has its division volume
  };
  std::string name;
  Length length = Length::kFixed;
  Distribution time{};
  std::uint32_t stages = 1;
  bool grows = true;                 ///< the cell grows in it
  std::vector<CellArrest> arrest{};  ///< factors of the rate at which it passes
};

/// What a cell's division volume follows from.
enum class SizeControl : std::uint8_t {
  kTimer,  ///< its birth volume: `ratio` times that
  kSizer,  ///< nothing of the cell: `size`
  kAdder,  ///< its birth volume: `size` more
};

/// Name of quiescence among the phases.
inline constexpr const char* kQuiescentPhase = "G0";

/// When cells leave a phase for quiescence (G0), and come back into it.
struct Quiescence {
  int phase = -1;           ///< number of the phase; −1: never
  double enter_below = 0.;  ///< when the factor of the phase has been less than this
  double leave_above = 1.;  ///< when it has been more than this again
  double hold = 0.0;        ///< for so long [s]
};

/// How cells of a type that cycles come from their birth to their division.
struct CellCycle {
  std::shared_ptr<const GrowthLaw> growth = linear_growth();
  LawValues growth_values{};         ///< of the law's own keys
  std::vector<CellArrest> arrest{};  ///< factors of the rate of growth
  double ratio = 2.0;                ///< division volume over birth volume
  SizeControl control = SizeControl::kTimer;
  double size = 0.0;                 ///< mean over cells; see SizeControl [µm³]
  double size_spread = 0.0;          ///< relative, of what is gained (timer, adder) or of the division volume (sizer)
  std::vector<CyclePhase> phases{};  ///< empty: one without a name, which ends at the division volume
  Quiescence quiescence{};
};

}  // namespace morula
