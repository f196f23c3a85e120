#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/contact/contact_layer.h"
#include "core/result.h"
#include "coupling/model.h"
#include "study/initial/cell_grid.h"

namespace morula::scenarios {

/// What stands where cells are to be placed: obstacles, walls of the domain, and the cells that are there already.
class Surroundings {
 public:
  /// Obstacles and walls of the model at time 0. Errors: those of contact_obstacles().
  static Result<Surroundings> of(const Model& model);

  /// A cell that is there [µm].
  void add(const Vec3d& center, double radius);
  /// To be called after add() and before push(): radius of the largest cell that will be asked about.
  void prepare(double largest_radius, double touch);

  [[nodiscard]] bool empty() const { return obstacles_ == 0 && center_.empty(); }

  /// How deep a ball lies in the deepest of obstacles and cells, touch·(r_i + r_j) − distance and touch·r − distance [µm]; negative: in none.
  /// `out`: where all that it lies in pushes it, by their depths [µm]. Walls are left out: packing keeps cells off them.
  [[nodiscard]] double push(const Vec3d& p, double radius, double touch, Vec3d& out) const;

  /// What a ball lies deepest in: "obstacle 'plate'" or "a cell that is there already". push() says how deep.
  [[nodiscard]] std::string what_is_at(const Vec3d& p, double radius, double touch) const;

  /// Number of obstacles and walls, and how they are called: "obstacle 'plate'", "the wall".
  [[nodiscard]] std::size_t surface_count() const { return surfaces_.size(); }
  [[nodiscard]] std::string name(std::size_t surface) const;
  [[nodiscard]] bool is_wall(std::size_t surface) const { return surface >= obstacles_; }
  /// Distance of a point from a surface, or from the nearest of its images, on the side where cells live; negative within it. Far outside (beyond
  /// `cutoff`): cutoff. [µm]
  [[nodiscard]] double distance(std::size_t surface, const Vec3d& p, double cutoff, Vec3d* away = nullptr) const;

 private:
  /// The same without images.
  [[nodiscard]] double distance_of_one(std::size_t surface, const Vec3d& p, double cutoff, Vec3d* away) const;
  Space space_;
  std::vector<std::string> names_;
  std::vector<bool> inside_;
  std::shared_ptr<const std::vector<RigidSurface>> kept_;
  std::vector<const RigidSurface*> surfaces_;
  struct Ball {
    Vec3d center{};
    double radius = -1.0;  ///< negative: none
  };
  std::vector<Ball> clear_;  ///< of each surface: a ball on the side where cells live
  std::size_t obstacles_ = 0;
  std::vector<Vec3d> center_;
  std::vector<double> radius_;
  double largest_ = 0.0;
  std::optional<CellGrid> grid_;
};

}  // namespace morula::scenarios
