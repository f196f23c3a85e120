#pragma once
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "coupling/laws.h"
#include "coupling/model.h"
#include "study/criterion.h"
#include "study/diagnostics.h"
#include "study/mesh_cells.h"

namespace morula::scenarios {

/// Stress-free shape of shells.
enum class CellShape : std::uint8_t { kSphere, kBiconcave };
/// How the meshes of shells lie at time 0.
enum class Orientation : std::uint8_t { kRandom, kAligned };

/// What a fill fills.
enum class FillShape : std::uint8_t { kSphere, kBox };

/// How the places of a fill are found.
enum class FillPattern : std::uint8_t {
  kPacked,  ///< as close as they go, from a regular packing with a seeded jitter
  kRandom,  ///< anywhere where there is room (Poisson disc)
  kLayer,   ///< side by side on a plane, hexagonal
};

/// A plane that cells lie on.
struct LayerPlane {
  Vec3d point{};
  Vec3d normal{0, 0, 1};  ///< of length 1, towards the cells
};

/// How cells are placed at time 0.
struct InitialCells {
  enum class Source { kFill, kPositions, kCsv, kMeshes } source = Source::kFill;

  // fill: `count` cells of `type` or of a mixture in a shape
  std::uint16_t type = 0;  ///< of a mixture: the first
  struct Share {
    std::uint16_t type = 0;
    double part = 1.0;
  };
  std::vector<Share> mixture;  ///< parts of `count`, their sum 1; empty: all of `type`
  FillPattern pattern = FillPattern::kPacked;
  LayerPlane plane;         ///< of a layer
  std::uint64_t count = 0;  ///< of any source
  FillShape fill = FillShape::kSphere;
  Vec3d center{};
  double radius = 0.0;           ///< of a sphere; of the disc that a layer keeps to, 0: none [µm]
  Vec3d size{};                  ///< of a box [µm]
  std::vector<Vec3d> positions;  ///< kPositions, `at: [[x, y, z], ...]` [µm]
  bool random_age = true;        ///< each cell at a random point of its cycle, else at birth

  // csv: x,y,z,type[,radius,phase,model]; read with read_cells_csv (csv.h)
  std::string csv_path;                           ///< absolute
  std::string csv_unit;                           ///< of lengths whose column has none; empty: all have
  double coincident_shift = 6.0;                  ///< coincident cells are moved apart by this distance and named [µm]
  double coincident_below = 1e-3;                 ///< closer than this counts as coincident [µm]
  std::set<std::size_t> csv_spheres, csv_shells;  ///< the types of the rows, by the body that their cells begin with
  std::vector<double> room;  ///< volume of each cell, its part of the hull of all places, by row; empty: as its type or its row says [µm³]
  Vec3d cavity_center{};     ///< of the ball that is no cell's room [µm]
  double cavity_radius = 0.0;  ///< 0: none [µm]

  // meshes: surfaces from files; read with read_mesh_cells (initial/cells_from_meshes.h)
  MeshCells meshes;

  // body of these cells before any region is looked at; empty in the file: as the type says
  bool body_given = false;
  BodyKind body = BodyKind::kSphere;

  // start small and inflate: volume at time 0 as a part of the cell's volume, and the time to reach it
  double start_volume_fraction = 1.0;
  double inflate_time = 0.0;  ///< [s]

  CellShape shape = CellShape::kSphere;
  Orientation orientation = Orientation::kRandom;

  /// Whether cells of this type may be among them.
  [[nodiscard]] bool may_have(std::size_t of_type) const {
    if (source == Source::kCsv) return csv_spheres.contains(of_type) || csv_shells.contains(of_type);
    for (const Share& share : mixture)
      if (share.type == of_type) return true;
    if (source == Source::kMeshes && !meshes.types.empty())
      return std::find(meshes.types.begin(), meshes.types.end(), of_type) != meshes.types.end();
    return mixture.empty() && type == of_type;
  }

  /// Whether cells of this type among them may begin with this body; `usual` is that of the type.
  [[nodiscard]] bool may_begin_as(std::size_t of_type, BodyKind of_body, BodyKind usual) const {
    if (source == Source::kCsv) return (of_body == BodyKind::kShell ? csv_shells : csv_spheres).contains(of_type);
    return may_have(of_type) && (body_given ? body : usual) == of_body;
  }
};

struct TimeSpec {
  double end = 0.0;                ///< [s]
  double output = 3600.0;          ///< series and snapshots [s]
  double checkpoint = 6 * 3600.0;  ///< [s]; a multiple of output is not required: written at the first output time not before it is due
  double capped_start = 0.0;       ///< by when a capped start must have ended [s]
  double rest = 0.0;               ///< speed of all points below which the run ends at an output; 0: never [µm/s]
};

struct OutputSpec {
  std::vector<std::string> series;   ///< names of observables; empty: all
  std::vector<std::string> formats;  ///< hdf5 always; vtk if named
  bool report = true;
};

/// A file the study refers to: a CSV of cells or a surface.
struct InputFile {
  std::string path;  ///< absolute
  std::string copy;  ///< where its copy belongs in the run folder, as resolved_text names it: "inputs/cells.csv"
};

/// Friction of the cells of a type, per area [nN·s/µm³].
struct CellFriction {
  double medium = 0.0, approach = 0.0, along = 0.0;  ///< with the medium; of two cells of the type across and along their contact
};

/// A cell type whose spheres have a law of `morula calibrate`.
struct FittedType {
  std::size_t type = 0;                                ///< number of the cell type
  std::string name;                                    ///< of the type that was fitted
  std::string material;                                ///< what its shells were (cell_material.h)
  double smallest_radius = 0.0, largest_radius = 0.0;  ///< that were fitted [µm]
  std::optional<CellFriction> friction{};              ///< with which its shells came together; none: that was not fitted
};

/// The immutable, validated, unit-converted study; the only way settings enter.
struct Study {
  std::string name;
  std::string title;
  std::string scenario;             ///< library study that it was made from, told in its report; or ""
  std::vector<Criterion> criteria;  ///< what it is judged on
  std::vector<StudyPlot> plots;     ///< beside those of every run
  Model model;
  TimeSpec time;
  std::vector<InitialCells> initial;
  OutputSpec output;
  std::vector<FittedType> fitted;
  std::vector<std::string> type_colors;  ///< in pictures, by cell type, as pictures/palette.h reads them; empty text: of the palette
  std::string source_path;               ///< the file as given
  std::string source_text;               ///< its bytes
  std::string resolved_text;             ///< YAML with every default; beside the copies of its input files it reads to this same study
  std::vector<InputFile> input_files;
  std::shared_ptr<const Laws> laws = builtin_laws();  ///< that it was read with
  Diagnostics warnings;
  std::vector<std::string> notes;  ///< for the log: coincident cells that are moved, CSV columns left aside
};

struct ReadOptions {
  std::shared_ptr<const Laws> laws = builtin_laws();  ///< that the study may name
  std::vector<std::string> overrides{};               ///< `key.path=value`, as if written in the file
  std::vector<std::string> scenario_names{};          ///< library studies that exist; empty: not checked
  std::function<void(const Study&, Diagnostics&)>
      check_criteria{};      ///< whether its criteria and plots can be judged and drawn; null: not checked
  bool strict = false;       ///< warnings are errors
  bool fitted_laws = true;   ///< false: `law: fitted` is read as JKR, whose file is not looked at: it is about to be made
  bool judge_places = true;  ///< find and judge the places of all cells; false: the study has been checked before
};

/// Read, check and convert a study file. On failure all errors (and warnings), sorted by place.
Result<Study, Diagnostics> read_study(const std::filesystem::path& path, const ReadOptions& options = {});

/// As read_study, from text; `folder` is where its relative paths start.
Result<Study, Diagnostics> read_study_text(const std::string& shown_name, const std::string& text, const std::filesystem::path& folder,
                                           const ReadOptions& options = {});

}  // namespace morula::scenarios
