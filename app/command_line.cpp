#include "app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>

#include "results/build_info.h"
#include "scenarios/verify/suites.h"
#include "study/diagnostics.h"

namespace morula::app {
namespace {

std::vector<std::string> suite_names() {
  std::vector<std::string> out;
  for (const scenarios::VerifySuite& suite : scenarios::verify_suites()) out.emplace_back(suite.name);
  return out;
}

/// The parser of one verb writes here; `chosen` is the verb that was given.
struct Parsed {
  NewOptions make_new;
  CheckOptions check;
  RunOptions run;
  ResumeOptions resume;
  StatusOptions status;
  ListOptions list;
  InfoOptions info;
  ExplainOptions explain;
  PlotOptions plot;
  ExportOptions export_results;
  VerifyOptions verify;
  CompareOptions compare;
  CalibrateOptions calibrate;
  DoctorOptions doctor;
};

CLI::App* add_verb(CLI::App& program, const char* name, const char* what, const char* example_one, const char* example_two) {
  CLI::App* verb = program.add_subcommand(name, what);
  verb->footer(std::string("Examples:\n  ") + example_one + "\n  " + example_two);
  return verb;
}

/// A shell makes an empty word of a variable that has no value.
CLI::Validator not_empty() {
  return {[](const std::string& text) { return text.empty() ? std::string("it is empty") : std::string(); }, ""};
}

void add_limits(CLI::App& verb, RunLimits& limits) {
  verb.add_option("--until", limits.until,
                  "Simulated time at which to end, as 48h, or the next output after it; instead of the study's time.end")
      ->type_name("TIME");
  verb.add_option("--threads", limits.threads, "Threads of each rank; results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--max-wall", limits.max_wall, "Stop with a checkpoint after this wall time, as 2h (exit code 75)")->type_name("TIME");
  verb.add_flag("--timings", limits.timings, "Print the time spent in each stage of the step");
}

void add_making_verbs(CLI::App& program, Parsed& p) {
  CLI::App* verb = add_verb(program, "new", "Make a study folder from a template; without a name, list the templates", "morula new",
                            "morula new hybrid_spheroid spheroid");
  verb->add_option("TEMPLATE", p.make_new.template_name, "Name of the template");
  verb->add_option("DIR", p.make_new.folder, "Folder to make; it must not exist (default: the template's name)");

  verb = add_verb(program, "check", "Check studies and show all their mistakes at once; nothing is run",
                  "morula check study.yaml initial.0.count=1000 --estimate", "morula check --schema > study.schema.json");
  verb->add_option("STUDY|KEY=VALUE", p.check.studies, "Study files, and values that replace those of all of them, by the path of the key");
  verb->add_flag("--estimate", p.check.estimate, "Also print size, memory and time of the run");
  verb->add_flag("--schema", p.check.schema, "Print the JSON Schema of study files, for editors");
  verb->add_flag("--strict", p.check.strict, "Warnings are errors");
}

void add_running_verbs(CLI::App& program, Parsed& p) {
  CLI::App* verb = add_verb(program, "run", "Simulate a study", "morula run study.yaml --until 24h --threads 2",
                            "mpirun -n 4 morula run study.yaml seed=7 cell_types.hepatocyte.radius=\"7 um\"");
  verb->add_option("STUDY", p.run.study, "Study file")->required();
  verb->add_option("KEY=VALUE", p.run.overrides, "Values that replace those of the study, by the path of the key");
  verb->add_option("--out", p.run.out, "Run folder; it must not exist (default: runs/STUDY-NNNN)")->type_name("DIR")->check(not_empty());
  verb->add_option("--promote", p.run.promote, "A cell that is a shell from the start on, by its id; may stand several times")
      ->type_name("ID")
      ->allow_extra_args(false);
  verb->add_option("--demote", p.run.demote, "A cell that is a sphere from the start on")->type_name("ID")->allow_extra_args(false);
  verb->add_option("--seed", p.run.seed, "Seed of all random numbers, instead of the study's")
      ->check(CLI::Range(std::uint32_t{0}, std::numeric_limits<std::uint32_t>::max()))
      ->type_name("N");
  verb->add_flag("--dry-run", p.run.dry_run, "Check, place the cells at time 0, and say what would be done; nothing is written");
  add_limits(*verb, p.run.limits);

  verb = add_verb(program, "resume", "Go on with a run from its newest good checkpoint", "morula resume runs/spheroid-0001 --until 48h",
                  "morula resume runs/spheroid-0001 --set limits.overlap=\"0.4 um\" --out runs/softer");
  verb->add_option("RUN", p.resume.run, "Run folder")->required();
  verb->add_option("--from", p.resume.from,
                   "Checkpoint to start from, as cp_000003 (default: the newest good one); an older one makes a new run")
      ->type_name("CHECKPOINT");
  verb->add_option("--set", p.resume.overrides, "Change a value of the study; this makes a new run with this one as its parent")
      ->type_name("KEY=VALUE");
  verb->add_option("--out", p.resume.out, "Folder of the new run that --set or --from makes")->type_name("DIR")->check(not_empty());
  add_limits(*verb, p.resume.limits);

  verb = add_verb(program, "calibrate",
                  "Find the contact law of spheres from deformable cells: virtual experiments, a fit, a file and a report",
                  "morula calibrate jkr hepatocyte study.yaml", "mpirun -n 2 morula calibrate jkr tumour spheroid.yaml --out tumour_162");
  verb->add_option("LAW", p.calibrate.law, "What is fitted")->required()->check(CLI::IsMember({"jkr"}))->type_name("jkr");
  verb->add_option("TYPE", p.calibrate.type, "Cell type of the study, whose shells are the truth")->required();
  verb->add_option("STUDY", p.calibrate.study, "Study file")->required();
  verb->add_option("KEY=VALUE", p.calibrate.overrides, "Values that replace those of the study, by the path of the key");
  verb->add_option("--out", p.calibrate.out, "Folder; what was run there before is not run again (default: calibrations/TYPE)")
      ->type_name("DIR")
      ->check(not_empty());
  verb->add_flag("--pairs-only", p.calibrate.pairs_only, "No packings that shrink: quicker, and without a fitted curve of packing");
  verb->add_option("--budget", p.calibrate.budget,
                   "Computing time of one core; what there is no time for is left out, what only judges first")
      ->type_name("TIME");
  verb->add_option("--threads", p.calibrate.threads, "Threads of each rank; all of them share the experiments")
      ->check(CLI::Range(1, 1024))
      ->type_name("N")
      ->capture_default_str();
}

void add_looking_verbs(CLI::App& program, Parsed& p) {
  CLI::App* verb =
      add_verb(program, "status", "Say where a run stands", "morula status runs/spheroid-0001", "morula status runs/spheroid-0001 --json");
  verb->add_option("RUN", p.status.run, "Run folder")->required();
  verb->add_flag("--json", p.status.json, "Print JSON");

  verb = add_verb(program, "list", "Table of the runs in a folder", "morula list", "morula list /data/sweep --json");
  verb->add_option("DIR", p.list.folder, "Folder that holds run folders (default: runs, or the current folder)");
  verb->add_flag("--json", p.list.json, "Print JSON");

  verb = add_verb(program, "info", "What was run, what a study says, what a law is", "morula info runs/spheroid-0001 --json",
                  "morula info study.yaml --defaults");
  verb->add_option("RUN|STUDY|LAW", p.info.target, "Run folder, study file, or name of a law");
  verb->add_flag("--json", p.info.json, "Print JSON");
  verb->add_flag("--defaults", p.info.defaults, "Defaults with their sources; of a study or run: all values, defaults filled in");

  verb = add_verb(program, "explain", "What a key, a law, a measure or an error code means", "morula explain E203",
                  "morula explain cell_types.hepatocyte.dcm.cortex.tension");
  verb->add_option("ID", p.explain.id,
                   "Path of a key, name of a law, measure or theory, code of a message; `measures`, `theories`: all of them");
  verb->add_option("--markdown", p.explain.markdown, "Print a whole reference as Markdown")
      ->check(CLI::IsMember({"laws", "study", "measures"}))
      ->type_name("laws|study|measures");

  verb = add_verb(program, "verify", "Compare the laws with theory and published numbers (exit code 5 when one is outside its tolerance)",
                  "morula verify life", "morula verify physics --studies --json");
  verb->add_option("SUITE", p.verify.suite, "Which numbers (default: physics)")->check(CLI::IsMember(suite_names()))->type_name("NAME");
  CLI::Option* const list = verb->add_flag("--list", p.verify.list, "List the suites, or the references of one, and find nothing");
  verb->add_flag("--json", p.verify.json, "Print JSON: {suite, rows: [{id, quantity, reference, value, tolerance, passed, source}]}");
  CLI::Option* const studies =
      verb->add_flag("--studies", p.verify.studies, "Also run the single-cell experiments of the library (about half a minute)")
          ->excludes(list);
  verb->add_option("--only", p.verify.only, "Find the numbers with this id only, as T4.1; may stand several times")
      ->allow_extra_args(false)
      ->excludes(list)
      ->excludes(studies)
      ->type_name("ID ...");

  verb = add_verb(program, "doctor", "Check what a run needs of this machine: MPI, HDF5, threads, disk, memory", "morula doctor",
                  "mpirun -n 4 morula doctor --json");
  verb->add_flag("--json", p.doctor.json, "Print JSON");
}

void add_result_verbs(CLI::App& program, Parsed& p) {
  CLI::App* verb = add_verb(program, "plot", "Plots, pictures and report.html of a run", "morula plot runs/spheroid-0001",
                            "morula plot runs/spheroid-0001 --only cells --format svg");
  verb->add_option("RUN", p.plot.run, "Run folder")->required();
  verb->add_option("--only", p.plot.only, "Only plots and pictures whose name begins so; no report")->delimiter(',')->type_name("NAME");
  verb->add_option("--format", p.plot.formats, "svg for plots, png for pictures (default: both)")
      ->delimiter(',')
      ->check(CLI::IsMember({"svg", "png"}))
      ->type_name("svg,png");

  verb = add_verb(program, "compare",
                  "Runs of one study with other bodies, laws or seeds: what differs, by more than seeds spread, and a page of it",
                  "morula compare shells=runs/s-0001,runs/s-0002 hybrid=runs/s-0003,runs/s-0004 --within 3%",
                  "morula compare runs/spheroid-0001 runs/spheroid-0002 --only spheroid_radius,mean_pressure");
  verb->add_option("RUN", p.compare.runs,
                   "Run folders, or NAME=RUN,RUN: a group of runs that differ in their seeds alone. Single runs of one study with several "
                   "seeds are a group, too. "
                   "The first group is what the others are compared with")
      ->required()
      ->type_name("RUN|NAME=RUN,RUN");
  verb->add_option("--within", p.compare.within, "Exit code 5 where a difference is not within this part of the first group's value")
      ->type_name("PART");
  verb->add_option("--only", p.compare.only, "Only these columns of series.csv (default: those of the tissue, not of bodies and solver)")
      ->delimiter(',')
      ->type_name("NAME");
  verb->add_flag("--every", p.compare.every,
                 "Judge where the means are farthest apart, against the largest value (default: at the last common output)");
  verb->add_option("--from", p.compare.from, "Leave out what is before this simulated time")->type_name("TIME");
  verb->add_option("--out", p.compare.out, "Folder of compare.html and plots/ (default: comparisons/, by the groups)")
      ->type_name("DIR")
      ->check(not_empty());
  verb->add_flag("--json", p.compare.json, "Print JSON; writes no page without --out");

  verb = add_verb(program, "export", "Write the snapshots of a run for other programs", "morula export runs/spheroid-0001 vtk --every 4",
                  "morula export runs/spheroid-0001 lineage");
  verb->add_option("RUN", p.export_results.run, "Run folder")->required();
  verb->add_option("FORMAT", p.export_results.format,
                   "vtk (ParaView), csv (cells), stl (surfaces), lineage (all cells of the run as CSV and Newick)")
      ->required()
      ->check(CLI::IsMember({"vtk", "csv", "stl", "lineage"}));
  verb->add_option("--every", p.export_results.every, "Every n-th snapshot")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40))
      ->type_name("N")
      ->capture_default_str();
  verb->add_option("--from", p.export_results.from, "From this simulated time, as 12h")->type_name("TIME");
  verb->add_option("--to", p.export_results.to, "To this simulated time")->type_name("TIME");
  verb->add_option("--out", p.export_results.out, "Folder to make; it must not exist (default: in RUN, by the format)")
      ->type_name("DIR")
      ->check(not_empty());
}

Options chosen_options(const std::string& verb, Parsed&& p) {
  if (verb == "new") return std::move(p.make_new);
  if (verb == "check") return std::move(p.check);
  if (verb == "run") return std::move(p.run);
  if (verb == "resume") return std::move(p.resume);
  if (verb == "status") return std::move(p.status);
  if (verb == "list") return std::move(p.list);
  if (verb == "info") return std::move(p.info);
  if (verb == "explain") return std::move(p.explain);
  if (verb == "plot") return std::move(p.plot);
  if (verb == "export") return std::move(p.export_results);
  if (verb == "verify") return std::move(p.verify);
  if (verb == "compare") return std::move(p.compare);
  if (verb == "calibrate") return std::move(p.calibrate);
  return p.doctor;
}

/// The flags of a verb, for suggestions.
std::vector<std::string> flags_of(const CLI::App& verb) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  return flags;
}

Error usage_error(const CLI::App& program, const std::vector<std::string>& arguments, const CLI::ParseError& problem) {
  const auto verbs = program.get_subcommands();
  const CLI::App& verb = verbs.empty() ? program : *verbs.front();
  const std::vector<std::string> flags = flags_of(verb);
  for (const std::string& argument : arguments) {
    const std::string flag = argument.substr(0, argument.find('='));
    if (flag.size() > 2 && flag.compare(0, 2, "--") == 0 && std::find(flags.begin(), flags.end(), flag) == flags.end())
      return {ErrorKind::kInput, "unknown flag '" + flag + "'", scenarios::suggest(flag, flags)};
  }
  std::string what = problem.what();
  std::replace(what.begin(), what.end(), '\n', ' ');
  return {ErrorKind::kInput, what, "see `morula" + (verbs.empty() ? "" : " " + verb.get_name()) + " --help`"};
}

std::string version_text() {
  const scenarios::BuildInfo build = scenarios::build_info();
  return "morula " + build.version + " (" + build.git_hash + ", " + build.compiler + ", " + build.build_type + ")\n" +
         "licence: " + build.licence + "\n";
}

/// What `check` was given has KEY=VALUE among its studies: what has a '=' and is no file.
void part_overrides(CheckOptions& check) {
  const auto is_study = [](const std::string& argument) {
    return argument.find('=') == std::string::npos || std::filesystem::exists(argument);
  };
  const auto first = std::stable_partition(check.studies.begin(), check.studies.end(), is_study);
  check.overrides.assign(first, check.studies.end());
  check.studies.erase(first, check.studies.end());
}

/// Options that CLI11 cannot check by itself.
Status check_combinations(const std::string& verb, const Parsed& p) {
  const auto wrong = [&](const std::string& message) { return Error{ErrorKind::kInput, message, "see `morula " + verb + " --help`"}; };
  if (verb == "check" && p.check.studies.empty() && !p.check.schema) return wrong("`check` needs a study file");
  if (verb == "explain" && p.explain.id.empty() == p.explain.markdown.empty())
    return wrong("`explain` needs one of: a key, law or error code; --markdown");
  if (verb == "info" && p.info.target.empty() && !p.info.defaults)
    return wrong("`info` needs a run folder, a study file or the name of a law");
  if (verb == "resume" && !p.resume.out.empty() && p.resume.overrides.empty() && p.resume.from.empty())
    return Error{ErrorKind::kInput, "`resume --out` goes with --set or --from only", "without --set a run goes on in its own folder"};
  return {};
}

}  // namespace

Result<std::variant<Options, Answer>> read_command_line(const std::vector<std::string>& arguments) {
  Parsed parsed;
  CLI::App program("Morula simulates tissues in which some cells are spheres and some are deformable shells.", "morula");
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done; 1 internal error; 2 bad command or study; 3 file missing or target exists; 4 physics limit or solver failed;\n"
      "5 verification failed; 6 memory or disk; 75 stopped early with a checkpoint; 130 interrupted with a checkpoint.\n\n"
      "Examples:\n  morula new hybrid_spheroid spheroid\n  morula run spheroid/study.yaml");
  bool version = false;
  program.add_flag("--version", version, "Print the version");
  add_making_verbs(program, parsed);
  add_running_verbs(program, parsed);
  add_looking_verbs(program, parsed);
  add_result_verbs(program, parsed);

  if (!arguments.empty() && arguments[0] == "--version") return std::variant<Options, Answer>(Answer{version_text()});
  std::vector<std::string> verbs;
  for (const CLI::App* verb : program.get_subcommands({})) verbs.push_back(verb->get_name());
  if (arguments.empty()) return Error{ErrorKind::kInput, "no verb given", scenarios::suggest("", verbs) + "; see `morula --help`"};
  if (arguments[0] == "help" && arguments.size() == 1) return std::variant<Options, Answer>(Answer{program.help()});
  if (arguments[0][0] != '-' && std::find(verbs.begin(), verbs.end(), arguments[0]) == verbs.end())
    return Error{ErrorKind::kInput, "unknown verb '" + arguments[0] + "'", scenarios::suggest(arguments[0], verbs)};
  try {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // as CLI11 wants them
    program.parse(reversed);
  } catch (const CLI::CallForHelp&) {
    const auto chosen = program.get_subcommands();
    return std::variant<Options, Answer>(Answer{chosen.empty() ? program.help() : chosen.front()->help("morula")});
  } catch (const CLI::ParseError& problem) {
    return usage_error(program, arguments, problem);
  }
  const std::string verb = program.get_subcommands().front()->get_name();
  part_overrides(parsed.check);
  MORULA_TRY(check_combinations(verb, parsed));
  return std::variant<Options, Answer>(chosen_options(verb, std::move(parsed)));
}

}  // namespace morula::app
