/// What an exchange of one body costs in tissues of different sizes.
///
///   bench_exchange [--json FILE] [--threads N] [--cells N]       N: only tissues of so many cells
///
/// A sphere becomes a shell of 162 nodes, among spheres and among shells, far from the surface of the tissue; one sphere in each of several steps,
/// all else at rest. Prints, over the exchanges:
///   exchange   the part of the step that exchanges bodies, the shortest wall time [s]
///   in all     CPU time (median) that the steps with and right after an exchange take beyond others: with tables, scene and lists of pairs made anew [s]
///   step       CPU time of an ordinary step [s]
#include <mpi.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "bench/cpu_seconds.h"
#include "core/parallel/quiet_mpi.h"
#include "core/space/curve.h"
#include "coupling/behaviours/birth.h"
#include "coupling/cell_record.h"
#include "coupling/simulation.h"

namespace {

using namespace morula;

constexpr double kStep = 10.0;          // [s]
constexpr double kFirst = 200.0;        // when the first cell exchanges its body [s]
constexpr double kBetween = 5 * kStep;  // from one to the next [s]
constexpr int kExchanges = 8;
constexpr double kRadius = 6.0, kSpacing = 11.4;  // of cells and of their lattice [µm]

/// What the neighbours of the cell are.
enum class Among { kSpheres, kShells };

/// Places of a face-centred cubic lattice, nearest to the origin first.
std::vector<Vec3d> lattice(std::size_t count) {
  const double a = kSpacing / std::numbers::sqrt2;
  const int n = static_cast<int>(std::cbrt(static_cast<double>(count))) + 3;
  std::vector<Vec3d> points;
  for (int x = -n; x <= n; ++x)
    for (int y = -n; y <= n; ++y)
      for (int z = -n; z <= n; ++z)
        if ((x + y + z) % 2 == 0) points.push_back(Vec3d{a * x, a * y, a * z});
  std::stable_sort(points.begin(), points.end(), [](const Vec3d& p, const Vec3d& q) { return norm2(p) < norm2(q) - 1e-9; });
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

/// The cells that exchange their bodies: eight corners of a cube around the middle, or the middle one alone, to and fro.
Model make_model(Among among, const std::vector<Vec3d>& places) {
  Model model;
  model.space.box = {{-1e4, -1e4, -1e4}, {1e4, 1e4, 1e4}};
  CellType type;
  type.name = "cell";
  type.cycles = false;
  type.shell.spring_stiffness = 0.173;
  type.shell.tension = 0.5;
  type.shell.hinge_stiffness = 2.0 / std::sqrt(3.0) * 8.8889e-4;
  type.sphere = {0.45, 0.4};
  model.types = {type};
  model.pairs = {ContactPair{0.02, 50.0, 50.0}};
  model.contact.range = 0.5;
  model.contact.points_per_face = 3;
  model.contact.repulsion = 40.0;
  model.step.max_step = model.step.initial_step = kStep;
  model.swaps.hold = 0.0;
  if (among == Among::kShells) {  // the middle one is a sphere half of the time; all around it are shells
    for (int k = 0; k < kExchanges; ++k) {
      const double promoted = kFirst + k * kBetween;
      model.swaps.regions.push_back(
          region("hole", BodyKind::kSphere, {}, 4.0, k == 0 ? 0.0 : promoted - 2 * kStep, promoted - 0.5 * kStep));
    }
    model.swaps.regions.push_back(region("patch", BodyKind::kShell, {}, 2.3 * kSpacing, 0.0, kNever));
    return model;
  }
  for (int k = 0; k < kExchanges; ++k)
    model.swaps.regions.push_back(
        region("cell", BodyKind::kShell, places[static_cast<std::size_t>(k) * 14], 4.0, kFirst + (k - 0.1) * kBetween, kNever));
  return model;
}

Tissue make_tissue(const Model& model, const std::vector<Vec3d>& places, const Comm& comm) {
  std::vector<CellRecord> cells;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (static_cast<int>(i * static_cast<std::size_t>(comm.size()) / places.size()) != comm.rank()) continue;
    CellRecord& cell = cells.emplace_back();
    cell.row = make_founder(CellId::founder(i + 1), 0, model.types[0], 1, 0.0, false);
    cell.row.order = curve_place(places[i]);
    cell.row.phase = Phase::kResting;
    cell.sphere = SphereRecord{places[i], kRadius, {}, {}};
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

struct Figures {
  double exchange = 0.0, all = 0.0, step = 0.0;  ///< [s]
  int exchanges = 0;
};

bool run_case(Among among, std::size_t cells, const Comm& comm, int threads, Figures& out) {
  const std::vector<Vec3d> places = lattice(cells);
  const Model model = make_model(among, places);
  auto created = Simulation::create(model, make_tissue(model, places, comm), comm, threads);
  if (!created || !(*created)->first_swaps()) return false;
  Simulation& simulation = **created;
  std::vector<double> with, after, usual, exchange;
  bool follows = false;
  for (int k = 0; k < static_cast<int>((kFirst + kExchanges * kBetween) / kStep); ++k) {
    const double before = cpu_seconds(), coupling = simulation.timer().seconds(Stage::kCoupling);
    const auto done = simulation.step(kStep * (k + 1));
    if (!done) {
      std::fprintf(stderr, "%s\n", done.error().message.c_str());
      return false;
    }
    const double spent = cpu_seconds() - before;
    const auto is = [&](EventKind kind) {
      return std::any_of(done->events.begin(), done->events.end(), [&](const Event& event) { return event.kind == kind; });
    };
    if (is(EventKind::kPromotion)) {
      with.push_back(spent);
      exchange.push_back(simulation.timer().seconds(Stage::kCoupling) - coupling);
    } else if (follows) {
      after.push_back(spent);
    } else if (k > 10 && !is(EventKind::kDemotion)) {
      usual.push_back(spent);
    }
    follows = is(EventKind::kPromotion);
  }
  out.exchanges = static_cast<int>(with.size());
  out.step = median(usual);
  out.exchange = exchange.empty() ? 0.0 : *std::ranges::min_element(exchange);
  out.all = median(with) + median(after) - 2.0 * out.step;
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  quiet_mpi();
  MPI_Init(&argc, &argv);
  int status = 0;
  {
    const Comm comm(MPI_COMM_WORLD);
    std::string json;
    int threads = 1;
    std::size_t only = 0;
    for (int i = 1; i + 1 < argc; i += 2) {
      if (std::strcmp(argv[i], "--json") == 0) json = argv[i + 1];
      if (std::strcmp(argv[i], "--threads") == 0) threads = std::atoi(argv[i + 1]);
      if (std::strcmp(argv[i], "--cells") == 0) only = static_cast<std::size_t>(std::atoll(argv[i + 1]));
    }
    omp_set_num_threads(threads);
    std::string text = "{\n  \"ranks\": " + std::to_string(comm.size()) + ", \"threads\": " + std::to_string(threads) + ",\n  \"cases\": [";
    const char* separator = "\n";
    for (const Among among : {Among::kSpheres, Among::kShells})
      for (const std::size_t cells : {std::size_t{1000}, std::size_t{10000}, std::size_t{100000}}) {
        if (only != 0 && cells != only) continue;
        Figures f;
        if (!run_case(among, cells, comm, threads, f)) {
          status = 1;
          continue;
        }
        if (!comm.is_root()) continue;
        const char* name = among == Among::kSpheres ? "among spheres" : "among shells";
        char line[256];
        std::snprintf(line, sizeof line, "%-14s %7zu cells: %d exchanges, each %.4f s, in all %.4f s; a step %.4f s", name, cells,
                      f.exchanges, f.exchange, f.all, f.step);
        std::puts(line);
        std::snprintf(line, sizeof line,
                      R"(%s    {"case": "%s", "cells": %zu, "exchanges": %d, "exchange_s": %.6f, "all_s": %.6f, "step_s": %.6f})",
                      separator, name, cells, f.exchanges, f.exchange, f.all, f.step);
        text += line;
        separator = ",\n";
      }
    if (comm.is_root() && !json.empty()) std::ofstream(json) << text << "\n  ]\n}\n";
  }
  MPI_Finalize();
  return status;
}
