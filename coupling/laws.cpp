#include "coupling/laws.h"

#include "cbm/builtin.h"
#include "dcm/builtin.h"

namespace morula {

std::shared_ptr<const Laws> builtin_laws() {
  return std::make_shared<const Laws>(Laws{.shells = dcm::shell_laws(), .spheres = cbm::sphere_laws(), .surfaces = surface_laws()});
}

}  // namespace morula
