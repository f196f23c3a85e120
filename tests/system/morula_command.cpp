#include "tests/system/morula_command.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace morula::test {
namespace fs = std::filesystem;

TestFolder::TestFolder() {
  std::string pattern = (fs::temp_directory_path() / "morula-test-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no folder for the test: " + pattern);
  path_ = pattern;
}

TestFolder::~TestFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path TestFolder::write(const std::string& name, const std::string& text) const {
  fs::create_directories((path_ / name).parent_path());
  std::ofstream(path_ / name, std::ios::binary) << text;
  return path_ / name;
}

std::string read_text(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

namespace {

std::vector<std::string> whole_command(std::vector<std::string> arguments, const CommandOptions& options) {
  std::vector<std::string> command;
  if (!options.shell_before.empty()) command = {"bash", "-c", options.shell_before + " exec \"$@\"", "bash"};
  if (options.ranks > 0) command.insert(command.end(), {MPIEXEC_PROGRAM, "--oversubscribe", "-n", std::to_string(options.ranks)});
  command.push_back(MORULA_PROGRAM);
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

[[noreturn]] void become(const std::vector<std::string>& command, const fs::path& folder, const fs::path& streams,
                         const CommandOptions& options) {
  setpgid(0, 0);  // so that a test that gives up ends mpirun and its ranks together
  const int out = open((streams / "out").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600),
            err = open((streams / "err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int in = open("/dev/null", O_RDONLY);
  if (out < 0 || err < 0 || in < 0 || dup2(in, 0) < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0 || chdir(folder.c_str()) != 0) _exit(126);
  setenv("OMP_NUM_THREADS", "1", 0);
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execvp(words[0], words.data());
  _exit(127);
}

}  // namespace

RunningCommand::RunningCommand(std::vector<std::string> arguments, const fs::path& working_folder, const CommandOptions& options)
    : deadline_(std::chrono::steady_clock::now() + options.timeout) {
  const std::vector<std::string> command = whole_command(std::move(arguments), options);
  process_ = fork();
  if (process_ == 0) become(command, working_folder, streams_.path(), options);
  if (process_ < 0) throw std::runtime_error("fork failed");
}

RunningCommand::~RunningCommand() {
  if (ended()) return;
  kill(-process_, SIGKILL);
  waitpid(process_, &status_, 0);
}

void RunningCommand::send(int signal) const {
  if (!ended()) kill(process_, signal);
}

bool RunningCommand::ended() const {
  if (!reaped_) reaped_ = waitpid(process_, &status_, WNOHANG) == process_;
  return reaped_;
}

Outcome RunningCommand::wait() {
  Outcome outcome;
  while (!ended()) {
    if (std::chrono::steady_clock::now() > deadline_) {
      outcome.timed_out = true;
      kill(-process_, SIGKILL);
      waitpid(process_, &status_, 0);
      reaped_ = true;
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  outcome.exit_code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
  outcome.out = read_text(streams_ / "out");
  outcome.err = read_text(streams_ / "err");
  return outcome;
}

bool RunningCommand::wait_for(const fs::path& file, const std::string& text) const {
  while (std::chrono::steady_clock::now() < deadline_) {
    std::error_code ignored;
    if (fs::exists(file, ignored) && (text.empty() || read_text(file).find(text) != std::string::npos)) return true;
    if (ended()) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

Outcome run_morula(const std::vector<std::string>& arguments, const fs::path& working_folder, const CommandOptions& options) {
  return RunningCommand(arguments, working_folder, options).wait();
}

}  // namespace morula::test
