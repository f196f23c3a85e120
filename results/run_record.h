#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "coupling/events.h"

namespace morula::scenarios {

enum class RunState : std::uint8_t { kRunning, kDone, kStopped, kFailed };

/// `running`, `done`, `stopped`, `failed`.
[[nodiscard]] std::string name_of(RunState state);

/// A file the run was made from.
struct InputRecord {
  std::string source;  ///< as given
  std::string copy;    ///< in the run folder, relative
  std::string sha256;
};

/// The state at the end, for `morula info`.
struct FinalState {
  double time = 0.0;  ///< [s]
  std::uint64_t cells = 0, spheres = 0, shells = 0;
  std::string state_hash;
  bool at_rest = false;  ///< the run ended because nothing moved any more, nor would (`time.rest`)
};

/// What run.json says: what was run, with what, where, and how it ended. Version, compiler, libraries and host are filled by complete_record.
struct RunRecord {
  RunState state = RunState::kRunning;
  int exit_code = 0;
  std::string message;  ///< why it stopped or failed
  std::string study, title;
  std::uint64_t seed = 0;
  int ranks = 1, threads = 1;
  std::string command;
  std::string parent;  ///< run folder it goes on from, or empty
  std::string study_hash;
  std::vector<InputRecord> inputs;
  std::string started, finished;  ///< UTC, as 2026-11-21T12:00:00Z
  double wall_time = 0.0;         ///< [s], over all restarts
  std::optional<FinalState> final_state;
  std::vector<std::pair<std::string, double>> timings;  ///< name with unit, value; empty when not asked for

  std::string version, git_hash, compiler, build_type, host;
  std::vector<std::pair<std::string, std::string>> libraries;
};

/// Fills in version, build, libraries, host; and `started` if it is empty.
void complete_record(RunRecord& record);
/// Now, UTC, as 2026-11-21T12:00:00Z.
[[nodiscard]] std::string utc_now();

[[nodiscard]] std::string to_json(const RunRecord& record);
Result<RunRecord> read_run_record(const std::filesystem::path& run_json);

/// What status.json says: where a run stands, for `morula status` and other programs.
struct RunStatus {
  RunState state = RunState::kRunning;
  double time = 0.0, end = 0.0;  ///< [s]
  std::uint64_t cells = 0, shells = 0, steps = 0;
  double step = 0.0;                         ///< step size [s]
  double wall_time = 0.0;                    ///< [s]
  double left_low = -1.0, left_high = -1.0;  ///< wall time left, a range; −1: not known [s]
  std::int64_t process = 0;                  ///< process id of the root
  std::string updated;                       ///< UTC; filled when written
};
[[nodiscard]] std::string to_json(const RunStatus& status);
Result<RunStatus> read_run_status(const std::filesystem::path& status_json);

/// An event, and what its numbers stand for in words.
struct ToldEvent {
  Event event;
  std::string text;                          ///< the reason
  std::array<std::string, 2> birth_types{};  ///< of a division: Event::birth_type; empty: not told
};
/// The words for an event of this model.
[[nodiscard]] ToldEvent told(const Event& event, const Model& model);
/// One line of events.jsonl, with the newline.
[[nodiscard]] std::string to_json_line(const ToldEvent& told);
/// What a line of events.jsonl says.
struct EventLine {
  double time = 0.0;                   ///< [s]
  std::string kind;                    ///< name_of(EventKind)
  std::string cell;                    ///< id; empty for an event of the run
  std::vector<std::string> daughters;  ///< ids
  std::string text;
  double volume = 0.0;                     ///< of a division: the mother's target volume; 0: not told [µm³]
  std::vector<double> birth_volumes;       ///< of her daughters [µm³]
  std::vector<std::string> birth_types;    ///< and their types; empty: not told
  std::optional<double> energy_rise;       ///< of the divisions by cut of its moment, together [nN·µm]
  std::optional<ExchangeEffect> exchange;  ///< of an exchange of bodies, and of what became of it
};
/// Nothing for a line that is not whole.
[[nodiscard]] std::optional<EventLine> event_of_line(const std::string& line);
/// The lines of events.jsonl that are whole, in their order.
[[nodiscard]] std::vector<EventLine> events_of_lines(const std::string& lines);
[[nodiscard]] std::string name_of(EventKind kind);

/// One criterion of a run.
struct Verdict {
  std::string id;  ///< as `S18.1`
  std::string quantity;
  double value = 0.0;  ///< no number where the criterion found nothing to judge: then it has failed
  std::string limit;   ///< as `<= 0.3 um`
  bool passed = false;
};
/// The value for people: `0.0123`, or `nothing to judge`.
[[nodiscard]] std::string value_text(const Verdict& verdict);

/// What a green verdict says nothing about.
struct NotChecked {
  std::string id;  ///< as `INV.7`; may be empty
  std::string what, why;
};

/// What the criteria say about a run, and what they do not.
struct Judgement {
  std::vector<Verdict> verdicts;
  std::vector<NotChecked> not_checked;

  [[nodiscard]] bool passed() const;
  [[nodiscard]] std::string failures() const;  ///< "checks failed: S6.1, S18.3"; empty when all passed
};
/// verdict.json.
[[nodiscard]] std::string to_json(const Judgement& judgement);

}  // namespace morula::scenarios
