#pragma once
#include <string>

namespace morula::app {

/// A measure or a theory of a criterion as `morula explain` tells it; empty where there is none of this name. `measures` and `theories`
/// list all.
std::string explain_measure(const std::string& name);

/// All measures and theories as Markdown: docs/measures.md.
std::string measure_reference();

}  // namespace morula::app
