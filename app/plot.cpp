#include <algorithm>
#include <filesystem>

#include "app/verbs.h"
#include "app/words.h"
#include "core/shell_word.h"
#include "report/pictures/png.h"
#include "report/pictures/standard_pictures.h"
#include "report/run_plots.h"
#include "results/file_io.h"
#include "results/run_folder.h"
#include "results/series_reader.h"
#include "scenarios/criteria/judge.h"
#include "scenarios/run/report_run.h"

namespace morula::app {
namespace fs = std::filesystem;
namespace {

/// What the user wants to see: names that begin so; nothing given: all.
bool wanted(const std::string& name, const std::vector<std::string>& only) {
  return only.empty() || std::any_of(only.begin(), only.end(), [&](const std::string& begin) { return name.starts_with(begin); });
}

Status write_plots(const scenarios::Study& study, const scenarios::RunFiles& run, const std::vector<std::string>& only,
                   std::string& written) {
  MORULA_TRY_ASSIGN(const scenarios::SeriesTable series, scenarios::read_series(run.series()));
  MORULA_TRY_ASSIGN(const std::vector<scenarios::NamedPlot> plots, scenarios::plots_of(study, run.path(), series));
  for (const scenarios::NamedPlot& one : plots) {
    if (!wanted(one.name, only)) continue;
    MORULA_TRY(scenarios::write_curves(one.plot, run.plots() / one.name));
    written += (run.plots() / (one.name + ".svg")).string() + "\n";
  }
  return {};
}

Status write_pictures(const scenarios::Study& study, const scenarios::RunFiles& run, const std::vector<std::string>& only,
                      const Context& context, std::string& written) {
  std::vector<std::pair<double, std::string>> damaged;
  MORULA_TRY_ASSIGN(const auto snapshots, scenarios::snapshots_over_time(run.results(), damaged));
  for (const auto& [time, what] : damaged) context.console.warning(what);
  for (const scenarios::Picture& picture : scenarios::standard_pictures(snapshots, scenarios::type_colors(study))) {
    if (!wanted(picture.name, only)) continue;
    const fs::path path = run.plots() / (picture.name + ".png");
    MORULA_TRY_ASSIGN(const std::vector<std::uint8_t> png, scenarios::encode_png(picture.image));
    MORULA_TRY(scenarios::write_png(png, path));
    written += path.string() + "\n";
  }
  return {};
}

/// Plots and pictures alone, some of them, without a report.
Status plot_some(const scenarios::RunFiles& run, const PlotOptions& options, const Context& context) {
  const auto has = [&](const char* format) {
    return options.formats.empty() || std::find(options.formats.begin(), options.formats.end(), format) != options.formats.end();
  };
  MORULA_TRY_ASSIGN(const scenarios::Study study, scenarios::read_run_study(run.path(), context.laws));
  MORULA_TRY(scenarios::make_folder(run.plots()));
  std::string written;
  if (has("svg")) MORULA_TRY(write_plots(study, run, options.only, written));
  if (has("png")) MORULA_TRY(write_pictures(study, run, options.only, context, written));
  if (written.empty())
    return Error{ErrorKind::kInput, "no plot or picture has a name that begins so",
                 "`morula plot " + shell_word(run.path().string()) + "` writes all; their names are those of the files in plots/"};
  context.console.result(written);
  return {};
}

}  // namespace

Status plot(const PlotOptions& options, const Context& context) {
  MORULA_TRY_ASSIGN(const scenarios::RunFolder folder, scenarios::RunFolder::open(options.run, Comm()));
  if (!options.only.empty() || !options.formats.empty()) return plot_some(folder, options, context);
  MORULA_TRY_ASSIGN(const fs::path report, scenarios::plot_run(folder.path(), context.laws));
  context.console.result(report.string() + "\n");
  return {};
}

}  // namespace morula::app
