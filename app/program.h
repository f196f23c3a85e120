#pragma once
#include <memory>

#include "coupling/laws.h"

namespace morula::app {

/// The program `morula` as a function: reads the command line, does what it says on all ranks, and gives the exit code of the process. To be called
/// once, first thing in main(), for it starts and ends MPI.
///
/// A program of one's own hands in builtin_laws() with its laws behind them; all verbs then know them: `check`, `explain`, `run`, `resume`, `plot`.
int run_program(int argc, char** argv, std::shared_ptr<const Laws> laws = builtin_laws());

}  // namespace morula::app
