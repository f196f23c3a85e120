// Values of measures and of what they are held against, at the moments and over the cells that a study asks for.
#include <algorithm>
#include <cmath>
#include <map>

#include "scenarios/criteria/judge_criteria.h"
#include "scenarios/measures/interpolated.h"
#include "scenarios/measures/verdicts.h"

namespace morula::scenarios {
namespace {

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

/// The mean of what another measure finds at a time; of all where it finds one moment's only.
double mean_at(const std::vector<Sample>& samples, double time, bool whatever_time) {
  double sum = 0.0;
  int count = 0;
  for (const Sample& one : samples)
    if (whatever_time || std::abs(one.time - time) <= 1e-6 * std::max(1.0, time)) sum += one.value, ++count;
  return count > 0 ? sum / count : kNothing;
}

}  // namespace

Result<std::vector<Sample>> measured(FinishedRun& run, const Measure& measure, const Subject& subject, const Moments& moments,
                                     const std::string& over_cells, const std::string& over_time) {
  MORULA_TRY_ASSIGN(std::vector<Sample> out, measure.take(run, subject, moments));
  const bool of_mean = over_cells == "mean" || over_cells == "sum";
  if (of_mean) {  // cells come and go: those of a moment first
    out = over_all_cells(out, over_cells);
    if (over_time != "each") out = over_all_times(out, over_time);
    return out;
  }
  if (over_time != "each") out = over_all_times(out, over_time);
  if (over_cells == "each" || out.empty()) return out;
  return over_time == "each" ? over_all_cells(out, over_cells) : std::vector<Sample>{reduced(out, over_cells)};
}

Result<std::vector<double>> expected_values(FinishedRun& run, const Expectation& expected, const Measure& measure, const Subject& subject,
                                            const std::vector<Sample>& samples, const Moments& moments, const std::string& over_time) {
  std::vector<double> out;
  std::vector<Sample> others;
  if (expected.kind == Expectation::Kind::kMeasure) {
    MORULA_TRY_ASSIGN(others, measured(run, expected.measure->measure, expected.measure->subjects.front(), moments, "mean", over_time));
  }
  for (const Sample& sample : samples) {
    double value = kNothing;
    if (expected.kind == Expectation::Kind::kValue) value = expected.value.internal;
    if (expected.kind == Expectation::Kind::kMeasure) value = mean_at(others, sample.time, over_time != "each");
    if (expected.kind == Expectation::Kind::kData) value = interpolated(expected.xs, expected.ys, sample.time);
    if (expected.kind == Expectation::Kind::kTheory) {
      MORULA_TRY_ASSIGN(value, expected.theory->value(run, subject, measure.name, sample));
    }
    out.push_back(value);
  }
  return out;
}

}  // namespace morula::scenarios
