#pragma once
#include <chrono>
#include <filesystem>
#include <string>

#include "app/console.h"
#include "scenarios/run/driver.h"

namespace morula::app {

/// What a run says while it goes on: on a terminal one line that is written over, else a plain line now and then. Lives on the root.
class RunDisplay {
 public:
  RunDisplay(const Console& console, std::string first_line) : console_(console), first_line_(std::move(first_line)) {}
  ~RunDisplay() { clear(); }
  RunDisplay(const RunDisplay&) = delete;
  RunDisplay& operator=(const RunDisplay&) = delete;

  /// Lets the request call this display.
  void listen_to(scenarios::RunRequest& request);
  /// The last lines: done, or stopped and how to go on.
  void end(const scenarios::RunSummary& summary);

 private:
  void start(const std::filesystem::path& run);
  void progress(const scenarios::Progress& progress);
  void note(const scenarios::Note& note);
  void clear();

  const Console& console_;
  std::string first_line_;
  std::string until_;  ///< of the command, as an option of the next one; empty: to the end of the study
  std::string live_;   ///< what stands on the terminal's line now
  std::chrono::steady_clock::time_point drawn_{};
  scenarios::PlainPace pace_;
};

}  // namespace morula::app
