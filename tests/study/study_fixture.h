#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "study/study.h"

namespace morula::scenarios::test {

/// A study that uses every section, and is right. Tests break one thing at a time.
inline const char* const kGoodStudy = R"(schema: 1
study: spheroid_core
title: Spheroid of centre-based cells with a deformable core
seed: 20261121
time: {end: 96 h, step: auto, output: 1 h, checkpoint: 6 h}
domain: {size: [400 um, 400 um, 400 um], boundary: open}
cell_types:
  hepatocyte:
    radius: {mean: 6 um, spread: 10 %}
    cycle: {model: volume_threshold, duration: {mean: 18 h, spread: 10 %}, axis: random}
    inhibit_growth: {pressure_above: 800 Pa}
    death: {oxygen_below: 0.02 mM, rate: 0.05 1/h}
    migration: {speed: 2 um/h, persistence: 30 min}
    friction: {cell_cell: 5e10 N s/m^3, medium: 1e8 N s/m^3}
    adhesion: {hepatocyte: 1e-4 J/m^2, capsule: 1e-6 J/m^2}
    cbm: {law: jkr, young: 450 Pa, poisson: 0.4}
    dcm:
      nodes: 162
      cortex: {young: 1 kPa, thickness: 200 nm, poisson: 0.5, tension: 0.2 mN/m}
      bulk_modulus: 2.5 kPa
geometry:
  capsule: {sphere: {radius: 150 um}, side: inside, motion: fixed}
initial:
  - {type: hepatocyte, count: 60, fill: sphere, radius: 40 um, as: cbm}
fields:
  oxygen: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, boundary: {all: 0.2 mM}, uptake: {hepatocyte: 40 amol/s}}
coupling:
  max_shells: 120
  regions:
    - {name: core, shape: sphere, center: [0 um, 0 um, 0 um], radius: 25 um, as: dcm, margin: 3 um}
  triggers:
    - {promote: pressure > 1 kPa, demote: pressure < 600 Pa, hold: 30 min}
output:
  series: [cell_count, volume_error]
  formats: [hdf5, vtk]
limits: {volume_error: 2 %, overlap: 0.3 um, field_balance: 1e-6}
)";

/// The good study with the first `from` replaced by `to`.
inline std::string changed(const std::string& from, const std::string& to, std::string text = kGoodStudy) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "the good study does not hold: " << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline Result<Study, Diagnostics> read(const std::string& text, const ReadOptions& options = {},
                                       const std::filesystem::path& folder = ".") {
  return read_study_text("study.yaml", text, folder, options);
}

/// The messages of a study that must fail; "" (and a test failure) when it does not.
inline std::string errors_of(const std::string& text, const ReadOptions& options = {}, const std::filesystem::path& folder = ".") {
  const auto study = read(text, options, folder);
  if (study.ok()) {
    ADD_FAILURE() << "the study was accepted";
    return "";
  }
  return study.error().text();
}

/// The warnings of a study that must be accepted.
inline std::string warnings_of(const std::string& text, const ReadOptions& options = {}) {
  const auto study = read(text, options);
  if (!study.ok()) {
    ADD_FAILURE() << study.error().text();
    return "";
  }
  return study->warnings.text();
}

/// What a study that must be accepted tells beside its warnings, a line each.
inline std::string notes_of(const std::string& text) {
  const auto study = read(text);
  if (!study.ok()) {
    ADD_FAILURE() << study.error().text();
    return "";
  }
  std::string out;
  for (const std::string& note : study->notes) out += note + "\n";
  return out;
}

/// A folder of its own for a test, removed at its end.
class Folder {
 public:
  Folder() {
    const auto& unit = *testing::UnitTest::GetInstance();
    const auto* info = unit.current_test_info();  // none while a whole suite is set up
    path_ = std::filesystem::temp_directory_path() / (std::string("morula_") + unit.current_test_suite()->name() + "_" +
                                                      (info != nullptr ? info->name() : "suite") + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace morula::scenarios::test
