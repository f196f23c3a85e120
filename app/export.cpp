#include <filesystem>

#include "app/verbs.h"
#include "app/words.h"
#include "results/export.h"
#include "results/file_io.h"
#include "results/lineage.h"
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
  const fs::path folder = options.out.empty() ? run.path() / options.format : fs::path(options.out);
  MORULA_TRY(must_be_new(folder));
  if (options.format == "lineage") {
    if (options.every != 1 || !options.from.empty() || !options.to.empty())
      return Error{ErrorKind::kInput, "a lineage is that of the whole run", "leave out `--every`, `--from` and `--to`"};
    MORULA_TRY_ASSIGN(const std::size_t cells, scenarios::export_lineage(run.results(), run.events(), folder));
    context.console.result(folder.string() + "\n");
    context.console.note(count_words(cells, "cell", "cells") + " written");
    return {};
  }
  const ExportFormat format = options.format == "vtk"   ? ExportFormat::kVtk
                              : options.format == "csv" ? ExportFormat::kCsv
                                                        : ExportFormat::kStl;
  MORULA_TRY_ASSIGN(const std::size_t count, scenarios::export_snapshots(run.results(), folder, format, range));
  context.console.result(folder.string() + "\n");
  context.console.note(count_words(count, "snapshot", "snapshots") + " written");
  return {};
}

}  // namespace morula::app
