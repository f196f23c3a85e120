#pragma once
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace morula::test {

/// Whether the program can remesh cells: a build with MORULA_WITH_GPL=OFF cannot.
inline constexpr bool kCanRemesh = MORULA_CAN_REMESH;

/// A folder of this test alone, removed at its end.
class TestFolder {
 public:
  TestFolder();
  ~TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// Writes a file below the folder and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

[[nodiscard]] std::string read_text(const std::filesystem::path& path);

/// How a command ended and what it said.
struct Outcome {
  int exit_code = -1;      ///< 128 + number of the signal that ended it
  bool timed_out = false;  ///< it was killed by the test
  std::string out, err;
  [[nodiscard]] std::string all() const { return "exit " + std::to_string(exit_code) + "\n--- stdout\n" + out + "--- stderr\n" + err; }
};

struct CommandOptions {
  int ranks = 0;  ///< 0: without mpirun
  std::vector<std::pair<std::string, std::string>> environment{};
  std::chrono::milliseconds timeout{60'000};
  std::string shell_before{};  ///< as `ulimit -f 20;`, run by bash before the program
};

/// The program, running in the background.
class RunningCommand {
 public:
  RunningCommand(std::vector<std::string> arguments, const std::filesystem::path& working_folder, const CommandOptions& options = {});
  ~RunningCommand();
  RunningCommand(const RunningCommand&) = delete;
  RunningCommand& operator=(const RunningCommand&) = delete;

  void send(int signal) const;
  [[nodiscard]] Outcome wait();
  /// Whether a file appears (and holds `text`) while the command runs, within the timeout.
  [[nodiscard]] bool wait_for(const std::filesystem::path& file, const std::string& text = "") const;

 private:
  [[nodiscard]] bool ended() const;
  TestFolder streams_;
  std::chrono::steady_clock::time_point deadline_;
  pid_t process_ = -1;
  mutable int status_ = -1;
  mutable bool reaped_ = false;
};

/// Runs the program to its end in a folder.
Outcome run_morula(const std::vector<std::string>& arguments, const std::filesystem::path& working_folder,
                   const CommandOptions& options = {});

}  // namespace morula::test
