// The life of a cell from its birth to its division.
#include "coupling/behaviours/arrest.h"
#include "coupling/behaviours/division_axis.h"
#include "coupling/behaviours/growth_law.h"
#include "study/declare.h"
#include "study/law_keys.h"
#include "study/own_section.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;

void declare_fate(Section& f, draft::Fate& fate) {
  f.quantity({.name = "share",
              .doc = "Of the divisions.",
              .quantity = Q::kFraction,
              .required = true,
              .low = 0.0,
              .high = 1.0,
              .low_open = true,
              .example = "80 %"},
             fate.share);
  f.words({.name = "types",
           .doc = "Of the daughter to which the axis points, and of the other.",
           .required = true,
           .example = "[stem, transit]"},
          fate.types);
}

/// By which plane a cell divides, and what each daughter gets.
void declare_division(Section& c, draft::CellType& t) {
  KeySpec axis{
      .name = "axis",
      .doc =
          "Axis of division: the cell is cut across it. Where a cell has no such axis (a round one no longest, one within the tissue "
          "none along its surface) it is random.",
      .fallback = "random",
      .example = "long",
      .source = "Van Liedekerke et al."};
  for (const auto& one : c.laws().division_axes) axis.words.push_back(one->info.name);
  c.word(axis, t.axis);
  std::vector<const std::vector<OwnKey>*> of_axes;
  for (const auto& one : c.laws().division_axes) of_axes.push_back(&one->keys);
  declare_own_keys(c, of_axes, t.axis_own, false);
  c.quantity({.name = "axis_spread",
              .doc = "How far axes stray from the one that `axis` says: standard deviation of the angle in each of two directions (von "
                     "Mises-Fisher).",
              .quantity = Q::kAngle,
              .fallback = "0 deg",
              .low = 0.0,
              .high = 1.5,
              .example = "20 deg",
              .source = "chosen: off"},
             t.axis_spread);
  bool given = false;
  c.group({.name = "daughters", .doc = "What daughters are.", .example = "{polarity: mirrored}"}, given, [&t](Section& d) {
    d.list(
        {.name = "fates",
         .doc =
             "Types that they may have, and how often; else both have that of their mother. One is drawn for each division. Where "
             "`body` of the type is another one than of the mother's, a daughter gets it when the sisters have parted, half an hour later.",
         .example = "[{share: 80 %, types: [stem, transit]}, {share: 10 %, types: [transit, transit]}]"},
        t.fates, &declare_fate);
    d.word({.name = "polarity",
            .doc = "kept: both have that of their mother; mirrored: the one to which the axis points has it, the other the "
                   "opposite; new: each "
                   "one of her own, as a cell that is placed.",
            .fallback = "kept",
            .words = {"kept", "mirrored", "new"},
            .example = "mirrored",
            .source = "chosen"},
           t.daughter_polarity);
  });
  c.group({.name = "share",
           .doc = "Part of the mother's volume that the daughter gets to which the axis points; kept within 10 and 90 %.",
           .shorthand = "mean",
           .example = "{mean: 50 %, spread: 5 %}"},
          given, [&t](Section& d) {
            declare_spread(d, t.division_share, Q::kFraction, "50 %", "Mean over cells.", "chosen: equal daughters", 0.1, 0.9);
          });
}

/// The law of growth, with the keys of the laws' own.
void declare_growth(Section& c, draft::CellType& t) {
  KeySpec growth{
      .name = "growth", .doc = "Volume against time. ", .fallback = "linear", .example = "linear", .source = "Van Liedekerke et al."};
  for (const auto& law : c.laws().growth) {
    growth.doc += (growth.words.empty() ? "" : "; ") + law->word + ": " + law->doc;
    growth.words.push_back(law->word);
  }
  growth.doc += ".";
  c.word(growth, t.growth);
  declare_law_keys(c, choosable_growth_laws(c.laws()),
                   {"model", "duration", "growth", "ratio", "size", "phases", "arrest", "quiescence", "axis", "direction", "field",
                    "geometry", "daughters", "axis_spread", "share", "shells", "new_surface"},
                   t.growth_own);
}

/// At which volume cells divide.
void declare_size(Section& c, draft::Cycle& t) {
  c.quantity({.name = "ratio",
              .doc = "Division volume over birth volume. Daughters that are halves keep the size of their mothers only with 2.",
              .fallback = "2",
              .low = 1.0,
              .high = 100.0,
              .low_open = true,
              .example = "2",
              .source = "chosen"},
             t.ratio);
  bool given = false;
  c.group(
      {.name = "size",
       .doc = "What the division volume follows from.",
       .shorthand = "control",
       .example = "{control: adder, spread: 10 %}"},
      given, [&t](Section& s) {
        s.word({.name = "control",
                .doc = "timer: `ratio` times the birth volume; sizer: the same for all cells; adder: the same more than at birth.",
                .fallback = "timer",
                .words = {"timer", "sizer", "adder"},
                .example = "adder",
                .source = "chosen"},
               t.control);
        s.quantity({.name = "volume",
                    .doc = "Of a sizer the division volume, of an adder what is added. Without it `ratio` times, or `ratio` - 1 times, the "
                           "volume of the type's mean `radius`.",
                    .quantity = Q::kVolume,
                    .low = 0.0,
                    .low_open = true,
                    .example = "1800 um^3"},
                   t.volume);
        s.quantity(
            {.name = "spread",
             .doc = "Relative standard deviation from cell to cell (Gaussian, cut at 3): of a sizer that of the division volume, else that "
                    "of what a cell gains.",
             .quantity = Q::kFraction,
             .fallback = "0 %",
             .low = 0.0,
             .high = 0.3,
             .example = "10 %",
             .source = "chosen"},
            t.volume_spread);
      });
}

/// The factors of the registry, each a section.
void declare_arrest(Section& s, const char* doc, bool& present, std::map<std::string, draft::OwnSection>& own) {
  s.group({.name = "arrest", .doc = doc, .optional_section = true, .example = "{pressure: {from: 200 Pa, to: 800 Pa}}"}, present,
          [&own](Section& a) {
            for (const auto& factor : a.laws().arrest) {
              KeySpec section = factor->section;
              section.optional_section = true;
              draft::OwnSection& mine = own[section.name];
              a.group(section, mine.present, [&](Section& inner) { declare_own_keys(inner, factor->keys, mine, true); });
            }
          });
}

void declare_phase(Section& s, draft::CyclePhase& p) {
  s.quantity({.name = "duration",
              .doc = "How long it lasts: the mean of its law before it is cut, which with a `gaussian` spread above 40 % is less than the "
                     "mean over cells.",
              .quantity = Q::kTime,
              .low = 0.0,
              .high = 1e9,
              .low_open = true,
              .example = "7 h"},
             p.duration);
  s.word({.name = "law",
          .doc = "fixed: the same for all cells; gaussian: with `spread`, cut at 3 deviations and above 0; erlang: the sum of `stages` "
                 "exponential times.",
          .fallback = "fixed",
          .words = {"fixed", "gaussian", "erlang"},
          .example = "erlang",
          .source = "chosen"},
         p.law);
  s.quantity({.name = "spread",
              .doc = "Relative standard deviation, of `law: gaussian`.",
              .quantity = Q::kFraction,
              .low = 0.0,
              .high = 1.0,
              .example = "10 %"},
             p.spread);
  s.whole(
      {.name = "stages", .doc = "Number of stages, of `law: erlang`; 1: one exponential time.", .low = 1, .high = 10000, .example = "10"},
      p.stages);
  s.word(
      {.name = "until",
       .doc =
           "time: it ends after `duration`; size: when the cell has its division volume, in the last phase in which it grows. That phase "
           "lasts until the division volume is there in any case: what slows growth alone makes it longer.",
       .fallback = "time",
       .words = {"time", "size"},
       .example = "size",
       .source = "chosen"},
      p.until);
  s.flag({.name = "grows", .doc = "Whether cells grow in it.", .fallback = "true", .example = "false", .source = "chosen"}, p.grows);
  declare_arrest(s, "Factors of the rate at which it passes; they multiply.", p.has_arrest, p.arrest);
}

/// Phases, what holds them and growth back, and the way out of them.
void declare_phases(Section& c, draft::Cycle& t) {
  c.named(
      {.name = "phases",
       .doc = "Phases of `model: phases`, by name, in their order. Without them G1, S, G2 and M with 7, 6, 3 and 2 parts of `duration`.",
       .shorthand = "duration",
       .example = "{G1: {duration: 7 h, law: erlang, stages: 10}, S: 6 h, G2: 3 h, M: 2 h}"},
      t.phases, &declare_phase);
  declare_arrest(c, "Factors of the rate of growth, between 0 and 1, beside `inhibit_growth`; they multiply.", t.has_arrest, t.arrest);
  c.group({.name = "quiescence",
           .doc = "Cells leave a phase for G0, in which they neither grow nor pass phases, and come back, by the factor of its `arrest`.",
           .optional_section = true,
           .example = "{phase: G1, below: 10 %, above: 50 %, hold: 1 h}"},
          t.has_quiescence, [&t](Section& q) {
            q.text({.name = "phase", .doc = "Name of the phase.", .required = true, .example = "G1"}, t.quiescent_phase);
            const auto part = [&q](const char* name, const char* doc, const char* fallback, Given<double>& value) {
              q.quantity({.name = name,
                          .doc = doc,
                          .quantity = Q::kFraction,
                          .fallback = fallback,
                          .low = 0.0,
                          .high = 1.0,
                          .example = fallback,
                          .source = "chosen"},
                         value);
            };
            part("below", "They leave when the factor has been below this.", "10 %", t.enter_below);
            part("above", "They come back when it has been above this.", "50 %", t.leave_above);
            q.quantity({.name = "hold",
                        .doc = "For how long.",
                        .quantity = Q::kTime,
                        .fallback = "1 h",
                        .low = 0.0,
                        .example = "1 h",
                        .source = "chosen"},
                       t.hold);
          });
}

}  // namespace

void declare_cycle(Section& c, draft::CellType& t) {
  c.word({.name = "model",
          .doc = "volume_threshold: a cell grows from its birth volume to its division volume and divides; phases: it passes `phases` and "
                 "divides at the end of the last; none: it rests.",
          .fallback = "volume_threshold",
          .words = {"none", "volume_threshold", "phases"},
          .example = "volume_threshold",
          .source = "chosen"},
         t.cycle_model);
  bool given = false;
  c.group({.name = "duration",
           .doc = "Time from birth to division, or, where size is controlled, in which a cell of the type's birth volume grows to `ratio` "
                  "times that. Phases with times of their own take its place.",
           .shorthand = "mean",
           .example = "{mean: 18 h, spread: 10 %}"},
          given, [&t](Section& d) {
            declare_spread(d, t.cycle_duration, Q::kTime, "24 h", "Mean over cells.", "chosen: human stem cells and epithelia", 60.0, 1e9);
            declare_correlation(d, t.cycle_duration);
          });
  declare_growth(c, t);
  declare_size(c, t.cycle);
  declare_phases(c, t.cycle);
  declare_division(c, t);
  c.word({.name = "shells",
          .doc = "What a shell does at its division volume. cut: a plane through it and a cap on both sides make two shells; wait: it "
                 "stops growing until its body is exchanged for a sphere.",
          .fallback = "cut",
          .words = {"cut", "wait"},
          .example = "cut",
          .source = "chosen"},
         t.shells_divide);
  c.quantity({.name = "new_surface",
              .doc = "Time in which the interface that a cut has made takes its tension 2 T - W, beginning at none: at first sisters "
                     "adhere with 2 T. "
                     "An interface under full tension at once would jerk its neighbours. 0: at once.",
              .quantity = Q::kTime,
              .fallback = "10 min",
              .low = 0.0,
              .high = 1e6,
              .example = "10 min",
              .source = "chosen: cytokinesis takes about 10 min"},
             t.new_surface);
}

}  // namespace morula::scenarios
