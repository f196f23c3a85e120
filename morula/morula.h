#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"

namespace morula {
struct Laws;
}  // namespace morula

/// The public interface of Morula: read a study, make a simulation of it, step it, look at cells and meshes, write snapshots.
///
/// Lengths are in µm, forces in nN, times in s, amounts in amol; hence pressures in kPa. What can fail returns a Result: a value, or an Error with a
/// message and what would help; nothing throws. One process: `morula run` is what runs on several ranks. An object is used by one thread at a time;
/// the threads of a simulation are its own. See docs/embedding.md and examples/embed.
namespace morula::api {

/// Until 1.0 what is declared here may change from one minor version to the next.
struct Version {
  int major = 0, minor = 0, patch = 0;
  friend bool operator==(const Version&, const Version&) = default;
};
/// Of this header.
inline constexpr Version kHeaderVersion{0, 1, 0};
/// Of the library that the program is linked with.
[[nodiscard]] Version version();
/// The licence of a program that is linked with this library, for people.
[[nodiscard]] std::string licence();

/// A study that has been read and checked. Copies share what was read.
class Study {
 public:
  /// Read a study file. `overrides` are `key.path=value`, as on the command line. The error's message holds all that is wrong, one by one.
  /// `laws`: those that the study may name, from builtin_laws() of coupling/laws.h and of the program's own; null: those of Morula.
  static Result<Study> read(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                            std::shared_ptr<const Laws> laws = nullptr);
  /// The same from a text; `folder` is where its relative paths start.
  static Result<Study> from_text(const std::string& text, const std::filesystem::path& folder = ".",
                                 const std::vector<std::string>& overrides = {}, std::shared_ptr<const Laws> laws = nullptr);

  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] double end() const;              ///< of the run [s]
  [[nodiscard]] double output_interval() const;  ///< on whose multiples steps land [s]
  [[nodiscard]] std::span<const std::string> type_names() const;
  /// The study with every default, as text; it reads to this same study.
  [[nodiscard]] const std::string& resolved_text() const;
  /// What the check warned of; empty: nothing.
  [[nodiscard]] std::string warnings() const;

 private:
  friend class Simulation;
  struct Content;
  std::shared_ptr<const Content> content_;
};

using Point = std::array<double, 3>;            ///< [µm]
using Triangle = std::array<std::uint32_t, 3>;  ///< numbers of nodes, counter-clockwise seen from outside

enum class Body : std::uint8_t { kSphere, kShell };

/// One cell at one moment.
struct Cell {
  std::uint64_t id = 0, parent = 0;  ///< never used again; parent 0: a founder
  std::uint32_t type = 0;            ///< number in Study::type_names()
  Body body = Body::kSphere;
  Point centre{};               ///< centroid of its volume [µm]
  double radius = 0.0;          ///< of a sphere; of the ball of a shell's volume [µm]
  double volume = 0.0;          ///< [µm³]
  double area = 0.0;            ///< of its surface [µm²]
  double contact_area = 0.0;    ///< of it in contact [µm²]
  double pressure = 0.0;        ///< what others press on it with: −tr σ/3 [kPa]
  double inner_pressure = 0.0;  ///< −K_V ln(V/V0) of a shell; of a sphere its pressure [kPa]
  double age = 0.0;             ///< since its birth [s]
};

/// The surface of a shell at one moment.
struct Surface {
  std::uint64_t cell = 0;  ///< id
  std::span<const Point> nodes;
  std::span<const Triangle> faces;
};

/// What one step did.
struct Step {
  double length = 0.0;  ///< [s]
  int retries = 0;      ///< steps that were refused and tried again, smaller
  int newton = 0;       ///< iterations
  double energy = 0.0;  ///< at its end [fJ]
};

/// A tissue that is stepped through time. The steps are those of `morula run`: the same study ends in the same bits.
class Simulation {
 public:
  /// The tissue at time 0, on this number of threads, 1 to 1024. Errors: another number, cells that cannot be placed.
  static Result<Simulation> create(const Study& study, int threads = 1);
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  [[nodiscard]] double time() const;  ///< [s]
  [[nodiscard]] bool done() const;    ///< the study's end is reached

  /// One step. It lands on outputs and on the end of the study. Errors (kPhysics): no step size works; the tissue is that before the step. Where the
  /// end is reached already nothing is done, and the length is 0.
  Result<Step> step();
  /// Steps until this time, or the end of the study [s]. Lands on it exactly when it is a multiple of the output interval; else the last step may go
  /// beyond it.
  Status advance_to(double time);

  /// All cells, by increasing id; good until the simulation is stepped, moved or destroyed.
  [[nodiscard]] std::span<const Cell> cells() const;
  /// The surfaces of all shells, by increasing id; good as long as cells() are.
  [[nodiscard]] std::span<const Surface> surfaces() const;
  /// A hash of the whole state: equal for equal bits.
  [[nodiscard]] std::string state_hash() const;

  /// Add this moment to an HDF5 file as `morula run` writes it (docs/formats.md); the file is made where there is none. Snapshots at this time or later
  /// that the file has are replaced. Errors: a file of another study (its resolved text differs).
  Status write_snapshot(const std::filesystem::path& file) const;

 private:
  struct Content;
  explicit Simulation(std::unique_ptr<Content> content);
  std::unique_ptr<Content> content_;
};

}  // namespace morula::api
