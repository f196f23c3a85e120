/// What an event of one cell costs in tissues of different sizes, beside an ordinary step.
///
///   bench_events [--json FILE] [--threads N] [--cells N] [--only NAME]      N: only tissues of so many cells; NAME: what a case begins with
///
/// All cells grow. Every few steps one of them divides, is removed because it has shrunk, or becomes a shell of 162 nodes, far from the surface of
/// the tissue. CPU time, medians over the events:
///   extra   what the step with an event and the next take beyond two ordinary steps: the event itself, what is made anew because of it, and
///           what the neighbours then do [s]
///   step    an ordinary step [s]
///   ratio   extra/step: local events cost local work where it is below 0.1
///   shape   of extra: wall time in which a new shell finds its shape, or in which a shell is cut [s]
/// Linear iterations of the steps tell how much of the extra is motion of the neighbours.
#include <malloc.h>
#include <mpi.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "bench/cpu_seconds.h"
#include "core/close_packing.h"
#include "core/parallel/quiet_mpi.h"
#include "core/space/curve.h"
#include "coupling/behaviours/birth.h"
#include "coupling/cell_record.h"
#include "coupling/simulation.h"
#include "coupling/swaps.h"

namespace {

using namespace morula;

constexpr double kGrowth = 18 * 3600.0;  // from a volume to twice that [s]
constexpr int kEvents = 8;
constexpr std::size_t kApart = 14;  // places of the lattice from one event to the next, along the shells of the lattice

enum class What { kDivision, kRemoval, kExchange };

/// Cells of one kind and what happens to one of them from time to time.
struct Case {
  const char* name;
  What what;
  bool shells = false;        ///< the tissue is one of shells
  bool among_shells = false;  ///< spheres, but shells about the cells that exchange their bodies
  double step = 10.0;         ///< longest [s]
  int between = 5;            ///< steps from one event to the next

  [[nodiscard]] double time_of(int event) const { return (20.0 + event * between) * step; }
  [[nodiscard]] double spacing() const { return shells ? 12.0 : 11.4; }
};

/// Places of a face-centred cubic lattice, nearest to the origin first.
std::vector<Vec3d> lattice(std::size_t count, double spacing) {
  std::vector<Vec3d> points = close_packed_places(static_cast<int>(std::cbrt(static_cast<double>(count))) + 3, spacing);
  points.resize(std::min(count, points.size()));
  return points;
}

Region region(const char* name, BodyKind body, const Vec3d& center, double radius, double from, double until) {
  Region out;
  out.name = name;
  out.body = body;
  out.center = center;
  out.radius = radius;
  out.margin = 0.0;
  out.from = from;
  out.until = until;
  return out;
}

/// The cells that exchange their bodies: corners around the middle, or the middle one alone, to and fro.
void add_exchanges(const Case& c, const std::vector<Vec3d>& places, Model& model) {
  model.swaps.hold = 0.0;
  for (int k = 0; k < kEvents; ++k) {
    const double at = c.time_of(k) - 0.5 * c.step;
    if (c.among_shells)  // the middle one is a sphere half of the time; all around it are shells
      model.swaps.regions.push_back(region("hole", BodyKind::kSphere, {}, 4.0, k == 0 ? 0.0 : at - 2 * c.step, at));
    else
      model.swaps.regions.push_back(region("cell", BodyKind::kShell, places[static_cast<std::size_t>(k) * kApart], 4.0, at, kNever));
  }
  if (c.among_shells) model.swaps.regions.push_back(region("patch", BodyKind::kShell, {}, 2.3 * c.spacing(), 0.0, kNever));
}

Model make_model(const Case& c, const std::vector<Vec3d>& places) {
  Model model;
  model.space.box = {{-1e4, -1e4, -1e4}, {1e4, 1e4, 1e4}};
  CellType type;
  type.name = "cell";
  type.initial_body = c.shells ? BodyKind::kShell : BodyKind::kSphere;
  type.cycles = true;
  type.cycle.growth = growth_laws()[1];  // exponential
  type.cycle_duration = {kGrowth, 0.0};
  type.shell.spring_stiffness = 0.173;
  type.shell.tension = 0.5;
  type.shell.hinge_stiffness = 2.0 / std::sqrt(3.0) * 8.8889e-4;
  type.sphere = {0.45, 0.4};
  model.types = {type};
  model.pairs = {ContactPair{c.shells ? 0.1 : 0.02, 50.0, 50.0}};
  model.contact.range = c.shells ? 0.3 : 0.5;
  model.contact.points_per_face = 3;
  model.contact.repulsion = 40.0;
  model.step.max_step = model.step.initial_step = c.step;
  if (c.what == What::kExchange) add_exchanges(c, places, model);
  return model;
}

/// The cell of an event gets to it half a step before the time of it.
void prepare(const Case& c, const CellType& type, int event, CellRecord& cell) {
  const double time = c.time_of(event) - 0.5 * c.step;
  if (c.what == What::kDivision) {
    cell.row.division_volume = cell.row.target_volume * std::exp2(time / kGrowth);
    cell.row.birth_volume = 0.5 * cell.row.division_volume;
  } else if (c.what == What::kRemoval) {
    cell.row.phase = Phase::kDying;
    cell.row.death_time = time - type.apoptosis_time * std::log(1.0 / type.removal_fraction);
    cell.row.target_volume *= std::exp((cell.row.death_time - 0.0) / type.apoptosis_time);
    cell.sphere->radius = std::cbrt(3.0 * cell.row.target_volume / (4.0 * std::numbers::pi));
  }
}

/// A number from 0 to 1 that looks like chance.
double fraction(std::size_t i) { return static_cast<double>((i + 1) * 2654435761u % 4096) / 4096.0; }

Tissue make_tissue(const Case& c, const Model& model, const std::vector<Vec3d>& places, const Comm& comm) {
  ShapeLibrary shapes;
  const CellType& type = model.types[0];
  std::vector<CellRecord> cells;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (static_cast<int>(i * static_cast<std::size_t>(comm.size()) / places.size()) != comm.rank()) continue;
    CellRecord& cell = cells.emplace_back();
    cell.row = make_founder(CellId::founder(i + 1), 0, type, 1, 0.0, false);
    cell.row.order = curve_place(places[i]);
    if (!c.shells) cell.row.target_volume *= 0.85 + 0.3 * fraction(i);  // no lattice at rest: every step has something to do
    cell.row.birth_volume = 0.75 * cell.row.target_volume;
    cell.row.division_volume = 2.0 * cell.row.target_volume;
    if (c.shells)
      cell.shell = spherical_shell(shapes.icosphere(162).value(), places[i], cell.row.target_volume,
                                   free_reference_volume(cell.row.target_volume, type, 0.0));
    else
      cell.sphere = SphereRecord{places[i], std::cbrt(3.0 * cell.row.target_volume / (4.0 * std::numbers::pi)), {}, {}};
    if (c.what != What::kExchange && i % kApart == 0 && i / kApart < kEvents) prepare(c, type, static_cast<int>(i / kApart), cell);
  }
  Tissue tissue;
  tissue.clock.next_step = model.step.initial_step;
  put_together(tissue, std::move(cells));
  return tissue;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

constexpr std::size_t kStages = kStageNames.size();
using StageSeconds = std::array<double, kStages>;

StageSeconds stage_seconds(const StageTimer& timer) {
  StageSeconds out;
  for (std::size_t s = 0; s < kStages; ++s) out[s] = timer.seconds(static_cast<Stage>(s));
  return out;
}

/// Steps of one kind.
struct Steps {
  std::vector<double> seconds, iterations;
  std::array<std::vector<double>, kStages> by_stage;  ///< wall time [s]
};

struct Figures {
  Steps with, after, usual;
  std::vector<double> shape;  ///< [s]
  [[nodiscard]] double step() const { return median(usual.seconds); }
  [[nodiscard]] double extra() const { return median(with.seconds) + median(after.seconds) - 2.0 * step(); }
  [[nodiscard]] double extra(std::size_t stage) const {
    return median(with.by_stage[stage]) + median(after.by_stage[stage]) - 2.0 * median(usual.by_stage[stage]);
  }
};

bool is_the_event(const Case& c, const Event& event) {
  switch (c.what) {
    case What::kDivision:
      return event.kind == EventKind::kDivision;
    case What::kRemoval:
      return event.kind == EventKind::kRemoval;
    case What::kExchange:
      return event.kind == EventKind::kPromotion;
  }
  return false;
}

bool run_case(const Case& c, std::size_t cells, const Comm& comm, int threads, Figures& out) {
  const std::vector<Vec3d> places = lattice(cells, c.spacing());
  const Model model = make_model(c, places);
  auto created = Simulation::create(model, make_tissue(c, model, places, comm), comm, threads);
  if (!created || !(*created)->first_swaps()) return false;
  Simulation& simulation = **created;
  bool follows = false, verbose = std::getenv("BENCH_VERBOSE") != nullptr;
  while (simulation.tissue().clock.time < c.time_of(kEvents) - 0.5 * c.step) {
    const double before = cpu_seconds();
    const StageSeconds stages = stage_seconds(simulation.timer());
    const auto done = simulation.step(c.time_of(kEvents));
    if (!done) {
      std::fprintf(stderr, "%s: %s\n", c.name, done.error().message.c_str());
      return false;
    }
    const double spent = cpu_seconds() - before;
    const bool event = std::any_of(done->events.begin(), done->events.end(), [&](const Event& e) { return is_the_event(c, e); });
    const bool other = !done->events.empty() && !event;
    if (verbose)
      std::printf("  t %.1f dt %.2f newton %d linear %d retries %d: %.4f s%s\n", simulation.tissue().clock.time, done->mechanics.step,
                  done->mechanics.newton, done->mechanics.linear_iterations, done->retries, spent,
                  event   ? " *"
                  : other ? " o"
                          : "");
    Steps* const to = event                                                    ? &out.with
                      : follows                                                ? &out.after
                      : simulation.tissue().clock.time > 10 * c.step && !other ? &out.usual
                                                                               : nullptr;
    if (event) out.shape.push_back(simulation.timer().seconds(Stage::kShapes) - stages[static_cast<std::size_t>(Stage::kShapes)]);
    follows = event;
    if (to == nullptr) continue;
    to->seconds.push_back(spent);
    to->iterations.push_back(done->mechanics.linear_iterations);
    const StageSeconds now = stage_seconds(simulation.timer());
    for (std::size_t s = 0; s < kStages; ++s) to->by_stage[s].push_back(now[s] - stages[s]);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20), mallopt(M_TRIM_THRESHOLD, 512 << 20);  // as the command does
#endif
  quiet_mpi();
  MPI_Init(&argc, &argv);
  int status = 0;
  {
    const Comm comm(MPI_COMM_WORLD);
    std::string json, name;
    int threads = 1;
    std::size_t only = 0;
    const bool stages = std::getenv("BENCH_STAGES") != nullptr;
    for (int i = 1; i + 1 < argc; i += 2) {
      if (std::strcmp(argv[i], "--json") == 0) json = argv[i + 1];
      if (std::strcmp(argv[i], "--only") == 0) name = argv[i + 1];
      if (std::strcmp(argv[i], "--threads") == 0) threads = std::atoi(argv[i + 1]);
      if (std::strcmp(argv[i], "--cells") == 0) only = static_cast<std::size_t>(std::atoll(argv[i + 1]));
    }
    omp_set_num_threads(threads);
    const Case cases[] = {{"division of a sphere", What::kDivision},
                          {"removal of a sphere", What::kRemoval},
                          {"exchange among spheres", What::kExchange},
                          {.name = "exchange among shells", .what = What::kExchange, .among_shells = true},
                          {.name = "division of a shell", .what = What::kDivision, .shells = true, .step = 20.0}};
    std::string text = "{\n  \"ranks\": " + std::to_string(comm.size()) + ", \"threads\": " + std::to_string(threads) + ",\n  \"cases\": [";
    const char* separator = "\n";
    for (const Case& c : cases)
      for (const std::size_t cells : {std::size_t{1000}, std::size_t{10000}, std::size_t{100000}}) {
        if ((only != 0 && cells != only) || (c.shells && cells > 1000) || std::string(c.name).rfind(name, 0) != 0) continue;
        Figures f;
        if (!run_case(c, cells, comm, threads, f)) {
          status = 1;
          continue;
        }
        if (!comm.is_root()) continue;
        char line[400];
        std::snprintf(
            line, sizeof line,
            "%-22s %6zu %s: %zu events, extra %.4f s, step %.4f s, ratio %.3f, shape %.4f s; iterations %.0f, %.0f, ordinary %.0f", c.name,
            cells, c.shells ? "shells" : "spheres", f.with.seconds.size(), f.extra(), f.step(), f.extra() / f.step(), median(f.shape),
            median(f.with.iterations), median(f.after.iterations), median(f.usual.iterations));
        std::puts(line);
        if (stages)
          for (std::size_t s = 0; s < kStages; ++s)
            if (std::abs(f.extra(s)) > 0.005 * f.step()) std::printf("    %-16s %+.4f s\n", kStageNames[s].data(), f.extra(s));
        std::fflush(stdout);
        std::snprintf(
            line, sizeof line,
            R"(%s    {"case": "%s", "cells": %zu, "events": %zu, "extra_s": %.6f, "step_s": %.6f, "ratio": %.4f, "shape_s": %.6f})",
            separator, c.name, cells, f.with.seconds.size(), f.extra(), f.step(), f.extra() / f.step(), median(f.shape));
        text += line;
        separator = ",\n";
      }
    if (comm.is_root() && !json.empty()) std::ofstream(json) << text << "\n  ]\n}\n";
  }
  MPI_Finalize();
  return status;
}
