#include "core/mesh/renewal/surface_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/mesh/pseudonormal.h"
#include "core/mesh/renewal/mesh_matrix.h"

namespace morula {
namespace {

constexpr double kAlongSurface = 0.02;  // μ: the part of a misfit that counts in all directions
constexpr double kHold = 0.02;          // of the area of a node
constexpr double kWallWeight = 3.0;
constexpr int kFirstWallStep = 2;       // counted from 0
constexpr double kMostStep = 0.3;       // of the mean edge
constexpr double kSampleSpacing = 0.5;  // of the mean edge
constexpr double kCrease = 0.7;         // cosine of the angle between normals below which an edge is sharp
constexpr double kShortCrease = 1e-3;   // of the mean edge: slivers have no direction
constexpr double kCreaseWidth = 0.3;    // of the mean edge: width of the strip a sharp edge stands for
constexpr double kWallReach = 0.5;      // of the mean edge: what is deeper inside a wall was there before
constexpr double kSolved = 1e-3;        // of a step; the next step mends the rest

Vec3d at(std::span<const Vec3d> x, const Triangle& face, std::span<const double, 3> weight) {
  return x[face[0]] * weight[0] + x[face[1]] * weight[1] + x[face[2]] * weight[2];
}

/// Samples of the edges at which a surface bends by more than 45°, with the direction of the edge: the rim of a cut, the borders of flat
/// parts. Samples of faces alone would round them off.
void sample_creases(const AskedSurface& surface, double edge, double width, std::vector<SurfaceSample>& samples,
                    std::vector<Vec3d>& direction) {
  const SurfaceView view = surface.view();
  for (const Edge& e : view.topology->edges()) {
    const Vec3d a = view.position[e.i], along = view.position[e.j] - a;
    const double length = norm(along);
    if (length < kShortCrease * edge || dot(surface.normals()[e.left], surface.normals()[e.right]) > kCrease) continue;
    const int parts = static_cast<int>(length / (kSampleSpacing * edge)) + 1;
    for (int k = 0; k < parts; ++k) {
      samples.push_back({a + along * ((k + 0.5) / parts), e.left, width * edge * length / parts});
      direction.push_back(along / length);
    }
  }
}

/// Least-squares system of one step at the present positions.
struct System {
  MeshMatrix matrix;
  std::vector<Vec3d> downhill;

  /// A point of a face, with these corner weights, that is drawn by `pull` = target − point, mostly along n.
  void add(const Triangle& corner, std::uint32_t face, std::span<const double, 3> weight, const Vec3d& pull, const Vec3d& n, double area) {
    add(corner, face, weight, pull, outer(area * (1.0 - kAlongSurface), n) + isotropic(area * kAlongSurface));
  }
  /// The same with any symmetric matrix K.
  void add(const Triangle& corner, std::uint32_t face, std::span<const double, 3> weight, const Vec3d& pull, const SymMat3<double>& k) {
    matrix.add_point(face, weight, k);
    const Vec3d force = k * pull;
    for (std::size_t c = 0; c < 3; ++c) downhill[corner[c]] += force * weight[c];
  }
};

class Fit {
 public:
  Fit(const AskedSurface& surface, std::span<const AskedSurface* const> walls, const Topology& topology,
      std::span<const SurfacePlace> place, const FitOptions& options)
      : surface_(surface),
        topology_(topology),
        options_(options),
        edge_(std::sqrt(4.0 * surface.area() / (std::sqrt(3.0) * topology.face_count()))),
        samples_(sample_surface(surface.view(), kSampleSpacing * edge_, false)),
        first_crease_(samples_.size()),
        point_face_(6 * std::size_t{topology.face_count()}),
        asked_at_(point_face_.size()),
        free_within_(point_face_.size(), -1.0),
        system_{MeshMatrix(topology), {}} {
    if (options.crease_width > 0.0) sample_creases(surface, edge_, options.crease_width, samples_, crease_direction_);
    sample_face_.resize(samples_.size());
    Box box;
    for (const SurfacePlace& p : place) {
      x_.push_back(p.point);
      box.include(p.point);
    }
    for (const AskedSurface* wall : walls)
      if (wall->tree().bounds().overlaps(box.inflated(edge_))) walls_.push_back(wall);
    for (std::size_t n = 0; n < point_face_.size(); ++n) point_face_[n] = place[topology.faces()[n / 6][n % 3]].face;
  }

  void step(int number) {
    system_.matrix.set_zero();
    system_.downhill.assign(x_.size(), Vec3d{});
    add_points(number);
    add_samples(number);
    add_hold();
    std::vector<Vec3d> move = system_.matrix.solve(system_.downhill, kSolved);
    for (std::size_t n = 0; n < x_.size(); ++n) {
      const double length = norm(move[n]), most = kMostStep * edge_;
      x_[n] += length > most ? move[n] * (most / length) : move[n];
    }
  }

  std::vector<Vec3d> with_volume(double volume) {
    const std::vector<Vec3d> gradient = volume_gradient(topology_.faces(), x_);
    move_to_volume(topology_.faces(), system_.matrix.solve(gradient, kSolved), volume, x_);
    return std::move(x_);
  }

 private:
  /// Points of the mesh are drawn to their nearest points of the surface, and out of walls.
  void add_points(int number) {
    const auto faces = topology_.faces();
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      const auto& [a, b, c] = faces[f];
      const double area = norm(cross(x_[b] - x_[a], x_[c] - x_[a])) / 12.0;
      for (std::size_t k = 0; k < 6; ++k) {
        const std::size_t n = 6 * std::size_t{f} + k;
        const Vec3d p = at(x_, faces[f], kSixPoints[k]);
        // Exact at first; a step is short, so that walking finds the same later.
        const NearestFace foot = number == 0 ? surface_.nearest(p, point_face_[n]) : surface_.walk(p, point_face_[n]);
        point_face_[n] = foot.face;
        system_.add(faces[f], f, kSixPoints[k], foot.closest.point - p, surface_.normals()[foot.face], area);
        if (number >= kFirstWallStep) add_walls(f, k, p, area);
      }
    }
  }

  /// A point inside a wall is drawn to its surface; the deepest wall counts. A point that was found free is asked about again when it has
  /// moved as far as the nearest wall was away.
  void add_walls(std::uint32_t face, std::size_t k, const Vec3d& p, double area) {
    const std::size_t n = 6 * std::size_t{face} + k;
    const double reach = kWallReach * edge_;
    if (free_within_[n] > 0.0 && norm2(p - asked_at_[n]) < free_within_[n] * free_within_[n]) return;
    double least = reach;
    Vec3d pull, normal;
    for (const AskedSurface* wall : walls_) {
      if (!wall->tree().bounds().inflated(reach).contains(p)) continue;
      const auto nearest = wall->tree().nearest(p, reach);
      if (!nearest) continue;
      const Vec3d offset = nearest->closest.point - p;
      const double distance = signed_distance(*wall->view().topology, wall->view().position, p, nearest->face, nearest->closest);
      const auto less = [](const Vec3d& a, const Vec3d& b) { return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z}; };
      // Of equally deep walls that one whose offset comes first: the order of the list does not matter.
      if (distance > least || (distance == least && !less(offset, pull))) continue;
      least = distance;
      pull = offset;
      normal = wall->normals()[nearest->face];
    }
    asked_at_[n] = p;
    free_within_[n] = least;
    if (least < 0.0) system_.add(topology_.faces()[face], face, kSixPoints[k], pull, normal, kWallWeight * area);
  }

  /// The nearest points of the mesh are drawn to samples of the surface.
  void add_samples(int number) {
    const SurfaceView mesh{x_, &topology_};
    const auto use = [&](std::size_t s, const NearestFace& foot) {
      sample_face_[s] = foot.face;
      const std::span<const double, 3> weight(foot.closest.barycentric);
      const Triangle& corner = topology_.faces()[foot.face];
      const SurfaceSample& sample = samples_[s];
      const Vec3d pull = sample.point - foot.closest.point;
      if (s < first_crease_)
        system_.add(corner, foot.face, weight, pull, surface_.normals()[sample.face], sample.area);
      else  // towards the line, in any direction across it
        system_.add(corner, foot.face, weight, pull, isotropic(sample.area) + outer(-sample.area, crease_direction_[s - first_crease_]));
    };
    if (number > 0) {
      for (std::size_t s = 0; s < samples_.size(); ++s) use(s, walk_to_nearest(mesh, samples_[s].point, sample_face_[s]));
      return;
    }
    const TriangleTree tree(x_, topology_.faces());
    std::uint32_t near = 0;
    for (std::size_t s = 0; s < samples_.size(); ++s) {
      const double walked = std::sqrt(walk_to_nearest(mesh, samples_[s].point, near).closest.distance2);
      const auto foot = tree.nearest(samples_[s].point, walked * (1.0 + 1e-12));
      near = foot ? foot->face : near;
      use(s, foot ? *foot : walk_to_nearest(mesh, samples_[s].point, near));
    }
  }

  void add_hold() {
    const auto faces = topology_.faces();
    std::vector<Vec3d> normal(x_.size());
    std::vector<double> area(x_.size(), 0.0);
    for (const Triangle& face : faces) {
      const Vec3d twice = cross(x_[face[1]] - x_[face[0]], x_[face[2]] - x_[face[0]]);
      const double third = norm(twice) / 6.0;
      for (const std::uint32_t n : face) {
        normal[n] += twice;
        area[n] += third;
      }
    }
    for (std::uint32_t n = 0; n < x_.size(); ++n) {
      const double length = norm(normal[n]), tangential = area[n] * options_.tangential_hold;
      SymMat3<double> k = isotropic(area[n] * kHold + tangential);
      if (length > 0.0) k += outer(-tangential, normal[n] / length);
      system_.matrix.add_node(n, k);
    }
  }

  const AskedSurface& surface_;
  const Topology& topology_;
  FitOptions options_;
  double edge_;
  std::vector<SurfaceSample> samples_;      ///< of faces, then of sharp edges
  std::size_t first_crease_;                ///< of the samples
  std::vector<Vec3d> crease_direction_;     ///< by sample of a sharp edge
  std::vector<std::uint32_t> sample_face_;  ///< by sample: face of the mesh last nearest to it
  std::vector<std::uint32_t> point_face_;   ///< by point of the mesh: face of the surface last nearest to it
  std::vector<const AskedSurface*> walls_;
  std::vector<Vec3d> asked_at_;      ///< by point of the mesh: where it was when walls were last asked
  std::vector<double> free_within_;  ///< by point of the mesh: distance of the nearest wall then; negative: ask
  System system_;
  std::vector<Vec3d> x_;
};

}  // namespace

std::vector<Vec3d> volume_gradient(std::span<const Triangle> faces, std::span<const Vec3d> x) {
  std::vector<Vec3d> out(x.size());
  for (const Triangle& face : faces)
    for (std::size_t c = 0; c < 3; ++c)
      out[face[c]] += cross(x[face[(c + 1) % 3]] - x[face[c]], x[face[(c + 2) % 3]] - x[face[c]]) * (1.0 / 6.0);
  return out;
}

bool move_to_volume(std::span<const Triangle> faces, std::span<const Vec3d> direction, double volume, std::vector<Vec3d>& x) {
  constexpr int kMostSteps = 12;
  const Vec3d origin = volume_centroid(faces, x);
  double best = 1e300;
  std::vector<Vec3d> best_x;
  for (int step = 0; step < kMostSteps; ++step) {
    const double missing = volume - enclosed_volume(faces, x, origin);
    if (!(std::abs(missing) < best)) break;
    best = std::abs(missing);
    best_x = x;
    if (best <= 1e-15 * volume) break;
    const std::vector<Vec3d> gradient = volume_gradient(faces, x);
    double slope = 0.0;
    for (std::size_t n = 0; n < x.size(); ++n) slope += dot(gradient[n], direction[n]);
    const double t = missing / slope;
    for (std::size_t n = 0; n < x.size(); ++n) x[n] += direction[n] * t;
  }
  if (!best_x.empty()) x = std::move(best_x);
  return best <= 1e-13 * volume;
}

std::vector<Vec3d> fit_to_surface(const AskedSurface& surface, std::span<const AskedSurface* const> walls, const Topology& topology,
                                  std::span<const SurfacePlace> place, double volume, const FitOptions& options) {
  Fit fit(surface, walls, topology, place, options);
  for (int step = 0; step < options.steps; ++step) fit.step(step);
  return fit.with_volume(volume);
}

}  // namespace morula
