#pragma once
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/cell_id.h"
#include "core/mesh/topology.h"
#include "core/random/philox.h"
#include "core/vec3.h"
#include "dcm/shells.h"

namespace morula {

/// The random forces of a step: with friction Γ = Σ G Gᵀ, a term adds √(2 k_B T/Δt) Σ G ξ with independent normal numbers ξ (dcm.md §10).
/// Numbers depend on the cell, the step and the factor alone.
struct Noise {
  std::uint32_t seed = 0;
  std::uint64_t step = 0;
  double dt = 0.0;  ///< [s]

  /// √(2 k_B T/Δt) of an energy k_B T [nN·µm].
  [[nodiscard]] double strength(double energy) const { return std::sqrt(2.0 * energy / dt); }
  /// Number of a draw of this step: a cell has fewer than 2^20 in one stream.
  [[nodiscard]] std::uint64_t draw(std::uint64_t factor) const { return (step << 20) + factor; }
  /// So many normal numbers of a cell, from the draw of a factor on.
  [[nodiscard]] std::vector<double> normals(CellId cell, std::uint64_t first_factor, std::size_t count) const;
};

// Where the draws of a cell begin in the streams of nodes and edges. The cell's own shell comes first; it has fewer than 2^17.
inline constexpr std::uint64_t kDrawsOfNuclearShell = 1u << 17;
inline constexpr std::uint64_t kDrawsOfInterior = 1u << 18;
inline constexpr std::uint64_t kDrawsOfNucleus = 1u << 19;

/// Three independent standard normal numbers: the draws 2·index and 2·index + 1.
Vec3d normal_vector(const Random& random, CellId cell, std::uint64_t index);
/// A number of a contact point that no other point of the step shares: finalizer of SplitMix64 (Steele et al. 2014, doi:10.1145/2660193.2660195).
std::uint64_t mixed(std::uint64_t a);
std::uint64_t point_draw(std::uint64_t step, CellId partner, std::uint64_t point);
/// Of a noise of unit covariance, one of the covariance a (I − n nᵀ) + b n nᵀ.
Vec3d along_and_across(const Vec3d& noise, const Vec3d& n, double across, double along);

/// What the noise of one shell's own friction is made from.
struct ShellNoise {
  const dcm::ShellParameters& law;
  const Topology& topology;
  CellId cell;
  double strength;  ///< √(2 k_B T/Δt)
  std::span<const Vec3d> x;
  std::span<Vec3d> force;
  std::uint64_t first_draw = 0;
};
/// That of the dampers along the edges, and in all directions.
void add_edge_noise(const ShellNoise& shell, const Noise& noise);
/// That of the viscosity of the volume [µm³].
void add_bulk_noise(const ShellNoise& shell, const Noise& noise, double volume);

}  // namespace morula
