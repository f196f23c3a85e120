#include <filesystem>

#include "app/verbs.h"
#include "app/words.h"
#include "results/export.h"
#include "results/file_io.h"
#include "results/run_folder.h"

namespace morula::app {
namespace fs = std::filesystem;
using scenarios::ExportFormat;

Status export_results(const ExportOptions& options, const Context& context) {
  MORULA_TRY_ASSIGN(const scenarios::RunFolder run, scenarios::RunFolder::open(options.run, Comm()));
  scenarios::ExportRange range;
  range.every = options.every;
  if (!options.from.empty()) {
    MORULA_TRY_ASSIGN(range.from, read_time("--from", options.from));
  }
  if (!options.to.empty()) {
    MORULA_TRY_ASSIGN(range.to, read_time("--to", options.to));
  }
  const ExportFormat format = options.format == "vtk"   ? ExportFormat::kVtk
                              : options.format == "csv" ? ExportFormat::kCsv
                                                        : ExportFormat::kStl;
  const fs::path folder = options.out.empty() ? run.path() / options.format : fs::path(options.out);
  std::error_code error;
  if (fs::exists(folder, error))
    return Error{ErrorKind::kFile, "'" + folder.string() + "' exists already, and nothing is overwritten",
                 "name another folder with `--out DIR`"};
  MORULA_TRY_ASSIGN(const std::size_t count, scenarios::export_snapshots(run.results(), folder, format, range));
  context.console.result(folder.string() + "\n");
  context.console.note(count_words(count, "snapshot", "snapshots") + " written");
  return {};
}

}  // namespace morula::app
