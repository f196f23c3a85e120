#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "cbm/laws/jkr.h"
#include "cbm/spheres.h"
#include "core/space/space.h"
#include "core/vec3.h"

namespace morula::cbm {

/// What two surfaces do to each other, per pair of cell types.
struct SurfacePair {
  double adhesion = 0.0;             ///< W [nN/µm]
  double normal_friction = 0.0;      ///< γ_n per contact area [nN·s/µm³]
  double tangential_friction = 0.0;  ///< γ_t per contact area [nN·s/µm³]
};

/// Law constants of all pairs of cell types, looked up in the pair loop.
class ContactTable {
 public:
  struct Entry {
    ContactMaterial material;
    double normal_friction = 0.0;      ///< γ_n [nN·s/µm³]
    double tangential_friction = 0.0;  ///< γ_t [nN·s/µm³]
  };

  ContactTable() = default;
  /// types: elastic parameters by cell type; surfaces: (types × types), symmetric, row by row.
  ContactTable(std::span<const SphereParameters> types, std::span<const SurfacePair> surfaces);

  [[nodiscard]] std::size_t type_count() const { return types_; }
  [[nodiscard]] const Entry& entry(std::uint16_t a, std::uint16_t b) const { return entries_[std::size_t{a} * types_ + b]; }

  /// Largest centre distance at which any two spheres not larger than this can act on each other: 2R + 0.75 X_max [µm].
  [[nodiscard]] double reach(double largest_radius) const;

 private:
  std::size_t types_ = 0;
  std::vector<Entry> entries_;
};

/// Two spheres that may touch. i and j in the order of the cells, so that a pair is computed from the same side everywhere.
struct SpherePair {
  std::uint32_t i = 0, j = 0;
  bool attached = false;  ///< branch of the adhesive law, fixed within a step
  double offset = 0.0;    ///< overlap forgiven to fresh sisters (division_ramp.h) [µm]
};

/// What a pair needs to know of the spheres; spans of equal length (owned spheres and ghosts).
struct SphereView {
  std::span<const Vec3d> position;  ///< [µm]
  std::span<const double> radius;   ///< [µm]
  std::span<const std::uint16_t> type;
};

/// Everything about one pair in its present place.
///
/// Force on i is −force·normal, on j +force·normal. The positive semi-definite part of ∂²U/∂x_j² is
/// stiffness·nnᵀ + transverse_stiffness·(I − nnᵀ), where the transverse part max(0, −F)/d acts in tension only. The friction
/// block is A[γ_n nnᵀ + γ_t(I − nnᵀ)] = isotropic_friction·I + axial_friction·nnᵀ.
struct PairResponse {
  Vec3d normal;                       ///< from i to j; the x axis where the centres coincide
  double distance = 0.0;              ///< of the centres [µm]
  double overlap = 0.0;               ///< at which the law was evaluated: R_i + R_j − d − offset [µm]
  double force = 0.0;                 ///< [nN]
  double stiffness = 0.0;             ///< max(0, dF/dδ) [nN/µm]
  double transverse_stiffness = 0.0;  ///< [nN/µm]
  double area = 0.0;                  ///< [µm²]
  double energy = 0.0;                ///< [nN·µm]
  double isotropic_friction = 0.0;    ///< Aγ_t [nN·s/µm]
  double axial_friction = 0.0;        ///< A(γ_n − γ_t) [nN·s/µm]
};

/// One pair whose centres are `between` = x_j − x_i apart. Symmetric: exchanging i and j flips the normal and nothing else, bit for bit.
inline PairResponse evaluate_pair(const ContactTable::Entry& entry, const Vec3d& between, double radius_i, double radius_j, bool attached,
                                  double offset) noexcept {
  const PairLaw<double> law = make_pair_law(entry.material, radius_i, radius_j);
  PairResponse out;
  out.distance = norm(between);
  const double inverse = out.distance > 0.0 ? 1.0 / out.distance : 0.0;
  out.normal = out.distance > 0.0 ? between * inverse : Vec3d{1.0, 0.0, 0.0};
  out.overlap = radius_i + radius_j - out.distance - offset;
  const ContactResponse<double> contact = contact_response(law, out.overlap, attached);
  out.force = contact.force;
  out.stiffness = contact.stiffness;
  out.transverse_stiffness = max(-contact.force, 0.0) * inverse;
  out.area = contact.area;
  out.energy = contact.energy;
  out.isotropic_friction = contact.area * entry.tangential_friction;
  out.axial_friction = contact.area * (entry.normal_friction - entry.tangential_friction);
  return out;
}

/// A sphere and a rigid plane, Hertz with R* = R and E* = E/(1 − ν²): no adhesion and no friction, as at a wall of the domain.
/// outward: unit vector from the sphere towards the plane; distance: of the centre from the plane, negative behind it [µm].
inline PairResponse evaluate_wall(const SphereParameters& sphere, double radius, const Vec3d& outward, double distance) noexcept {
  const PairLaw<double> law = make_pair_law(ContactMaterial::against_rigid(sphere.young, sphere.poisson, 0.0), radius);
  PairResponse out;
  out.normal = outward;
  out.distance = distance;
  out.overlap = radius - distance;
  const ContactResponse<double> contact = hertz_contact(law, out.overlap);
  out.force = contact.force;
  out.stiffness = contact.stiffness;
  out.area = contact.area;
  out.energy = contact.energy;
  return out;
}

/// All pairs; out has the length of pairs. Threaded; the result of a pair depends on nothing but the pair.
void evaluate_pairs(const Space& space, const SphereView& spheres, const ContactTable& table, std::span<const SpherePair> pairs,
                    std::span<PairResponse> out);

/// At the end of a step: set the attached flag of every pair from its overlap in the given place. Returns how many flags changed.
std::size_t update_attached(const Space& space, const SphereView& spheres, const ContactTable& table, std::span<SpherePair> pairs);

/// Sums over the pairs of each sphere, in the order of the list (which must therefore be canonical for repeatable bits).
struct SphereContactSums {
  std::vector<Vec3d> force;          ///< [nN]
  std::vector<double> area;          ///< [µm²]
  std::vector<double> virial;        ///< Σ_j d_ij F_ij [nN·µm]
  std::vector<std::uint32_t> count;  ///< pairs with contact
};
SphereContactSums sum_contacts(std::size_t sphere_count, std::span<const SpherePair> pairs, std::span<const PairResponse> responses);

/// Virial pressure of a cell, p = (1/6V) Σ_j d_ij F_ij: half of each pair's virial goes to each cell (positive when compressed).
/// virial: Σ_j d_ij F_ij over its contacts [nN·µm]; volume: that of the cell itself, for no tessellation is built [µm³]. [kPa]
[[nodiscard]] constexpr double virial_pressure(double virial, double volume) noexcept { return virial / (6.0 * volume); }

}  // namespace morula::cbm
