#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cbm/laws/table.h"
#include "cbm/packing.h"
#include "cbm/spheres.h"
#include "coupling/laws.h"
#include "study/diagnostics.h"
#include "study/study.h"

namespace morula::scenarios {

/// A contact law of spheres that `morula calibrate` found from shells: what a study takes from TYPE.jkr.yaml.
struct FittedLaw {
  std::string version;         ///< of the program that made the fit
  std::string type, material;  ///< of the cells, and what their shells are (study/cell_material.h)
  bool table_is_better = false;

  double young = 0.0, poisson = 0.0;    ///< JKR: E [kPa], ν
  double adhesion = 0.0;                ///< W of two spheres [nN/µm]
  double adhesion_of_shells = 0.0;      ///< that the fitted shells have [nN/µm]
  std::optional<cbm::PairTable> table;  ///< none: the points made no table

  /// What spheres of a pair law have beside it.
  struct Spheres {
    cbm::PackingCurve packing;  ///< empty: packings were not fitted
    cbm::CrowdedArea area;      ///< contact areas among many; empty: not fitted
    /// Friction of such a sphere with cells over that of the shells, across their contact and along it; none: not fitted. Where `along` alone was
    /// not, that of approach stands for it.
    std::optional<double> approach, along;
  };
  Spheres of_jkr, of_table;
  std::optional<CellFriction> friction;  ///< of the shells with which friction was fitted

  std::optional<cbm::WithShells> with_shells;  ///< contact of a sphere with a shell; none: not fitted

  cbm::OverlapRange overlap;                           ///< δ over the smaller radius of what was fitted
  double smallest_radius = 0.0, largest_radius = 0.0;  ///< of the cells that were fitted [µm]
};

/// What a file says of itself in its last line, `checksum`: of all bytes before that line.
std::string checksum_of_law(std::string_view text_before);

/// Reads such a file. W693 where it is not as it was made. Errors go to `diagnostics`: E601–E605 at `referred_from`, what is wrong in the file at its place (E1xx, E2xx, E3xx), and E533 where
/// its numbers make no law, E530 where they make no curve of packing; then nothing.
std::optional<FittedLaw> read_fitted_law(const std::filesystem::path& path, const std::string& shown_name, const Place& referred_from,
                                         const Laws& laws, Diagnostics& diagnostics);

}  // namespace morula::scenarios
