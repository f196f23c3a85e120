#pragma once
#include <memory>
#include <vector>

#include "dcm/shell_law.h"

namespace morula {

/// The laws that a study may name. A program with laws of its own appends them to a copy of builtin_laws() and hands that to the study reader;
/// the models that it makes keep what they need of them.
struct Laws {
  std::vector<dcm::ShellLaw> shells;
};

/// What Morula brings.
std::shared_ptr<const Laws> builtin_laws();

}  // namespace morula
