#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/cell_id.h"
#include "core/mesh/mark_sets.h"
#include "core/mesh/topology.h"
#include "core/space/space.h"
#include "core/vec3.h"
#include "coupling/cells.h"

namespace morula::scenarios {

/// Names of the kinds of bodies and phases, by their numbers: in results.h5, CSV and on screen.
inline constexpr std::array<const char*, 2> kBodyNames{"sphere", "shell"};
inline constexpr std::array<const char*, 4> kPhaseNames{"growing", "waiting", "resting", "dying"};

/// One moment of a run as it is kept in results.h5, on one process: what pictures, exports and plots read.
struct Snapshot {
  struct Cell {
    CellId id, parent;
    std::uint16_t type = 0;
    BodyKind body = BodyKind::kSphere;
    Phase phase = Phase::kGrowing;
    Vec3d centroid;                           ///< [µm]
    double volume = 0.0;                      ///< [µm³]
    double area = 0.0;                        ///< surface [µm²]
    double pressure = 0.0;                    ///< −tr σ/3 [kPa]
    double inner_pressure = 0.0;              ///< of shells; of spheres their pressure [kPa]
    double stress_xx = 0.0, stress_xy = 0.0;  ///< σ: what neighbours, obstacles and loads put on the cell [kPa]
    double stress_xz = 0.0, stress_yy = 0.0, stress_yz = 0.0, stress_zz = 0.0;
    double contact_area = 0.0;  ///< [µm²]
    double age = 0.0;           ///< [s]
    double radius = 0.0;        ///< of a sphere; volume-equivalent radius of a shell [µm]
  };
  /// A number by cell that the model brings with it (CellVariable).
  struct Variable {
    std::string name, unit;
    std::vector<double> values;  ///< by cell
  };
  /// A shell: nodes first_node .. first_node+node_count−1, faces of topologies[topology].
  struct Shell {
    std::uint32_t cell = 0;
    std::uint32_t first_node = 0, node_count = 0;
    std::uint32_t topology = 0;
  };
  /// The rigid nucleus of a shell.
  struct Nucleus {
    std::uint32_t cell = 0;
    Vec3d center;         ///< [µm]
    double radius = 0.0;  ///< [µm]
  };
  /// A nucleus that is a shell: nodes of `nuclear_nodes`, faces of topologies[topology].
  using NuclearShell = Shell;
  /// A rigid obstacle or a wall of the domain.
  struct Obstacle {
    std::string name;
    Vec3d offset;                 ///< how far it has moved since time 0 [µm]
    std::vector<Vec3d> position;  ///< at time 0; of a snapshot of a run, empty until it is read from the file [µm]
    std::vector<Triangle> faces;
  };
  /// A cavity with fluid that exists at this moment.
  struct Lumen {
    std::string name;
    Vec3d center;           ///< where its fluid is looked at from [µm]
    double volume = 0.0;    ///< [µm³]
    double pressure = 0.0;  ///< [kPa]
  };
  struct Grid {
    std::string name;
    Vec3d low, spacing;  ///< [µm]
    std::array<std::int32_t, 3> voxels{};
    std::vector<double> concentration;  ///< x fastest [mM]
  };

  double time = 0.0;        ///< [s]
  Box box;                  ///< the domain at this time; empty in results that do not tell it [µm]
  std::vector<Cell> cells;  ///< sorted by id
  std::vector<Variable> variables;
  std::vector<Shell> shells;    ///< in the order of their cells
  std::vector<Nucleus> nuclei;  ///< the rigid ones, in the order of their cells
  std::vector<Vec3d> nodes;
  std::vector<NuclearShell> nuclear_shells;  ///< in the order of their cells
  std::vector<Vec3d> nuclear_nodes;
  std::vector<std::vector<Triangle>> topologies;
  std::vector<std::string> mark_names;
  std::vector<std::uint8_t> face_marks;  ///< sets of marks of the faces, in the order of the shells; empty when the study has no marks
  std::vector<Obstacle> obstacles;       ///< the same on every rank
  std::vector<Lumen> lumens;             ///< the same on every rank
  std::vector<Grid> fields;
  std::vector<std::string> type_names;

  /// Bytes of a face in face_marks.
  [[nodiscard]] std::size_t mark_width() const { return mark_bytes(mark_names.size()); }
  [[nodiscard]] MarkSets marks() const { return {face_marks, face_marks.size() / mark_width()}; }
};

}  // namespace morula::scenarios
