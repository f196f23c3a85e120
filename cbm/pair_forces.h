#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "cbm/laws/jkr.h"
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
    ContactMaterial material;
    double normal_friction = 0.0;      ///< γ_n [nN·s/µm³]
    double tangential_friction = 0.0;  ///< γ_t [nN·s/µm³]
  };

  ContactTable() = default;
  /// types: elastic parameters by cell type; surfaces: (types × materials), row by row, symmetric among types. Spheres of a type that is
  /// not adhesive do not adhere to anything.
  ContactTable(std::span<const SphereParameters> types, std::span<const SurfacePair> surfaces);

  [[nodiscard]] std::size_t type_count() const { return types_; }
  [[nodiscard]] std::size_t material_count() const { return materials_; }
  /// Of a sphere of type a against material b.
  [[nodiscard]] const Entry& entry(std::size_t a, std::size_t b) const { return entries_[a * materials_ + b]; }

 private:
  std::size_t types_ = 0, materials_ = 0;
  std::vector<Entry> entries_;
};

/// Centres closer than this have no direction: the z axis stands for it [µm].
inline constexpr double kCoincident = 1e-9;

/// Up to eight pairs at once: what evaluate() reads and what it finds, one pair a lane.
///
/// Force on a is −force·normal, on b +force·normal. stiffness·nnᵀ is the positive semi-definite part of ∂²U/∂x_b² along the normal. The
/// overlap at which the law is evaluated is R_a + R_b − d − offset.
struct PairBlock {
  static constexpr int kWidth = 8;
  using Row = double[kWidth];

  alignas(64) Row between[3] = {};  ///< x_b − x_a [µm]
  alignas(64) Row radius_a = {};    ///< [µm]
  alignas(64) Row radius_b = {};    ///< [µm]
  alignas(64) Row offset = {};      ///< overlap forgiven to fresh sisters (division_ramp.h) [µm]
  alignas(64) Row attached = {};    ///< 1: on the adhesive branch, fixed within a step; 0: not
  const ContactMaterial* material[kWidth] = {};

  alignas(64) Row normal[3] = {};   ///< from a to b
  alignas(64) Row distance = {};    ///< of the centres [µm]
  alignas(64) Row force = {};       ///< [nN]
  alignas(64) Row stiffness = {};   ///< max(0, dF/dδ) [nN/µm]
  alignas(64) Row area = {};        ///< [µm²]
  alignas(64) Row energy = {};      ///< [nN·µm]
  bool attached_next[kWidth] = {};  ///< at the end of a step that ends here

  void set(int lane, const Vec3d& x, double a, double b, const ContactMaterial& m, bool is_attached, double forgiven) noexcept {
    between[0][lane] = x.x;
    between[1][lane] = x.y;
    between[2][lane] = x.z;
    radius_a[lane] = a;
    radius_b[lane] = b;
    material[lane] = &m;
    attached[lane] = is_attached ? 1.0 : 0.0;
    offset[lane] = forgiven;
  }
};

/// Evaluate lanes 0 .. count−1, 0 < count <= kWidth. The result of a lane has the same bits whatever the others hold.
void evaluate(PairBlock& block, int count) noexcept;

/// One pair alone, as evaluate() gives it.
struct PairResponse {
  Vec3d normal;
  double distance = 0.0, force = 0.0, stiffness = 0.0, area = 0.0, energy = 0.0;
  bool attached_next = false;
};
PairResponse evaluate_pair(const ContactMaterial& material, const Vec3d& between, double radius_a, double radius_b, bool attached,
                           double offset) noexcept;

/// Virial pressure of a cell, p = (1/6V) Σ_j d_ij F_ij: half of each pair's virial goes to each cell (positive when compressed).
/// virial: Σ_j d_ij F_ij over its contacts [nN·µm]; volume: that of the cell itself, for no tessellation is built [µm³]. [kPa]
[[nodiscard]] constexpr double virial_pressure(double virial, double volume) noexcept { return virial / (6.0 * volume); }

}  // namespace morula::cbm
