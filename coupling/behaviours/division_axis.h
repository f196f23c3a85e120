#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/law_info.h"
#include "core/mesh/renewal/surface_view.h"
#include "core/own_keys.h"
#include "core/vec3.h"
#include "coupling/own_values.h"

namespace morula {

struct CellType;
struct CellState;

/// What lies around a cell that divides; only what the axis of its type looks at.
struct AroundDivision {
  std::vector<Vec3d> neighbours{};  ///< from its centre to those of the cells that it touches [µm]
  Vec3d surface_normal{};           ///< of the tissue, where it lies at its surface: OpenSides::middle()
  Vec3d gradient{};                 ///< of the field that the axis names [mM/µm]
  Vec3d to_geometry{};              ///< from its centre to the nearest point of the obstacle that the axis names [µm]
};

/// What the axis of a division may be chosen by.
struct CellAtDivision {
  const CellState& row;
  const CellType& type;
  SurfaceView surface{};  ///< of a shell; a sphere has none
  const AroundDivision& around = nothing();

  static const AroundDivision& nothing() {
    static const AroundDivision out;
    return out;
  }
};

/// How the axis of a division is chosen: what there is to say about it, and the axis. The cell is cut across it; its first daughter lies where it points.
struct DivisionAxis {
  LawInfo info;                 ///< info.name is the word of `cycle.axis`
  std::vector<OwnKey> keys{};   ///< of its own beside those of `cycle`: with `field` it looks at a gradient, with `geometry` at an obstacle
  bool needs_polarity = false;  ///< of the type
  bool spheres_look_at_neighbours = false;
  bool looks_at_surface = false;  ///< of the tissue
  /// The axis, any length; zero where the cell has none: then it is random. `random`: a direction uniform on the sphere.
  Vec3d (*of)(const CellAtDivision& cell, const Vec3d& random) = nullptr;
};

std::vector<std::shared_ptr<const DivisionAxis>> builtin_division_axes();
std::shared_ptr<const DivisionAxis> random_axis();

/// The axis of length 1 by which a cell divides at its attempt number `attempt`, from 0, with the numbers of the streams kDivisionAxis and
/// kDivisionTilt at its number of rare draws so far plus `attempt`.
///
/// The axis of the type's rule is turned by a random angle θ, distributed on the sphere after von Mises and Fisher with the concentration κ = 1/s²
/// (Fisher 1953, doi:10.1098/rspa.1953.0064), s the type's spread, which is the standard deviation in each of two directions where it is small:
/// cos θ = 1 + ln(u + (1 − u) e^(−2κ))/κ. Later attempts have 0.2 rad more spread each: other planes where one did not serve.
Vec3d division_axis(const CellAtDivision& cell, std::uint32_t seed, std::uint64_t attempt);

/// The part of the mother's volume that the first daughter gets: drawn from the type's share (stream kDivisionShare, truncated Gaussian), kept within
/// 0.1 to 0.9.
double division_share(const CellAtDivision& cell, std::uint32_t seed);

}  // namespace morula
