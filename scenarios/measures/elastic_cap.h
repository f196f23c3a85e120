#pragma once
#include <cstdint>

#include "coupling/model.h"

namespace morula::scenarios {

/// Contact radius and height of a cell on a plane, over the radius of a ball of its volume.
struct ElasticCap {
  double ratio, modulus;  ///< W/γ, Y/γ
  double contact_radius, height;
};

/// Static minimisation of an elastic cell of 642 nodes (E = 1 kPa, h = 200 nm, γ = 0.1 mN/m: spreading_static_reference.csv); null where
/// there is none for this ratio and modulus, or the mesh is coarser. Two such cells that stick to each other with twice the ratio are its
/// mirror images (S6.0).
const ElasticCap* elastic_cap(double ratio, double modulus, std::uint32_t nodes);

/// Tension of the free surface of a type at a time [nN/µm].
double tension_at(const CellType& type, double time);

/// Range of contact of two materials [µm].
double range_of(const Model& model, std::size_t a, std::size_t b);

}  // namespace morula::scenarios
