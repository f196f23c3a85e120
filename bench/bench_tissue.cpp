/// Whole-tissue benchmarks: clusters of shells and tissues of spheres, driven as a run drives them.
///
///   bench_tissue [--json FILE] [--only NAME] [--threads N] [--max-step S]      NAME: a case, or what the names of several begin with
///   bench_tissue --accuracy NAME [--max-step S]
///
/// Prints a table and writes the same as JSON: wall time split by stage, µs per node-step (or cell-step), steps per simulated hour, CPU
/// seconds per simulated hour and 1000 nodes (or cells), bytes per node (or cell). Under mpirun the tissue is shared by the ranks.
/// --accuracy runs a case of shells twice, as always and with steps of at most 10 s and a tenth of the displacement and of all
/// tolerances, and prints how contact area and shapes differ. --max-step: the longest step [s], 60 unless told (as in a study).
#include <malloc.h>
#include <mpi.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
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
#include "coupling/mechanics/scene.h"
#include "coupling/simulation.h"
#include "coupling/swaps.h"

namespace {

using namespace morula;

struct Case {
  std::string name;
  std::size_t cells;
  BodyKind body;
  double friction;         ///< between cells [nN·s/µm³]
  double relax;            ///< simulated before the clock is started [s]
  double duration;         ///< simulated and timed [s]
  double growth;           ///< doubling time [s]; 0: none
  double adhesion = 0.1;   ///< W between shells [nN/µm]
  double range = 0.3;      ///< c [µm]
  double max_step = 60.0;  ///< [s]
};

Model make_model(const Case& c) {
  Model model;
  model.space.box = {{-1e4, -1e4, -1e4}, {1e4, 1e4, 1e4}};
  CellType type;
  type.name = "cell";
  type.initial_body = c.body;
  type.cycles = c.growth > 0.0;
  type.shells_divide = false;            // as many cells at the end as at the start
  type.cycle.growth = growth_laws()[1];  // exponential
  type.cycle_duration = {c.growth > 0.0 ? c.growth : 18 * 3600.0, 0.0};
  type.shell.spring_stiffness = 0.173;
  type.shell.tension = 0.5;
  type.shell.hinge_stiffness = 2.0 / std::sqrt(3.0) * 8.8889e-4;
  type.sphere = {0.45, 0.4};
  model.types = {type};
  model.pairs = {ContactPair{c.body == BodyKind::kShell ? c.adhesion : 0.02, c.friction, c.friction}};
  model.contact.range = c.range;
  model.contact.points_per_face = 3;  // the default; time_stepping.md §9.6 for W ≤ 0.3
  model.contact.repulsion = 40.0;
  model.contact.skin = 0.2;  // as fast as 0.3, with fewer candidates to keep
  model.step.max_step = c.max_step;
  model.step.initial_step = 1.0;
  return model;
}

/// The `count` points of a face-centred cubic lattice nearest to the origin.
std::vector<Vec3d> packing(std::size_t count, double spacing) {
  const double a = spacing * std::numbers::sqrt2;
  const int n = static_cast<int>(std::cbrt(static_cast<double>(count))) + 3;
  std::vector<Vec3d> points;
  for (int x = -n; x <= n; ++x)
    for (int y = -n; y <= n; ++y)
      for (int z = -n; z <= n; ++z)
        if ((x + y + z) % 2 == 0) points.push_back(Vec3d{0.5 * a * x, 0.5 * a * y, 0.5 * a * z});
  std::sort(points.begin(), points.end(), [](const Vec3d& p, const Vec3d& q) {
    const double d = norm2(p) - norm2(q);
    if (std::abs(d) > 1e-9) return d < 0.0;
    return std::lexicographical_compare(&p.x, &p.x + 3, &q.x, &q.x + 3);
  });
  return {points.begin(), points.begin() + static_cast<std::ptrdiff_t>(std::min(count, points.size()))};
}

Tissue make_tissue(const Model& model, const Case& c, const Comm& comm) {
  ShapeLibrary shapes;
  std::vector<CellRecord> cells;
  const auto centers = packing(c.cells, c.body == BodyKind::kShell ? 12.0 : 11.4);
  cells.reserve(centers.size() / static_cast<std::size_t>(comm.size()) + 1);
  for (std::size_t i = 0; i < centers.size(); ++i) {
    if (static_cast<int>(i * static_cast<std::size_t>(comm.size()) / centers.size()) != comm.rank()) continue;
    CellRecord& cell = cells.emplace_back();
    cell.row = make_founder(CellId::founder(i + 1), 0, model.types[0], 1, 0.0, false);
    cell.row.order = curve_place(centers[i]);
    if (c.body == BodyKind::kShell)
      cell.shell = spherical_shell(shapes.icosphere(162).value(), centers[i], cell.row.target_volume,
                                   free_reference_volume(cell.row.target_volume, model.types[0], 0.0));
    else
      cell.sphere = SphereRecord{centers[i], 6.0, {}, {}};
  }
  Tissue tissue;
  tissue.clock.next_step = model.step.initial_step;
  put_together(tissue, std::move(cells));
  return tissue;
}

struct Figures {
  double wall = 0.0, unit_us = 0.0, cpu = 0.0, unit_cpu_us = 0.0, steps_per_hour = 0.0, bytes = 0.0, resident = 0.0, peak = 0.0,
         per_hour_kilo = 0.0, overlap = 0.0, newton = 0.0, linear = 0.0, halvings = 0.0, imbalance = 1.0;
  std::int64_t ghosts = 0;
  std::vector<std::pair<std::string, double>> stages;
  double evaluation[3] = {};  ///< contacts, internal forces, assembly of one evaluation [µs of CPU per unit]
};

/// Bytes of the state itself.
std::size_t state_bytes(const Tissue& tissue) {
  return tissue.cells.memory() + cbm::memory_of(tissue.spheres) + dcm::memory_of(tissue.shells);
}

/// A line of /proc/self/status in kB: VmRSS (resident now) or VmHWM (most so far); 0 where there is no such file.
std::int64_t resident_kb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.compare(0, name.size(), name) == 0) return std::atoll(line.c_str() + name.size());
  return 0;
}

/// What the process holds before a case: freed pages are handed back and the mark of the highest is set anew.
std::int64_t settle_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  std::ofstream("/proc/self/clear_refs") << "5\n";
  return resident_kb("VmRSS:");
}

bool run_case(const Case& c, const Comm& comm, int threads, Figures& out) {
  const Model model = make_model(c);
  const std::int64_t resident_before = settle_memory();
  auto created = Simulation::create(model, make_tissue(model, c, comm), comm, threads);
  if (!created) {
    std::fprintf(stderr, "%s\n", created.error().message.c_str());
    return false;
  }
  Simulation& simulation = **created;
  const auto run_to = [&](double end, double& newton, double& linear, std::int64_t& steps) {
    while (simulation.tissue().clock.time < end) {
      const auto done = simulation.step(end);
      if (!done) {
        std::fprintf(stderr, "%s: %s\n", c.name.c_str(), done.error().message.c_str());
        return false;
      }
      newton += done->mechanics.newton;
      linear += done->mechanics.linear_iterations;
      out.halvings += done->mechanics.halvings;
      out.overlap = std::max(out.overlap, done->mechanics.overlap);
      ++steps;
    }
    return true;
  };
  std::int64_t steps = 0;
  if (c.relax > 0.0 && !run_to(c.relax, out.newton, out.linear, steps)) return false;
  out = {};
  steps = 0;
  std::vector<double> before;
  for (std::size_t s = 0; s < kStageNames.size(); ++s) before.push_back(simulation.timer().seconds(static_cast<Stage>(s)));
  comm.barrier();
  const auto start = std::chrono::steady_clock::now();
  const double cpu_start = cpu_seconds();
  if (!run_to(c.relax + c.duration, out.newton, out.linear, steps)) return false;
  comm.barrier();
  OrderFreeSum cpu;
  cpu.add(cpu_seconds() - cpu_start);
  out.cpu = comm.sum(cpu);
  out.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double units = static_cast<double>(c.cells) * (c.body == BodyKind::kShell ? 162.0 : 1.0);
  out.unit_us = 1e6 * out.wall / (units * static_cast<double>(steps));
  out.steps_per_hour = static_cast<double>(steps) * 3600.0 / c.duration;
  out.unit_cpu_us = 1e6 * out.cpu / (units * static_cast<double>(steps));
  out.per_hour_kilo = out.cpu / (c.duration / 3600.0) / (units / 1000.0);
  out.newton /= static_cast<double>(steps);
  out.linear /= static_cast<double>(steps);
  out.halvings /= static_cast<double>(steps);
  const auto& tissue = simulation.tissue();
  double bytes = static_cast<double>(simulation.mechanics().memory() + state_bytes(tissue));
  OrderFreeSum sum;
  sum.add(bytes);
  out.bytes = comm.sum(sum) / units;
  out.peak = static_cast<double>(comm.sum(resident_kb("VmHWM:") - resident_before)) * 1024.0 / units;
  out.resident = static_cast<double>(comm.sum(settle_memory() - resident_before)) * 1024.0 / units;
  out.ghosts = comm.sum(static_cast<std::int64_t>(simulation.mechanics().scene().ghost_count()));
  out.imbalance = simulation.imbalance();
  for (std::size_t s = 0; s < kStageNames.size(); ++s)
    out.stages.emplace_back(kStageNames[s],
                            1e6 * (simulation.timer().seconds(static_cast<Stage>(s)) - before[s]) / (units * static_cast<double>(steps)));
  const double busy = std::min(1.0, out.cpu / (out.wall * comm.size()));  // stages are wall time: other processes' share is left out
  const auto stage = [&](Stage s) { return busy * out.stages[static_cast<std::size_t>(s)].second; };
  const double trials = out.newton + out.halvings;  // and at the start of each step internal forces once more, for new volumes
  out.evaluation[0] = (stage(Stage::kContacts) + stage(Stage::kCandidates)) / trials;
  out.evaluation[1] = stage(Stage::kInternal) / (trials + 1.0);
  out.evaluation[2] = stage(Stage::kAssemble) / out.newton;
  return true;
}

/// Contact area and positions at some time.
struct Shape {
  double area = 0.0;            ///< of all cells [µm²]
  std::vector<Vec3d> position;  ///< of all nodes, cells by id
};

/// The state of a case every third of its duration; empty when a step fails.
std::vector<Shape> shapes_of(const Case& c, const Model& model, const Comm& comm, int threads) {
  auto created = Simulation::create(model, make_tissue(model, c, comm), comm, threads);
  std::vector<Shape> out;
  if (!created) return out;
  Simulation& simulation = **created;
  for (int third = 1; third <= 3; ++third) {
    const double end = c.relax + c.duration * third / 3.0;
    while (simulation.tissue().clock.time < end)
      if (const auto done = simulation.step(end); !done) {
        std::fprintf(stderr, "%s: %s\n", c.name.c_str(), done.error().message.c_str());
        return {};
      }
    Shape& shape = out.emplace_back();
    for (const double area : simulation.mechanics().values(simulation.tissue()).contact_area) shape.area += area;
    const Tissue& tissue = simulation.tissue();
    std::vector<std::pair<CellId, std::size_t>> by_id;  // the order in storage changes
    for (std::size_t i = 0; i < tissue.cells.size(); ++i) by_id.emplace_back(tissue.cells.rows[i].id, i);
    std::sort(by_id.begin(), by_id.end());
    for (const auto& [id, shell] : by_id) {
      const auto nodes = tissue.shells.nodes(shell);
      shape.position.insert(shape.position.end(), nodes.begin(), nodes.end());
    }
  }
  return out;
}

/// Default control against small steps.
bool compare_with_small_steps(const Case& c, const Comm& comm, int threads) {
  Model model = make_model(c);
  const auto usual = shapes_of(c, model, comm, threads);
  model.step.max_step = 10.0;
  model.step.max_displacement *= 0.1;
  model.step.newton_stop *= 0.1;
  model.step.first_tolerance *= 0.1;
  model.step.later_tolerance *= 0.1;
  const auto fine = shapes_of(c, model, comm, threads);
  if (usual.size() != 3 || fine.size() != 3) return false;
  std::printf("%s against steps of at most 10 s and %.3f c\n", c.name.c_str(), model.step.max_displacement);
  for (std::size_t k = 0; k < 3; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < fine[k].position.size(); ++i) sum += norm2(usual[k].position[i] - fine[k].position[i]);
    std::printf("  after %5.2f h  contact area %9.1f um2  error %+.3f %%  shape rms %.4f um\n",
                (c.relax + c.duration * static_cast<double>(k + 1) / 3.0) / 3600.0, fine[k].area,
                100.0 * (usual[k].area / fine[k].area - 1.0), std::sqrt(sum / static_cast<double>(fine[k].position.size())));
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
    std::string json, only, accuracy;
    int threads = 1;
    double max_step = 0.0;
    for (int i = 1; i + 1 < argc; i += 2) {
      if (std::strcmp(argv[i], "--json") == 0) json = argv[i + 1];
      if (std::strcmp(argv[i], "--only") == 0) only = argv[i + 1];
      if (std::strcmp(argv[i], "--accuracy") == 0) accuracy = argv[i + 1];
      if (std::strcmp(argv[i], "--max-step") == 0) max_step = std::atof(argv[i + 1]);
      if (std::strcmp(argv[i], "--threads") == 0) threads = std::atoi(argv[i + 1]);
    }
    omp_set_num_threads(threads);
    const double h = 3600.0;
    std::vector<Case> cases{
        {"cluster_13", 13, BodyKind::kShell, 50.0, 0.0, 18 * h, 18 * h},
        {"cluster_55", 55, BodyKind::kShell, 50.0, 0.0, 18 * h, 18 * h},
        {"cluster_200", 200, BodyKind::kShell, 50.0, 300.0, 600.0, 18 * h},
        {"dcm_cluster", 1000, BodyKind::kShell, 50.0, 300.0, 600.0, 18 * h},
        {"dcm_growth", 1000, BodyKind::kShell, 50.0, 3600.0, 1800.0, 18 * h},
        {"dcm_scaling_10", 10, BodyKind::kShell, 50.0, 120.0, 60.0, 18 * h},
        {"dcm_scaling_100", 100, BodyKind::kShell, 50.0, 120.0, 60.0, 18 * h},
        {"dcm_scaling_1000", 1000, BodyKind::kShell, 50.0, 120.0, 60.0, 18 * h},
        {"dcm_scaling_5000", 5000, BodyKind::kShell, 50.0, 120.0, 60.0, 18 * h},
        {"aggregation_13", 13, BodyKind::kShell, 50.0, 0.0, 600.0, 18 * h},               // from point contacts
        {"cluster_55_w03", 55, BodyKind::kShell, 50.0, 1800.0, 6 * h, 18 * h, 0.3, 0.5},  // time_stepping.md §9.5
        {"cbm_tissue", 100000, BodyKind::kSphere, 50.0, 120.0, 600.0, 18 * h},
        {"cbm_tissue_no_friction", 100000, BodyKind::kSphere, 0.0, 120.0, 600.0, 18 * h},
    };
    if (max_step > 0.0)
      for (Case& c : cases) c.max_step = max_step;
    std::string text = "{\n  \"ranks\": " + std::to_string(comm.size()) + ", \"threads\": " + std::to_string(threads) + ",\n  \"cases\": [";
    bool first = true;
    for (const Case& c : cases) {
      if (!accuracy.empty()) {
        if (c.name == accuracy && !compare_with_small_steps(c, comm, threads)) status = 1;
        continue;
      }
      if (!only.empty() && c.name.compare(0, only.size(), only) != 0) continue;
      Figures f;
      if (!run_case(c, comm, threads, f)) {
        status = 1;
        continue;
      }
      if (!comm.is_root()) continue;
      const char* unit = c.body == BodyKind::kShell ? "node" : "cell";
      std::printf(
          "%-24s %6zu cells  %7.2f s  %6.3f us/%s-step (CPU of all ranks %.3f)  %6.1f steps/h  %6.4f s/(h k%s)  newton %.2f  linear %.1f  "
          "%5.0f B/%s (resident %.0f, peak %.0f)  overlap %.3f "
          "um  ghosts %ld  imbalance %.2f\n",
          c.name.c_str(), c.cells, f.wall, f.unit_us, unit, f.unit_cpu_us, f.steps_per_hour, f.per_hour_kilo, unit, f.newton, f.linear,
          f.bytes, unit, f.resident, f.peak, f.overlap, static_cast<long>(f.ghosts), f.imbalance);
      text += std::string(first ? "" : ",") + "\n    {\"name\": \"" + c.name + "\", \"cells\": " + std::to_string(c.cells) +
              ", \"seconds\": " + std::to_string(f.wall) + ", \"us_per_" + unit + "_step\": " + std::to_string(f.unit_us) +
              ", \"cpu_us_per_" + unit + "_step\": " + std::to_string(f.unit_cpu_us) +
              ", \"steps_per_hour\": " + std::to_string(f.steps_per_hour) + ", \"s_per_hour_and_1000_" + unit +
              "s\": " + std::to_string(f.per_hour_kilo) + ", \"newton\": " + std::to_string(f.newton) +
              ", \"linear_iterations\": " + std::to_string(f.linear) + ", \"bytes_per_" + unit + "\": " + std::to_string(f.bytes) +
              ", \"resident_bytes_per_" + unit + "\": " + std::to_string(f.resident) + ", \"peak_bytes_per_" + unit +
              "\": " + std::to_string(f.peak) + ", \"overlap_um\": " + std::to_string(f.overlap) +
              ", \"ghosts\": " + std::to_string(f.ghosts) + ", \"imbalance\": " + std::to_string(f.imbalance) + ", \"stages_us\": {";
      bool first_stage = true;
      for (const auto& [name, us] : f.stages) {
        if (us > 0.0005) std::printf("    %-18s %7.3f\n", name.c_str(), us);
        text += std::string(first_stage ? "" : ", ") + "\"" + name + "\": " + std::to_string(us);
        first_stage = false;
      }
      text += "}";
      if (c.body == BodyKind::kShell) {
        std::printf("    one evaluation     %7.3f  contacts %.3f, internal forces %.3f, assembly %.3f\n",
                    f.evaluation[0] + f.evaluation[1] + f.evaluation[2], f.evaluation[0], f.evaluation[1], f.evaluation[2]);
        text += ", \"one_evaluation_us\": {\"contacts\": " + std::to_string(f.evaluation[0]) +
                ", \"internal_forces\": " + std::to_string(f.evaluation[1]) + ", \"assembly\": " + std::to_string(f.evaluation[2]) + "}";
      }
      text += "}";
      first = false;
      std::fflush(stdout);
    }
    text += "\n  ]\n}\n";
    if (!json.empty() && comm.is_root()) std::ofstream(json) << text;
  }
  MPI_Finalize();
  return status;
}
