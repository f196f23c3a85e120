#pragma once
#include <vector>

#include "report/run_plots.h"
#include "results/run_record.h"
#include "scenarios/criteria/understand.h"

namespace morula::scenarios {

/// A criterion judged on a finished run: a verdict for each of the things that it is about. Of several moments and cells the one that is
/// furthest from passing is told. What finds nothing to measure, or nothing to compare with, has failed. Values and limits are in the unit
/// that the study writes. Errors: kFile.
Result<std::vector<Verdict>> judge_criterion(FinishedRun& run, const UnderstoodCriterion& criterion);

/// All criteria of the run's study, in their order. One that cannot be understood has failed.
Result<std::vector<Verdict>> judge_criteria(FinishedRun& run);

/// Its plots. One that cannot be understood is left out: `check` says why.
Result<std::vector<NamedPlot>> study_plots(FinishedRun& run);

/// What a question finds of some of its things: their values, what several cells, moments and things are made into, over what divides
/// them. `data`: of `curve: rms`.
Result<std::vector<Sample>> answers(FinishedRun& run, const Question& question, const MeasureCall& of, const std::vector<Subject>& things,
                                    const Expectation& data);

/// The values of a measure of one thing, several cells and moments made into what is asked for.
Result<std::vector<Sample>> measured(FinishedRun& run, const Measure& measure, const Subject& subject, const Moments& moments,
                                     const std::string& over_cells, const std::string& over_time);

/// The mean of what another measure found at a time [s]; of all where the time does not matter. No number where there is nothing.
double mean_at(const std::vector<Sample>& samples, double time, bool whatever_time);

/// The same question of a measure that another is compared with: not divided, and of a value of each cell the mean.
Question as_compared(const Question& question);

/// What is expected in the place of each sample of a thing; no number where nothing is. What is made of several moments is made of data and theories alike.
Result<std::vector<double>> expected_values(FinishedRun& run, const Expectation& expected, const Question& question, const Subject& subject,
                                            const std::vector<Sample>& samples);

}  // namespace morula::scenarios
