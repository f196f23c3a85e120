/// New shells find their shape among the cells within reach alone (decision 0042).
#include "coupling/settle_shells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "cbm/packing.h"
#include "core/close_packing.h"
#include "core/mesh/primitives.h"
#include "coupling/mechanics/relax.h"
#include "coupling/neighbourhoods.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

using test::clusters_model;
using test::make_tissue;

constexpr double kSpacing = 11.2;  // of cells of radius 6: spheres overlap, and shells that begin as balls, too [µm]

using Bodies = std::function<BodyKind(std::size_t, const Vec3d&)>;

/// A tissue before its new shells settle. Those are balls in the places of cells.
struct Settlement {
  Model model = clusters_model();
  ShapeLibrary shapes;
  Tissue tissue;
  std::vector<CellId> fresh;

  void fill(const std::vector<Vec3d>& places, std::vector<std::size_t> new_shells, const Bodies& others) {
    std::ranges::sort(new_shells);
    std::vector<BodyKind> bodies;
    for (std::size_t i = 0; i < places.size(); ++i)
      bodies.push_back(std::ranges::binary_search(new_shells, i) ? BodyKind::kShell : others(i, places[i]));
    tissue = make_tissue(model, shapes, places, bodies);
    tissue.clock.steps = 1;
    tissue.obstacle_offset.resize(model.obstacles.size());
    for (const std::size_t i : new_shells) fresh.push_back(CellId::founder(i + 1));
  }
  [[nodiscard]] std::size_t shell_of(CellId id) const {
    for (const BodyOfRow& body : bodies_of(tissue.cells))
      if (body.is_shell && tissue.cells.rows[body.row].id == id) return body.number;
    return tissue.shells.size();
  }
  [[nodiscard]] Mechanics mechanics() { return Mechanics(model, contact_obstacles(model).value(), shapes, Comm(), 1); }

  /// Nodes of the new shells after they settled, one after the other.
  [[nodiscard]] std::vector<Vec3d> settled(std::vector<CellId> which = {}) {
    if (which.empty()) which = fresh;
    Tissue copy = tissue;
    const Mechanics of_tissue = mechanics();
    const Settled done = settle_shells(copy, of_tissue, model, shapes, Comm(), which, true);
    EXPECT_TRUE(done.no_room.empty());
    EXPECT_FALSE(done.overlap_is_left);
    return nodes_of(copy, which);
  }
  /// The same in the scene of the whole tissue.
  [[nodiscard]] std::vector<Vec3d> settled_in_all() {
    Tissue copy = tissue;
    std::vector<char> moves(copy.cells.size(), 0);
    const auto is_fresh = [&](const BodyOfRow& body) { return std::ranges::binary_search(fresh, copy.cells.rows[body.row].id); };
    for (const BodyOfRow& body : bodies_of(copy.cells)) moves[body.place(copy.shells.size())] = is_fresh(body);
    Mechanics of_tissue = mechanics();
    EXPECT_LT(of_tissue.relax(copy, moves), kOverlapAtRest);
    for (const BodyOfRow& body : bodies_of(copy.cells))
      if (is_fresh(body)) {
        const std::size_t s = body.number;
        set_enclosed_volume(copy.shells.topology(s), copy.shells.nodes(s), copy.shells.rest_volume[s]);
      }
    return nodes_of(copy, fresh);
  }
  [[nodiscard]] static std::vector<Vec3d> nodes_of(const Tissue& tissue, const std::vector<CellId>& which) {
    std::vector<Vec3d> out;
    for (const CellId id : which)
      for (const BodyOfRow& body : bodies_of(tissue.cells))
        if (tissue.cells.rows[body.row].id == id) {
          const auto nodes = tissue.shells.nodes(body.number);
          out.insert(out.end(), nodes.begin(), nodes.end());
        }
    return out;
  }
};

double furthest(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, norm(a[i] - b[i]));
  return most;
}

constexpr auto kAllSpheres = [](std::size_t, const Vec3d&) { return BodyKind::kSphere; };

/// What lies out of reach adds nothing to any force; what is left is the order in which the solver's single-precision numbers are added up.
constexpr double kSame = 1e-5;  // [µm]

TEST(SettleShells, AmongSpheresAsInTheWholeTissue) {
  Settlement s;
  s.fill(close_packed_places(3, kSpacing), {0}, kAllSpheres);
  const auto here = s.settled();
  EXPECT_LT(furthest(here, s.settled_in_all()), kSame);
  EXPECT_GT(furthest(here, Settlement::nodes_of(s.tissue, s.fresh)), 0.1);
}

TEST(SettleShells, AmongSpheresThatResistTheirPackingAsInTheWholeTissue) {
  Settlement s;
  s.model.types[0].sphere.packing = cbm::PackingCurve::through(cbm::ideal_filled_cell(2.5, 0.45, 0.4).value()).value();
  s.fill(close_packed_places(4, 10.7), {0}, kAllSpheres);  // more than space holds without it
  EXPECT_LT(furthest(s.settled(), s.settled_in_all()), kSame);
}

TEST(SettleShells, AmongShellsAndSpheresAsInTheWholeTissue) {
  Settlement s;
  s.fill(close_packed_places(2, kSpacing), {0},
         [](std::size_t, const Vec3d& x) { return x.x > 1.0 ? BodyKind::kShell : BodyKind::kSphere; });
  EXPECT_LT(furthest(s.settled(), s.settled_in_all()), kSame);
}

TEST(SettleShells, AtAnObstacleAsInTheWholeTissue) {
  Settlement s;
  const TriangleMesh mesh = make_box({80, 80, 4}, 8.0).value();
  s.model.obstacles = {{"plate", mesh.position, mesh.faces, false, {}}};
  for (Vec3d& x : s.model.obstacles[0].position) x += Vec3d{0, 0, -7.5};  // its upper side is at −5.5, half a micrometre within the cells
  s.model.pairs.assign(4, ContactPair{0.1, 50.0, 50.0});
  std::vector<Vec3d> places = close_packed_places(3, kSpacing);
  std::erase_if(places, [](const Vec3d& x) { return x.z < -1.0; });
  s.fill(places, {0}, kAllSpheres);
  const auto here = s.settled();
  EXPECT_LT(furthest(here, s.settled_in_all()), kSame);
  for (const Vec3d& x : here) EXPECT_GT(x.z, -5.5 - 0.1);
}

TEST(SettleShells, AcrossAPeriodicFaceAsInTheMiddle) {
  const double edge = 8.0 * kSpacing / std::numbers::sqrt2;  // the lattice goes on through the faces
  const auto settled_at = [&](const Vec3d& shift) {
    Settlement s;
    s.model.space.box = {{-0.5 * edge, -0.5 * edge, -0.5 * edge}, {0.5 * edge, 0.5 * edge, 0.5 * edge}};
    for (auto& axis : s.model.space.boundary) axis = {BoundaryKind::kPeriodic, BoundaryKind::kPeriodic};
    std::vector<Vec3d> places = close_packed_places(4, kSpacing);
    std::erase_if(places, [](const Vec3d& x) { return std::max({x.x, x.y, x.z}) > 31.0; });  // the images of the other side
    for (Vec3d& x : places) x = s.model.space.wrapped(x + shift);
    s.fill(places, {0}, kAllSpheres);
    auto nodes = s.settled();
    for (Vec3d& x : nodes) x -= places[0];
    return nodes;
  };
  const auto middle = settled_at({0.1, 0.1, 0.1}), corner = settled_at({0.5 * edge - 0.1, 0.1, 0.5 * edge - 0.1});
  // The order along the curve is another, so that sums run otherwise.
  EXPECT_LT(furthest(middle, corner), 1e-4);
  double longest = 0.0;
  for (const Vec3d& x : middle) longest = std::max(longest, norm(x));
  EXPECT_GT(longest, 6.1);
}

TEST(SettleShells, TwoNeighbourhoodsAtOnceAsEachAlone) {
  Settlement s;
  std::vector<Vec3d> places = close_packed_places(3, kSpacing);
  const std::size_t count = places.size();
  for (std::size_t i = 0; i < count; ++i) places.push_back(places[i] + Vec3d{70, 3, 5});
  s.fill(places, {0, count}, kAllSpheres);
  const auto both = s.settled();
  for (const std::size_t which : {std::size_t{0}, std::size_t{1}}) {
    const auto alone = s.settled({s.fresh[which]});
    const auto first = both.begin() + static_cast<std::ptrdiff_t>(which * alone.size());
    EXPECT_TRUE(std::equal(alone.begin(), alone.end(), first)) << which;
  }
}

TEST(SettleShells, NeighboursTogetherAsInTheWholeTissue) {
  Settlement s;
  s.fill(close_packed_places(3, kSpacing), {0, 1, 2}, kAllSpheres);
  EXPECT_LT(furthest(s.settled(), s.settled_in_all()), kSame);
}

TEST(SettleShells, LeavesAllOthersAsTheyAre) {
  Settlement s;
  s.fill(close_packed_places(2, kSpacing), {0},
         [](std::size_t i, const Vec3d&) { return i % 2 == 0 ? BodyKind::kShell : BodyKind::kSphere; });
  for (Vec3f& v : s.tissue.spheres.velocity) v = {1e-3f, 0, 0};
  Tissue after = s.tissue;
  const Mechanics mechanics = s.mechanics();
  (void)settle_shells(after, mechanics, s.model, s.shapes, Comm(), s.fresh, true);
  EXPECT_EQ(after.spheres.position, s.tissue.spheres.position);
  EXPECT_EQ(after.clock.time, s.tissue.clock.time);
  for (const Vec3f& v : after.spheres.velocity) EXPECT_EQ(v.x, 1e-3f);
  std::size_t changed = 0;
  for (std::size_t k = 0; k < after.shells.size(); ++k)
    changed += !std::ranges::equal(std::as_const(after.shells).nodes(k), std::as_const(s.tissue.shells).nodes(k));
  EXPECT_EQ(changed, 1u);
}

TEST(Neighbourhoods, HoldWhatCanBeTouchedAndNothingElse) {
  Settlement s;
  s.fill(close_packed_places(3, kSpacing), {0}, kAllSpheres);
  const Reach reach{0.3, 0.25, false};
  const auto found = find_neighbourhoods(s.tissue, s.model.space, s.fresh, reach, Comm());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].movers, s.fresh);
  const double near = 12.0, far = 2.0 * (6.0 + std::numbers::sqrt3 * (6.0 + 3.3));  // boxes are larger than balls
  for (const CellRow& row : s.tissue.cells.rows) {
    const auto number = static_cast<std::size_t>(&row - s.tissue.cells.rows.data());
    const Vec3d at = close_packed_places(3, kSpacing)[row.id.bits() == 0 ? 0 : static_cast<std::size_t>(row.id.founder_number()) - 1];
    const bool in = std::ranges::binary_search(found[0].rows, number);
    if (norm(at) < near) {
      EXPECT_TRUE(in) << row.id.text();
    } else if (norm(at) > far) {
      EXPECT_FALSE(in) << row.id.text();
    }
  }
}

TEST(Neighbourhoods, OfCellsThatPressOnTheSameSphereAreOne) {
  Settlement s;
  // Three in a row: the outer two touch the middle one, which is packed by both.
  s.fill({{0, 0, 0}, {kSpacing, 0, 0}, {2 * kSpacing, 0, 0}, {3 * kSpacing, 0, 0}, {100, 0, 0}}, {0, 2}, kAllSpheres);
  EXPECT_EQ(find_neighbourhoods(s.tissue, s.model.space, s.fresh, {0.3, 0.1, false}, Comm()).size(), 2u);
  const auto packed = find_neighbourhoods(s.tissue, s.model.space, s.fresh, {0.3, 0.1, true}, Comm());
  ASSERT_EQ(packed.size(), 1u);
  EXPECT_EQ(packed[0].rows.size(), 4u);
}

/// The middle shell of a packing is pressed to 92 % along an axis: its nodes are in no balance, as those of a new daughter.
Settlement with_a_pressed_shell(std::vector<Vec3d> places = close_packed_places(2, 11.9)) {
  Settlement s;
  s.fill(places, {0}, [](std::size_t, const Vec3d& p) { return norm(p) < 15.0 ? BodyKind::kShell : BodyKind::kSphere; });
  for (Vec3d& p : s.tissue.shells.nodes(s.shell_of(s.fresh.front()))) p = {p.x / std::sqrt(0.92), p.y / std::sqrt(0.92), 0.92 * p.z};
  return s;
}

TEST(SettleDaughters, MovesNobodyElseAndLeavesThemAStepAsLongAsThatOfTheTissue) {
  constexpr double kStep = 60.0;
  Settlement s = with_a_pressed_shell(close_packed_places(2, 14.0));  // others that would not rest would say nothing of this one
  Tissue after = s.tissue;
  settle_daughters(after, s.mechanics(), s.model, s.shapes, Comm(), s.fresh, kStep);
  EXPECT_EQ(after.clock.time, s.tissue.clock.time);
  EXPECT_EQ(after.spheres.position, s.tissue.spheres.position);
  for (std::size_t shell = 0; shell < after.shells.size(); ++shell) {
    if (shell == s.shell_of(s.fresh.front())) continue;
    EXPECT_TRUE(std::ranges::equal(std::as_const(after.shells).nodes(shell), std::as_const(s.tissue.shells).nodes(shell))) << shell;
  }
  EXPECT_GT(furthest(Settlement::nodes_of(after, s.fresh), Settlement::nodes_of(s.tissue, s.fresh)), 0.2);
  const auto nodes_go = [&](Tissue tissue) {
    const std::vector<Vec3d> before = Settlement::nodes_of(tissue, s.fresh);
    const std::vector<Vec3d> none(Mechanics::external_size(tissue));
    Mechanics mechanics = s.mechanics();
    if (!mechanics.step(tissue, kStep, none)) return std::numeric_limits<double>::infinity();  // refused
    return furthest(Settlement::nodes_of(tissue, s.fresh), before);
  };
  const double allowed = s.model.step.max_displacement * s.model.contact.range;
  EXPECT_GT(nodes_go(s.tissue), 4.5 * allowed) << "a step that the tissue would not take";
  EXPECT_LT(nodes_go(after), 4.5 * allowed);
}

TEST(SettleDaughters, FindTheSameWhateverElseThereIs) {
  Settlement near = with_a_pressed_shell();
  std::vector<Vec3d> places = close_packed_places(2, 11.9);
  places.push_back({200, 0, 0});
  Settlement more = with_a_pressed_shell(places);
  settle_daughters(near.tissue, near.mechanics(), near.model, near.shapes, Comm(), near.fresh, 60.0);
  settle_daughters(more.tissue, more.mechanics(), more.model, more.shapes, Comm(), more.fresh, 60.0);
  EXPECT_EQ(Settlement::nodes_of(near.tissue, near.fresh), Settlement::nodes_of(more.tissue, more.fresh));
}

}  // namespace
}  // namespace morula
