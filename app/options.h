#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace morula::app {

/// What the user asked for, one struct a verb; texts with units are kept as typed and read by the verb.
struct NewOptions {
  std::string template_name;  ///< empty: list the templates
  std::string folder;         ///< empty: the template's name
};

struct CheckOptions {
  std::vector<std::string> studies;
  std::vector<std::string> overrides;  ///< key.path=value, for all of them
  bool estimate = false;
  bool schema = false;
  bool strict = false;
};

/// What `run` and `resume` have in common.
struct RunLimits {
  std::string until;     ///< simulated time, as `48 h`
  std::string max_wall;  ///< wall time, as `2 h`
  int threads = 1;       ///< of each rank
  bool timings = false;
};

struct RunOptions {
  std::string study;
  std::vector<std::string> overrides;  ///< key.path=value
  std::string out;                     ///< run folder; empty: runs/<study>-NNNN
  std::optional<std::uint32_t> seed;
  std::vector<std::string> promote, demote;  ///< ids of cells
  bool dry_run = false;
  RunLimits limits;
};

struct ResumeOptions {
  std::string run;
  std::string from;                    ///< a checkpoint of the run, by file name or path; empty: the newest good one
  std::vector<std::string> overrides;  ///< of --set: make a new run
  std::string out;                     ///< folder of the new run
  RunLimits limits;
};

struct StatusOptions {
  std::string run;
  bool json = false;
};

struct ListOptions {
  std::string folder;  ///< empty: `runs` if there is one, else the current folder
  bool json = false;
};

struct InfoOptions {
  std::string target;  ///< run folder, study file or name of a law; may be empty with `defaults`
  bool json = false;
  bool defaults = false;
};

struct ExplainOptions {
  std::string id;
  std::string markdown;  ///< `laws`, `study` or `measures`: the whole reference
};

struct PlotOptions {
  std::string run;
  std::vector<std::string> only;     ///< names of plots; empty: all, and the report
  std::vector<std::string> formats;  ///< svg, png; empty: both
};

struct ExportOptions {
  std::string run, format, out;
  std::uint64_t every = 1;
  std::string from, to;  ///< simulated time, as `12 h`
};

struct VerifyOptions {
  std::string suite;  ///< a name of verify_suites(); empty: the first, or all to list
  bool list = false;
  bool json = false;
  bool studies = false;           ///< also run the library's quick experiments
  std::vector<std::string> only;  ///< ids of the numbers to find; empty: all
};

struct CalibrateOptions {
  std::string law;                     ///< `jkr`
  std::string type;                    ///< of cells
  std::string study;                   ///< that has it
  std::vector<std::string> overrides;  ///< key.path=value
  std::string out;                     ///< folder; empty: calibrations/TYPE
  int threads = 1;                     ///< of each rank
  bool pairs_only = false;             ///< run no packings
  std::string budget;                  ///< computing time of one core, as 20min; empty: all experiments
};

struct CompareOptions {
  std::vector<std::string> runs;  ///< run folders, or NAME=RUN,RUN
  std::vector<std::string> only;  ///< columns of series.csv
  std::string within;             ///< as `3 %`; empty: nothing is asked
  std::string from;               ///< simulated time, as `12 h`
  std::string out;                ///< folder; empty: comparisons/A_B
  bool every = false;             ///< judge at each output
  bool json = false;
};

struct DoctorOptions {
  bool json = false;
};

using Options = std::variant<NewOptions, CheckOptions, RunOptions, ResumeOptions, StatusOptions, ListOptions, InfoOptions, ExplainOptions,
                             PlotOptions, ExportOptions, VerifyOptions, CompareOptions, CalibrateOptions, DoctorOptions>;

}  // namespace morula::app
