#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "cbm/sphere_law.h"
#include "coupling/surface_law.h"
#include "dcm/shell_law.h"

namespace morula {

namespace fields {
struct Reaction;
}

struct ArrestFactor;
struct Behaviour;
struct DivisionAxis;
struct GrowthLaw;
struct Load;
struct MigrationLaw;
struct Model;
struct Observable;
struct PolarityRule;
struct RegionShape;
struct TriggerValue;

/// Columns of series.csv that are declared together: those that a run of this model has (coupling/observables/observable.h).
using Observables = std::function<std::vector<Observable>(const Model&)>;

/// The laws that a study may name. A program with laws of its own appends them to a copy of builtin_laws() and hands that to the study reader;
/// the models that it makes keep what they need of them.
struct Laws {
  std::vector<dcm::ShellLaw> shells;
  std::vector<std::shared_ptr<const cbm::SphereLaw>> spheres;  ///< of their contact
  std::vector<std::shared_ptr<const SurfaceLaw>> surfaces;     ///< of contact of surfaces
  std::vector<std::shared_ptr<const Behaviour>> behaviours;    ///< in the order in which they act
  std::vector<std::shared_ptr<const GrowthLaw>> growth;
  std::vector<std::shared_ptr<const ArrestFactor>> arrest;  ///< of growth and of phases
  std::vector<std::shared_ptr<const DivisionAxis>> division_axes;
  std::vector<std::shared_ptr<const MigrationLaw>> migration;
  std::vector<std::shared_ptr<const PolarityRule>> polarity;  ///< in the order in which they act
  std::vector<std::shared_ptr<const Load>> loads;
  std::vector<std::shared_ptr<const RegionShape>> region_shapes;
  std::vector<std::shared_ptr<const TriggerValue>> trigger_values;
  std::vector<std::shared_ptr<const fields::Reaction>> reactions;  ///< of fields
  std::vector<Observables> observables;
};

/// What Morula brings.
std::shared_ptr<const Laws> builtin_laws();

}  // namespace morula
