#include "study/declare.h"

namespace morula::scenarios {
namespace {

void declare_things(Section& s, MeasuredThings& of) {
  s.group({.name = "of",
           .doc = "What the measure is taken of. Each measure says which of these it needs.",
           .optional_section = true,
           .shorthand = "type",
           .example = "left"},
          of.present, [&of](Section& o) {
            o.one_or_more({.name = "type", .doc = "A cell type, or several, each by itself.", .example = "left"}, of.type);
            o.words(
                {.name = "pair", .doc = "Two cell types that touch each other; of one type: two cells of it.", .example = "[left, left]"},
                of.pair);
            o.text({.name = "cell", .doc = "The id of a cell; `all`: every cell of the tissue.", .example = "all"}, of.cell);
            o.one_or_more({.name = "load", .doc = "An external load, or several, each by itself.", .example = "pull"}, of.load);
            o.one_or_more({.name = "obstacle", .doc = "An obstacle, or several, each by itself.", .example = "glass"}, of.obstacle);
            o.flag({.name = "together",
                    .doc = "Several things count as one: a single verdict over all their cells and moments.",
                    .fallback = "false",
                    .example = "true",
                    .source = "chosen"},
                   of.together);
            o.one_or_more({.name = "field", .doc = "A field, or several, each by itself.", .example = "oxygen"}, of.field);
          });
}

/// `of_plot`: each output, and the mean of the cells.
void declare_moments(Section& s, MeasuredMoments& m, bool of_plot) {
  s.text(
      {.name = "at",
       .doc =
           "When: `end` or `start` of the run, `every` output, the time of an output, or `holds(thing)`: the last output of each time "
           "in which the course of a load or the way of an obstacle rests, or with `domain` that of the box; `holds` alone: of the load or "
           "obstacle that is measured.",
       .fallback = of_plot ? "every" : "end",
       .example = "6 h",
       .source = "chosen"},
      m.at);
  s.quantity({.name = "from",
              .doc = "With `until`, instead of `at`: every output from this time on; beside `at: holds`: those from this time on.",
              .quantity = Quantity::kTime,
              .low = 0.0,
              .example = "2 h"},
             m.from);
  s.quantity({.name = "until", .doc = "Every output up to this time.", .quantity = Quantity::kTime, .low = 0.0, .example = "6 h"}, m.until);
  s.word({.name = "over_cells",
          .doc = "What is made of several cells. `each`: every cell for itself.",
          .fallback = of_plot ? "mean" : "each",
          .words = {"each", "min", "max", "mean", "sum"},
          .example = "mean",
          .source = "chosen"},
         m.over_cells);
  if (of_plot) return;
  s.word(
      {.name = "over_time",
       .doc =
           "What is made of several moments. `each`: every moment for itself. `rise`: last less first; `growth`: last over first, less 1; "
           "`slope`: that of the straight line through all, per time; `change`: largest difference from the first, over the first; `left`: "
           "difference of the last from the first, over the largest rise above the first; `rising`, `falling`: 1 where each is above, "
           "below "
           "the one before it, else 0.",
       .fallback = "each",
       .words = {"each", "first", "last", "min", "max", "mean", "rise", "growth", "slope", "change", "left", "rising", "falling"},
       .example = "max",
       .source = "chosen"},
      m.over_time);
}

void declare_expected(Section& s, const char* name, ExpectedValue& against, const char* doc) {
  s.group({.name = name, .doc = doc, .optional_section = true, .shorthand = "value", .example = "youngs_law"}, against.present,
          [&against](Section& a) {
            a.any_quantity(
                {.name = "value", .doc = "A number with the unit of the measure; a word is the name of a theory.", .example = "0.5 nN"},
                against.value);
            a.text({.name = "theory", .doc = "A theory by its name; `morula explain theories` lists them.", .example = "youngs_law"},
                   against.theory);
            a.text({.name = "measure",
                    .doc = "Another measure of the same run, at the same moments: `measure(thing)`.",
                    .example = "volume(control)"},
                   against.measure);
            a.text({.name = "data", .doc = "A CSV file whose header gives each column as `name [unit]`.", .example = "force.csv"},
                   against.data);
            a.text({.name = "x",
                    .doc = "The column of the file that lies along: times, or what the plot has as x.",
                    .fallback = "time",
                    .example = "time",
                    .source = "chosen"},
                   against.x);
            a.text({.name = "y", .doc = "The column of the file that is compared.", .example = "force"}, against.y);
            a.text({.name = "source",
                    .doc = "Where these numbers come from; shown in the report.",
                    .fallback = "",
                    .example = "Chu et al. 2005, doi:10.1103/PhysRevLett.94.028102"},
                   against.source);
          });
}

void declare_curve(Section& s, Criterion& c) {
  s.text({.name = "along",
          .doc = "Another measure that lies along, instead of time: of the same things where none are named.",
          .fallback = "",
          .example = "force"},
         c.along);
  s.word(
      {.name = "curve",
       .doc =
           "What is made of the measure as a curve over `along`, of all moments and things together: `r_squared`, `intercept` or "
           "`relative_intercept` (over the value of largest size) of the straight line through its points; `rms`: root mean square of its "
           "differences from the data, at those of their points that it reaches.",
       .words = {"r_squared", "intercept", "relative_intercept", "rms"},
       .example = "r_squared"},
      c.curve);
}

}  // namespace

void declare_criterion(Section& s, Criterion& c) {
  s.text({.name = "id", .doc = "Its name in verdict.json.", .required = true, .example = "S6.1"}, c.id);
  s.text({.name = "measure",
          .doc = "What is measured in the finished run: a measure by name, or a column of series.csv; `measure(thing)` also says of what. "
                 "`morula "
                 "explain measures` lists them.",
          .required = true,
          .example = "cap.angle"},
         c.measure);
  declare_things(s, c.of);
  declare_moments(s, c.moments, false);
  declare_expected(s, "over", c.over,
                   "What the measure is divided by: another measure, of the same things or of another one, a theory or a number. What is "
                   "judged is a plain number then.");
  declare_curve(s, c);
  declare_expected(
      s, "against", c.against,
      "What the measure must be near to, by `within`: a number, a theory, another measure, or data over time or over `along`.");
  s.any_quantity(
      {.name = "within",
       .doc = "How near to `against`: with the unit of the measure, in % of what is expected, or with `curve: rms` as near to the data as "
              "another measure, `measure(thing)`, is.",
       .example = "4 deg"},
      c.within);
  s.any_quantity(
      {.name = "below", .doc = "Largest value: with the unit of the measure, or another measure, `measure(thing)`.", .example = "0.3 um"},
      c.below);
  s.any_quantity(
      {.name = "above", .doc = "Smallest value: with the unit of the measure, or another measure, `measure(thing)`.", .example = "0.5 nN"},
      c.above);
  s.any_quantities({.name = "between", .doc = "Smallest and largest value.", .example = "[350, 450]"}, c.between);
  s.text({.name = "text",
          .doc = "What it asks, for people. Not given: made from the measure.",
          .fallback = "",
          .example = "contact angle against Young's law"},
         c.text);
}

void declare_study_plot(Section& s, StudyPlot& p) {
  s.text({.name = "name",
          .doc = "Name of its files in plots/: letters, digits, `_` and `-`. Not given: made from the measures.",
          .fallback = "",
          .example = "force_way"},
         p.name);
  s.text({.name = "title", .doc = "Its title. Not given: made from the measures.", .fallback = "", .example = "Pull-off"}, p.title);
  s.text({.name = "x", .doc = "What lies along: `time`, or a measure.", .fallback = "time", .example = "way(pull)", .source = "chosen"},
         p.x);
  s.one_or_more({.name = "y", .doc = "The measure that is shown, or several in one unit.", .required = true, .example = "force(pull)"},
                p.y);
  declare_things(s, p.of);
  declare_moments(s, p.moments, true);
  declare_expected(s, "against", p.against, "What is drawn beside it: a number, a theory, another measure or data.");
}

}  // namespace morula::scenarios
