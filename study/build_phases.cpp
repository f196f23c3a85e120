// Phases of the cycle, and the way out of them.
#include <algorithm>
#include <cmath>

#include "coupling/behaviours/phases.h"
#include "study/build.h"

namespace morula::scenarios {
namespace {

using Length = CyclePhase::Length;

/// Those of a cycle for which the study gives none.
std::vector<CyclePhase> usual_phases() {
  std::vector<CyclePhase> out;
  for (const auto& [name, part] : {std::pair("G1", 7.0), {"S", 6.0}, {"G2", 3.0}, {"M", 2.0}})
    out.push_back({.name = name, .length = Length::kPart, .time = {part / 18.0, 0.0}});
  return out;
}

/// A key that belongs to another word: E515; one that a word needs: E516.
template <class T>
void check_key(BuildContext& c, const Given<T>& key, const char* name, bool needed, const Given<std::string>& word, const char* belongs) {
  if (!word.known()) return;
  if (key.given && !needed) c.diagnostics.error(515, key.place, "'" + std::string(name) + "' has no effect here", belongs);
  if (!key.given && !key.known() && needed)
    c.diagnostics.error(516, word.place, "`" + word.value + "` needs `" + name + "`", std::string("`") + name + "` is not given");
}

CyclePhase build_phase(BuildContext& c, const Named<draft::CyclePhase>& item) {
  const draft::CyclePhase& p = item.content;
  CyclePhase out;
  out.name = item.name;
  if (item.name == kQuiescentPhase)
    c.diagnostics.error(112, item.place, "a phase cannot be called 'G0'", "that is where `quiescence` takes cells to");
  const bool by_size = p.until.value == "size", gaussian = p.law.value == "gaussian", erlang = p.law.value == "erlang";
  const char* const no_duration = "a phase that ends by size has no duration";
  check_key(c, p.duration, "duration", !by_size, p.until, no_duration);
  check_key(c, p.spread, "spread", gaussian && !by_size, p.law, by_size ? no_duration : "it belongs to `law: gaussian`");
  check_key(c, p.stages, "stages", erlang && !by_size, p.law, by_size ? no_duration : "it belongs to `law: erlang`");
  if (by_size && p.law.is_changed()) check_key(c, p.law, "law", false, p.until, no_duration);
  out.length = by_size ? Length::kSize : gaussian ? Length::kGaussian : erlang ? Length::kErlang : Length::kFixed;
  out.time = {p.duration.value, gaussian ? p.spread.value : 0.0};
  if (erlang) out.stages = static_cast<std::uint32_t>(std::max<std::uint64_t>(1, p.stages.value));
  out.grows = p.grows.value;
  out.arrest = build_phase_arrest(c, p, item.place);
  return out;
}

/// A phase that ends by size is the last in which cells grow, and nothing holds it back but for G0; there is one where size is controlled: W515, E700, E702.
void check_size_phase(BuildContext& c, const draft::CellType& t, const CellType& type) {
  const CellCycle& cycle = type.cycle;
  const std::vector<CyclePhase>& phases = cycle.phases;
  bool by_size = false;
  for (std::size_t p = 0; p < phases.size() && !t.cycle.phases.empty(); ++p) {
    if (phases[p].length != Length::kSize) continue;
    by_size = true;
    const Place& place = t.cycle.phases[p].content.until.place;
    if (!cycle.growth->grows || p != last_growing_phase(cycle))
      c.diagnostics.error(702, place, "phase '" + phases[p].name + "' cannot end by size: it is not the last phase in which cells grow",
                          "`grows: false` in those behind it");
    if (!phases[p].arrest.empty() && cycle.quiescence.phase != static_cast<int>(p))
      c.diagnostics.warning(515, t.cycle.phases[p].place,
                            "'arrest' of phase '" + phases[p].name + "' has no effect here: the phase ends by size, however long it takes",
                            "`arrest` of the cycle holds growth back; `quiescence` takes cells of this phase to G0");
  }
  if (cycle.control != SizeControl::kTimer && !by_size)
    c.diagnostics.error(702, t.cycle.control.place, "no phase of '" + type.name + "' ends by size, so that size cannot be controlled",
                        "`until: size` for the last phase in which cells grow");
  if (cycle.growth->grows && last_growing_phase(cycle) == phases.size())
    c.diagnostics.error(700, t.cycle.phases.front().place, "cells of '" + type.name + "' grow in no phase",
                        "`growth: none` for cells that only become smaller");
}

/// Mean and spread of the whole cycle from those of its phases.
Distribution whole_cycle(const std::vector<CyclePhase>& phases) {
  double mean = 0.0, variance = 0.0;
  for (const CyclePhase& phase : phases) {
    const double relative = phase.length == Length::kErlang ? 1.0 / std::sqrt(phase.stages) : phase.time.relative_spread;
    mean += phase.time.mean;
    variance += phase.time.mean * phase.time.mean * relative * relative;
  }
  return {mean, mean > 0.0 ? std::sqrt(variance) / mean : 0.0};
}

/// E510, E515, E703.
void build_quiescence(BuildContext& c, const draft::Cycle& t, CellCycle& cycle) {
  if (!t.has_quiescence) return;
  const auto at = std::ranges::find(cycle.phases, t.quiescent_phase.value, &CyclePhase::name);
  if (at == cycle.phases.end()) {
    std::vector<std::string> names;
    for (const CyclePhase& phase : cycle.phases) names.push_back(phase.name);
    if (t.quiescent_phase.known())
      c.diagnostics.error(703, t.quiescent_phase.place, "there is no phase '" + t.quiescent_phase.value + "'",
                          suggest(t.quiescent_phase.value, names));
    return;
  }
  if (at->arrest.empty())
    c.diagnostics.error(703, t.quiescent_phase.place, "nothing holds phase '" + at->name + "' back: its cells never leave it for G0",
                        "give the phase an `arrest`");
  if (t.enter_below.known() && t.leave_above.known() && !(t.enter_below.value <= t.leave_above.value))
    c.diagnostics.error(510, t.leave_above.given ? t.leave_above.place : t.enter_below.place,
                        "cells would leave below " + t.enter_below.text + " and come back above " + t.leave_above.text,
                        "set `above` above `below`");
  cycle.quiescence = {static_cast<int>(at - cycle.phases.begin()), t.enter_below.value, t.leave_above.value, t.hold.value};
}

}  // namespace

void build_phases(BuildContext& c, const draft::CellType& t, CellType& type) {
  CellCycle& cycle = type.cycle;
  if (t.cycle_model.value != "phases") {
    if (!t.cycle.phases.empty() && t.cycle_model.known())
      c.diagnostics.error(515, t.cycle_model.given ? t.cycle_model.place : t.cycle.phases.front().place,
                          "the phases of '" + type.name + "' have no effect here",
                          "they belong to `model: phases`; `phases: default` where they are those of the type that it is `like`");
    if (t.cycle.has_quiescence)
      c.diagnostics.error(515, t.cycle.quiescent_phase.place, "'quiescence' has no effect here", "it belongs to `model: phases`");
    return;
  }
  for (const auto& item : t.cycle.phases) cycle.phases.push_back(build_phase(c, item));
  if (cycle.phases.empty()) cycle.phases = usual_phases();
  build_quiescence(c, t.cycle, cycle);
  check_size_phase(c, t, type);
  if (paced_by_phases(cycle)) type.cycle_duration = whole_cycle(cycle.phases);
}

}  // namespace morula::scenarios
