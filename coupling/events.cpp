#include "coupling/events.h"

#include "coupling/behaviours/life.h"
#include "coupling/model.h"

namespace morula {
namespace {

using Cause = EventReason::Cause;

std::string text_of(const Trigger& trigger, const Model& model) {
  if (trigger.type >= 0) return "type " + model.types[static_cast<std::size_t>(trigger.type)].name;
  if (!trigger.phase.empty()) return "phase " + trigger.phase;
  return trigger.field >= 0 ? model.fields[static_cast<std::size_t>(trigger.field)].name : trigger.value->info.name;
}

std::string text_of(const CellCycle& cycle) {
  return "the rate of phase " + cycle.phases[static_cast<std::size_t>(cycle.quiescence.phase)].name;
}

std::string text_of_cause(const EventReason& reason, const Model& model) {
  switch (reason.cause) {
    case Cause::kNone:
      return "";
    case Cause::kDivisionVolume:
      return "reached its division volume";
    case Cause::kLastPhase:
      return "its last phase ended";
    case Cause::kPhaseHeld:
      return text_of(model.types[reason.number].cycle);
    case Cause::kDivisionVolumeAsShell:
      return "reached its division volume as a shell";
    case Cause::kNoPlane:
      return "reached its division volume and found no plane that leaves two good meshes with room among their neighbours; it tries others "
             "every " +
             std::to_string(static_cast<int>(kTimeBetweenTries / 60.0)) + " min";
    case Cause::kUnevenMesh:
      return "has a face that is nearly a line, and its nodes cannot be spread evenly on its surface; it tries again every " +
             std::to_string(static_cast<int>(kTimeBetweenTries / 60.0)) + " min";
    case Cause::kLongLineage:
      return "cannot divide: its lineage is " + std::to_string(CellId::kMaxGenerations) + " generations long";
    case Cause::kBehaviour:
      return model.types[reason.number & 0xFFFF].behaviours[reason.number >> 16].reason;
    case Cause::kShrunk:
      return "shrunk below the volume at which a dead cell is removed";
    case Cause::kRegion:
      return "region " + model.swaps.regions[reason.number].name;
    case Cause::kTrigger:
      return text_of(model.swaps.triggers[reason.number], model);
    case Cause::kOutside:
      if (!model.swaps.regions.empty()) return "outside";
      return model.swaps.triggers.empty() ? "its type" : "no trigger asks for a shell any more";
    case Cause::kBecameShell:
      return "how far its neighbours went since it became a shell";
    case Cause::kBecameSphere:
      return "how far its neighbours went since it became a sphere";
  }
  return "";
}

}  // namespace

std::string text_of(const EventReason& reason, const Model& model) {
  const std::string cause = text_of_cause(reason, model);
  if (!reason.no_room) return cause;
  return "no room among its neighbours to become a shell (" + cause + "); it stays a sphere until the hold time is over";
}

}  // namespace morula
