// The whole program `morula` with laws of one's own: `check`, `explain`, `run`, `resume` and `plot` know them as they know the others.
#include <app/program.h>

#include "death_by_pressure.h"
#include "evans_skalak.h"
#include "linear_spring.h"
#include "roundness.h"

int main(int argc, char** argv) {
  auto laws = std::make_shared<morula::Laws>(*morula::builtin_laws());
  laws->shells.push_back(evans_skalak());
  laws->spheres.push_back(linear_spring());
  laws->behaviours.push_back(death_by_pressure());
  laws->observables.emplace_back(&roundness);
  return morula::app::run_program(argc, argv, laws);
}
