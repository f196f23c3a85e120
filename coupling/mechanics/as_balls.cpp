/// The cells as the laws of spheres see them: how far beyond the range of their laws they are (decision 0050).
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "cbm/contact_on.h"
#include "cbm/sphere_range.h"
#include "core/ball.h"
#include "core/contact/broad_phase.h"
#include "core/contact/rigid_surface.h"
#include "coupling/mechanics/mechanics.h"
#include "coupling/mechanics/workspace.h"

namespace morula {
namespace {

/// Sums over the contacts of each owned body, by place.
using Standings = std::vector<SphereContacts::Standing>;

/// Volume of the sphere that a shell would be: what growth and inflation drive, and, where the cell follows its water, what this has made of it [µm³].
double volume_as_sphere(const Model& model, const Cells& cells, std::size_t row) {
  const CellRow& cell = cells.rows[row];
  const double volume = cell.target_volume;
  return model.types[cell.type].osmosis.acts() ? volume * std::exp(cells.optional.reference_excess[row]) : volume;
}

/// All bodies of a rank's scene as balls, ghosts too; the box of each is that of its body: what does not touch has no contact.
struct Balls {
  std::vector<Extent> extent;
  std::vector<std::uint32_t> place;

  Balls(const Workspace& work, const Tissue& tissue);
};

Balls::Balls(const Workspace& work, const Tissue& tissue) {
  const Scene& scene = work.scene;
  const std::span<const ContactBody> bodies = scene.bodies();
  std::vector<std::uint64_t> radius(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) radius[b] = std::bit_cast<std::uint64_t>(bodies[b].radius);
  for (const BodyOfRow& body : bodies_of(tissue.cells))
    if (body.is_shell)
      radius[body.number] = std::bit_cast<std::uint64_t>(ball_radius(volume_as_sphere(work.setting.model, tissue.cells, body.row)));
  scene.exchange_bodies(radius);
  const std::span<const Vec3d> x = scene.position();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto points = x.subspan(bodies[b].first_point, bodies[b].point_count);
    Extent& ball = extent.emplace_back();
    ball.radius = std::bit_cast<double>(radius[b]);
    ball.center = b < scene.shells() ? volume_centroid(scene.topologies()[b]->faces(), points) : points[0];
    for (const Vec3d& p : points) ball.box.include(p);
    if (b >= scene.shells()) ball.box = ball.box.inflated(ball.radius);
    place.push_back(bodies[b].place);
  }
}

/// Contacts of owned bodies with each other where one of the two is a shell: those of two spheres are known.
void add_pairs_with_shells(const Workspace& work, const Balls& balls, Standings& to) {
  const Scene& scene = work.scene;
  const auto number = [&](std::uint32_t body) {  // among the owned ones
    return body < scene.first_sphere() ? body : body - scene.first_sphere() + scene.owned_shells();
  };
  std::vector<std::uint32_t> shells(scene.first_sphere());
  std::iota(shells.begin(), shells.end(), 0u);
  find_body_pairs_of(shells, balls.extent, balls.place, work.setting.model.space, work.setting.threads, [&](const BodyPair& pair) {
    const Extent &first = balls.extent[pair.a], &second = balls.extent[pair.b];
    const double distance = norm(second.center + pair.shift - first.center), overlap = first.radius + second.radius - distance;
    if (!(overlap > 0.0)) return;
    const ContactBody &a = scene.bodies()[pair.a], &b = scene.bodies()[pair.b];
    const cbm::PairContact& contact = work.terms.spheres->table().entry(a.material, b.material).contact;
    const double area = contact.law->respond(contact, cbm::reduced_radius(first.radius, second.radius), overlap, true).response.area;
    const double part = cbm::part_of_range(contact, overlap, area, std::min(first.radius, second.radius));
    const cbm::SphereCaps caps = cbm::sphere_caps(first.radius, second.radius, distance);
    const auto add = [&](std::uint32_t body, double cap) {
      SphereContacts::Standing& sum = to[number(body)];
      sum.outside = std::max(sum.outside, part);
      sum.caps += cap;
    };
    if (a.owned) add(pair.a, caps.volume_a);
    if (b.owned) add(pair.b, caps.volume_b);
  });
}

/// Contacts of owned shells with obstacles and walls.
void add_obstacles_of_shells(const Workspace& work, const Balls& balls, Standings& to) {
  const ContactLayer& layer = work.terms.contacts->layer();
  const auto obstacles = layer.obstacles();
  const cbm::ContactTable& table = work.terms.spheres->table();
  std::vector<std::uint32_t> parts;
  const auto add = [&](std::size_t i, std::uint32_t o, const SurfaceImage& image) {
    const double radius = balls.extent[i].radius;
    const Vec3d center = balls.extent[i].center - (layer.obstacle_offset(o) + image.shift);
    parts_near(obstacles[o], center, radius, parts);
    const std::size_t material = std::min<std::size_t>(work.setting.model.types.size() + o, table.material_count() - 1);
    const cbm::PairContact& contact = table.entry(work.scene.bodies()[i].material, material).contact;
    for (const std::uint32_t part : parts) {
      const auto foot = foot_on_part(obstacles[o], part, center, radius);
      if (!foot || !(foot->distance < radius)) continue;
      const double overlap = radius - foot->distance;
      const cbm::ContactOn on = cbm::contact_on(radius, foot->curvature);
      const double area = on.area * contact.law->respond(contact, on.radius, overlap, true).response.area;
      to[i].outside = std::max(to[i].outside, cbm::part_of_range(contact, overlap, area, radius));
      to[i].caps += cbm::plane_cap(radius, overlap).volume;
    }
  };
  for (std::size_t i = 0; i < work.scene.owned_shells(); ++i) {
    const Extent& ball = balls.extent[i];
    const Box around = Box{ball.center, ball.center}.inflated(ball.radius);
    for (std::uint32_t o = 0; o < obstacles.size(); ++o)
      for_images(obstacles[o], layer.obstacle_offset(o), work.setting.model.space, around,
                 [&](const SurfaceImage& image) { add(i, o, image); });
  }
}

}  // namespace

AsBalls Mechanics::as_balls(const Tissue& tissue) {
  look(tissue);
  const Workspace& work = *work_;
  const std::size_t shells = work.scene.owned_shells();
  Standings standings(shells);
  const Standings of_spheres = work.terms.spheres->standings(work.scene);
  standings.insert(standings.end(), of_spheres.begin(), of_spheres.end());
  std::vector<double> radius(shells);
  radius.insert(radius.end(), tissue.spheres.radius.begin(), tissue.spheres.radius.end());
  if (work.setting.comm.any(shells > 0)) {
    const Balls balls(work, tissue);
    for (std::size_t i = 0; i < shells; ++i) radius[i] = balls.extent[i].radius;
    add_pairs_with_shells(work, balls, standings);
    add_obstacles_of_shells(work, balls, standings);
  }
  AsBalls out;
  for (std::size_t i = 0; i < standings.size(); ++i) {
    const auto [outside, caps] = standings[i];
    const std::uint16_t type = i < shells ? work.scene.bodies()[i].material : tissue.spheres.type[i - shells];
    const double last = work.setting.model.types[type].sphere.packing.last();
    const double packing = caps / ball_volume(radius[i]);
    out.outside_law.push_back(last > 0.0 ? std::max(outside, packing / last) : outside);
    out.packing.push_back(packing);
    out.caps.push_back(caps);
  }
  return out;
}

}  // namespace morula
