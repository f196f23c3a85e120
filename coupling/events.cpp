#include "coupling/events.h"

#include "coupling/model.h"

namespace morula {
namespace {

using Cause = EventReason::Cause;

std::string text_of(const Trigger& trigger, const Model& model) {
  switch (trigger.value) {
    case Trigger::Value::kType:
      return "type " + model.types[trigger.type].name;
    case Trigger::Value::kPressure:
      return "pressure";
    default:
      return model.fields[static_cast<std::size_t>(trigger.field)].name;
  }
}

std::string text_of_cause(const EventReason& reason, const Model& model) {
  switch (reason.cause) {
    case Cause::kNone:
      return "";
    case Cause::kDivisionVolume:
      return "reached its division volume";
    case Cause::kDivisionVolumeAsShell:
      return "reached its division volume as a shell";
    case Cause::kLongLineage:
      return "cannot divide: its lineage is " + std::to_string(CellId::kMaxGenerations) + " generations long";
    case Cause::kLowConcentration: {
      const CellType& type = model.types[reason.number];
      return model.fields[static_cast<std::size_t>(type.death_field)].name + " is below what " + type.name + " needs";
    }
    case Cause::kShrunk:
      return "shrunk below the volume at which a dead cell is removed";
    case Cause::kRegion:
      return "region " + model.swaps.regions[reason.number].name;
    case Cause::kTrigger:
      return text_of(model.swaps.triggers[reason.number], model);
    case Cause::kOutside:
      return "outside";
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
