#include "scenarios/library/cavity.h"

#include "results/series_reader.h"
#include "scenarios/library/verdicts.h"

namespace morula::scenarios {
namespace {

constexpr double kGrowth = 0.02;  // S18.4
constexpr double kLeak = 0.05;    // S18.4: part of the directions from the centre in which there is no wall

}  // namespace

Status cavity_needs(const Study& study) {
  return study.model.lumens.empty() ? Status(Error{ErrorKind::kInput, "a cavity (`lumens`)", ""}) : Status{};
}

Result<std::vector<Verdict>> judge_cavity(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const SeriesTable series, read_series(run / "series.csv"));
  const std::string& name = study.model.lumens.front().name;
  const SeriesColumn* volume = series.find("volume_" + name);
  const SeriesColumn* pressure = series.find("pressure_" + name);
  const SeriesColumn* open = series.find("open_" + name);
  if (volume == nullptr || pressure == nullptr || open == nullptr)
    return Error{ErrorKind::kFile, "series.csv has no columns of the cavity '" + name + "'",
                 "leave `output.series` away, or name them there"};
  std::size_t before = 0;
  while (before + 1 < series.rows() && !(pressure->values[before + 1] > 0.0)) ++before;
  const double without = volume->values[before], with = volume->values.back();
  std::vector<Verdict> out;
  out.push_back(at_least("S18.4", "volume of the cavity under pressure over that before, less 1",
                         without > 0.0 ? with / without - 1.0 : 0.0, kGrowth));
  out.push_back(at_least("S18.4", "pressure of the cavity at the end", pressure->values.back(), 1e-6, "kPa"));
  out.push_back(at_most("S18.4", "part of the directions from the centre of the cavity without a wall", open->values.back(), kLeak));
  return out;
}

}  // namespace morula::scenarios
