#include "app/run_display.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include "app/words.h"
#include "core/numbers/number_text.h"
#include "core/shell_word.h"

namespace morula::app {
namespace {

/// The first `columns` characters of a UTF-8 text.
std::string cut(const std::string& text, std::size_t columns) {
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = (static_cast<unsigned char>(text[i]) & 0xC0u) != 0x80u;
    if (begins && ++characters > columns) return text.substr(0, i);
  }
  return text;
}

std::size_t terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

}  // namespace

void RunDisplay::listen_to(scenarios::RunRequest& request) {
  request.on_start = [this](const std::filesystem::path& run) { start(run); };
  request.on_progress = [this](const scenarios::Progress& now) { progress(now); };
  request.on_note = [this](const scenarios::Note& text) { note(text); };
  if (request.until) until_ = " --until " + number_text("%.15g", *request.until) + "s";
}

void RunDisplay::start(const std::filesystem::path& run) { console_.message(first_line_ + " · " + run.string() + "\n"); }

void RunDisplay::clear() {
  if (live_.empty()) return;
  console_.message("\r\033[K");
  live_.clear();
}

void RunDisplay::progress(const scenarios::Progress& now) {
  if (!console_.live()) {
    if (pace_.due(now)) console_.message(scenarios::plain_line(now) + "\n");
    return;
  }
  constexpr auto kBetweenDrawings = std::chrono::milliseconds(100);
  const auto moment = std::chrono::steady_clock::now();
  if (moment - drawn_ < kBetweenDrawings && now.time < now.end) return;
  drawn_ = moment;
  live_ = cut(scenarios::live_line(now), terminal_columns() - 1);
  console_.message("\r" + live_ + "\033[K");
}

void RunDisplay::note(const scenarios::Note& note) {
  const std::string again = live_;
  clear();
  const bool warning = note.kind == scenarios::Note::Kind::kWarning;
  const std::string label = warning ? " warn  " : " note  ";
  const std::string line = padded(scenarios::time_text(note.time), 9) + " " + note.text + "\n";
  console_.message(console_.colour() && warning ? "\033[1;33m" + label + "\033[0m" + line : label + line);
  if (!again.empty()) console_.message(again);
  live_ = again;
}

void RunDisplay::end(const scenarios::RunSummary& summary) {
  clear();
  const scenarios::FinalState& state = summary.final_state;
  const std::string where = scenarios::time_text(state.time) + (state.at_rest ? ", at rest, in " : " in ") +
                            scenarios::duration_text(summary.wall_time) + " · " + count_words(state.cells, "cell", "cells");
  if (summary.stopped) {
    console_.message("stopped at " + where + ", with a checkpoint\n  go on with `morula resume " + shell_word(summary.path.string()) +
                     until_ + "`\n");
  } else {
    std::string line = "done   " + where;
    if (!summary.verdicts.empty()) line += summary.passed ? " · checks passed" : " · checks FAILED";
    if (!summary.report.empty()) line += " · report: " + summary.report.string();
    console_.message(line + "\n");
    for (const scenarios::Verdict& verdict : summary.verdicts)
      if (!verdict.passed)
        console_.warning("check " + verdict.id + " failed: " + verdict.quantity + ": " + scenarios::value_text(verdict) + ", wanted " +
                         verdict.limit);
  }
  if (!summary.timings.empty()) console_.message(summary.timings);
  console_.result(summary.path.string() + "\n");
}

}  // namespace morula::app
