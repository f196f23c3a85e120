#include "coupling/behaviours/behaviour.h"

#include <cmath>

#include "coupling/cell_view.h"

namespace morula {
namespace {

constexpr int kStepBits = 40;  // of the index of a random number; those above tell the draws of a step apart

/// Of a behaviour whose stream has no name of its own: from its name, apart from all named ones (FNV-1a with the highest bit set).
RandomStream stream_of(const std::string& name) {
  std::uint32_t hash = 2166136261u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return static_cast<RandomStream>(hash | 0x80000000u);
}

std::uint64_t index_of(std::uint64_t step, std::uint64_t draw) { return step + (draw << kStepBits); }

}  // namespace

RandomPair CellStep::uniform(std::uint64_t draw) const { return random.uniform(cell.row().id, index_of(number, draw)); }
RandomPair CellStep::normal(std::uint64_t draw) const { return random.normal(cell.row().id, index_of(number, draw)); }
bool CellStep::happens(double rate, std::uint64_t draw) const { return uniform(draw).first < -std::expm1(-rate * dt); }

CellBehaviour::CellBehaviour(std::shared_ptr<const Behaviour> behaviour, OwnValues given, const std::string& type)
    : what(std::move(behaviour)),
      values(std::move(given)),
      act(what->build(values)),
      reason(what->reason != nullptr ? what->reason(values, type) : what->info.title),
      stream(what->stream.value_or(stream_of(what->info.name))) {}

std::vector<std::shared_ptr<const Behaviour>> builtin_behaviours() { return {starvation()}; }

}  // namespace morula
