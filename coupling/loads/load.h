#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/mark_sets.h"
#include "core/mesh/topology.h"
#include "core/numbers/time_course.h"
#include "core/own_keys.h"
#include "core/vec3.h"
#include "coupling/own_values.h"

namespace morula {

struct CellLoad;
struct Model;
struct ReferenceShape;

/// The shell that a load acts on.
struct LoadedShell {
  const ReferenceShape& shape;
  std::span<const Vec3d> position;  ///< of its nodes [µm]
  MarkSets marks;                   ///< of its faces; empty: none
  double strength = 1.0;            ///< the load's course at this time
};

/// A spring from a point x, or the centre of volume x of a shell, to a place: energy ½ k |x − X|². The step holds it implicitly, so that it may be stiff.
struct Anchor {
  std::uint32_t node =
      0;  ///< the point, or the shell's first; by shell node of the rank, after them its spheres; of Load::hold, by node of the shell
  double stiffness = 0.0;  ///< k [nN/µm]
  Vec3d target{};          ///< X [µm]
  int shell = -1;          ///< number on the rank of the shell that is held as a whole; −1: a point is

  bool operator==(const Anchor&) const = default;
};

/// What pulls or pushes cells from outside: what there is to say about it, its section of a load in the study, and its force. Exactly one of push,
/// push_cell, hold and hold_center is there.
struct Load {
  LawInfo info;     ///< its parameters have the names of keys; info.name is that of its section
  KeySpec section;  ///< of a load
  std::vector<OwnKey> keys{};
  bool bare = false;  ///< its one key, which has the name of the section, stands in the load itself
  /// Fills in what the load's functions read of a CellLoad; null: they read CellLoad::values.
  void (*build)(const OwnValues& values, CellLoad& load) = nullptr;
  /// What is wrong with the values; null: nothing can be.
  std::vector<LawProblem> (*judge)(const CellLoad& load, const Model& model) = nullptr;
  /// It acts on nodes that it finds on the undeformed cell: cells keep these nodes, and lie as placed.
  bool (*of_chosen_nodes)(const CellLoad& load) = nullptr;

  /// Adds the force on the nodes of a shell at present positions [nN]; a step holds it as a dead load, unless it follows the surface.
  void (*push)(const CellLoad& load, const LoadedShell& shell, std::span<Vec3d> force) = nullptr;
  /// Whether this one follows the surface: a step finds it where it ends, by its energy. Null: never.
  bool (*follows)(const CellLoad& load) = nullptr;
  /// Of a load that follows: the energy whose negative gradient push() is [fJ].
  double (*energy)(const CellLoad& load, const LoadedShell& shell) = nullptr;
  /// The force on a whole cell of either body [nN].
  Vec3d (*push_cell)(const CellLoad& load, double strength) = nullptr;
  /// Springs on the nodes of a shell of this target volume [µm³] at a time [s].
  std::vector<Anchor> (*hold)(const CellLoad& load, const ReferenceShape& shape, double target_volume, double time) = nullptr;
  /// The spring on the centre of a cell of either body at a time [s]; its points are not filled in.
  Anchor (*hold_center)(const CellLoad& load, double time) = nullptr;

  /// It acts through springs to places of the laboratory.
  [[nodiscard]] bool holds() const { return hold != nullptr || hold_center != nullptr; }
  /// It asks nothing of the surface of a cell: spheres bear it, too.
  [[nodiscard]] bool of_whole_cells() const { return push_cell != nullptr || hold_center != nullptr; }
};

/// The loads that Morula brings, each in a file of this folder.
std::vector<std::shared_ptr<const Load>> builtin_loads();
std::shared_ptr<const Load> traction_load();
std::shared_ptr<const Load> pull_load();
std::shared_ptr<const Load> patch_load();
std::shared_ptr<const Load> pressure_load();
std::shared_ptr<const Load> grip_load();
std::shared_ptr<const Load> trap_load();
std::shared_ptr<const Load> body_force_load();

enum class LoadEnd : std::uint8_t { kBoth, kHigh, kLow };

/// An external load on all cells of a type.
struct CellLoad {
  std::string name;
  std::uint16_t type = 0;
  std::shared_ptr<const Load> what = body_force_load();
  Vec3d axis{1, 0, 0};           ///< of length 1
  double size = 0.0;             ///< peak stress or pressure [kPa]; force at an end [nN]; stiffness of a grip at an end [nN/µm]
  Vec3d force{};                 ///< of a body force or a patch [nN]
  double part = 1.0;             ///< of the nodes, at an end
  int mark = -1;                 ///< of the faces that bear the load; −1: by place
  LoadEnd end = LoadEnd::kBoth;  ///< which ends
  TimeCourse course;             ///< factor over time; empty: 1
  bool within = false;           ///< a pressure: only faces whose middle lies in the cylinder from low_end to high_end
  Vec3d low_end{}, high_end{};   ///< [µm]
  double radius = 0.0;           ///< [µm]
  Vec3d gradient{};              ///< of a pressure in space; `size` at `origin` [kPa/µm]
  Vec3d origin{};                ///< [µm]
  Vec3d center{};                ///< of the undeformed cell whose end nodes a grip holds, before it moves [µm]
  Vec3d direction{0, 0, 1};      ///< of `way`, of length 1
  TimeCourse way;                ///< how far a grip has moved; empty: it stays [µm]
  OwnValues values{};            ///< of the load's own keys
};

}  // namespace morula
