#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/space/space.h"
#include "study/initial/surroundings.h"
#include "study/study.h"

namespace morula::scenarios {

/// What a filled shape looks like.
struct Packing {
  std::vector<Vec3d> center;        ///< by cell, from the middle of the shape outwards [µm]
  double worst_overlap = 0.0;       ///< largest of touch·(r_i + r_j) − distance over all pairs; ≤ 0: none [µm]
  double reach_beyond = 0.0;        ///< how far the outermost cell sticks out of the shape; 0: not at all [µm]
  double worst_intrusion = -1e300;  ///< how deep a cell lies in what was there before; ≤ 0: none does [µm]
  double allowed_overlap = 0.0;     ///< up to which overlaps were let be [µm]
  bool jammed = false;              ///< drawn at random, they did not come apart: the shape is too small for them
  std::uint64_t room = 0;           ///< cells that have a place; fewer than asked for: `center` is empty
};

/// Centres of `radius.size()` cells of these radii in the block's shape, beside what is there.
///
/// Face-centred cubic close packing, the nearest points to the shape's middle (measured by the shape itself, so that a box fills as a box),
/// turned at random in a sphere, with a jitter of 3 % of the spacing; then overlapping cells are pushed apart until no two centres are
/// closer than touch·(r_i + r_j), up to 0.1 % of the mean radius or a number of passes, while cells of a ball are drawn together. Walls
/// keep cells inside; periodic faces count. Points within what is there are left out. Random numbers: stream kInitialPosition of the founders
/// first_number …; a pure function of its arguments, whatever the number of threads.
///
/// From kMany cells on they are not drawn together, begin further apart the more their radii differ (a lattice of unequal balls cannot be as dense), and
/// come apart by part_many() until none overlaps by more than 5 % of the mean radius; shells, which have touch = 1, by 2 %.
Packing pack_cells(const InitialCells& block, std::span<const double> radius, double touch, const Space& space, std::uint64_t first_number,
                   std::uint32_t seed, const Surroundings& around = {}, int threads = 1);

/// A layer on the block's plane: a hexagonal lattice around the point below `center`, from there outwards as a disc or, within a box, as a rectangle, each
/// cell its radius above the plane, pushed apart along it where radii differ. As pack_cells() otherwise.
Packing layer_cells(const InitialCells& block, std::span<const double> radius, double touch, const Space& space,
                    const Surroundings& around = {}, int threads = 1);

/// Places drawn at random in the block's shape. Up to 30 % of its volume one cell after the other, each as often as needed to keep its distance from all that
/// is there (Poisson disc; random sequential adsorption, which ends near 38 %). Denser, or where that finds no place: one cell in each cube of a
/// lattice, anywhere in it, then all come apart within the shape (part_many()), with overlaps as pack_cells() leaves of many cells; equal balls end near 64 %, and what
/// does not come apart is `jammed`. As pack_cells() otherwise.
Packing scatter_cells(const InitialCells& block, std::span<const double> radius, double touch, const Space& space,
                      std::uint64_t first_number, std::uint32_t seed, const Surroundings& around = {}, int threads = 1);

/// How cells are pushed apart.
struct PushApart {
  double touch = 1.0;  ///< of r_i + r_j
  double slack = 0.0;  ///< overlap that may remain [µm]
  int most_passes = 400;
  int drawn_passes = 0;                  ///< in the first of them all cells are drawn together as well, ever less
  Vec3d middle{};                        ///< towards this point
  const Surroundings* around = nullptr;  ///< prepared; pushes and is not pushed
  const LayerPlane* plane = nullptr;     ///< each cell stays its radius above it
};

/// Push spheres apart in place until no two centres are closer than touch·(r_i + r_j) − slack; returns the largest remaining overlap [µm].
/// `worst_intrusion`: that with what is around.
double push_apart(std::vector<Vec3d>& center, std::span<const double> radius, const PushApart& how, const Space& space,
                  double* worst_intrusion = nullptr);

/// Keep a cell within the walls of the domain and its centre in the image of the domain.
void keep_within_walls(Vec3d& p, double radius, const Space& space);

/// Cube root of the mean of the cubes of radii [µm].
double mean_radius(std::span<const double> radius);

/// Distance of neighbours in a lattice of cells of these radii that are to touch like this [µm].
double lattice_spacing(std::span<const double> radius, double touch);

/// Volume of cells of these radii over that of the entry's shape.
double filled_part(const InitialCells& block, std::span<const double> radius);

/// Overlap that many cells may begin with, if they are to touch like this [µm].
double slack_of_many(double touch, double mean_radius);

}  // namespace morula::scenarios
