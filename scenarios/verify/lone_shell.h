#pragma once
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/ball.h"
#include "core/mesh/surface_geometry.h"
#include "core/mesh/triangle_mesh.h"
#include "coupling/mechanics/mechanics.h"
#include "dcm/internal_forces.h"
#include "dcm/shell_friction.h"

/// What the reference numbers of one cell are measured on: shells alone with the laws of dcm/, and one cell in an empty space.
namespace morula::scenarios {

// Table 1 of the seed with the tension that dcm.md takes; R in µm, E and K_V in kPa, h in µm, γ in nN/µm, friction per area in nN·s/µm³
inline constexpr double kRadius = 6.0, kYoung = 1.0, kThickness = 0.2, kPoisson = 0.5, kTension = 0.5, kBulk = 2.5, kMedium = 0.1;

enum class Size {
  kNodes,   ///< nodes on the sphere of radius 6: the mesh encloses less
  kVolume,  ///< the mesh encloses the volume of that sphere
};

/// One icosphere without stress.
dcm::Shells sphere(std::uint32_t nodes, Size size);
/// The same of any closed mesh.
dcm::Shells shell_of(const TriangleMesh& mesh);
/// `shells` with every node moved by 2 % of the radius in a direction of its own.
dcm::Shells rough(dcm::Shells shells);

/// Parameters with which no law acts.
dcm::ShellParameters nothing();

dcm::ShellMechanics mechanics(const dcm::Shells& shells, const dcm::ShellParameters& parameters, std::span<const Vec3d> position);
inline dcm::ShellMechanics mechanics(const dcm::Shells& shells, const dcm::ShellParameters& parameters) {
  return mechanics(shells, parameters, shells.position);
}
SurfaceGeometry geometry(const dcm::Shells& shells, std::span<const Vec3d> position);
inline SurfaceGeometry geometry(const dcm::Shells& shells) { return geometry(shells, shells.position); }
/// ∂V/∂x of a mesh: the force of a pressure 1.
std::vector<Vec3d> volume_gradient(dcm::Shells shells);

/// Γ_n of one shell at its positions.
class LoneFriction {
 public:
  LoneFriction(dcm::Shells shells, const dcm::ShellParameters& parameters);
  [[nodiscard]] std::vector<Vec3d> times(std::span<const Vec3d> velocity) const;
  [[nodiscard]] double dissipation(std::span<const Vec3d> velocity) const;
  [[nodiscard]] const dcm::Shells& shells() const { return shells_; }

 private:
  dcm::Shells shells_;
  dcm::ShellBlocks blocks_;
  dcm::ShellFriction friction_;
};

/// The larger of two; what is not a number wins.
inline double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

double dot_of(std::span<const Vec3d> a, std::span<const Vec3d> b);
double norm_of(std::span<const Vec3d> a);
Vec3d sum_of(std::span<const Vec3d> a);
/// Σ |a_i|
double size_of(std::span<const Vec3d> a);
Vec3d torque_of(std::span<const Vec3d> position, std::span<const Vec3d> force);
/// Net force and torque over the sums of forces and levers.
struct Balance {
  double force, torque;
};
Balance balance_of(std::span<const Vec3d> position, std::span<const Vec3d> force);
std::vector<Vec3d> scaled(std::span<const Vec3d> a, double factor);
/// a + factor·b
std::vector<Vec3d> plus(std::span<const Vec3d> a, std::span<const Vec3d> b, double factor = 1.0);
/// The same vector for all.
std::vector<Vec3d> all_alike(std::size_t count, const Vec3d& v);
/// Ω × x
std::vector<Vec3d> turning(std::span<const Vec3d> position, const Vec3d& rate);
/// Unit vectors of any direction, the same at every call with this number.
std::vector<Vec3d> random_directions(std::size_t count, std::uint64_t number);

/// One type of cell with the values of Table 1 and no contacts.
Model lone_cell_model();
/// Steps that end only when nothing is left to be balanced.
void solve_tightly(Model& model);
/// One cell of that type at the origin; V0 is that at which it is at rest.
Tissue lone_cell(const Model& model, std::uint32_t nodes, Size size = Size::kVolume);
/// The same cell, and mechanics to move it.
class LoneCell {
 public:
  LoneCell(Model model, std::uint32_t nodes, Size size = Size::kVolume);
  LoneCell(const LoneCell&) = delete;
  LoneCell& operator=(const LoneCell&) = delete;

  /// One step under these forces on the nodes (none: no force); false when it was refused.
  [[nodiscard]] bool step(double dt, std::span<const Vec3d> external = {});
  [[nodiscard]] double energy();
  [[nodiscard]] BodyValues values() { return mechanics_.values(tissue); }
  [[nodiscard]] const Model& model() const { return model_; }

 private:
  Model model_;
  ShapeLibrary shapes_;

 public:
  Tissue tissue;

 private:
  Mechanics mechanics_;
};

}  // namespace morula::scenarios
