#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/model.h"

namespace morula::scenarios {

/// How cells are placed at time 0.
struct InitialCells {
  enum class Source { kFill, kCsv, kLattice } source = Source::kFill;

  // fill: `count` cells of `type` in a shape, relaxed from a regular packing with a seeded jitter
  std::uint16_t type = 0;
  std::uint64_t count = 0;
  RegionShape fill = RegionShape::kSphere;  ///< kSphere or kBox
  Vec3d center{};
  double radius = 0.0;  ///< of a sphere [µm]
  Vec3d size{};         ///< of a box [µm]
  bool explicit_positions = false;
  std::vector<Vec3d> positions;  ///< given in the study, `at: [[x, y, z], ...]` [µm]
  bool random_age = true;        ///< each cell at a random point of its cycle, else at birth

  // csv: x,y,z,type[,radius,phase,model]
  std::string csv_path;
  double coincident_shift = 6.0;   ///< coincident cells are moved apart by this distance and named [µm]
  double coincident_below = 1e-3;  ///< closer than this counts as coincident [µm]

  // body of these cells before any region is looked at; empty in the file: as the type says
  bool body_given = false;
  BodyKind body = BodyKind::kSphere;

  // start small and inflate: volume at time 0 as a part of the cell's volume, and the time to reach it
  double start_volume_fraction = 1.0;
  double inflate_time = 0.0;  ///< [s]
};

struct TimeSpec {
  double end = 0.0;                ///< [s]
  double output = 3600.0;          ///< series and snapshots [s]
  double checkpoint = 6 * 3600.0;  ///< [s]; a multiple of output is not required: written at the first output time not before it is due
};

struct OutputSpec {
  std::vector<std::string> series;   ///< names of observables; empty: all
  std::vector<std::string> formats;  ///< hdf5 always; vtk if named
  bool report = true;
};

/// The immutable, validated, unit-converted study; the only way settings enter.
struct Study {
  std::string name;
  std::string title;
  std::string scenario;  ///< library study it was made from, or "" (gives the criteria that go to verdict.json)
  Model model;
  TimeSpec time;
  std::vector<InitialCells> initial;
  OutputSpec output;
  std::string source_path;               ///< the file as given
  std::string source_text;               ///< its bytes
  std::string resolved_text;             ///< YAML with every default
  std::vector<std::string> input_files;  ///< CSV and mesh files it refers to, as absolute paths
};

}  // namespace morula::scenarios
