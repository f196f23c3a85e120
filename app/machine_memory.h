#pragma once
#include <unistd.h>

namespace morula::app {

/// Of this machine [bytes].
inline double machine_memory() { return static_cast<double>(sysconf(_SC_PAGESIZE)) * static_cast<double>(sysconf(_SC_PHYS_PAGES)); }

}  // namespace morula::app
