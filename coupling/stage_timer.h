#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <string_view>

namespace morula {

/// The stages of a step as `run --timings` prints them. Finding shapes (of cells that become shells, of daughters of shells) is a part of the stage
/// that does it, too.
enum class Stage : std::uint8_t {
  kGhosts,
  kCandidates,
  kContacts,
  kInternal,
  kAssemble,
  kSolve,
  kAdvance,
  kFields,
  kBehaviours,
  kCoupling,
  kShapes,
  kBalance,
  kObserve,
  kCount
};
inline constexpr std::array<std::string_view, static_cast<std::size_t>(Stage::kCount)> kStageNames{
    "exchange ghosts", "find candidates", "contacts", "internal forces", "assemble", "solve",  "advance",
    "fields",          "behaviours",      "coupling", "find shapes",     "balance",  "observe"};

/// Wall time by stage. Timing never influences a result.
class StageTimer {
 public:
  /// Time from construction to destruction goes to the stage.
  class Scope {
   public:
    Scope(StageTimer& timer, Stage stage) : timer_(timer), stage_(stage), start_(Clock::now()) {}
    ~Scope() { timer_.seconds_[static_cast<std::size_t>(stage_)] += std::chrono::duration<double>(Clock::now() - start_).count(); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    using Clock = std::chrono::steady_clock;
    StageTimer& timer_;
    Stage stage_;
    Clock::time_point start_;
  };

  [[nodiscard]] Scope scope(Stage stage) { return Scope(*this, stage); }
  [[nodiscard]] double seconds(Stage stage) const { return seconds_[static_cast<std::size_t>(stage)]; }
  [[nodiscard]] double total() const {
    double sum = 0.0;
    for (const double s : seconds_) sum += s;
    return sum;
  }

 private:
  std::array<double, static_cast<std::size_t>(Stage::kCount)> seconds_{};
};

}  // namespace morula
