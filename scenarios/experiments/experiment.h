#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cbm/spheres.h"
#include "core/vec3.h"
#include "scenarios/calibrate/packing_geometry.h"
#include "study/cell_material.h"

namespace morula::scenarios {

/// A virtual experiment with deformable cells of one type: a study that is run like any other.
struct Experiment {
  enum class Kind {
    kPair,        ///< two cells, held at a distance by their centres, pressed together and pulled apart
    kPacking,     ///< a periodic packing whose box shrinks
    kMixedPair,   ///< a sphere and a shell, likewise; without a text until the sphere's law is known
    kRelaxation,  ///< two cells that touch and come together by themselves, with the friction of their type
    kPressed,     ///< a ball of cells between two plates that come nearer, likewise
    kCluster,     ///< a few cells that touch and come together by themselves, likewise
  } kind = Kind::kPair;
  calibrate::Arrangement arrangement = calibrate::Arrangement::kFaceCentred;  ///< of a packing
  std::uint32_t seed = 1;

  std::string name;                       ///< of its folder
  std::string purpose;                    ///< for people
  std::string text;                       ///< of its study
  bool held_out = false;                  ///< judged by, never fitted to
  double radius_a = 0.0, radius_b = 0.0;  ///< of the free cells [µm]
  double rate = 0.0;                      ///< of the distance of a pair [µm/s]; of the strain of the volume of a packing [1/s]
  double turn = 0.0;                      ///< when a pair is closest, when the plates of a pressed cluster set out [s]
  double pressing = 0.0, way = 0.0;       ///< how long these move [s], how far each of both comes [µm]
  cbm::WithShells with_shells{};          ///< of the sphere of a mixed pair
  CellFriction friction{};                ///< of the cells of a relaxation or a pressed cluster
  double work = 1.0;                      ///< expected, against that of other experiments: cells times the time that they are simulated [s]
  int dispensable = 0;                    ///< of a calibration that has too little time the largest goes first; 0: there is no fit without
};

/// Rates at which a pair is pressed and pulled, the fastest first: each half of the one before, so that forces without rate are found.
inline constexpr int kPairRates = 3;
/// Ratio of the radii of pairs that are held out.
inline constexpr double kUnequalPair = 1.3;

/// What the calibration of a contact law asks (fields_and_coupling.md E). E1 and E2: equal cells that come nearer until δ = 0.35 R and part, at three
/// rates; E4, where cells adhere: three pairs that come together by themselves, and, not without `packings`, three balls of 32 cells that are pressed between plates and clusters of 3, 4 and 13 cells
/// that come together by themselves, with a pair and a ball of 38 that are held out (decision 0096); E3, not without `packings`: random packings from V/V0 = 1.35 to 0.7, two to fit to and one held out, and face-centred and body-centred cubic
/// ones, held out (decision 0056); E5: cells of radii 1 : 1.3, held out; pairs of a sphere and a shell (mixed_contact.h), last.
///
/// The centres of the pairs of E1, E2 and E5 are held by springs, so that pairs are stable at any distance. Friction between their cells is 0 and that with
/// the medium small: forces at rest do not depend on it, and they are extrapolated to no rate.
std::vector<Experiment> experiments_for(const CellMaterial& material, bool packings = true);

/// A pair of cells of these radii [µm], pressed and pulled at a rate [µm/s].
Experiment pair_experiment(const CellMaterial& material, const std::string& name, double radius_a, double radius_b, double rate);
/// A sphere, of the modulus, with the factors and the packing of `sphere`, and a shell, pressed and pulled at mixed_pair_rate(); the seed turns the mesh.
Experiment mixed_pair_experiment(const CellMaterial& material, const std::string& name, double radius_of_sphere, double radius_of_shell,
                                 const cbm::SphereParameters& sphere, std::uint32_t seed);
/// At which mixed pairs are pressed and pulled, and one of the pairs of shells [µm/s].
double mixed_pair_rate(const CellMaterial& material);
/// A cubic packing whose V/V0 falls from 1.35 to 0.7, V0 the volume of a free cell, over a time [s].
Experiment packing_experiment(const CellMaterial& material, calibrate::Arrangement lattice, double time);
/// Friction of a free cell with the medium, γ_med 4πR² [nN·s/µm], radius in µm.
double drag_of(const CellFriction& friction, double radius);
/// Two cells that touch, with the friction of their type, until they rest; the seed turns their meshes.
Experiment relaxation_experiment(const CellMaterial& material, std::uint32_t seed);
/// Cells that touch, with the friction of their type, until they rest: a triangle, a tetrahedron, one and its twelve neighbours of a close packing, else a ball without order; the seed
/// turns their meshes and is that of such a ball.
Experiment cluster_experiment(const CellMaterial& material, int cells, std::uint32_t seed);
/// How long it is given [s].
double time_of_cluster(const CellMaterial& material);
/// A study of spheres of the type at these places [µm], as long as a cluster is given, in no box. Their law is JKR without packing.
std::string study_of_spheres_in_cluster(const CellMaterial& material, std::span<const Vec3d> centers);
/// The same of one sphere and its twelve neighbours of a close packing, which touch: when they have had that long, the one in the middle, which is the first of them, becomes a shell, and they
/// have as long again.
std::string study_of_promotion(const CellMaterial& material);
/// A ball of 32 cells with the friction of their type, which adhere to each other for a while and are then pressed flat by two plates without friction; the seed is that of
/// their places and turns their meshes.
Experiment pressed_experiment(const CellMaterial& material, std::uint32_t seed);
/// The same with spheres, whose law is JKR without packing.
Experiment pressed_spheres_experiment(const CellMaterial& material, std::uint32_t seed);
/// Outputs of the plates' way.
inline constexpr int kPressedOutputs = 60;
/// Cells at random places that grow into each other at V/V0 = 1.35, which then falls to 0.7.
Experiment random_packing_experiment(const CellMaterial& material, std::uint32_t seed);

/// A study of spheres of the type at these places [µm], or their images, in a periodic cube [µm], with the friction of the type, for four times as
/// long as two cells are given to come together. Their law is JKR without packing.
std::string study_of_spheres(const CellMaterial& material, std::span<const Vec3d> centers, double edge);

}  // namespace morula::scenarios
