#include "coupling/laws.h"

#include "cbm/builtin.h"
#include "coupling/behaviours/arrest.h"
#include "coupling/behaviours/behaviour.h"
#include "coupling/behaviours/division_axis.h"
#include "coupling/behaviours/growth_law.h"
#include "coupling/behaviours/migration_law.h"
#include "coupling/behaviours/polarity_rule.h"
#include "coupling/loads/load.h"
#include "coupling/observables/observable.h"
#include "coupling/regions/region.h"
#include "dcm/builtin.h"
#include "fields/builtin.h"

namespace morula {

std::shared_ptr<const Laws> builtin_laws() {
  static const auto laws =
      std::make_shared<const Laws>(Laws{.shells = dcm::shell_laws(),
                                        .spheres = cbm::sphere_laws(),
                                        .surfaces = surface_laws(),
                                        .behaviours = builtin_behaviours(),
                                        .growth = growth_laws(),
                                        .arrest = builtin_arrest_factors(),
                                        .division_axes = builtin_division_axes(),
                                        .migration = migration_laws(),
                                        .polarity = polarity_rules(),
                                        .loads = builtin_loads(),
                                        .region_shapes = builtin_region_shapes(),
                                        .trigger_values = builtin_trigger_values(),
                                        .reactions = fields::builtin_reactions(),
                                        .observables = {&tissue_observables, &box_observables, &type_observables, &phase_observables,
                                                        &obstacle_observables, &lumen_observables, &grip_observables, &field_observables}});
  return laws;
}

}  // namespace morula
