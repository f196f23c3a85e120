#include "coupling/laws.h"

#include "dcm/builtin.h"

namespace morula {

std::shared_ptr<const Laws> builtin_laws() { return std::make_shared<const Laws>(Laws{.shells = dcm::shell_laws()}); }

}  // namespace morula
