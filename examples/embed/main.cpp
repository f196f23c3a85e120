// Reads a study, steps it to its end, and prints the pressures of its cells at every output: all that a program needs of Morula.
#include <morula/morula.h>

#include <cstdio>

namespace {

int failed(const morula::Error& error) {
  std::fprintf(stderr, "%s\n%s\n", error.message.c_str(), error.help.c_str());
  return 1;
}

void print(const morula::api::Study& study, const morula::api::Simulation& simulation) {
  for (const morula::api::Cell& cell : simulation.cells())
    std::printf("%g s  cell %llu  %-6s %s  pressure %+.4f kPa  inner %+.4f kPa\n", simulation.time(),
                static_cast<unsigned long long>(cell.id), study.type_names()[cell.type].c_str(),
                cell.body == morula::api::Body::kShell ? "shell " : "sphere", cell.pressure, cell.inner_pressure);
  for (const morula::api::Surface& surface : simulation.surfaces())
    std::printf("%g s  surface of cell %llu: %zu nodes, %zu faces\n", simulation.time(), static_cast<unsigned long long>(surface.cell),
                surface.nodes.size(), surface.faces.size());
}

}  // namespace

int main(int count, char** arguments) {
  const morula::api::Version version = morula::api::version();
  std::printf("Morula %d.%d.%d, %s\n", version.major, version.minor, version.patch, morula::api::licence().c_str());
  const auto study = morula::api::Study::read(count > 1 ? arguments[1] : "study.yaml");
  if (!study.ok()) return failed(study.error());
  auto simulation = morula::api::Simulation::create(*study);
  if (!simulation.ok()) return failed(simulation.error());
  print(*study, *simulation);
  for (double output = study->output_interval(); !simulation->done(); output += study->output_interval()) {
    if (const auto stepped = simulation->advance_to(output); !stepped.ok()) return failed(stepped.error());
    print(*study, *simulation);
  }
  if (count > 2)
    if (const auto written = simulation->write_snapshot(arguments[2]); !written.ok()) return failed(written.error());
  std::printf("state %s\n", simulation->state_hash().c_str());
  return 0;
}
