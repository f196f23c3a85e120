#include "scenarios/experiments/experiment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/ball.h"
#include "core/close_packing.h"
#include "core/numbers/joined.h"
#include "core/numbers/number_text.h"
#include "core/vec3.h"
#include "dcm/drops.h"
#include "scenarios/experiments/ball_of_cells.h"
#include "scenarios/experiments/mixed_contact.h"

namespace morula::scenarios {
namespace {

constexpr double kDeepest = 0.35;              // δ/R at which a pair turns, at least
constexpr double kBeyondRest = 0.2;            // and how much deeper than a doublet at rest
constexpr double kFarthest = -0.8;             // δ/R at which it ends
constexpr double kFastest = 0.002;             // rate of the fastest pair over R [1/s]
constexpr double kTrap = 20.0;                 // stiffness of the traps [nN/µm]
constexpr int kPairOutputs = 100;              // of a pair
constexpr double kLoose = 1.35, kTight = 0.7;  // V/V0 of a packing at its start and end
constexpr double kPackingTime = 3000.0;        // [s]
constexpr int kPackingOutputs = 65;
constexpr int kRandomCells = 48;                           // no cell meets another from both sides at the end
constexpr double kInflate = 900.0, kRandomStart = 1200.0;  // of a random packing: until when its cells grow, and its box stays as it is [s]
constexpr double kRandomTime = 1500.0, kRandomOutput = 60.0;  // of its compression [s]
constexpr std::uint32_t kRandomFitted = 2, kRandomHeldOut = 1;
constexpr std::uint32_t kRelaxations = 3;                         // each with meshes that are turned otherwise
constexpr double kRelaxationTimes = 40.0;                         // simulated, in times of relaxation as guessed
constexpr double kZipped = 0.02;                                  // part of the friction in contact that is guessed to hold cells back
constexpr int kRelaxationOutputs = 120, kRelaxationSteps = 1200;  // at least
constexpr double kLeastWay = 0.1;                                 // δ/R at rest that is guessed at least
constexpr std::uint32_t kPressedClusters = 3;                     // each with other places
constexpr int kPressedCells = 32, kPressedSteps = 240;
constexpr double kClusterTime = 4.0;  // in the time of a relaxing pair
constexpr int kClusterOutputs = 10;
constexpr double kTouch = 1.99;                         // distance of the centres of cells that touch, in radii
constexpr double kPressTime = 4.0;                      // in the time of a relaxing pair
constexpr double kRestTime = 4.0, kLeastRest = 1800.0;  // of spheres in a packing, at most: in the same, but no less than this [s]
constexpr int kAdhereOutputs = 8;                       // before the plates set out
constexpr double kFlattened = 0.57;  // half of the distance of the plates at the end, in radii of a ball with the cells' volume
constexpr double kClearance = 0.1;   // of plates from cells at the start, in radii and beside the range of contact
/// Friction of a type with the medium and with other cells.
struct Friction {
  std::string medium, cells;
};
/// Traps drag a pair through the medium and past each other: next to nothing.
const Friction kOfPairs{"1e6 N s/m^3", "0 N s/m^3"};
/// A box carries its cells along; what wets its neighbours without friction does so within milliseconds, and the steps are as short. Pressures are the
/// same within 1 % from V/V0 = 0.99 down (decision 0044).
const Friction kOfPackings{"1e8 N s/m^3", "5e10 N s/m^3"};

std::string number(double value) { return shortest_text(value); }
std::string of(double value, const char* unit) { return number(value) + " " + unit; }
std::string place(const Vec3d& p) { return "[" + of(p.x, "um") + ", " + of(p.y, "um") + ", " + of(p.z, "um") + "]"; }

/// The material, and JKR without packing for spheres of it, in whose place a law on trial comes.
CellMaterial with_plain_spheres(CellMaterial material) {
  material.shell = "cbm: {law: jkr, packing: none}, " + material.shell;
  return material;
}

/// A type with this material, without life.
std::string type_text(const CellMaterial& material, const char* name, double radius, const std::string& adhesion,
                      const Friction& friction) {
  return "  " + std::string(name) + ": {radius: " + of(radius, "um") + ", friction: {medium: " + friction.medium +
         ", cell_cell: " + friction.cells + ", obstacle: 0 N s/m^3}, adhesion: {" + adhesion + "}, " + material.shell + "}\n";
}

/// The section `contact` for cells of these two types.
std::string contact_text(const CellMaterial& material, const char* between) {
  if (material.pair.empty()) return material.contact;
  const std::string open = material.contact.substr(0, material.contact.size() - 1);
  return open + (open.size() > 1 ? ", " : "") + "pairs: [{between: [" + between + "]" + material.pair + "}]}";
}

std::string head(const CellMaterial& material, const Experiment& experiment, const char* between, double end, double output,
                 const std::string& step = "") {
  return "schema: 1\nstudy: " + experiment.name + "\ntitle: \"" + experiment.purpose + "\"\nseed: " + std::to_string(experiment.seed) +
         "\ntime: {end: " + of(end, "s") + ", output: " + of(output, "s") + ", checkpoint: " + of(0.25 * end, "s") + step +
         "}\ncontact: " + contact_text(material, between) + "\n" + "output: {report: false}\nlimits: {overlap: 1 um}\n";
}

std::string trap(const char* type, const Vec3d& center, const std::string& way) {
  return "  on_" + std::string(type) + ": {type: " + type + ", trap: {stiffness: " + of(kTrap, "mN/m") + ", center: " + place(center) +
         way + "}}\n";
}

/// Places of a cubic packing in units of the edge of its cube.
std::vector<Vec3d> cube_of(calibrate::Arrangement lattice) {
  if (lattice == calibrate::Arrangement::kBodyCentred) return {{0, 0, 0}, {0.5, 0.5, 0.5}};
  return {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
}

/// A pair whose first cell is a shell, or a sphere of these keys.
Experiment pair_of(const CellMaterial& material, const std::string& name, double radius_a, double radius_b, double rate,
                   const std::string& sphere, std::uint32_t seed) {
  const double radius = std::min(radius_a, radius_b), gap = material.range;
  const double deepest = std::max(kDeepest, dcm::overlap_of_doublet(material.adhesion, material.tension) + kBeyondRest);
  const double in = (gap + deepest * radius) / rate, out = (deepest - kFarthest) * radius / rate;
  const double output = std::ceil((in + out) / kPairOutputs);
  const std::string sizes =
      number_text("%.4g", radius_a) + (sphere.empty() ? " and " : " um and a shell of ") + number_text("%.4g", radius_b);
  Experiment e{.kind = Experiment::Kind::kPair,
               .seed = seed,
               .name = name,
               .purpose = (sphere.empty() ? "Two cells of " : "A sphere of ") + sizes + " um, pressed together and pulled apart at " +
                          number_text("%.4g", 1e3 * rate) + " nm/s",
               .text = {},
               .radius_a = radius_a,
               .radius_b = radius_b,
               .rate = rate,
               .turn = in};
  const double end = output * std::ceil((in + out) / output), box = 8.0 * (radius_a + radius_b);
  const Vec3d low{0, 0, -radius_a - gap}, high{0, 0, radius_b};
  const std::string way = ", direction: [0, 0, 1], way: [{time: 0 s, distance: 0 um}, {time: " + of(in, "s") +
                          ", distance: " + of(-(gap + deepest * radius), "um") + "}, {time: " + of(in + out, "s") +
                          ", distance: " + of(-gap - kFarthest * radius, "um") + "}]";
  CellMaterial first = material;
  if (!sphere.empty()) first.shell = sphere + ", " + first.shell;
  const std::string none = "0 J/m^2", w = of(material.adhesion, "nN/um");
  e.text = head(material, e, "low, high", end, output) + "domain: {size: " + place({box, box, box}) + ", boundary: open}\ncell_types:\n" +
           type_text(first, "low", radius_a, "low: " + none + ", high: " + w, kOfPairs) +
           type_text(material, "high", radius_b, "high: " + none, kOfPairs) + "initial:\n" + "  - {type: low, at: [" + place(low) +
           "], as: " + (sphere.empty() ? "shell" : "sphere") + "}\n  - {type: high, at: [" + place(high) + "], as: shell}\nloads:\n" +
           trap("low", low, "") + trap("high", high, way);
  e.work = (sphere.empty() ? 2.0 : 1.0) * (end + 1000.0);
  return e;
}

}  // namespace

Experiment pair_experiment(const CellMaterial& material, const std::string& name, double radius_a, double radius_b, double rate) {
  return pair_of(material, name, radius_a, radius_b, rate, "", 1);
}

Experiment mixed_pair_experiment(const CellMaterial& material, const std::string& name, double radius_of_sphere, double radius_of_shell,
                                 const cbm::SphereParameters& sphere, std::uint32_t seed) {
  const auto knot = [](const cbm::PackingKnot& k) {
    return "{packing: " + of(100.0 * k.packing, "%") + ", pressure: " + of(k.pressure, "kPa") + "}";
  };
  const std::string packing = sphere.packing.empty() ? "none" : "{law: knots, knots: [" + joined(sphere.packing.knots(), knot) + "]}";
  const std::string keys = "cbm: {law: jkr, packing: " + packing + ", young: " + of(sphere.young, "kPa") +
                           ", poisson: " + number(sphere.poisson) + ", with_shells: {stiffness: " + number(sphere.with_shells.stiffness) +
                           ", adhesion: " + number(sphere.with_shells.adhesion) + "}}";
  Experiment e = pair_of(material, name, radius_of_sphere, radius_of_shell, mixed_pair_rate(material), keys, seed);
  e.kind = Experiment::Kind::kMixedPair;
  e.with_shells = sphere.with_shells;
  return e;
}

double mixed_pair_rate(const CellMaterial& material) { return 0.5 * kFastest * material.radius; }

Experiment packing_experiment(const CellMaterial& material, calibrate::Arrangement lattice, double time) {
  const bool face_centred = lattice == calibrate::Arrangement::kFaceCentred;
  const std::vector<Vec3d> cube = cube_of(lattice);
  const int cubes = 3;  // no cell may meet another from both sides
  const double free = ball_volume(material.radius);
  const double edge = std::cbrt(static_cast<double>(cube.size()) * free * kLoose), box = cubes * edge;
  Experiment e{.kind = Experiment::Kind::kPacking,
               .arrangement = lattice,
               .name = face_centred ? "packing_fcc" : "packing_bcc",
               .purpose = std::string(face_centred ? "Face" : "Body") +
                          "-centred cubic packing whose box shrinks from 1.35 to 0.7 times the volume of its cells",
               .text = {},
               .radius_a = material.radius,
               .radius_b = material.radius,
               .rate = std::log(kLoose / kTight) / time};
  std::string places;
  for (int x = 0; x < cubes; ++x)
    for (int y = 0; y < cubes; ++y)
      for (int z = 0; z < cubes; ++z)
        for (const Vec3d& p : cube)
          places +=
              (places.empty() ? "" : ", ") +
              place((p + Vec3d{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)} + Vec3d{0.25, 0.25, 0.25}) * edge -
                    Vec3d{0.5, 0.5, 0.5} * box);
  e.text = head(material, e, "cell, cell", time, time / kPackingOutputs) + "domain: {size: " + place({box, box, box}) +
           ", boundary: periodic, course: [{time: 0 s, volume: 1}, {time: " + of(time, "s") + ", volume: " + number(kTight / kLoose) +
           "}]}\ncell_types:\n" + type_text(material, "cell", material.radius, "cell: " + of(material.adhesion, "nN/um"), kOfPackings) +
           "initial:\n  - {type: cell, at: [" + places + "], as: shell}\n";
  e.work = static_cast<double>(cube.size() * static_cast<std::size_t>(cubes * cubes * cubes)) * (time + 1000.0);
  return e;
}

double drag_of(const CellFriction& friction, double radius) { return ball_surface(radius) * friction.medium; }

namespace {

/// How long cells come together: some forty times as long as a pair is guessed to take, δ′ = 2F/drag with F = 0.75 πWR [s].
double time_of_relaxation(const CellMaterial& material) {
  const CellFriction& f = material.friction;
  const double radius = material.radius, way = std::max(kLeastWay * radius, dcm::overlap_of_doublet(material.adhesion, material.tension));
  const double drag = drag_of(f, radius) + kZipped * std::numbers::pi * radius * radius * f.approach;
  return std::ceil(kRelaxationTimes * drag * way / (1.5 * std::numbers::pi * material.adhesion * radius));
}

Friction friction_text(const CellFriction& f) {
  return {of(f.medium, "nN s/um^3"), of(f.approach, "nN s/um^3") + ", cell_cell_tangential: " + of(f.along, "nN s/um^3")};
}

std::string at_text(std::span<const Vec3d> places, const char* body) {
  return "initial:\n  - {type: cell, at: [" + joined(places, place) + "], as: " + body + "}\n";
}

std::vector<Vec3d> places_of_cluster(int cells, double radius, std::uint32_t seed) {
  const double distance = kTouch * radius;
  std::vector<Vec3d> out = cells == 13 ? close_packed_places(1, distance) : cube_of(calibrate::Arrangement::kFaceCentred);
  if (cells < 13)
    for (Vec3d& p : out) p = p * (std::numbers::sqrt2 * distance);
  if (cells > static_cast<int>(out.size())) return ball_of_cells(cells, radius, seed);
  out.resize(static_cast<std::size_t>(cells));
  return out;
}

/// Cells of the type in no box, with the friction of the type.
std::string cluster_text(const CellMaterial& material, const Experiment& e, int cells, double end, const std::string& initial) {
  const double box = 12.0 * material.radius * std::cbrt(static_cast<double>(cells));
  return head(material, e, "cell, cell", end, end / kClusterOutputs) + "domain: {size: " + place({box, box, box}) +
         ", boundary: open}\ncell_types:\n" +
         type_text(material, "cell", material.radius, "cell: " + of(material.adhesion, "nN/um"), friction_text(material.friction)) +
         initial;
}

/// A plate at this height that faces the middle and comes nearer after `from` [s], by `way` [µm] until `to` [s].
std::string plate_text(const char* name, double height, double size, double from, double to, double way) {
  const std::string inwards = height > 0.0 ? "[0, 0, -1]" : "[0, 0, 1]";
  return "  " + std::string(name) + ": {plane: {center: " + place({0, 0, height}) + ", normal: " + inwards + ", size: " + of(size, "um") +
         "}, motion: {direction: " + inwards + ", course: [{time: " + of(from, "s") + ", distance: 0 um}, {time: " + of(to, "s") +
         ", distance: " + of(way, "um") + "}]}}\n";
}

Experiment pressed(const CellMaterial& material, std::uint32_t seed, const char* body) {
  const double radius = material.radius, size = 20.0 * radius * std::cbrt(kPressedCells);
  const std::vector<Vec3d> places = ball_of_cells(kPressedCells, radius, seed);
  double height = 0.0;
  for (const Vec3d& p : places) height = std::max(height, std::abs(p.z) + (1.0 + kClearance) * radius + material.range);
  const double output = std::ceil(kPressTime * time_of_relaxation(material) / kPressedOutputs);
  const double adhere = kAdhereOutputs * output, press = kPressedOutputs * output;
  Experiment e{.kind = Experiment::Kind::kPressed,
               .seed = seed,
               .name = "pressed_cluster_" + std::to_string(seed),
               .purpose = "A ball of " + std::to_string(kPressedCells) + " cells that two plates press flat",
               .text = {},
               .radius_a = radius,
               .radius_b = radius,
               .turn = adhere,
               .pressing = press,
               .way = height - kFlattened * radius * std::cbrt(kPressedCells),
               .friction = material.friction,
               .work = kPressedCells * (adhere + press + 1000.0)};
  const double end = adhere + press;
  e.text = head(material, e, "cell, cell", end, output, ", step: " + of(press / kPressedSteps, "s")) +
           "domain: {size: " + place({size, size, 4.0 * height}) + ", boundary: open}\ngeometry:\n" +
           plate_text("lower", -height, size, adhere, end, e.way) + plate_text("upper", height, size, adhere, end, e.way) +
           "cell_types:\n" +
           type_text(material, "cell", radius, "cell: " + of(material.adhesion, "nN/um") + ", lower: 0 J/m^2, upper: 0 J/m^2",
                     friction_text(material.friction)) +
           at_text(places, body);
  return e;
}

}  // namespace

Experiment relaxation_experiment(const CellMaterial& material, std::uint32_t seed) {
  const double radius = material.radius, end = time_of_relaxation(material), box = 16.0 * radius;
  Experiment e{.kind = Experiment::Kind::kRelaxation,
               .seed = seed,
               .name = "relaxing_pair_" + std::to_string(seed),
               .purpose = "Two cells that touch and come together by themselves",
               .text = {},
               .radius_a = radius,
               .radius_b = radius,
               .friction = material.friction,
               .work = 2.0 * (0.5 * end + 1000.0)};
  const Vec3d places[] = {{0, 0, -radius}, {0, 0, radius}};
  e.text = head(material, e, "cell, cell", end, end / kRelaxationOutputs, ", step: " + of(end / kRelaxationSteps, "s")) +
           "domain: {size: " + place({box, box, box}) + ", boundary: open}\ncell_types:\n" +
           type_text(material, "cell", radius, "cell: " + of(material.adhesion, "nN/um"), friction_text(material.friction)) +
           at_text(places, "shell");
  return e;
}

double time_of_cluster(const CellMaterial& material) { return kClusterTime * time_of_relaxation(material); }

Experiment cluster_experiment(const CellMaterial& material, int cells, std::uint32_t seed) {
  Experiment e{.kind = Experiment::Kind::kCluster,
               .seed = seed,
               .name = "cluster_of_" + std::to_string(cells) + "_" + std::to_string(seed),
               .purpose = std::to_string(cells) + " cells that touch and come together by themselves",
               .text = {},
               .radius_a = material.radius,
               .radius_b = material.radius,
               .friction = material.friction,
               .work = cells * 0.25 * time_of_cluster(material)};
  e.text = cluster_text(material, e, cells, time_of_cluster(material), at_text(places_of_cluster(cells, material.radius, seed), "shell"));
  return e;
}

std::string study_of_spheres_in_cluster(const CellMaterial& material, std::span<const Vec3d> centers) {
  const Experiment e{.kind = Experiment::Kind::kCluster, .name = "spheres", .purpose = "Spheres in a cluster", .text = {}};
  return cluster_text(with_plain_spheres(material), e, static_cast<int>(centers.size()), time_of_cluster(material),
                      at_text(centers, "sphere"));
}

std::string study_of_promotion(const CellMaterial& material) {
  constexpr int kCells = 13;
  const Experiment e{.kind = Experiment::Kind::kCluster, .name = "promotion", .purpose = "A sphere becomes a shell", .text = {}};
  const double time = time_of_cluster(material);
  return cluster_text(with_plain_spheres(material), e, kCells, 2.0 * time,
                      at_text(places_of_cluster(kCells, material.radius, 1), "sphere")) +
         "coupling: {regions: [{name: middle, shape: sphere, center: " + place({}) + ", radius: " + of(0.1 * material.radius, "um") +
         ", margin: " + of(material.radius, "um") + ", as: shell, from: " + of(time, "s") + "}]}\n";
}

Experiment pressed_experiment(const CellMaterial& material, std::uint32_t seed) { return pressed(material, seed, "shell"); }

Experiment pressed_spheres_experiment(const CellMaterial& material, std::uint32_t seed) {
  return pressed(with_plain_spheres(material), seed, "sphere");
}

Experiment random_packing_experiment(const CellMaterial& material, std::uint32_t seed) {
  const double free = ball_volume(material.radius);
  const double edge = std::cbrt(kRandomCells * free * kLoose), end = kRandomStart + kRandomTime;
  Experiment e{.kind = Experiment::Kind::kPacking,
               .arrangement = calibrate::Arrangement::kRandom,
               .seed = seed,
               .name = "packing_random_" + std::to_string(seed),
               .purpose = "Random packing whose box shrinks from 1.35 to 0.7 times the volume of its cells",
               .text = {},
               .held_out = seed > kRandomFitted,
               .radius_a = material.radius,
               .radius_b = material.radius,
               .rate = std::log(kLoose / kTight) / kRandomTime};
  const std::string size = place({edge, edge, edge});
  e.text = head(material, e, "cell, cell", end, kRandomOutput) + "domain: {size: " + size +
           ", boundary: periodic, course: [{time: 0 s, volume: 1}, {time: " + of(kRandomStart, "s") +
           ", volume: 1}, {time: " + of(end, "s") + ", volume: " + number(kTight / kLoose) + "}]}\ncell_types:\n" +
           type_text(material, "cell", material.radius, "cell: " + of(material.adhesion, "nN/um"), kOfPackings) +
           "initial:\n  - {type: cell, count: " + std::to_string(kRandomCells) + ", fill: random, size: " + size +
           ", start_volume: 50 %, inflate: " + of(kInflate, "s") + ", as: shell}\n";
  e.work = kRandomCells * (end + 1000.0);
  return e;
}

std::string study_of_spheres(const CellMaterial& material, std::span<const Vec3d> centers, double edge) {
  const CellMaterial spheres = with_plain_spheres(material);
  const auto inside = [edge](double x) { return x - edge * std::floor(x / edge + 0.5); };
  const std::string places = joined(centers, [&](const Vec3d& c) { return place({inside(c.x), inside(c.y), inside(c.z)}); });
  const Experiment e{.kind = Experiment::Kind::kPacking, .name = "spheres", .purpose = "Spheres in a packing", .text = {}};
  const double end = material.adhesion > 0.0 ? std::max(kLeastRest, kRestTime * time_of_relaxation(material)) : kLeastRest;
  Friction friction = friction_text(material.friction);
  if (material.friction.medium == 0.0) friction.medium = kOfPairs.medium;
  return head(material, e, "cell, cell", end, end) + "domain: {size: " + place({edge, edge, edge}) +
         ", boundary: periodic}\nnumerics: {max_displacement: 1, initial_step: 60 s}\ncell_types:\n" +
         type_text(spheres, "cell", material.radius, "cell: " + of(material.adhesion, "nN/um"), friction) +
         "initial:\n  - {type: cell, at: [" + places + "], as: sphere}\n";
}

namespace {

/// What a calibration does without first when its time is short: the last first. Without its slowest rate a pair still tells the force at no rate, but
/// not whether that is straight; what is held out only judges; without mixed pairs spheres meet shells by their modulus; without packings there is no curve of packing.
enum Dispensable : int {
  kNeeded,
  kFirstPacking,
  kSecondPacking,
  kEqualSlowest,
  kRelaxing,
  kPressedBalls,
  kClusters,
  kMixedPairs,
  kUnequalFaster,
  kHeldOutPacking,
  kUnequalSlowest,
  kLattices
};

/// Clusters to fit to, small ones three times, each with meshes that are turned otherwise; and a pair and a ball that judge.
void add_clusters(const CellMaterial& material, std::vector<Experiment>& out) {
  const auto add = [&](int cells, std::uint32_t seeds, bool held_out) {
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
      out.push_back(cluster_experiment(material, cells, seed));
      out.back().held_out = held_out;
      out.back().dispensable = kClusters;
    }
  };
  add(2, 3, false), add(3, 3, false), add(4, 3, false), add(13, 1, false);
  add(38, 1, true);
}

/// Cells of two radii at all rates, the fastest first.
void add_pairs(const CellMaterial& material, const std::string& name, double ratio, bool held_out, std::vector<Experiment>& out) {
  double rate = kFastest * material.radius;
  for (int k = 1; k <= kPairRates; ++k, rate *= 0.5) {
    out.push_back(pair_experiment(material, name + "_" + std::to_string(k), material.radius, ratio * material.radius, rate));
    out.back().held_out = held_out;
    const bool slowest = k == kPairRates;
    out.back().dispensable = held_out ? (slowest ? kUnequalSlowest : kUnequalFaster) : (slowest ? kEqualSlowest : kNeeded);
  }
}

}  // namespace

std::vector<Experiment> experiments_for(const CellMaterial& material, bool packings) {
  std::vector<Experiment> out;
  add_pairs(material, "equal_pair", 1.0, false, out);
  if (material.adhesion > 0.0 && material.friction.approach > 0.0)
    for (std::uint32_t seed = 1; seed <= kRelaxations; ++seed) {
      out.push_back(relaxation_experiment(material, seed));
      out.back().dispensable = kRelaxing;
    }
  if (packings) {
    if (material.adhesion > 0.0 && material.friction.along > 0.0)
      for (std::uint32_t seed = 1; seed <= kPressedClusters; ++seed) {
        out.push_back(pressed_experiment(material, seed));
        out.back().dispensable = kPressedBalls;
      }
    if (material.adhesion > 0.0 && material.friction.approach > 0.0) add_clusters(material, out);
    for (std::uint32_t seed = 1; seed <= kRandomFitted + kRandomHeldOut; ++seed) {
      out.push_back(random_packing_experiment(material, seed));
      out.back().dispensable = out.back().held_out ? kHeldOutPacking : seed > 1 ? kSecondPacking : kFirstPacking;
    }
    for (const auto lattice : {calibrate::Arrangement::kFaceCentred, calibrate::Arrangement::kBodyCentred}) {
      out.push_back(packing_experiment(material, lattice, kPackingTime));
      out.back().held_out = true;
      out.back().dispensable = kLattices;
    }
  }
  add_pairs(material, "unequal_pair", kUnequalPair, true, out);
  for (Experiment& mixed : mixed_pairs(material)) {
    out.push_back(std::move(mixed));
    out.back().dispensable = kMixedPairs;
  }
  return out;
}

}  // namespace morula::scenarios
