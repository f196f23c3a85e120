#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/friction/friction_system.h"
#include "core/parallel/comm.h"
#include "coupling/mechanics/free_clusters.h"
#include "coupling/mechanics/owned_points.h"
#include "coupling/mechanics/scene.h"
#include "coupling/mechanics/step_report.h"
#include "coupling/mechanics/terms.h"
#include "coupling/model.h"
#include "coupling/stage_timer.h"
#include "coupling/tissue.h"

namespace morula {

/// How cells settle in place while the clock stands still: obstacles, tensions and who adheres to whom stay as they are.
struct Settling {
  std::vector<char> moves;     ///< by owned body: which move
  ContactStrength strength{};  ///< cap and depth count while the clock says that the start is capped
};

/// What a step is asked to do.
struct StepTask {
  double dt = 0.0;                     ///< [s]
  std::span<const Vec3d> external;     ///< dead loads: owned shell nodes, owned spheres; points within shells after them, or left out [nN]
  std::span<const Anchor> anchors;     ///< springs to places of the laboratory
  const Settling* settling = nullptr;  ///< null: the clock runs
  std::vector<Vec3d> by_point{};       ///< `external` and random forces; empty: there are none of these [nN]
  /// Norm of all forces before obstacles and springs went to where they are at the step's end, where they do [nN]. What they do to cells that have not moved
  /// yet, stretched over a step, may be a hundred times the forces that are left when all have: no measure for what may be left of the residual.
  std::optional<double> forces_before{};
};

/// Energy and forces of all terms at the present positions of the scene.
struct Evaluation {
  double energy = 0.0;       ///< without external work, of all ranks [fJ]
  std::vector<Vec3d> force;  ///< by point; nothing else keeps them: who makes something of them takes them away
};

/// What the terms know of the tissue as it is. Its forces are there until a step uses them up; what else the terms have found stays.
struct Known {
  double energy = 0.0;
  std::optional<std::vector<Vec3d>> force;
};

/// Since when the scene holds. None: bodies have changed, and the scene and all lists are to be made anew.
struct SceneAge {
  bool cells_replaced = false;     ///< a few bodies have come or gone: the scene is to be built again, and lists are to be mended
  std::vector<Vec3d> start;        ///< owned positions when the ghosts were found; empty on one rank
  double skin_used = 0.0;          ///< of the list of pairs, at the end of the last step
  double expected_skin_use = 0.0;  ///< at the end of the next step; beyond 1 the list would wear out in the middle of it
};

/// Areas and normals of the shells' nodes at the present positions of a scene.
class NodeGeometry {
 public:
  /// Ghosts and geometry at the scene's positions; nothing is done where they are known. Collective.
  void update(Scene& scene, int threads, StageTimer& timer);
  /// What only forces need goes until the next update().
  void give_back();
  [[nodiscard]] const SurfaceGeometry& now() const { return geometry_; }
  [[nodiscard]] std::size_t memory() const;

 private:
  SurfaceGeometry geometry_;
  std::optional<std::uint64_t> at_;  ///< Scene::positions_number()
};

/// How far things are to go in one step [µm].
struct AllowedWays {
  double of_body;  ///< as OwnedPoints::largest_way_of_body() finds it
  /// Where a surface parts from a neighbour or falls onto it, a few of its points go fast for a short way, in any tissue at any time. Where they
  /// end is given by the energy, and not by how many steps they took: they may go further, though no further than contacts reach (decision 0052).
  double of_point;
  /// What the way of a sphere counts beside that of a point: it has no surface that could cross another, and no nodes on which contacts have kinks.
  static constexpr double kSphereCounts = 0.5;
};
AllowedWays allowed_ways(const Model& model);
/// A step in which a tissue went so many times further is refused.
inline constexpr double kFurtherThanAllowed = 1.5;
/// The same of a point where a few bodies went further, and Newton's method has come to its end: a sphere here counts as any other (decision 0093).
inline constexpr double kFurthestPoint = 3.0;

/// Everything that mechanics works with. It can be rebuilt from the tissue at any time, and rebuilding it never changes a result.
struct Workspace {
  struct Setting {
    const Model& model;
    ShapeLibrary& shapes;
    Comm comm;
    int threads;
  };
  struct Solver {
    FrictionSystem system;
    std::vector<Float4> velocity;  ///< by point; the last solution is the next start
    FreeClusters clusters;         ///< of the present matrix
    std::vector<HeldPoint> held;   ///< by obstacles in the present matrix, in canonical order; of active bodies
  };

  Setting setting;
  StageTimer timer{};
  Scene scene{};
  std::optional<SceneAge> age{};
  NodeGeometry geometry{};
  Terms terms;
  Solver solver{};
  std::optional<Known> known{};
  double prescribed_time = 0.0;  ///< up to which terms that vary with time were asked for [s]
  std::size_t most_bytes = 0;    ///< at any time of the present step

  [[nodiscard]] World world(const Tissue& tissue) const;
  [[nodiscard]] OwnedPoints points() const { return {scene, setting.comm, setting.threads}; }
  [[nodiscard]] std::size_t bytes_now() const;
  void note_memory() { most_bytes = std::max(most_bytes, bytes_now()); }
  /// Place of an owned point among the external forces.
  [[nodiscard]] std::size_t external_place(std::uint32_t point) const;
  /// External force on an owned point [nN].
  [[nodiscard]] Vec3d external_on(const StepTask& task, std::uint32_t point) const;
};

/// The scene at the positions of the tissue, as far as it is not there: where only places are asked for. Collective.
void prepare_scene(Workspace& work, const Tissue& tissue, const Settling* settling = nullptr);
/// Let the workspace know the tissue: scene, lists, and an evaluation at its positions, as far as they are not known. Collective.
const Known& prepare(Workspace& work, const Tissue& tissue, const Settling* settling = nullptr);
/// The same with forces that nobody has used up, and friction that is that of a step which begins now. Collective.
const Known& prepare_step(Workspace& work, const Tissue& tissue, const Settling* settling = nullptr);
/// All terms at the scene's positions; `room` is used for the forces. Collective.
Evaluation evaluate(Workspace& work, const Tissue& tissue, std::vector<Vec3d> room);
/// What makes the present positions impossible, if anything.
std::optional<StepFault> find_fault(const Workspace& work, const Tissue& tissue);
/// A cell of this rank whose surface has passed through another on the way from `start`, if there is one.
std::optional<CellId> find_crossed(const Workspace& work, const Tissue& tissue, std::span<const Vec3d> start);
/// Deepest penetration of a surface into another, of all ranks [µm]. Collective.
double deepest_overlap(const Workspace& work);

}  // namespace morula
