#include "scenarios/run/run_plots.h"

#include <algorithm>

namespace morula::scenarios {
namespace {

class Plots {
 public:
  Plots(const Study& study, const SeriesTable& series) : study_(study), series_(series) {
    const SeriesColumn* time = series.find("time");
    const double last = time && !time->values.empty() ? time->values.back() : 0.0;
    const double unit = last < 7200.0 ? 60.0 : 3600.0;
    axis_ = {"time", unit == 60.0 ? "min" : "h", false, {}, {}};
    if (time)
      for (const double t : time->values) time_.push_back(t / unit);
  }

  /// A plot of those of the columns that exist and show something; none if none does.
  CurvePlot* add(const std::string& name, const std::string& title, const std::string& label, const std::string& unit,
                 const std::vector<std::pair<std::string, std::string>>& columns, double scale = 1.0,
                 CurveStyle style = CurveStyle::kLine) {
    return add_those(name, title, {label, unit, false, {}, {}}, columns, scale, style, false);
  }

  /// Numbers of cells and events, which jump.
  void add_counts(const std::string& name, const std::string& title, const std::string& label,
                  const std::vector<std::pair<std::string, std::string>>& columns) {
    if (CurvePlot* plot = add(name, title, label, "", columns, 1.0, CurveStyle::kSteps)) plot->y.low = 0.0;
  }

  /// A plot about steps and solver, also where nothing changes.
  CurvePlot* add_numerics(const std::string& name, const std::string& title, const std::string& label, const std::string& unit,
                          const std::vector<std::pair<std::string, std::string>>& columns, double scale = 1.0) {
    CurvePlot* plot = add_those(name, title, {label, unit, false, {}, {}}, columns, scale, CurveStyle::kLine, true);
    if (plot != nullptr) out_.back().numerics = true;
    return plot;
  }

  void add_limited(const std::string& name, const std::string& title, const std::string& label, const std::string& unit,
                   const std::vector<std::pair<std::string, std::string>>& columns, double limit, double scale = 1.0) {
    if (CurvePlot* plot = add_numerics(name, title, label, unit, columns, scale)) plot->limits.push_back({limit * scale, "limit"});
  }

  std::vector<NamedPlot> all() {
    const Model& model = study_.model;
    add_counts("cells_by_body", "Cells by body", "cells", {{"cell_count", "all"}, {"sphere_count", "spheres"}, {"shell_count", "shells"}});
    std::vector<std::pair<std::string, std::string>> types;
    for (const CellType& type : model.types) types.emplace_back("count_" + type.name, type.name);
    if (types.size() > 1) add_counts("cells_by_type", "Cells by type", "cells", types);
    add("size", "Size of the tissue", "radius", "um", {{"spheroid_radius", "by gyration"}, {"largest_extent", "largest extent"}});
    add("pressure", "Pressure", "pressure", "Pa",
        {{"mean_pressure", "mean"}, {"shell_pressure", "mean of shells"}, {"max_pressure", "largest"}}, 1000.0);
    add("contact_area", "Contact", "area per cell", "um^2", {{"mean_contact_area", "mean"}});
    add("energy", "Energy", "energy", "nN um", {{"energy", "energy"}});
    for (const auto& spec : model.fields)
      add("field_" + spec.name, spec.name, "concentration", "mM", {{"mean_" + spec.name, "mean"}, {"min_" + spec.name, "least"}});
    add_numerics("step", "Step size", "step", "s", {{"step_size", "mean step"}});
    add_numerics("solver", "Work of the solver", "iterations per step", "",
                 {{"newton_iterations", "Newton"}, {"linear_iterations", "linear"}});
    add_counts("events", "Events", "since the start",
               {{"divisions", "divisions"}, {"deaths", "deaths"}, {"promotions", "promotions"}, {"demotions", "demotions"}});
    add_limited("volume_error", "Volume against the pressure law", "largest error", "%",
                {{"volume_error", "worst cell"}, {"total_volume_error", "all cells"}}, model.limits.volume_error, 100.0);
    add_limited("overlap", "Overlap of surfaces", "depth", "um", {{"overlap", "at the output"}, {"worst_overlap", "in any step"}},
                model.limits.overlap);
    if (!model.fields.empty())
      add_limited("field_balance", "Balance of the fields", "relative error", "", {{"field_balance", "largest"}},
                  model.limits.field_balance);
    return std::move(out_);
  }

 private:
  CurvePlot* add_those(const std::string& name, const std::string& title, CurveAxis y_axis,
                       const std::vector<std::pair<std::string, std::string>>& columns, double scale, CurveStyle style, bool also_flat) {
    CurvePlot plot;
    plot.title = title;
    plot.x = axis_;
    plot.y = std::move(y_axis);
    bool changes = false;
    for (const auto& [column, shown] : columns) {
      const SeriesColumn* found = series_.find(column);
      if (!found || found->values.empty()) continue;
      Curve curve{shown, time_, found->values, style};
      for (double& y : curve.y) y *= scale;
      const auto [low, high] = std::minmax_element(curve.y.begin(), curve.y.end());
      const bool zero = *low == 0.0 && *high == 0.0;
      const bool again = std::any_of(plot.curves.begin(), plot.curves.end(), [&](const Curve& c) { return c.y == curve.y; });
      if (!also_flat && (zero || again)) continue;
      changes = changes || *low != *high;
      plot.curves.push_back(std::move(curve));
    }
    if (plot.curves.empty() || !(changes || also_flat)) return nullptr;
    out_.push_back({name, std::move(plot)});
    return &out_.back().plot;
  }

  const Study& study_;
  const SeriesTable& series_;
  CurveAxis axis_;
  std::vector<double> time_;
  std::vector<NamedPlot> out_;
};

}  // namespace

std::vector<NamedPlot> standard_plots(const Study& study, const SeriesTable& series) { return Plots(study, series).all(); }

}  // namespace morula::scenarios
