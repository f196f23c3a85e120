#include "results/run_folder.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>

#include "core/numbers/number_text.h"
#include "core/shell_word.h"
#include "results/file_io.h"
#include "results/series_reader.h"

namespace morula::scenarios {
namespace fs = std::filesystem;
namespace {

/// A study's name as a part of a folder's name.
std::string safe_name(const std::string& study) {
  std::string out;
  for (const char c : study) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
    out += plain ? c : '_';
  }
  return out.empty() || out[0] == '.' ? "run" + out : out;
}

/// The largest NNNN among `<name>-NNNN` in a folder, 0 if there is none.
long largest_number(const fs::path& parent, const std::string& name) {
  long largest = 0;
  std::error_code error;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end; entry.increment(error)) {
    const std::string text = entry->path().filename().string();
    if (text.size() <= name.size() + 1 || text.compare(0, name.size() + 1, name + '-') != 0) continue;
    long number = 0;
    const char* last = text.data() + text.size();
    const auto [end_of_number, problem] = std::from_chars(text.data() + name.size() + 1, last, number);
    if (problem == std::errc() && end_of_number == last) largest = std::max(largest, number);
  }
  return largest;
}

Status make_parents(const fs::path& path) {
  std::error_code error;
  if (!path.empty() && !fs::is_directory(path, error)) {
    fs::create_directories(path, error);
    if (error) return file_error(path, "create folder", error.value());
  }
  return {};
}

/// mkdir is atomic: of two runs that start together, each gets its own folder.
Result<fs::path> make_run(const fs::path& parent, const fs::path& out, const std::string& study) {
  if (!out.empty()) {
    const fs::path clean = out.has_filename() ? out : out.parent_path();
    MORULA_TRY(make_parents(clean.parent_path()));
    if (::mkdir(clean.c_str(), 0755) == 0) return clean;
    if (errno == EEXIST)
      return Error{ErrorKind::kFile, "'" + clean.string() + "' exists already, and a run never overwrites anything",
                   "give --out another name, or go on with `morula resume " + shell_word(clean.string()) + "`"};
    return file_error(clean, "create folder", errno);
  }
  MORULA_TRY(make_parents(parent));
  const std::string name = safe_name(study);
  for (long number = largest_number(parent, name) + 1;; ++number) {
    char suffix[32];
    std::snprintf(suffix, sizeof suffix, "-%04ld", number);
    const fs::path path = parent / (name + suffix);
    if (::mkdir(path.c_str(), 0755) == 0) return path;
    if (errno != EEXIST) return file_error(path, "create folder", errno);
  }
}

/// Keeps the whole lines that begin before `length` and that `keep` likes.
Status filter_lines(const fs::path& path, std::uint64_t length, const std::function<bool(const std::string&, std::size_t)>& keep) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return {};
  MORULA_TRY_ASSIGN(const std::string text, read_file(path));
  std::string kept;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < std::min<std::uint64_t>(text.size(), length);) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;  // written by halves
    const std::string line = text.substr(begin, end - begin);
    if (keep(line, number++)) kept += line + '\n';
    begin = end + 1;
  }
  return kept == text ? Status{} : write_file_atomically(path, kept);
}

Result<InputRecord> copy_input(const InputFile& input, const fs::path& run) {
  MORULA_TRY_ASSIGN(const std::string bytes, read_file(input.path));
  MORULA_TRY(make_parents((run / input.copy).parent_path()));
  MORULA_TRY(write_file_atomically(run / input.copy, bytes));
  MORULA_TRY_ASSIGN(const std::string sha256, sha256_of_text(bytes));
  return InputRecord{input.path, input.copy, sha256};
}

}  // namespace

Result<RunFolder> RunFolder::create(const fs::path& parent, const fs::path& out, const std::string& study, const Comm& comm) {
  std::string made;
  Status status;
  if (comm.is_root()) {
    auto folder = make_run(parent, out, study);
    if (folder.ok())
      made = folder->string();
    else
      status = std::move(folder).error();
  }
  MORULA_TRY(agree(std::move(status), comm));
  std::vector<std::byte> bytes(made.size());
  std::memcpy(bytes.data(), made.data(), made.size());
  comm.broadcast(bytes);
  return RunFolder(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), comm.is_root());
}

Result<RunFolder> RunFolder::open(const fs::path& path, const Comm& comm) {
  Status status;
  std::error_code ignored;
  if (comm.is_root()) {
    if (!fs::is_directory(path, ignored))
      status = Error{ErrorKind::kFile, "there is no run '" + path.string() + "'", "`morula list` shows the runs"};
    else if (!fs::exists(RunFiles(path).record(), ignored))
      status = Error{ErrorKind::kFile, "'" + path.string() + "' is not a run: it has no run.json", "`morula list` shows the runs"};
  }
  MORULA_TRY(agree(std::move(status), comm));
  return RunFolder(path, comm.is_root());
}

Status RunFolder::write_study(const Study& study, RunRecord& record) const {
  if (!is_root_) return {};
  MORULA_TRY(write_file_atomically(RunFiles::study(), study.source_text));
  MORULA_TRY(write_file_atomically(resolved_study(), study.resolved_text));
  MORULA_TRY_ASSIGN(const std::string source_hash, sha256_of_text(study.source_text));
  MORULA_TRY_ASSIGN(record.study_hash, sha256_of_text(study.resolved_text));
  record.inputs = {{study.source_path, "study.yaml", source_hash}};
  MORULA_TRY(make_folder(path() / "inputs"));
  for (const InputFile& input : study.input_files) {
    MORULA_TRY_ASSIGN(InputRecord copied, copy_input(input, path()));
    record.inputs.push_back(std::move(copied));
  }
  return {};
}

Status RunFolder::write_record(const RunRecord& run) const {
  if (!is_root_) return {};
  std::error_code ignored;
  if (run.state == RunState::kRunning) fs::remove(path() / "FAILED", ignored);  // from before a resume
  Status written = write_file_atomically(record(), to_json(run));
  if (!written.ok() && run.state == RunState::kFailed) {
    fs::remove(status(), ignored);  // room on a full disk: it says nothing that run.json does not
    written = write_file_atomically(record(), to_json(run));
  }
  if (!written.ok() && run.state != RunState::kFailed) return written;
  const bool failed = run.state == RunState::kFailed || (run.state == RunState::kDone && run.exit_code != 0);
  for (const auto& [marker, holds] : {std::pair{"DONE", run.state == RunState::kDone && !failed}, std::pair{"FAILED", failed}}) {
    if (!holds) {
      fs::remove(path() / marker, ignored);  // from before a resume
      continue;
    }
    Status marked = write_file_atomically(path() / marker, run.message.empty() ? "" : run.message + '\n');
    // An empty file takes no room: the mark alone says how the run ended.
    if (!marked.ok() && !OutputFile::open(path() / marker, true).ok()) return marked;
  }
  return written;
}

Status RunFolder::write_status(const RunStatus& run_status) const {
  return is_root_ ? write_file_atomically(status(), to_json(run_status)) : Status{};
}

Status RunFolder::write_verdict(const Judgement& judgement) const {
  return is_root_ ? write_file_atomically(verdict(), to_json(judgement)) : Status{};
}

Status RunFolder::add_to_log(const std::string& line) const { return is_root_ ? append_to_text(log(), line + '\n') : Status{}; }

Status RunFolder::add_events(std::span<const ToldEvent> list) const {
  if (!is_root_ || list.empty()) return {};
  std::string lines;
  for (const ToldEvent& event : list) lines += to_json_line(event);
  return append_to_text(events(), lines);
}

Status RunFolder::begin_series(std::span<const SeriesHeader> columns) const {
  if (!is_root_) return {};
  std::string header = "time [s]";
  for (const SeriesHeader& column : columns) header += ',' + column.name + " [" + column.unit + ']';
  header += '\n';
  std::error_code ignored;
  const bool is_empty = fs::is_regular_file(series(), ignored) && fs::file_size(series(), ignored) == 0;
  if (is_empty || !fs::exists(series(), ignored)) return write_file_atomically(series(), header);
  MORULA_TRY_ASSIGN(const std::string text, read_file(series()));
  if (text.compare(0, header.size(), header) == 0) return {};
  return Error{ErrorKind::kInput, "'" + series().string() + "' has other columns than the study's series",
               "resume with the study that the run was started with; where the file is damaged, move it away: a new one begins"};
}

Status RunFolder::add_to_series(double time, std::span<const double> values) const {
  if (!is_root_) return {};
  std::string line = shortest_text(time);
  for (const double value : values) line += ',' + (std::isnan(value) ? std::string() : shortest_text(value));
  return append_to_text(series(), line + '\n');
}

Result<TextLengths> RunFolder::sync_texts() const {
  TextLengths out;
  if (!is_root_) return out;
  MORULA_TRY(sync_text(series()));
  MORULA_TRY_ASSIGN(out.events, sync_text(events()));
  MORULA_TRY_ASSIGN(out.log, sync_text(log()));
  return out;
}

Result<bool> RunFolder::cut_back(double time, const TextLengths& lengths) const {
  if (!is_root_) return false;
  MORULA_TRY(filter_lines(log(), lengths.log, [](const std::string&, std::size_t) { return true; }));
  std::size_t columns = 0;
  MORULA_TRY(filter_lines(series(), kWholeText, [&](const std::string& line, std::size_t number) {
    if (number == 0) columns = 1 + static_cast<std::size_t>(std::ranges::count(line, ','));
    if (number == 0) return true;  // the header
    const auto row = numbers_of_row(line);
    return row && row->size() == columns && row->front() <= time;
  }));
  std::error_code none;
  const std::uintmax_t length = fs::file_size(events(), none);
  bool lost = lengths.events != kWholeText && (none ? 0 : length) < lengths.events;
  MORULA_TRY(filter_lines(events(), lengths.events, [&](const std::string& line, std::size_t) {
    const std::optional<EventLine> event = event_of_line(line);
    lost = lost || (!event && lengths.events != kWholeText);  // up to that length all lines were whole
    return event && event->time <= time;
  }));
  return lost;
}

}  // namespace morula::scenarios
