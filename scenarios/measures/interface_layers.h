#pragma once
#include <cmath>
#include <vector>

#include "results/snapshot.h"

namespace morula::scenarios {

/// Mean over some cells and its standard error (no number for a single cell); no number where there is no cell.
struct LayerMean {
  double mean = std::nan(""), error = std::nan("");
};

/// The cells that are as far from the other body: 1 touches it, 2 touches those, and so on.
struct InterfaceLayer {
  BodyKind body = BodyKind::kSphere;
  int number = 1;
  bool and_beyond = false;  ///< also those that are farther
  std::size_t cells = 0;
  LayerMean pressure;      ///< [kPa]
  LayerMean contact_part;  ///< contact area over surface
  LayerMean volume;        ///< [µm³]
  LayerMean way;           ///< from `start`, of the cells that were there already [µm]
  LayerMean speed;         ///< net way from `before` over the time since [µm/s]
};

/// How many layers on each side are told apart.
inline constexpr int kInterfaceLayers = 4;

/// Layers on both sides of where spheres and shells meet: from the spheres farthest away to the shells farthest away; those without a cell are left out, and
/// all where one body is missing or none touches the other. Two cells touch where their centres are nearer than 1.2 times the sum of the radii of balls of their
/// volumes: second neighbours of a close packing are at 1.41. Snapshots of one run; ways are the shortest over periodic images.
std::vector<InterfaceLayer> interface_layers(const Snapshot& start, const Snapshot& before, const Snapshot& now, const Space& space);

/// The difference of shells that touch spheres from spheres that touch shells: of means, with its standard error.
LayerMean jump(const std::vector<InterfaceLayer>& layers, LayerMean InterfaceLayer::*value);

}  // namespace morula::scenarios
