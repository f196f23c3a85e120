#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/parallel/comm.h"
#include "core/result.h"
#include "coupling/events.h"
#include "results/run_files.h"
#include "results/run_record.h"
#include "results/text_lengths.h"
#include "study/study.h"

namespace morula::scenarios {

/// A column of series.csv as its header names it.
struct SeriesHeader {
  std::string name;
  std::string unit;  ///< "1" for a number
};

/// The folder of one run, and how its texts are written. Only the root rank touches texts: on the other
/// ranks the calls do nothing and succeed; pass the result to agree() where all ranks must know.
class RunFolder : public RunFiles {
 public:
  /// Collective. Makes `<parent>/<study>-NNNN` with the next free number, or exactly `out` if given. Never an existing folder: kFile.
  static Result<RunFolder> create(const std::filesystem::path& parent, const std::filesystem::path& out, const std::string& study,
                                  const Comm& comm);
  /// Collective. An existing run, to resume or to look at: kFile if it is none.
  static Result<RunFolder> open(const std::filesystem::path& path, const Comm& comm);

  /// study.yaml, study.resolved.yaml and inputs/; fills the record's inputs with their SHA-256.
  Status write_study(const Study& study, RunRecord& record) const;
  /// run.json, and for scripts an empty file DONE, or FAILED with the reason in it (a stopped run has neither). A run that came to its end with a
  /// criterion that failed is done, and FAILED stands beside its verdict.json.
  /// On a disk too full even for run.json a failed run gets the mark alone, which read_run_record() believes.
  Status write_record(const RunRecord& record) const;
  Status write_status(const RunStatus& status) const;
  Status write_verdict(const Judgement& judgement) const;
  Status add_to_log(const std::string& line) const;
  Status add_events(std::span<const ToldEvent> events) const;
  /// Header of series.csv (`time [s]` first). When the file is there already (a resumed run), its header must be the same: kInput.
  Status begin_series(std::span<const SeriesHeader> columns) const;
  Status add_to_series(double time, std::span<const double> values) const;
  /// Makes the texts that grow with the run last, as a checkpoint does its state; their lengths then, on the root.
  Result<TextLengths> sync_texts() const;
  /// After a restart: takes from series.csv and events.jsonl what is later than `time`, from events.jsonl and log.txt what came after the
  /// checkpoint that had these lengths, and what was written by halves or is no row of numbers. Whether events are missing that the checkpoint knew (at the root).
  Result<bool> cut_back(double time, const TextLengths& lengths) const;

 private:
  RunFolder(std::filesystem::path path, bool is_root) : RunFiles(std::move(path)), is_root_(is_root) {}
  bool is_root_;
};

}  // namespace morula::scenarios
