#include "app/console.h"

#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace morula::app {
namespace {

bool terminal_with_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) && !(no_colour && *no_colour) && !(terminal && std::string_view(terminal) == "dumb");
}

/// The other end of a pipe is closed, or the terminal is gone: what is printed reaches nobody, and is dropped.
bool nobody_reads(int descriptor) {
  pollfd asked{descriptor, POLLOUT, 0};
  return poll(&asked, 1, 0) > 0 && (asked.revents & (POLLERR | POLLHUP)) != 0;
}

void write(std::FILE* stream, std::string_view text) { std::fwrite(text.data(), 1, text.size(), stream); }

}  // namespace

Console::Console(bool heard) : heard_(heard), colour_(heard && terminal_with_colour()), live_(heard && isatty(STDERR_FILENO)) {}

void Console::result(std::string_view text) const {
  if (heard_) write(stdout, text);
}

void Console::message(std::string_view text) const {
  if (!heard_) return;
  std::fflush(stdout);
  write(stderr, text);
  std::fflush(stderr);
}

void Console::labelled(std::string_view label, std::string_view ansi, std::string_view text) const {
  std::string line;
  if (colour_) line += "\033[" + std::string(ansi) + "m";
  line += label;
  if (colour_) line += "\033[0m";
  line += " " + std::string(text) + "\n";
  message(line);
}

void Console::error(const Error& error) const {
  if (error.message.empty()) return;
  labelled("error:", "1;31", error.message);
  if (!error.help.empty()) labelled("  = help:", "1;36", error.help);
}

void Console::warning(std::string_view text) const { labelled("warning:", "1;33", text); }

void Console::note(std::string_view text) const { labelled("note:", "1;36", text); }

bool Console::finish() const {
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  return written || nobody_reads(STDOUT_FILENO);
}

}  // namespace morula::app
