// Values of measures and of what they are held against, at the moments and over the cells that a study asks for.
#include <algorithm>
#include <cmath>
#include <map>

#include "scenarios/criteria/judge_criteria.h"
#include "scenarios/measures/interpolated.h"
#include "scenarios/measures/verdicts.h"

namespace morula::scenarios {
namespace {

/// What several values in the order of time say of their course: see `over_time` of a criterion. No number of one value only.
double course_of(const std::vector<Sample>& samples, const std::string& how) {
  const double first = samples.front().value;
  double farthest = 0.0, highest = 0.0;
  bool rising = true, falling = true;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    rising = rising && samples[i].value > samples[i - 1].value;
    falling = falling && samples[i].value < samples[i - 1].value;
    farthest = std::max(farthest, std::abs(samples[i].value / first - 1.0));
    highest = std::max(highest, samples[i].value - first);
  }
  if (samples.size() < 2) return kNothing;
  if (how == "change") return farthest;
  if (how == "left") return std::abs(samples.back().value - first) / highest;
  return how == "rising" ? rising : falling;
}

/// One value of several; the sample where it is found, or the last one.
Sample reduced(const std::vector<Sample>& samples, const std::string& how) {
  const auto by_value = [](const Sample& a, const Sample& b) { return a.value < b.value; };
  if (how == "min") return *std::min_element(samples.begin(), samples.end(), by_value);
  if (how == "max") return *std::max_element(samples.begin(), samples.end(), by_value);
  if (how == "first") return samples.front();
  Sample out = samples.back();
  if (how == "last") return out;
  if (how == "rise") {
    out.value -= samples.front().value;
    return out;
  }
  if (how == "growth") {
    out.value = out.value / samples.front().value - 1.0;
    return out;
  }
  if (how == "change" || how == "left" || how == "rising" || how == "falling") {
    out.value = course_of(samples, how);
    return out;
  }
  double sum = 0.0, time = 0.0;
  for (const Sample& one : samples) sum += one.value, time += one.time;
  const double count = static_cast<double>(samples.size());
  out.value = how == "sum" ? sum : sum / count;
  if (how != "slope") return out;
  double both = 0.0, square = 0.0;
  for (const Sample& one : samples) {
    both += (one.time - time / count) * (one.value - sum / count);
    square += (one.time - time / count) * (one.time - time / count);
  }
  out.value = both / square;  // no number where there is one moment only
  return out;
}

std::vector<Sample> over_all_cells(const std::vector<Sample>& samples, const std::string& how) {
  std::vector<Sample> out, same;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    same.push_back(samples[i]);
    if (i + 1 < samples.size() && samples[i + 1].time == samples[i].time) continue;
    out.push_back(reduced(same, how));
    if (how == "mean" || how == "sum") out.back().cell.clear();
    same.clear();
  }
  return out;
}

std::vector<Sample> over_all_times(const std::vector<Sample>& samples, const std::string& how) {
  std::map<std::string, std::vector<Sample>> by_cell;
  std::vector<std::string> order;
  for (const Sample& one : samples) {
    auto& list = by_cell[one.cell];
    if (list.empty()) order.push_back(one.cell);
    list.push_back(one);
  }
  std::vector<Sample> out;
  for (const std::string& cell : order) out.push_back(reduced(by_cell[cell], how));
  return out;
}

/// Points of one measure over another.
struct CurvePoints {
  std::vector<double> x, y;
};

/// Of the straight line through the points, by least squares: what `curve` of a criterion says.
double of_line(const CurvePoints& points, const std::string& what) {
  double sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0, largest = 0;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    sx += points.x[i];
    sy += points.y[i];
    sxx += points.x[i] * points.x[i];
    syy += points.y[i] * points.y[i];
    sxy += points.x[i] * points.y[i];
    largest = std::max(largest, std::abs(points.y[i]));
  }
  const double n = static_cast<double>(points.x.size());
  if (n < (what == "r_squared" ? 3.0 : 2.0)) return kNothing;
  const double both = sxy - sx * sy / n, slope = both / (sxx - sx * sx / n);
  if (what == "r_squared") return slope * both / (syy - sy * sy / n);
  const double intercept = (sy - slope * sx) / n;
  return what == "intercept" ? intercept : intercept / largest;
}

/// The points from left to right, those of one place in their order; without those that have none.
CurvePoints from_left(const CurvePoints& curve) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (!std::isnan(curve.x[i]) && !std::isnan(curve.y[i])) order.push_back(i);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return curve.x[i]; });
  CurvePoints out;
  for (const std::size_t i : order) out.x.push_back(curve.x[i]), out.y.push_back(curve.y[i]);
  return out;
}

/// Root mean square of what a curve is above the data, at those of their points that lie between its own. No number where none does.
double rms_from_data(const CurvePoints& points, const Expectation& data) {
  const CurvePoints curve = from_left(points);
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < data.xs.size(); ++i) {
    const double here = interpolated(curve.x, curve.y, data.xs[i]);
    if (std::isnan(here)) continue;
    sum += (here - data.ys[i]) * (here - data.ys[i]);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : kNothing;
}

bool is_at(const Sample& sample, double time) { return std::abs(sample.time - time) <= 1e-6 * std::max(1.0, time); }

/// Where each sample of a thing lies along: at its time, or at what the other measure finds then, of a sample of several cells the mean over all. No number where that finds nothing.
Result<std::vector<double>> places_of(FinishedRun& run, const Question& q, const Subject& thing, const std::vector<Sample>& samples) {
  std::vector<double> out;
  for (const Sample& one : samples) out.push_back(q.along ? kNothing : one.time);
  if (!q.along) return out;
  const Subject& whose = q.along_of_thing && q.along->measure.of != MeasureOf::kRun ? thing : q.along->subjects.front();
  MORULA_TRY_ASSIGN(const auto found, q.along->measure.take(run, whose, q.moments.of(run.study(), whose)));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    double sum = 0.0;
    int count = 0;
    for (const Sample& x : found)
      if (is_at(x, samples[i].time) && (x.cell == samples[i].cell || x.cell.empty() || samples[i].cell.empty())) sum += x.value, ++count;
    if (count > 0) out[i] = sum / count;
  }
  return out;
}

/// The values of a thing, each over the theory or number that divides them.
Result<std::vector<Sample>> divided(FinishedRun& run, const Question& q, const MeasureCall& of, const Subject& thing) {
  MORULA_TRY_ASSIGN(std::vector<Sample> out, of.measure.take(run, thing, q.moments.of(run.study(), thing)));
  for (Sample& one : out) {
    if (q.over.kind == Expectation::Kind::kValue) one.value /= q.over.value.internal;
    if (q.over.kind != Expectation::Kind::kTheory) continue;
    MORULA_TRY_ASSIGN(const double below, q.over.theory->value(run, thing, of.measure.name, one));
    one.value /= below;
  }
  return out;
}

/// Several cells and moments made into what is asked for.
std::vector<Sample> made_into_one(std::vector<Sample> out, const std::string& over_cells, const std::string& over_time) {
  if (over_cells == "mean" || over_cells == "sum") {  // cells come and go: those of a moment first
    out = over_all_cells(out, over_cells);
    return over_time != "each" ? over_all_times(out, over_time) : out;
  }
  if (over_time != "each") out = over_all_times(out, over_time);
  if (over_cells == "each" || out.empty()) return out;
  return over_time == "each" ? over_all_cells(out, over_cells) : std::vector<Sample>{reduced(out, over_cells)};
}

}  // namespace

double mean_at(const std::vector<Sample>& samples, double time, bool whatever_time) {
  double sum = 0.0;
  int count = 0;
  for (const Sample& one : samples)
    if (whatever_time || is_at(one, time)) sum += one.value, ++count;
  return count > 0 ? sum / count : kNothing;
}

Result<std::vector<Sample>> measured(FinishedRun& run, const Measure& measure, const Subject& subject, const Moments& moments,
                                     const std::string& over_cells, const std::string& over_time) {
  MORULA_TRY_ASSIGN(std::vector<Sample> out, measure.take(run, subject, moments));
  return made_into_one(std::move(out), over_cells, over_time);
}

Result<std::vector<Sample>> answers(FinishedRun& run, const Question& q, const MeasureCall& of, const std::vector<Subject>& things,
                                    const Expectation& data) {
  std::vector<Sample> all;
  CurvePoints curve;
  for (const Subject& thing : things) {
    MORULA_TRY_ASSIGN(const std::vector<Sample> found, divided(run, q, of, thing));
    all.insert(all.end(), found.begin(), found.end());
    if (q.curve.empty()) continue;
    MORULA_TRY_ASSIGN(const std::vector<double> places, places_of(run, q, thing, found));
    for (std::size_t i = 0; i < found.size(); ++i) {
      curve.x.push_back(places[i]);
      curve.y.push_back(found[i].value);
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Sample& a, const Sample& b) { return a.time < b.time; });
  const bool one_value = !q.curve.empty() && !all.empty();
  if (one_value)
    all = {{all.back().time, q.curve == "rms" ? rms_from_data(curve, data) : of_line(curve, q.curve), ""}};
  else
    all = made_into_one(std::move(all), q.over_cells, q.over_time);
  if (q.over.kind != Expectation::Kind::kMeasure) return all;
  Question below = q;
  below.over = {};
  MORULA_TRY_ASSIGN(const auto others, answers(run, below, *q.over.measure, q.over.measure->subjects, data));
  const bool whatever_time = one_value || q.over_time != "each" || (all.size() == 1 && others.size() == 1);
  for (Sample& one : all) one.value /= mean_at(others, one.time, whatever_time);
  return all;
}

Question as_compared(const Question& question) {
  Question out = question;
  out.over = {};
  if (out.over_cells == "each") out.over_cells = "mean";
  return out;
}

namespace {

/// What data or a theory say at each moment, made into one as the measure is.
Result<std::vector<double>> expected_over_time(FinishedRun& run, const Expectation& expected, const Question& question,
                                               const Subject& subject, const std::vector<Sample>& samples) {
  Question each = question;
  each.over = {};
  each.over_cells = each.over_time = "each";
  MORULA_TRY_ASSIGN(std::vector<Sample> course, answers(run, each, question.measured, {subject}, {}));
  MORULA_TRY_ASSIGN(const std::vector<double> values, expected_values(run, expected, each, subject, course));
  for (std::size_t i = 0; i < course.size(); ++i) course[i].value = values[i];
  course = made_into_one(std::move(course), question.over_cells, question.over_time);
  std::vector<double> out;
  for (const Sample& one : samples) {
    const auto same = std::ranges::find_if(course, [&](const Sample& c) { return c.cell == one.cell || course.size() == 1; });
    out.push_back(same != course.end() ? same->value : kNothing);
  }
  return out;
}

/// Whether a value of this is of several moments, and of none of them.
bool is_of_a_course(const std::string& over_time) {
  return over_time != "each" && over_time != "min" && over_time != "max" && over_time != "first" && over_time != "last";
}

}  // namespace

Result<std::vector<double>> expected_values(FinishedRun& run, const Expectation& expected, const Question& question, const Subject& subject,
                                            const std::vector<Sample>& samples) {
  if (question.curve == "rms") return std::vector<double>(samples.size(), 0.0);  // the samples are differences already
  const bool by_moment = expected.kind == Expectation::Kind::kData || expected.kind == Expectation::Kind::kTheory;
  if (by_moment && is_of_a_course(question.over_time)) return expected_over_time(run, expected, question, subject, samples);
  std::vector<Sample> others;
  std::vector<double> places;
  if (expected.kind == Expectation::Kind::kMeasure) {
    const Question same = as_compared(question);
    MORULA_TRY_ASSIGN(others, answers(run, same, *expected.measure, expected.measure->subjects, {}));
  }
  if (expected.kind == Expectation::Kind::kData) {
    MORULA_TRY_ASSIGN(places, places_of(run, question, subject, samples));
  }
  std::vector<double> out;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    double value = kNothing;
    if (expected.kind == Expectation::Kind::kValue) value = expected.value.internal;
    if (expected.kind == Expectation::Kind::kMeasure)
      value = mean_at(others, samples[i].time, question.over_time != "each" || (samples.size() == 1 && others.size() == 1));
    if (expected.kind == Expectation::Kind::kData) value = interpolated(expected.xs, expected.ys, places[i]);
    if (expected.kind == Expectation::Kind::kTheory) {
      MORULA_TRY_ASSIGN(value, expected.theory->value(run, subject, question.measured.measure.name, samples[i]));
    }
    out.push_back(value);
  }
  return out;
}

}  // namespace morula::scenarios
