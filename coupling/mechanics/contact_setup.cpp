#include "coupling/mechanics/contact_setup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "cbm/contact_on.h"

namespace morula {
namespace {

/// Deviations of factors from 1, in spreads: 3 of a founder, √2 times that of a daughter whose mother had as much of the same sign.
constexpr double kFurthest = 3.0 * 1.4143;
constexpr double kSoftest = 0.1;

constexpr double kWallThickness = 10.0;  // of the plates that stand for walls [µm]

Result<RigidSurface> rigid_surface(const std::string& name, std::vector<Vec3d> position, std::vector<Triangle> faces, bool inside,
                                   std::uint16_t material) {
  if (inside)
    for (Triangle& t : faces) std::swap(t[1], t[2]);
  RigidSurface out;
  auto topology = Topology::build(static_cast<std::uint32_t>(position.size()), std::move(faces));
  if (!topology) return Error{ErrorKind::kInput, "obstacle '" + name + "': " + topology.error().message, topology.error().help};
  out.topology = std::move(topology).value();
  out.position = std::move(position);
  out.material = material;
  out.inside = inside;
  const Topology* const topologies[1] = {out.topology.get()};
  const std::uint32_t first_node[1] = {0};
  const std::uint32_t first_face[2] = {0, out.topology->face_count()};
  compute_surface_geometry({topologies, first_node, first_face}, out.position, out.geometry);
  out.tree = std::make_unique<TriangleTree>(out.position, out.topology->faces());
  find_smooth_parts(out);
  return out;
}

/// A closed box as eight nodes and twelve faces, outward.
void box_mesh(const Box& box, std::vector<Vec3d>& position, std::vector<Triangle>& faces) {
  position.clear();
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 2; ++x) position.push_back({x ? box.high.x : box.low.x, y ? box.high.y : box.low.y, z ? box.high.z : box.low.z});
  faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
           {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
}

/// The largest number of faces (by their centroids) in any cube of this edge that lies on a grid of half its edge.
std::size_t most_faces_in_cube(const RigidSurface& surface, double edge) {
  using Place = std::array<long, 3>;
  std::map<Place, std::size_t> bins;
  for (const Triangle& t : surface.topology->faces()) {
    const Vec3d c = (surface.position[t[0]] + surface.position[t[1]] + surface.position[t[2]]) * (1.0 / 3.0);
    ++bins[{std::lround(2.0 * c.x / edge), std::lround(2.0 * c.y / edge), std::lround(2.0 * c.z / edge)}];
  }
  std::size_t most = 0;
  for (const auto& [place, count] : bins) {
    std::size_t here = 0;
    for (long corner = 0; corner < 8; ++corner) {
      const auto bin = bins.find({place[0] + (corner & 1), place[1] + (corner >> 1 & 1), place[2] + (corner >> 2)});
      if (bin != bins.end()) here += bin->second;
    }
    most = std::max(most, here);
  }
  return most;
}

/// A pair's lists number the faces near one cell in 15 bits.
Status check_fineness(const Model& model, const std::string& name, const RigidSurface& surface) {
  double radius = 0.0;
  for (const CellType& type : model.types) radius = std::max(radius, type.radius.mean * (1.0 + 3.0 * type.radius.relative_spread));
  if (surface.topology->face_count() < kNoFace || radius == 0.0) return {};
  const std::size_t faces = most_faces_in_cube(surface, 4.0 * radius);
  if (faces < kNoFace) return {};
  return Error{ErrorKind::kInput,
               "obstacle '" + name + "' has " + std::to_string(faces) + " faces within reach of one cell; at most " +
                   std::to_string(kNoFace - 1) + " can be held",
               "use a coarser mesh: edges far below those of the cells' meshes add nothing"};
}

/// Radius of a cell of the type in the middle of its life; obstacles are flat.
double curvature(const Model& model, std::size_t material) {
  return material < model.types.size() ? 1.0 / model.types[material].radius.mean : 0.0;
}

SurfaceTraction traction(const Model& model, std::size_t a, std::size_t b) {
  const ContactPair& pair = model.pair(a, b);
  LawValues values = pair.own;
  values.set("adhesion", pair.adhesion);
  values.set("range", pair.range > 0.0 ? pair.range : model.contact.range);
  values.set("repulsion", pair.repulsion > 0.0 ? pair.repulsion : model.contact.repulsion);
  values.set("curvature", curvature(model, a) + curvature(model, b));
  return pair.law->build(values);
}

}  // namespace

std::vector<ContactMaterial> contact_materials(const Model& model, double time) {
  const std::size_t given = model.material_count(), count = contact_material_count(model);
  std::vector<ContactMaterial> out(count * count);
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) {
      ContactMaterial& material = out[a * count + b];
      material.law.range = model.contact.range;
      material.law.repulsion = model.contact.repulsion;
      if (a >= given || b >= given) continue;
      const ContactPair& pair = model.pair(a, b);
      if (a < model.types.size()) {
        const auto& sphere = model.types[a].sphere;
        material.sphere_modulus = sphere.young / (1.0 - sphere.poisson * sphere.poisson);
        material.sphere_stiffness = sphere.with_shells.stiffness;
        material.sphere_adhesion = sphere.with_shells.adhesion;
        const RegionalTension& tensions = model.types[a].regional_tension;
        const double own = model.types[a].shell.tension;
        material.tension = tensions.of_face(own, {}, 1.0, time);
        if (b < model.types.size()) {
          material.new_surface = std::max(model.types[a].new_surface, model.types[b].new_surface);
          material.tension_drop = tensions.drop_in_contact(own, time);
        }
      }
      material.law = traction(model, a, b);
      if (!pair.regions.empty())
        material.regional =
            std::make_shared<const RegionalAdhesion>(pair.adhesion, pair.regions, static_cast<int>(model.mark_names.size()));
      if (a == b && a < model.types.size()) {
        material.self_distance = model.types[a].self_contact;
        material.self_radius = model.types[a].radius.mean;
      }
      material.friction = material.with_sphere = {pair.normal_friction, pair.tangential_friction};
      if (a < model.types.size() && b < model.types.size()) {
        material.with_sphere.normal *= model.types[a].sphere.approach_factor;
        material.with_sphere.tangential *= model.types[a].sphere.along_factor;
      }
    }
  return out;
}

Result<std::vector<RigidSurface>> contact_obstacles(const Model& model) {
  std::vector<RigidSurface> out;
  for (std::size_t i = 0; i < model.obstacles.size(); ++i) {
    const ObstacleSpec& spec = model.obstacles[i];
    MORULA_TRY_ASSIGN(auto surface,
                      rigid_surface(spec.name, spec.position, spec.faces, spec.inside, static_cast<std::uint16_t>(model.types.size() + i)));
    MORULA_TRY(check_fineness(model, spec.name, surface));
    out.push_back(std::move(surface));
  }
  const Box& box = model.space.box;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t side = 0; side < 2; ++side) {
      if (model.space.boundary[axis][side] != BoundaryKind::kWall) continue;
      Box plate = box.inflated(kWallThickness);
      (side == 0 ? plate.high : plate.low)[axis] = (side == 0 ? box.low : box.high)[axis];
      std::vector<Vec3d> position;
      std::vector<Triangle> faces;
      box_mesh(plate, position, faces);
      MORULA_TRY_ASSIGN(auto surface, rigid_surface("wall", position, faces, false, static_cast<std::uint16_t>(model.material_count())));
      out.push_back(std::move(surface));
    }
  return out;
}

std::size_t contact_obstacle_count(const Model& model) {
  std::size_t walls = 0;
  for (const auto& axis : model.space.boundary)
    for (const BoundaryKind kind : axis) walls += kind == BoundaryKind::kWall;
  return model.obstacles.size() + walls;
}

cbm::ContactTable sphere_contact_table(const Model& model) {
  std::vector<cbm::SphereParameters> types;
  std::vector<cbm::SurfacePair> surfaces;
  for (std::size_t a = 0; a < model.types.size(); ++a) {
    types.push_back(model.types[a].sphere);
    for (std::size_t b = 0; b < model.material_count(); ++b)
      surfaces.push_back({model.pair(a, b).adhesion, model.pair(a, b).normal_friction, model.pair(a, b).tangential_friction});
    surfaces.push_back({});
  }
  return {types, surfaces};
}

namespace {

/// Of the softest spheres of two types that adhere most; or of one type and an obstacle.
cbm::PairCoefficients farthest_reaching(const Model& model, const cbm::SphereLaw& law, std::size_t a, std::size_t b) {
  const auto furthest = [&](std::size_t type, Trait trait) { return kFurthest * model.types[type].traits.of(trait).relative_spread; };
  const auto softest = [&](std::size_t type) {
    cbm::SphereParameters out = model.types[type].sphere;
    out.young *= std::max(kSoftest, 1.0 - furthest(type, Trait::kStiffness));
    return out;
  };
  const cbm::SphereParameters first = softest(a);
  const double most = 1.0 + furthest(a, Trait::kAdhesion), adhesion = model.pair(a, b).adhesion;
  if (b >= model.types.size()) return law.couple(first, nullptr, adhesion * std::sqrt(most));
  const cbm::SphereParameters second = softest(b);
  return law.couple(first, &second, adhesion * std::sqrt(most * (1.0 + furthest(b, Trait::kAdhesion))));
}

}  // namespace

double stiffest_repulsion(const Model& model) {
  double out = model.contact.repulsion;
  for (const ContactPair& pair : model.pairs) out = std::max(out, pair.repulsion);
  return out;
}

ContactSettings contact_settings(const Model& model, int threads) {
  ContactSettings settings;
  settings.range = model.contact.range;
  for (const ContactPair& pair : model.pairs) settings.range = std::max(settings.range, pair.range);
  settings.skin = model.contact.skin;
  settings.body_skin = 2.0 * model.contact.skin;
  settings.points_per_face = model.contact.points_per_face;
  settings.threads = threads;
  settings.objective_friction = model.contact.objective_friction;
  // Spheres may hold on to each other and to obstacles over a gap, at the largest radius a cell of the type reaches.
  const cbm::ContactTable table = sphere_contact_table(model);
  const auto radius = [&](std::size_t t) { return 2.0 * model.types[t].radius.mean * (1.0 + 3.0 * model.types[t].radius.relative_spread); };
  for (std::size_t a = 0; a < model.types.size(); ++a)
    for (std::size_t b = a; b < model.material_count(); ++b) {
      cbm::PairContact contact = table.entry(a, b).contact;
      if (contact.law->reach == nullptr) continue;
      if (model.types[a].traits.variable_of(Trait::kStiffness) || model.types[a].traits.variable_of(Trait::kAdhesion))
        contact.coefficient = farthest_reaching(model, *contact.law, a, b);
      const double reduced = b < model.types.size() ? cbm::reduced_radius(radius(a), radius(b)) : cbm::kMostOfHollow * radius(a);
      settings.sphere_reach = std::max(settings.sphere_reach, contact.law->reach(contact, reduced));
    }
  return settings;
}

}  // namespace morula
