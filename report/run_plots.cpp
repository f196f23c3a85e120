#include "report/run_plots.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace morula::scenarios {
namespace {

class Plots {
 public:
  Plots(const Study& study, const SeriesTable& series) : study_(study), series_(series) {
    const SeriesColumn* time = series.find("time");
    const double last = time && !time->values.empty() ? time->values.back() : 0.0;
    const auto [axis, unit] = time_axis(last);
    axis_ = axis;
    if (time)
      for (const double t : time->values) time_.push_back(t / unit);
  }

  /// A plot of those of the columns that exist and show something; none if none does.
  CurvePlot* add(const std::string& name, const std::string& title, const std::string& label, const std::string& unit,
                 const std::vector<std::pair<std::string, std::string>>& columns, double scale = 1.0,
                 CurveStyle style = CurveStyle::kLine) {
    return add_those(name, title, {label, unit, false, {}, {}}, columns, scale, style, 0.0);
  }

  /// Numbers of cells and events, which jump.
  CurvePlot* add_counts(const std::string& name, const std::string& title, const std::string& label,
                        const std::vector<std::pair<std::string, std::string>>& columns) {
    CurvePlot* plot = add(name, title, label, "", columns, 1.0, CurveStyle::kSteps);
    if (plot != nullptr) plot->y.low = 0.0;
    return plot;
  }

  /// A plot about steps and solver, also where nothing changes.
  CurvePlot* add_numerics(const std::string& name, const std::string& title, const std::string& label, const std::string& unit,
                          const std::vector<std::pair<std::string, std::string>>& columns, double scale = 1.0) {
    CurvePlot* plot = add_those(name, title, {label, unit, false, {}, {}}, columns, scale, CurveStyle::kLine, std::nullopt);
    if (plot != nullptr) out_.back().numerics = true;
    return plot;
  }

  /// Means over the steps since the output before: the row of time 0 has no step and is left out.
  void add_of_steps(const std::string& name, const std::string& title, const std::string& label, const std::string& unit,
                    const std::vector<std::pair<std::string, std::string>>& columns) {
    CurvePlot* plot = add_numerics(name, title, label, unit, columns);
    if (plot == nullptr || time_.size() < 2 || time_.front() != 0.0) return;
    for (Curve& curve : plot->curves) {
      curve.x.erase(curve.x.begin());
      curve.y.erase(curve.y.begin());
    }
  }

  void add_limited(const std::string& name, const std::string& title, const std::string& label, const std::string& unit,
                   const std::vector<std::pair<std::string, std::string>>& columns, double limit, double scale = 1.0) {
    if (CurvePlot* plot = add_numerics(name, title, label, unit, columns, scale)) plot->limits.push_back({limit * scale, "limit"});
  }

  std::vector<NamedPlot> all() {
    const Model& model = study_.model;
    CurvePlot* cells = add_counts("cells_by_body", "Cells by body", "cells",
                                  {{"cell_count", "all"}, {"sphere_count", "spheres"}, {"shell_count", "shells"}});
    if (cells != nullptr && cells->curves.size() == 1) cells->title = "Cells";
    std::vector<std::pair<std::string, std::string>> types;
    for (const CellType& type : model.types) types.emplace_back("count_" + type.name, type.name);
    if (types.size() > 1) add_counts("cells_by_type", "Cells by type", "cells", types);
    constexpr double kGrowth = 0.005;  // of its size: less is no growth but cells that change their shapes
    add_those("size", "Size of the tissue", {"radius", "um", false, {}, {}},
              {{"spheroid_radius", "by gyration"}, {"largest_extent", "largest extent"}}, 1.0, CurveStyle::kLine, kGrowth);
    add("pressure", "Pressure", "pressure", "Pa",
        {{"mean_pressure", "mean"}, {"shell_pressure", "mean of shells"}, {"max_pressure", "largest"}}, 1000.0);
    add("contact_area", "Contact", "area per cell", "um^2", {{"mean_contact_area", "mean"}});
    if (CurvePlot* law = add("outside_law", "Spheres against the range of their laws", "outside_law", "",
                             {{"mean_outside_law", "mean"}, {"max_outside_law", "largest"}}))
      law->limits.push_back({1.0, "end of the range"});
    add("contacts_outside", "Outside of the range of the laws of spheres", "part", "%",
        {{"contacts_beyond_range", "contacts"}, {"spheres_outside_law", "spheres"}}, 100.0);
    add("energy", "Energy", "energy", "nN um", {{"energy", "energy"}});
    add_lumens();
    for (const auto& spec : model.fields)
      add("field_" + spec.name, spec.name, "concentration", "mM", {{"mean_" + spec.name, "mean"}, {"min_" + spec.name, "least"}});
    add_of_steps("step", "Step size", "step", "s", {{"step_size", "mean step"}});
    add_of_steps("solver", "Work of the solver", "iterations per step", "",
                 {{"newton_iterations", "Newton"}, {"linear_iterations", "linear"}});
    add_counts("events", "Events", "events since the start",
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
  void add_lumens() {
    const auto columns = [&](const char* what) {
      std::vector<std::pair<std::string, std::string>> out;
      for (const Lumen& lumen : study_.model.lumens) out.emplace_back(what + lumen.name, lumen.name);
      return out;
    };
    add("lumen_volume", "Volume of cavities", "volume", "um^3", columns("volume_"));
    add("lumen_pressure", "Pressure of cavities", "pressure", "Pa", columns("pressure_"), 1000.0);
    add("lumen_open", "Directions from the centre of a cavity without a wall", "part", "%", columns("open_"), 100.0);
  }

  /// `least_change`: between least and largest value of some curve, over its largest size; less, and the plot is left out. None given:
  /// never left out.
  CurvePlot* add_those(const std::string& name, const std::string& title, CurveAxis y_axis,
                       const std::vector<std::pair<std::string, std::string>>& columns, double scale, CurveStyle style,
                       std::optional<double> least_change) {
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
      double low = 1e300, high = -1e300;
      for (const double y : curve.y)
        if (!std::isnan(y)) low = std::min(low, y), high = std::max(high, y);
      if (low > high) continue;
      const bool zero = low == 0.0 && high == 0.0;
      const bool again = std::any_of(plot.curves.begin(), plot.curves.end(), [&](const Curve& c) { return c.y == curve.y; });
      if (least_change && (zero || again)) continue;
      changes = changes || high - low > least_change.value_or(0.0) * std::max(std::abs(low), std::abs(high));
      plot.curves.push_back(std::move(curve));
    }
    if (plot.curves.empty() || (least_change && !changes)) return nullptr;
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
