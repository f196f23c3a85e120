#pragma once
#include <filesystem>
#include <utility>

namespace morula::scenarios {

/// Where the files of a run are (UX, section 5), whether the folder is there or not.
class RunFiles {
 public:
  explicit RunFiles(std::filesystem::path folder) : path_(std::move(folder)) {}

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path study() const { return path_ / "study.yaml"; }
  [[nodiscard]] std::filesystem::path resolved_study() const { return path_ / "study.resolved.yaml"; }
  [[nodiscard]] std::filesystem::path results() const { return path_ / "results.h5"; }
  [[nodiscard]] std::filesystem::path checkpoints() const { return path_ / "checkpoints"; }
  [[nodiscard]] std::filesystem::path record() const { return path_ / "run.json"; }
  [[nodiscard]] std::filesystem::path status() const { return path_ / "status.json"; }
  [[nodiscard]] std::filesystem::path verdict() const { return path_ / "verdict.json"; }
  [[nodiscard]] std::filesystem::path series() const { return path_ / "series.csv"; }
  [[nodiscard]] std::filesystem::path events() const { return path_ / "events.jsonl"; }
  [[nodiscard]] std::filesystem::path log() const { return path_ / "log.txt"; }
  [[nodiscard]] std::filesystem::path vtk() const { return path_ / "vtk"; }
  [[nodiscard]] std::filesystem::path plots() const { return path_ / "plots"; }
  [[nodiscard]] std::filesystem::path report() const { return path_ / "report.html"; }
  [[nodiscard]] std::filesystem::path methods() const { return path_ / "methods.md"; }

 private:
  std::filesystem::path path_;
};

}  // namespace morula::scenarios
