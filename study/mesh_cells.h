#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/vec3.h"

namespace morula::scenarios {

/// Cells of time 0 that come with surfaces of their own, from files.
struct MeshCells {
  /// What tells one cell of a file from the next.
  enum class CellIs : std::uint8_t {
    kAuto,       ///< parts where the file has several closed ones, else components
    kPart,       ///< a polyhedron of VTK, a solid of STL, an object or group of OBJ
    kComponent,  ///< faces that hang together
    kFile,       ///< the whole file
    kArray,      ///< equal numbers in `id_array`
  };

  std::vector<std::string> path;   ///< absolute
  std::vector<std::string> shown;  ///< as the study names them
  double scale = 1.0;              ///< coordinates in the files × scale = µm
  CellIs cell_is = CellIs::kAuto;
  std::string id_array;
  std::vector<std::uint16_t> types;  ///< of each cell, or of the values 0, 1, … of type_array; empty: all as the entry says
  std::string type_array;            ///< empty: none
  std::string pressure_array;        ///< empty: none, a cell starts with the pressure of a free one
  double pressure_unit = 0.0;        ///< numbers of that array × this = kPa
  std::uint32_t nodes = 0;           ///< remesh to about so many nodes; 0: not
  double edge = 0.0;                 ///< remesh to edges of about this length [µm]; 0: not
  bool repair = true;
  double overlap = 0.3;     ///< deeper than this cells may not reach into each other at the start [µm]
  bool has_center = false;  ///< move all cells together
  Vec3d center{};           ///< so that the centroid of their volume is here [µm]

  [[nodiscard]] bool remeshes() const { return nodes > 0 || edge > 0.0; }
};

}  // namespace morula::scenarios
