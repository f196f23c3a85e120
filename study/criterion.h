#pragma once
#include <string>
#include <vector>

#include "study/section.h"

namespace morula::scenarios {

/// What a measure is taken of: names of things of the study. A measure says which of these it needs; of several things each is measured by
/// itself.
struct MeasuredThings {
  bool present = false;
  Given<std::vector<std::string>> type, load, obstacle, field;
  Given<std::vector<std::string>> pair;  ///< two cell types that touch each other
  Given<std::string> cell;               ///< the id of a cell, or `all`
  Given<bool> together;                  ///< several things count as one
};

/// What a measure is held against: one of `value`, `theory`, `measure` and `data`.
struct ExpectedValue {
  bool present = false;
  Given<std::string> value;         ///< a number with its unit
  Given<std::string> theory;        ///< a theory by name
  Given<std::string> measure;       ///< another measure of the same run, `name(thing)`
  Given<std::string> data;          ///< a CSV file; after the study is read the absolute path
  Given<std::string> x, y, source;  ///< its columns, and where its numbers come from
};

/// At which moments of a run a measure is taken, and what is made of several moments and cells.
struct MeasuredMoments {
  Given<std::string> at;                     ///< `end`, `start`, `every` output, `holds`, `holds(thing)`, or a time
  Given<double> from, until;                 ///< instead: all outputs between; with `holds`: those of them [s]
  Given<std::string> over_time, over_cells;  ///< `each`: all of them must pass
};

/// A criterion of a study.
struct Criterion {
  Place place;
  Given<std::string> id, measure, text;
  MeasuredThings of;
  MeasuredMoments moments;
  ExpectedValue over;               ///< what the measure is divided by
  Given<std::string> along, curve;  ///< the measure that another is a curve over, and what is made of the curve
  ExpectedValue against;
  Given<std::string> within;                ///< of `against`: a number with the unit of the measure, relative in %, or another measure
  Given<std::string> below, above;          ///< a number with its unit, or another measure of the run
  Given<std::vector<std::string>> between;  ///< two numbers with their units
};

/// A plot of a study: one or more measures over another, or over time.
struct StudyPlot {
  Place place;
  Given<std::string> name, title, x;
  Given<std::vector<std::string>> y;
  MeasuredThings of;
  MeasuredMoments moments;
  ExpectedValue against;
};

}  // namespace morula::scenarios
