#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "coupling/model.h"

namespace morula::scenarios {

/// Load of a tissue in units of one sphere: a node of a shell is worth as much as in the balance of ranks (coupling/balance.h).
struct Load {
  double spheres = 0.0;
  double nodes = 0.0;  ///< of all shells
  double shells = 0.0;
  double most_shells = std::numeric_limits<double>::infinity();  ///< to which they multiply; cells beyond are spheres
  [[nodiscard]] double total() const { return spheres + 3.0 * nodes; }
};

/// How many times as many cells there are after a time [s] at a rate [1/s].
double multiplied(double growth, double duration);

/// ∫ of spheres and nodes over a time in which all cells multiply, and shells as long as there is room for them; a node costs more among more shells.
Load load_integral(const Load& load, double growth, double duration);

/// The load after a time, likewise.
Load load_after(const Load& load, double growth, double duration);

/// Rate at which the number of cells grows if nothing inhibits it: ln 2 / cycle, averaged over the cells of each type [1/s]; where daughters are of other types, the
/// mean rate over `duration` [s] with the mixture that comes of it.
double free_growth_rate(const Model& model, const std::vector<std::int64_t>& cells_of_type, double duration);

}  // namespace morula::scenarios
