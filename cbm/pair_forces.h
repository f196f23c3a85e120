#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "cbm/pair_block.h"
#include "cbm/spheres.h"
#include "core/vec3.h"

namespace morula::cbm {

/// What two surfaces do to each other, per pair of materials.
struct SurfacePair {
  double adhesion = 0.0;             ///< W [nN/µm]
  double normal_friction = 0.0;      ///< γ_n per contact area [nN·s/µm³]
  double tangential_friction = 0.0;  ///< γ_t per contact area [nN·s/µm³]
};

/// Law constants of all pairs of materials: cell types first, rigid materials (obstacles, walls) after them.
class ContactTable {
 public:
  struct Entry {
    PairContact contact;
    double normal_friction = 0.0;      ///< γ_n [nN·s/µm³]
    double tangential_friction = 0.0;  ///< γ_t [nN·s/µm³]
  };

  ContactTable() = default;
  /// types: elastic parameters by cell type; surfaces: (types × materials), row by row, symmetric among types. Two types of different
  /// laws meet by Hertz's, from the moduli that all spheres have, unless the same law stands in for both (SphereLaw::elsewhere).
  ContactTable(std::span<const SphereParameters> types, std::span<const SurfacePair> surfaces);

  [[nodiscard]] std::size_t type_count() const { return types_; }
  [[nodiscard]] std::size_t material_count() const { return materials_; }
  /// Of a sphere of type a against material b.
  [[nodiscard]] const Entry& entry(std::size_t a, std::size_t b) const { return entries_[a * materials_ + b]; }

 private:
  /// `adhere_alike`: as the spheres of each type among themselves.
  [[nodiscard]] const SphereLaw* law_of(const SphereParameters& a, const SphereParameters* b, bool adhere_alike) const;

  std::size_t types_ = 0, materials_ = 0;
  std::vector<Entry> entries_;
  std::shared_ptr<const SphereLaw> other_ = hertz_law();  ///< of two types whose laws differ
};

/// Evaluate lanes 0 .. count−1, 0 < count <= kWidth, each by the law of its contact; the loop of a law is run once for all lanes that have it.
/// The result of a lane has the same bits whatever the others hold.
void evaluate(PairBlock& block, int count) noexcept;

/// One pair alone, as evaluate() gives it.
struct PairResponse {
  Vec3d normal;
  double distance = 0.0, force = 0.0, stiffness = 0.0, area = 0.0, energy = 0.0;
  bool attached_next = false;
};
PairResponse evaluate_pair(const PairContact& contact, const Vec3d& between, double radius_a, double radius_b, bool attached,
                           double offset) noexcept;

/// How far the contact with a sphere of radius b at distance d lies from the centre of one of radius a: in the middle of their overlap [µm].
/// Of two alike it is d/2; the two ways sum to d, so that the pair's virial d F is shared without rest.
[[nodiscard]] constexpr double contact_arm(double distance, double a, double b) noexcept { return 0.5 * (distance + a - b); }

/// Pressure of a cell of this volume, p = −tr σ/3 with σ = (1/V) Σ_k (x_k − x) ⊗ f_k (fields_and_coupling.md, D); positive when compressed.
/// virial: Σ_k (x − x_k)·f_k over its contacts, arm times force for two spheres [nN·µm]; volume [µm³]. [kPa]
[[nodiscard]] constexpr double virial_pressure(double virial, double volume) noexcept { return virial / (3.0 * volume); }

/// Volume that a pressure [kPa] leaves of the ball V0 of a sphere: V0 e^(−p/K_V), as a shell has it by p = −K_V ln(V/V0), and V0/e at least.
/// The ball itself keeps the size of the free cell and overlaps its neighbours. K_V [kPa], 0: the ball.
[[nodiscard]] double pressed_volume(double pressure, double free_volume, double bulk_modulus) noexcept;

/// virial_pressure() of a sphere with pressed_volume(): p V(p) = virial/3. In the cubic close packing of ideal filled cells V is the volume of a
/// cell of the lattice (cbm.md §3), and p its pressure.
[[nodiscard]] double sphere_pressure(double virial, double free_volume, double bulk_modulus) noexcept;

}  // namespace morula::cbm
