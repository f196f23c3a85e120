#include "coupling/behaviours/growth_law.h"

#include <cmath>
#include <limits>

namespace morula {
namespace {

constexpr double kNeverThere = std::numeric_limits<double>::infinity();
constexpr const char* kOurs = "choice of this project; ages of a balanced population: Powell 1956, doi:10.1099/00221287-15-3-492";

std::shared_ptr<const GrowthLaw> make_law(GrowthLaw law) {
  law.info.parameters.insert(
      law.info.parameters.begin(),
      {given_by_study("cycle_duration", "time", "s", "T: time from the birth volume V_b to the division volume V_d, the mean over cells."),
       given_by_study("division_ratio", "number", "1", "V_d/V_b.")});
  for (const KeySpec& key : law.own) law.info.keys.push_back({"cycle", key});
  return std::make_shared<const GrowthLaw>(std::move(law));
}

std::shared_ptr<const GrowthLaw> exponential_growth() {
  return make_law({.info = {.name = "exponential_growth",
                            .title = "Exponential growth over the cycle",
                            .equation = "V = V_b (V_d/V_b)^(t/T)",
                            .source = kOurs,
                            .parameters = {}},
                   .word = "exponential",
                   .doc = "in proportion to the volume",
                   .at = [](const GrowthPace& p, const LawValues&, double point) { return p.from * std::pow(p.to / p.from, point); },
                   .after =
                       [](const GrowthPace& p, const LawValues&, double volume, double dt) {
                         const double whole = std::log(p.to / p.from);
                         return volume * std::exp(whole * dt / p.duration);
                       },
                   .time_to = [](const GrowthPace& p, const LawValues&, double volume,
                                 double wanted) { return p.duration * std::log(wanted / volume) / std::log(p.to / p.from); }});
}

KeySpec limit_key() {
  return {.name = "limit",
          .doc = "Volume at which growth would end, over the division volume.",
          .fallback = "1.5",
          .low = 1.0,
          .high = 1e3,
          .low_open = true,
          .example = "1.25",
          .source = "chosen"};
}

LawParameter limit_parameter() { return given_by_study("limit", "number", "1", "V_∞/V_d."); }

double logit(double part) { return std::log(part / (1.0 - part)); }

std::shared_ptr<const GrowthLaw> logistic_growth() {
  return make_law({.info = {.name = "logistic_growth",
                            .title = "Logistic growth over the cycle",
                            .equation = "dV/dt = r V (1 − V/V_∞), r such that V goes from V_b to V_d in T",
                            .source = "Verhulst 1838",
                            .parameters = {limit_parameter()}},
                   .word = "logistic",
                   .doc = "in proportion to the volume, more and more slowly towards `limit`",
                   .own = {limit_key()},
                   .at =
                       [](const GrowthPace& p, const LawValues& own, double point) {
                         const double end = own("limit") * p.to, start = logit(p.from / end);
                         return end / (1.0 + std::exp(-(start + point * (logit(p.to / end) - start))));
                       },
                   .after =
                       [](const GrowthPace& p, const LawValues& own, double volume, double dt) {
                         const double end = own("limit") * p.to;
                         if (volume >= end) return volume;
                         const double rate = (logit(p.to / end) - logit(p.from / end)) / p.duration;
                         return end / (1.0 + std::exp(-(logit(volume / end) + rate * dt)));
                       },
                   .time_to =
                       [](const GrowthPace& p, const LawValues& own, double volume, double wanted) {
                         const double end = own("limit") * p.to;
                         if (wanted <= volume) return 0.0;
                         if (wanted >= end) return kNeverThere;
                         return p.duration * (logit(wanted / end) - logit(volume / end)) / (logit(p.to / end) - logit(p.from / end));
                       }});
}

std::shared_ptr<const GrowthLaw> relaxing_growth() {
  return make_law({.info = {.name = "relaxing_growth",
                            .title = "Growth that relaxes to a volume",
                            .equation = "dV/dt = r (V_∞ − V), r such that V goes from V_b to V_d in T",
                            .source = "physics/cbm.md §5",
                            .parameters = {limit_parameter()}},
                   .word = "relaxing",
                   .doc = "fast at first, more and more slowly towards `limit`",
                   .own = {limit_key()},
                   .at =
                       [](const GrowthPace& p, const LawValues& own, double point) {
                         const double end = own("limit") * p.to;
                         return end - (end - p.from) * std::pow((end - p.to) / (end - p.from), point);
                       },
                   .after =
                       [](const GrowthPace& p, const LawValues& own, double volume, double dt) {
                         const double end = own("limit") * p.to;
                         if (volume >= end) return volume;
                         return end - (end - volume) * std::pow((end - p.to) / (end - p.from), dt / p.duration);
                       },
                   .time_to =
                       [](const GrowthPace& p, const LawValues& own, double volume, double wanted) {
                         const double end = own("limit") * p.to;
                         if (wanted <= volume) return 0.0;
                         if (wanted >= end) return kNeverThere;
                         return p.duration * std::log((end - volume) / (end - wanted)) / std::log((end - p.from) / (end - p.to));
                       }});
}

std::shared_ptr<const GrowthLaw> no_growth() {
  return make_law(
      {.info = {.name = "no_growth",
                .title = "Cells keep their volume from birth to division",
                .equation = "V = V_b",
                .source = "choice of this project: cleavage",
                .parameters = {}},
       .word = "none",
       .doc = "not at all: daughters are smaller and smaller, as in cleavage; it needs `model: phases`",
       .grows = false,
       .at = [](const GrowthPace& p, const LawValues&, double) { return p.from; },
       .after = [](const GrowthPace&, const LawValues&, double volume, double) { return volume; },
       .time_to = [](const GrowthPace&, const LawValues&, double volume, double wanted) { return wanted <= volume ? 0.0 : kNeverThere; }});
}

}  // namespace

std::shared_ptr<const GrowthLaw> linear_growth() {
  static const auto law =
      make_law({.info = {.name = "linear_growth",
                         .title = "Linear growth over the cycle",
                         .equation = "V = V_b + (V_d − V_b) t/T",
                         .source = kOurs,
                         .parameters = {}},
                .word = "linear",
                .doc = "the same volume in every hour",
                .at = [](const GrowthPace& p, const LawValues&, double point) { return p.from + (p.to - p.from) * point; },
                .after =
                    [](const GrowthPace& p, const LawValues&, double volume, double dt) {
                      const double whole = p.to - p.from;
                      return volume + whole * dt / p.duration;
                    },
                .time_to =
                    [](const GrowthPace& p, const LawValues&, double volume, double wanted) {
                      const double whole = p.to - p.from;
                      return p.duration * (wanted - volume) / whole;
                    }});
  return law;
}

std::vector<std::shared_ptr<const GrowthLaw>> growth_laws() {
  return {linear_growth(), exponential_growth(), logistic_growth(), relaxing_growth(), no_growth()};
}

}  // namespace morula
