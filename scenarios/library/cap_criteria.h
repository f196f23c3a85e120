#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/model.h"
#include "results/run_record.h"

namespace morula::scenarios {

/// Limits for a cell with a fluid cortex against the spherical cap of Young's law.
struct CapTolerance {
  double angle = 0.0;           ///< [deg]
  double contact_radius = 0.0;  ///< relative
  double height = 0.0;          ///< relative
};

/// The limits of a study (physics/scenarios.md S4 or S6), and where mesh and range of contact are fine enough the narrower ones that were measured
/// on cells of 642 nodes (dcm.md §8): 3 degrees and 1.5 % of the height at a range of 1/12 of the cell's radius R0, 2 degrees and 0.5 % at 1/24. They
/// hold up to a hemisphere: beyond, a small angle changes the height much more. `expected`: the angle of Young's law [rad].
CapTolerance cap_tolerance(const CapTolerance& of_study, double expected, std::uint32_t nodes, double range, double r0);

/// A contact angle and the way to it.
struct ReachedAngle {
  double ratio = 0.0;                      ///< W/γ
  double range = 0.0;                      ///< of contact [µm]
  std::uint32_t nodes = 0;                 ///< of a cell
  bool came_back = false;                  ///< from a larger contact, under a tension that was lower at first
  double angle = 0.0;                      ///< [rad]
  [[nodiscard]] std::string text() const;  ///< ", W/T = 1, back from a larger contact"
};

/// Angles that must not depend on the way to them: from small and from large contacts (T8.1, dcm.md §8: 1 degree), nor on the range of contact where
/// one is about twice the other (S6.4: 2 degrees). Cells of fewer than 642 nodes have twice the tolerance (physics/scenarios.md S6, quick).
void judge_ways(const std::vector<ReachedAngle>& angles, std::vector<Verdict>& out);

/// Contact radius and height of a cell on a plane, over the radius of a ball of its volume.
struct ElasticCap {
  double ratio, modulus;  ///< W/γ, Y/γ
  double contact_radius, height;
};

/// Static minimisation of an elastic cell of 642 nodes (E = 1 kPa, h = 200 nm, γ = 0.1 mN/m: spreading_static_reference.csv); null where there is none for
/// this ratio and modulus, or the mesh is coarser. Two such cells that stick to each other with twice the ratio are its mirror images (S6.0).
const ElasticCap* elastic_cap(double ratio, double modulus, std::uint32_t nodes);

/// Tension of the free surface of a type at a time [nN/µm].
double tension_at(const CellType& type, double time);

/// Range of contact of two materials [µm].
double range_of(const Model& model, std::size_t a, std::size_t b);

}  // namespace morula::scenarios
