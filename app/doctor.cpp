#include <hdf5.h>
#include <mpi.h>
#include <omp.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/machine_memory.h"
#include "app/verbs.h"
#include "app/words.h"
#include "results/build_info.h"
#include "results/file_io.h"

namespace morula::app {
namespace fs = std::filesystem;
namespace {

/// One thing that a run needs: how it is, and whether that is well.
struct Finding {
  std::string name, value;
  bool good = true;
  std::string advice;  ///< what to do when it is not
};

Finding mpi(const Comm& comm) {
  int provided = MPI_THREAD_SINGLE;
  MPI_Query_thread(&provided);
  return {"mpi",
          scenarios::build_info().libraries.at(1).second + ", " + count_words(static_cast<std::uint64_t>(comm.size()), "rank", "ranks"),
          provided >= MPI_THREAD_FUNNELED, "this MPI does not allow threads: use --threads 1"};
}

Finding hdf5() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  hbool_t safe = false;
  H5is_library_threadsafe(&safe);
#ifdef H5_HAVE_PARALLEL
  const bool parallel = true;
#else
  const bool parallel = false;
#endif
  return {
      "hdf5",
      std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release) + (parallel ? ", parallel" : ", not parallel"),
      parallel, "build with the parallel HDF5 (Debian: libhdf5-openmpi-dev)"};
}

Finding threads() {
  const int cores = omp_get_num_procs();
  return {"cores", std::to_string(cores) + " for this process; OpenMP " + std::to_string(_OPENMP), cores >= 1, ""};
}

Finding memory() {
  const double all = machine_memory(), free = static_cast<double>(sysconf(_SC_PAGESIZE)) * static_cast<double>(sysconf(_SC_AVPHYS_PAGES));
  return {"memory", bytes_words(all) + ", " + bytes_words(free) + " free", all >= 1e9, "less than 1 GB: only small studies will fit"};
}

Finding disk() {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  const fs::space_info space = fs::space(here, error);
  if (error) return {"disk", "cannot be asked: " + error.message(), false, "go to a folder that can be read"};
  return {"disk", bytes_words(static_cast<double>(space.available)) + " free in " + here.string(), space.available >= 500'000'000,
          "less than 500 MB free: results may not fit"};
}

Finding writing() {
  std::error_code error;
  const fs::path probe = fs::current_path(error) / (".morula-doctor-" + std::to_string(getpid()));
  const Status written = scenarios::write_file_atomically(probe, "probe\n");
  fs::remove(probe, error);
  return {"writing", written.ok() ? "this folder can be written" : written.error().message, written.ok(),
          "run in a folder of your own, or use `morula run --out DIR`"};
}

}  // namespace

Status doctor(const DoctorOptions& options, const Context& context) {
  const scenarios::BuildInfo build = scenarios::build_info();
  std::vector<Finding> findings{
      {"morula", build.version + " (" + build.git_hash + "), " + build.compiler + ", " + build.build_type, true, ""},
      {"licence", build.licence, true, ""}};
  for (Finding& finding : std::vector<Finding>{mpi(context.comm), hdf5(), threads(), memory(), disk(), writing()})
    findings.push_back(std::move(finding));

  bool well = true;
  nlohmann::ordered_json json;
  std::vector<std::vector<std::string>> rows;
  for (const Finding& finding : findings) {
    well = well && finding.good;
    json["findings"].push_back(
        {{"name", finding.name}, {"value", finding.value}, {"good", finding.good}, {"advice", finding.good ? "" : finding.advice}});
    rows.push_back({finding.good ? "ok" : "bad", finding.name, finding.value + (finding.good ? "" : ": " + finding.advice)});
  }
  json["good"] = well;
  json["ranks"] = context.comm.size();
  context.console.result(options.json ? json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"
                                      : table_text(rows));
  if (!well) return Error{ErrorKind::kVerification, "this machine is not ready for a run", "see the lines marked `bad`"};
  return {};
}

}  // namespace morula::app
