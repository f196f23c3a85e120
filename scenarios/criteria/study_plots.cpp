// Plots that a study declares.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "scenarios/criteria/judge_criteria.h"

namespace morula::scenarios {
namespace {

/// The unit in which an axis shows a quantity, and how many internal units it is.
struct ShownUnit {
  std::string text;
  double factor = 1.0;
};

ShownUnit shown_unit(Quantity quantity) {
  if (quantity == Quantity::kAngle) return {"deg", std::numbers::pi / 180.0};
  if (quantity == Quantity::kPressure) return {"Pa", 1e-3};
  return {std::string(describe(quantity).internal_unit), 1.0};
}

ShownUnit shown_time(double last) {
  return last < 120.0 ? ShownUnit{"s", 1.0} : last < 7200.0 ? ShownUnit{"min", 60.0} : ShownUnit{"h", 3600.0};
}

/// Points of a curve in internal units, and what a theory expects at each.
struct PlotPoints {
  std::vector<double> x, y, expected;
  bool of_many = false;  ///< several cells at one moment: no line leads from one to the next

  void sort_by_x() {
    if (expected.empty()) expected.resize(x.size(), std::nan(""));
    std::vector<std::size_t> order(x.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) { return x[a] < x[b]; });
    for (auto* column : {&x, &y, &expected}) {
      std::vector<double> sorted;
      for (const std::size_t i : order) sorted.push_back((*column)[i]);
      *column = std::move(sorted);
    }
  }
};

class StudyPlotMaker {
 public:
  StudyPlotMaker(FinishedRun& run, const UnderstoodPlot& plot) : run_(run), plot_(plot) {}

  Result<NamedPlot> made() {
    CurvePlot out;
    const Measure& first = plot_.y.front().measure;
    y_ = shown_unit(first.quantity);
    MORULA_TRY_ASSIGN(const std::vector<double>* const times, run_.snapshot_times());
    x_ = plot_.x ? shown_unit(plot_.x->measure.quantity) : shown_time(times->empty() ? 0.0 : times->back());
    out.x = {plot_.x ? plot_.x->measure.title : "time", x_.text, false, {}, {}};
    out.y = {first.title, y_.text, false, {}, {}};
    out.title = !plot_.title.empty() ? plot_.title : first.title + (plot_.x ? " over " + plot_.x->measure.title : " over time");
    const Moments& when = plot_.moments.moments;
    single_ = when.kind == Moments::Kind::kStart || when.kind == Moments::Kind::kEnd || when.from == when.until;
    MORULA_TRY(add_measures(out));
    MORULA_TRY(add_expected(out));
    return NamedPlot{plot_.name, std::move(out)};
  }

 private:
  /// The points of one thing: values of y over those of x at the same time.
  Result<PlotPoints> points_of(const MeasureCall& call, std::size_t number) {
    const Subject& subject = call.subjects[number];
    MORULA_TRY_ASSIGN(const std::vector<Sample> ys,
                      measured(run_, call.measure, subject, plot_.moments.of(run_.study(), subject), plot_.over_cells, "each"));
    std::vector<Sample> xs;
    if (plot_.x) {
      const Subject& thing = plot_.x->subjects[std::min(number, plot_.x->subjects.size() - 1)];
      MORULA_TRY_ASSIGN(xs, measured(run_, plot_.x->measure, thing, plot_.moments.of(run_.study(), thing), plot_.over_cells, "each"));
    }
    PlotPoints out;
    std::vector<Sample> used;
    for (const Sample& y : ys) {
      const auto x = std::find_if(xs.begin(), xs.end(), [&](const Sample& one) {
        return std::abs(one.time - y.time) <= 1e-6 * std::max(1.0, y.time) && (one.cell == y.cell || one.cell.empty() || y.cell.empty());
      });
      if (plot_.x && x == xs.end()) continue;
      out.x.push_back(plot_.x ? x->value : y.time);
      out.y.push_back(y.value);
      out.of_many = out.of_many || (!used.empty() && used.back().time == y.time);
      used.push_back(y);
    }
    if (plot_.expected.kind == Expectation::Kind::kTheory || plot_.expected.kind == Expectation::Kind::kMeasure) {
      MORULA_TRY_ASSIGN(out.expected, expected_values(run_, plot_.expected, question_of(call), subject, used));
    }
    return out;
  }

  /// What a measure is asked at each moment.
  [[nodiscard]] Question question_of(const MeasureCall& call) const {
    Question out;
    out.measured = call;
    out.moments = plot_.moments;
    out.over_cells = plot_.over_cells;
    out.over_time = "each";
    return out;
  }

  void add_curve(CurvePlot& out, const std::string& name, const PlotPoints& points, const std::vector<double>& values, CurveStyle style,
                 int color) const {
    Curve curve{name, {}, {}, style, color};
    for (const double x : points.x) curve.x.push_back(x / x_.factor);
    for (const double y : values) curve.y.push_back(y / y_.factor);
    if (!curve.x.empty()) out.curves.push_back(std::move(curve));
  }

  Status add_measures(CurvePlot& out) {
    int color = 0;
    for (const MeasureCall& call : plot_.y) {
      PlotPoints together;  // of all things, where each is one point
      for (std::size_t i = 0; i < call.subjects.size(); ++i) {
        MORULA_TRY_ASSIGN(PlotPoints points, points_of(call, i));
        if (single_) {
          together.x.insert(together.x.end(), points.x.begin(), points.x.end());
          together.y.insert(together.y.end(), points.y.begin(), points.y.end());
          together.expected.insert(together.expected.end(), points.expected.begin(), points.expected.end());
          continue;
        }
        if (points.of_many) points.sort_by_x();
        add_pair(out, name_of(call, call.subjects[i]), points, points.of_many ? CurveStyle::kPoints : CurveStyle::kLine, color++);
      }
      if (!single_) continue;
      together.sort_by_x();
      add_pair(out, plot_.y.size() > 1 ? call.measure.title : "cells", together, CurveStyle::kPoints, color++);
    }
    return {};
  }

  /// A measure, and what is expected of it in the same colour.
  void add_pair(CurvePlot& out, const std::string& name, const PlotPoints& points, CurveStyle style, int color) const {
    add_curve(out, name, points, points.y, style, color);
    const bool some = std::any_of(points.expected.begin(), points.expected.end(), [](double y) { return std::isfinite(y); });
    const std::string whose = plot_.y.size() * plot_.y.front().subjects.size() > 1 && !single_ ? ", " + name : "";
    if (some)
      add_curve(out, plot_.expected.text + whose, points, points.expected,
                style == CurveStyle::kPoints ? CurveStyle::kLine : CurveStyle::kPoints, color + 1);
  }

  std::string name_of(const MeasureCall& call, const Subject& subject) const {
    if (plot_.y.size() > 1 && call.subjects.size() == 1) return call.text;
    return subject.text.empty() ? call.measure.title : subject.text;
  }

  Status add_expected(CurvePlot& out) const {
    if (plot_.expected.kind == Expectation::Kind::kValue)
      out.limits.push_back({plot_.expected.value.internal / y_.factor, plot_.expected.text});
    if (plot_.expected.kind == Expectation::Kind::kData) {
      PlotPoints data{plot_.expected.xs, plot_.expected.ys, {}};
      add_curve(out, plot_.expected.text, data, data.y, CurveStyle::kPoints, -1);
    }
    return {};
  }

  FinishedRun& run_;
  const UnderstoodPlot& plot_;
  ShownUnit x_, y_;
  bool single_ = false;  ///< one moment: each thing is a point
};

}  // namespace

Result<std::vector<NamedPlot>> study_plots(FinishedRun& run) {
  std::vector<NamedPlot> out;
  for (const StudyPlot& asked : run.study().plots) {
    Diagnostics told_by_check;
    const auto understood = understand(run.study(), asked, told_by_check);
    if (!understood) continue;
    MORULA_TRY_ASSIGN(NamedPlot plot, StudyPlotMaker(run, *understood).made());
    out.push_back(std::move(plot));
  }
  return out;
}

}  // namespace morula::scenarios
