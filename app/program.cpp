#include "app/program.h"

#include <malloc.h>
#include <mpi.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/command_line.h"
#include "app/verbs.h"
#include "core/parallel/quiet_mpi.h"
#include "core/shell_word.h"
#include "scenarios/run/exit_code.h"

namespace morula::app {
namespace {

Status call(const Options& options, const Context& context) {
  struct Visitor {
    const Context& c;
    Status operator()(const NewOptions& o) const { return make_new(o, c); }
    Status operator()(const CheckOptions& o) const { return check(o, c); }
    Status operator()(const RunOptions& o) const { return run(o, c); }
    Status operator()(const ResumeOptions& o) const { return resume(o, c); }
    Status operator()(const StatusOptions& o) const { return show_status(o, c); }
    Status operator()(const ListOptions& o) const { return list(o, c); }
    Status operator()(const InfoOptions& o) const { return info(o, c); }
    Status operator()(const ExplainOptions& o) const { return explain(o, c); }
    Status operator()(const PlotOptions& o) const { return plot(o, c); }
    Status operator()(const ExportOptions& o) const { return export_results(o, c); }
    Status operator()(const VerifyOptions& o) const { return verify(o, c); }
    Status operator()(const CompareOptions& o) const { return compare(o, c); }
    Status operator()(const CalibrateOptions& o) const { return calibrate(o, c); }
    Status operator()(const DoctorOptions& o) const { return doctor(o, c); }
  };
  return std::visit(Visitor{context}, options);
}

/// Runs the command; the root alone where the verb is no simulation.
Status run_command(const std::vector<std::string>& arguments, const Context& context) {
  MORULA_TRY_ASSIGN(auto parsed, read_command_line(arguments));
  if (const auto* answer = std::get_if<Answer>(&parsed)) {
    context.console.result(answer->text);
    return {};
  }
  const Options& options = std::get<Options>(parsed);
  const bool collective = std::holds_alternative<RunOptions>(options) || std::holds_alternative<ResumeOptions>(options) ||
                          std::holds_alternative<CalibrateOptions>(options);
  if (!collective && !context.comm.is_root()) return {};
  return call(options, context);
}

/// The exit code of this rank.
int guarded(const std::vector<std::string>& arguments, const Context& context) {
  int code = 0;
  try {
    if (const Status done = run_command(arguments, context); !done.ok()) {
      context.console.error(done.error());
      code = scenarios::exit_code(done.error().kind);
    }
  } catch (const std::bad_alloc&) {
    Console(true).error({ErrorKind::kResources, "out of memory", "use more ranks on more machines, or a smaller study"});
    code = scenarios::exit_code(ErrorKind::kResources);
    if (context.comm.size() > 1) MPI_Abort(MPI_COMM_WORLD, code);  // the other ranks wait for this one
  } catch (const std::exception& defect) {
    Console(true).error({ErrorKind::kInternal, std::string("internal error: ") + defect.what(),
                         "this is a defect of Morula; please report it with the study"});
    code = scenarios::exit_code(ErrorKind::kInternal);
    if (context.comm.size() > 1) MPI_Abort(MPI_COMM_WORLD, code);
  }
  if (!context.console.finish() && code == 0) {
    context.console.error({ErrorKind::kResources, "standard output cannot be written", "is the disk full?"});
    code = scenarios::exit_code(ErrorKind::kResources);
  }
  return code;
}

/// A thread that waits for another spins for a few microseconds and then sleeps, unless the user has said otherwise. The default of the OpenMP
/// runtime spins for milliseconds: where cores are shared, that takes the core which the awaited thread needs (118 s in place of 17 s for the
/// demo's first half hour); sleeping at once is slower than one thread. The runtime reads this when the program is loaded, hence once more.
void wait_briefly(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  std::error_code unknown;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (unknown || setenv("GOMP_SPINCOUNT", "10000", 0) != 0) return;
  execv(program.c_str(), argv);  // comes back only when it fails
}

/// Forces and the matrix of a step take turns in the same memory: it stays with the program instead of going back to the system, and coming back as
/// new pages, in every step.
void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
#endif
}

}  // namespace

int run_program(int argc, char** argv, std::shared_ptr<const Laws> laws) {
  keep_memory();
  wait_briefly(argv);
  quiet_mpi();
  int provided = MPI_THREAD_SINGLE;
  if (MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS) {
    Console(true).error({ErrorKind::kInternal, "MPI cannot be started", "check the installation with `ompi_info`"});
    return scenarios::exit_code(ErrorKind::kInternal);
  }
  int code = 0;
  {
    const Comm comm(MPI_COMM_WORLD);
    std::string command = "morula";
    for (int i = 1; i < argc; ++i) command += " " + shell_word(argv[i]);
    const Context context{comm, Console(comm.is_root()), std::move(command), std::move(laws)};
    code = guarded(std::vector<std::string>(argv + 1, argv + argc), context);
    code = static_cast<int>(comm.max(std::int64_t{code}));  // all ranks end alike
  }
  MPI_Finalize();
  return code;
}

}  // namespace morula::app
