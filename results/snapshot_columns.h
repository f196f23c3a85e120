#pragma once
#include "results/hdf5_plan.h"
#include "results/snapshot.h"

namespace morula::scenarios {

/// Format of results.h5, its root attribute `schema`. 1 (without the attribute): bare numbers; 2: datasets that describe themselves.
inline constexpr std::uint64_t kResultsSchema = 2;

/// The members of a snapshot's cell, once: file, CSV and VTK walk this list, and the variables after it. `visit(name, units, description, member)`.
template <class Visit>
void for_each_snapshot_column(Visit&& visit) {
  using Cell = Snapshot::Cell;
  visit("id", "1", "name of the cell as in events.jsonl and CSV: founder, then which daughter in each generation (17.01)", &Cell::id);
  visit("parent", "1", "name of the cell's mother; 0 for a founder", &Cell::parent);
  visit("type", "1", "cell type", &Cell::type);
  visit("body", "1", "body of the cell", &Cell::body);
  visit("phase", "1", "phase of the cell's life", &Cell::phase);
  visit("centroid", "um", "centre of the cell's volume: x, y, z", &Cell::centroid);
  visit("volume", "um^3", "volume of the body", &Cell::volume);
  visit("area", "um^2", "surface of the body", &Cell::area);
  visit("pressure", "kPa", "contact pressure p = -tr(stress)/3: what neighbours, obstacles and loads put on the cell", &Cell::pressure);
  visit("inner_pressure", "kPa", "pressure inside a shell, from its volume or its water; of a sphere its pressure", &Cell::inner_pressure);
  visit("stress_xx", "kPa", "contact stress of the cell, tension positive: xx", &Cell::stress_xx);
  visit("stress_xy", "kPa", "contact stress: xy", &Cell::stress_xy);
  visit("stress_xz", "kPa", "contact stress: xz", &Cell::stress_xz);
  visit("stress_yy", "kPa", "contact stress: yy", &Cell::stress_yy);
  visit("stress_yz", "kPa", "contact stress: yz", &Cell::stress_yz);
  visit("stress_zz", "kPa", "contact stress: zz", &Cell::stress_zz);
  visit("contact_area", "um^2", "area that touches cells and obstacles", &Cell::contact_area);
  visit("age", "s", "time since the cell's birth", &Cell::age);
  visit("radius", "um", "radius of a sphere; of a shell that of the ball with its volume", &Cell::radius);
}
static_assert(sizeof(Snapshot::Cell) == 2 * 8 + 8 + sizeof(Vec3d) + 13 * 8, "list every member of Snapshot::Cell");

/// What a table calls a variable: `concentration/oxygen` is oxygen, `amount/oxygen` is `amount of oxygen`.
inline std::string title_of(const Snapshot::Variable& variable) {
  const std::size_t slash = variable.name.find('/');
  if (slash == std::string::npos) return variable.name;
  const std::string kind = variable.name.substr(0, slash), of = variable.name.substr(slash + 1);
  return kind == "concentration" ? of : kind + " of " + of;
}

/// Any other dataset of results.h5, once: its path below the snapshot (or below the root), and what it says of itself.
struct ResultsDataset {
  const char* path;
  const char* units;
  const char* description;

  [[nodiscard]] DatasetLabel label() const { return {units, description}; }
};

namespace results {
// of the run
inline constexpr ResultsDataset kSourceStudy{"study/source", "", "the study file as it was given"};
inline constexpr ResultsDataset kResolvedStudy{"study/resolved", "", "the study with every default; reads to the same study"};
inline constexpr ResultsDataset kObstaclePosition{"position", "um", "nodes of the obstacle at time 0: x, y, z"};
inline constexpr ResultsDataset kObstacleFaces{"faces", "1", "three nodes of each face of the obstacle, counter-clockwise from outside"};
inline constexpr ResultsDataset kEventTime{"events/time", "s", "when it happened"};
inline constexpr ResultsDataset kEventKind{"events/kind", "1", "what happened"};
inline constexpr ResultsDataset kEventCell{"events/cell", "1", "the cell, named as in cells/id; empty for the run itself"};
inline constexpr ResultsDataset kEventDaughters{"events/daughters", "1",
                                                "the two cells of a division, named as in cells/id, with a space between; else empty"};
inline constexpr ResultsDataset kEventText{"events/text", "1", "the reason, for people"};
// of a snapshot
inline constexpr ResultsDataset kTime{"time", "s", "simulated time of this snapshot"};
inline constexpr ResultsDataset kBoxLow{"box/low", "um", "lower corner of the domain at this time: x, y, z"};
inline constexpr ResultsDataset kBoxHigh{"box/high", "um", "upper corner of the domain at this time: x, y, z"};
inline constexpr ResultsDataset kTypeNames{"type_names", "1", "names of the cell types by number"};
inline constexpr ResultsDataset kFieldNames{"field_names", "1", "names of the fields"};
inline constexpr ResultsDataset kVariableNames{"variable_names", "1",
                                               "numbers by cell that the study brings with it: their datasets below cells/"};
inline constexpr ResultsDataset kVariableUnits{"variable_units", "1", "units of the numbers in variable_names"};
inline constexpr ResultsDataset kMarkNames{"mark_names", "1", "names of the marks of faces, by bit"};
inline constexpr ResultsDataset kFaceCount{"topologies/face_count", "1", "faces of each list below"};
inline constexpr ResultsDataset kFaces{"topologies/faces", "1",
                                       "lists of faces one after the other: three nodes each, counted within the shell"};
inline constexpr ResultsDataset kSurfaceCell{"cell", "1", "row of the cell in cells/"};
inline constexpr ResultsDataset kFirstNode{"first_node", "1", "its first row in node"};
inline constexpr ResultsDataset kNodeCount{"node_count", "1", "number of its rows in node"};
inline constexpr ResultsDataset kTopology{"topology", "1", "number of its list of faces in topologies/"};
inline constexpr ResultsDataset kNode{"node", "um", "nodes of all surfaces one after the other: x, y, z"};
inline constexpr ResultsDataset kFaceMarks{"shells/face_marks", "1",
                                           "marks of each face as bits, faces of the shells one after the other; beyond eight marks a face "
                                           "has several bytes, that of the first eight first"};
inline constexpr ResultsDataset kNucleusCell{"nuclei/cell", "1", "row of the nucleus' cell in cells/"};
inline constexpr ResultsDataset kNucleusCenter{"nuclei/center", "um", "centre of the rigid nucleus: x, y, z"};
inline constexpr ResultsDataset kNucleusRadius{"nuclei/radius", "um", "radius of the rigid nucleus"};
inline constexpr ResultsDataset kObstacleName{"obstacles/name", "1", "obstacle, a group of obstacles/ at the root of the file"};
inline constexpr ResultsDataset kObstacleOffset{"obstacles/offset", "um", "how far it has moved since time 0: x, y, z"};
inline constexpr ResultsDataset kLumenName{"lumens/name", "1", "cavity with fluid"};
inline constexpr ResultsDataset kLumenCenter{"lumens/center", "um", "where the cavity is looked at from: x, y, z"};
inline constexpr ResultsDataset kLumenVolume{"lumens/volume", "um^3", "volume of the cavity"};
inline constexpr ResultsDataset kLumenPressure{"lumens/pressure", "kPa", "pressure of its fluid"};
// of a field of a snapshot
inline constexpr ResultsDataset kFieldLow{"low", "um", "lower corner of the grid: x, y, z"};
inline constexpr ResultsDataset kFieldSpacing{"spacing", "um", "edges of a voxel along x, y, z"};
inline constexpr ResultsDataset kFieldVoxels{"voxels", "1", "number of voxels along x, y, z"};
inline constexpr ResultsDataset kFieldConcentration{"concentration", "mM", "mean concentration in each voxel, x fastest, then y, then z"};
}  // namespace results

}  // namespace morula::scenarios
