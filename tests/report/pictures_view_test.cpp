// From where a tissue is looked at, where it is cut, and what is drawn beside cells.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "report/pictures/annotate.h"
#include "report/pictures/palette.h"
#include "report/pictures/renderer.h"
#include "report/pictures/smooth.h"
#include "report/pictures/standard_pictures.h"
#include "report/pictures/surroundings.h"
#include "report/pictures/ticks.h"
#include "report/pictures/view.h"
#include "tests/report/pictures_scene.h"

namespace morula::scenarios {
namespace {

using test::add_shell;
using test::add_sphere;

Snapshot grid(int nx, int ny, int nz) {
  Snapshot out;
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z) add_sphere(out, {10.0 * x, 10.0 * y, 10.0 * z}, 5.0);
  return out;
}

Snapshot::Obstacle box(const std::string& name, const Vec3d& low, const Vec3d& high) {
  Snapshot::Obstacle out;
  out.name = name;
  for (int i = 0; i < 8; ++i) out.position.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  out.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
               {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return out;
}

TEST(PicturesView, LayerIsSeenFromAboveAndCutAtItsHeight) {
  const Snapshot layer = grid(6, 6, 1);
  const View view = choose_view(std::span(&layer, 1));
  EXPECT_EQ(view.layout, Layout::kLayer);
  EXPECT_EQ(view.whole.toward.z, 1.0);
  EXPECT_EQ(view.whole.up.y, 1.0);
  EXPECT_EQ(view.whole.right.x, 1.0);
  const auto cut = place_cut(layer, view.cut_normal);
  ASSERT_TRUE(cut);
  EXPECT_NEAR(dot(cut->point, cut->normal), 0.0, 1e-9);
}

TEST(PicturesView, UprightLayerIsSeenFromItsFront) {
  const Snapshot layer = grid(6, 1, 6);
  const View view = choose_view(std::span(&layer, 1));
  EXPECT_EQ(view.layout, Layout::kLayer);
  EXPECT_EQ(view.whole.toward.y, -1.0);
  EXPECT_EQ(view.whole.up.z, 1.0);
  EXPECT_NEAR(norm(cross(view.whole.right, view.whole.up) - view.whole.toward), 0.0, 1e-14);
}

TEST(PicturesView, RowLiesAcrossThePictureAndIsNotCutObliquely) {
  for (const Vec3d along : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}}) {
    Snapshot row;
    for (int i = 0; i < 5; ++i) add_sphere(row, along * (20.0 * i), 6.0);
    const View view = choose_view(std::span(&row, 1));
    EXPECT_EQ(view.layout, Layout::kRow);
    EXPECT_NEAR(std::abs(dot(view.cut.right, along)), 1.0, 1e-12);
    EXPECT_NEAR(norm(view.cut.toward - view.cut_normal), 0.0, 1e-12) << "the cut is seen face to face";
    const auto cut = place_cut(row, view.cut_normal);
    ASSERT_TRUE(cut);
    for (const auto& cell : row.cells) EXPECT_NEAR(dot(cell.centroid - cut->point, cut->normal), 0.0, 1e-9) << "through every cell";
  }
}

TEST(PicturesView, BallIsSeenFromTheSide) {
  const Snapshot ball = grid(4, 4, 4);
  const View view = choose_view(std::span(&ball, 1));
  EXPECT_EQ(view.layout, Layout::kBall);
  EXPECT_EQ(norm(view.cut.toward - view.cut_normal), 0.0) << "the cut is seen face to face";
  EXPECT_GT(dot(view.whole.toward, view.cut_normal), 0.0);
  EXPECT_GT(view.whole.toward.z, 0.1) << "a little from above";
}

TEST(PicturesView, BallBetweenPlatesIsSeenFromTheFrontSoThatNoPlateHidesIt) {
  Snapshot snapshot;
  add_sphere(snapshot, {}, 6.0);
  snapshot.obstacles = {box("upper", {-20, -20, 6}, {20, 20, 10}), box("lower", {-20, -20, -10}, {20, 20, -6})};
  const std::vector<Picture> pictures = standard_pictures(std::span(&snapshot, 1));
  ASSERT_EQ(pictures[0].name, "cells_00");
  const Image& image = pictures[0].image;
  int blue = 0;  // of the cell, across its middle
  for (int x = 0; x < image.width; ++x) blue += image.at(x, image.height / 2).b - image.at(x, image.height / 2).r > 0.15f;
  EXPECT_EQ(choose_view(std::span(&snapshot, 1)).whole.toward.z, 0.0);
  EXPECT_GT(blue, static_cast<int>(0.5 * image.height));
}

TEST(PicturesView, CutThatMeetsNoCellIsMovedOrLeftOut) {
  Snapshot two;  // nothing lies half way between them
  add_sphere(two, {0, -20, 0}, 6.0);
  add_sphere(two, {0, 20, 0}, 6.0);
  const auto cut = place_cut(two, {0, 1, 0});
  ASSERT_TRUE(cut);
  EXPECT_NEAR(std::abs(dot(cut->point, cut->normal)), 20.0, 1.0) << "moved to the middle of a cell";
  EXPECT_FALSE(place_cut(Snapshot{}, {0, 1, 0}));
  const Snapshot none;
  for (const Picture& picture : standard_pictures(std::span(&none, 1))) EXPECT_EQ(picture.name.find("cut"), std::string::npos);
}

TEST(PicturesView, PictureIsAsWideAsTheTissue) {
  Snapshot row;
  for (int i = 0; i < 5; ++i) add_sphere(row, {20.0 * i, 0, 0}, 6.0);
  EXPECT_EQ(aspect_of(make_camera(0.0, 0.0), std::span(&row, 1)), 0.25);  // 12 µm high, 92 µm wide: no flatter than that
  const Snapshot ball = grid(2, 2, 2);
  EXPECT_NEAR(aspect_of(make_camera(0.0, 0.0), std::span(&ball, 1)), 1.0, 1e-12);
}

/// Largest distance of the surface of all faces from the unit sphere, at the middles of faces and edges.
double roundness(const Snapshot& s) {
  double worst = 0.0;
  for (const Triangle& f : s.topologies[0]) {
    const Vec3d &a = s.nodes[f[0]], &b = s.nodes[f[1]], &c = s.nodes[f[2]];
    for (const Vec3d& p : {(a + b + c) / 3.0, (a + b) / 2.0, (b + c) / 2.0}) worst = std::max(worst, std::abs(norm(p) - 1.0));
  }
  return worst;
}

TEST(PicturesSmooth, CoarseBallBecomesRoundAndStaysClosed) {
  Snapshot coarse;
  add_sphere(coarse, {}, 1.0);
  coarse.cells[0].body = BodyKind::kShell;
  const auto [x, faces] = test::icosphere(1);
  coarse.topologies = {faces};
  coarse.shells = {{0, 0, static_cast<std::uint32_t>(x.size()), 0}};
  coarse.nodes = x;
  coarse.face_marks.assign(faces.size(), 0);
  coarse.face_marks[7] = 1;
  const Snapshot fine = smoothed(coarse, 4);
  EXPECT_EQ(fine.topologies[0].size(), 16 * faces.size());
  EXPECT_EQ(std::count(fine.face_marks.begin(), fine.face_marks.end(), 1), 16);
  EXPECT_GT(roundness(coarse), 0.05);
  // A sixteenth of the coarse sag is left between the small faces, and a tenth is the error of a cubic patch over 36 degrees.
  EXPECT_LT(roundness(fine), 0.2 * roundness(coarse));
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;  // every edge once in each direction: closed and oriented
  for (const Triangle& f : fine.topologies[0])
    for (std::size_t c = 0; c < 3; ++c) ++edges[{f[c], f[(c + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(norm(fine.nodes[i] - x[i]), 0.0) << "the nodes themselves stay";
}

RenderOptions from_front(const Snapshot& snapshot, bool cut) {
  RenderOptions options;
  options.width = options.height = 200;
  options.samples = 1;
  options.annotations = options.outlines = false;
  options.camera = make_camera(0.0, 0.0);
  options.camera.pixels_per_um = 5.0;
  if (cut) options.cut = place_cut(snapshot, options.camera.toward);
  return options;
}

constexpr Rgb kPaper{1.0f, 1.0f, 1.0f};
bool grey(const Rgb& c) { return std::abs(c.r - c.b) < 0.12f && c.r < 0.95f; }

TEST(PicturesSurroundings, PlateIsSeenBesideACellBehindAndBeforeIt) {
  Snapshot snapshot;
  add_sphere(snapshot, {}, 6.0);
  snapshot.obstacles = {box("plate", {-12, -12, -10}, {12, 12, -6})};
  for (const bool cut : {false, true}) {
    const Image image = render(snapshot, from_front(snapshot, cut));
    EXPECT_TRUE(grey(image.at(100, 100 + 40))) << "8 µm below the middle";
    EXPECT_TRUE(grey(image.at(50, 100 + 40))) << "and 10 µm to the left";
    EXPECT_EQ(image.at(100, 100 - 60), kPaper);
  }
  snapshot.obstacles[0].offset = {0, 0, 30};  // it has moved
  const Image moved = render(snapshot, from_front(snapshot, false));
  EXPECT_EQ(moved.at(100, 100 + 40), kPaper);
  // A cell behind a plate is still seen through it.
  snapshot.obstacles = {box("before", {-12, -20, -12}, {12, -16, 12})};
  const Image through = render(snapshot, from_front(snapshot, false));
  const Rgb cell = through.at(100, 100), plate = through.at(50, 100);
  EXPECT_GT(cell.b - cell.r, 0.1f) << "the blue of the first type";
  EXPECT_TRUE(grey(plate));
}

/// A wall of the domain is a surface without thickness: seen along itself it would not be there.
TEST(PicturesSurroundings, AWallThatIsSeenEdgeOnIsALine) {
  Snapshot snapshot;
  add_sphere(snapshot, {}, 6.0);
  snapshot.obstacles = {{"wall z low", {}, {{-20, -20, -6}, {20, -20, -6}, {20, 20, -6}, {-20, 20, -6}}, {{0, 1, 2}, {0, 2, 3}}}};
  for (const bool cut : {false, true}) {
    const Image image = render(snapshot, from_front(snapshot, cut));
    EXPECT_TRUE(grey(image.at(50, 100 + 31))) << "just below the cell, " << cut;
    EXPECT_EQ(image.at(50, 100 + 27), kPaper) << "above it";
    EXPECT_EQ(image.at(50, 100 + 40), kPaper) << "below it";
  }
}

TEST(PicturesSurroundings, SidesOfAPlateAreFlatAndTubesRound) {
  Snapshot snapshot;
  add_sphere(snapshot, {0, 0, 40}, 1.0);  // away from what is looked at
  snapshot.obstacles = {box("plate", {-12, -12, -10}, {12, 12, -6})};
  RenderOptions options = from_front(snapshot, false);
  options.camera = make_camera(0.0, 0.6);
  options.camera.pixels_per_um = 4.0;
  options.camera.center = {0, 0, -6};
  const Image plate = render(snapshot, options);
  for (const int x : {70, 100, 130})
    for (const int y : {80, 100, 118})
      EXPECT_EQ(plate.at(x, y), plate.at(100, 90)) << x << ' ' << y << ": one grey all over its upper side";
  EXPECT_NE(plate.at(100, 134), plate.at(100, 90)) << "and another one at its front, 12 µm towards the eye";
  Snapshot::Obstacle tube;  // 24 sides around z, without ends
  tube.name = "tube";
  for (int i = 0; i < 24; ++i)
    for (const double z : {-20.0, 20.0}) {
      const double angle = 2.0 * std::numbers::pi * i / 24.0;
      tube.position.push_back({10.0 * std::cos(angle), 10.0 * std::sin(angle), z});
    }
  for (std::uint32_t i = 0; i < 24; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % 24);
    tube.faces.push_back({a, b, a + 1});
    tube.faces.push_back({b, b + 1, a + 1});
  }
  snapshot.obstacles = {tube};
  options.camera = make_camera(0.0, 0.0);
  options.camera.pixels_per_um = 8.0;
  const Image round = render(snapshot, options);
  // Facets would be bands of one grey, 20 pixels wide in the middle.
  float largest = 0.0f;
  for (int x = 105; x < 150; ++x) largest = std::max(largest, std::abs(round.at(x + 1, 100).r - round.at(x, 100).r));
  EXPECT_LT(largest, 0.0065f) << "no step between two sides: those of 15 degrees would be 0.009 and 0.018";
  EXPECT_NE(round.at(105, 100), round.at(145, 100));
}

TEST(PicturesSurroundings, ContainerDoesNotHideWhatIsInIt) {
  Snapshot snapshot;
  add_sphere(snapshot, {}, 6.0);
  const Image alone = render(snapshot, from_front(snapshot, false));
  snapshot.obstacles = {box("mould", {-15, -15, -15}, {15, 15, 15})};
  const Image within = render(snapshot, from_front(snapshot, false));
  EXPECT_EQ(within.at(100, 100), alone.at(100, 100));
  EXPECT_TRUE(grey(within.at(40, 100))) << "its far side is seen";
}

TEST(PicturesSurroundings, CavityIsFilledWithFluidInTheCut) {
  Snapshot ring;  // closed in the plane of the cut
  for (int i = 0; i < 12; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 12.0;
    add_sphere(ring, {12.0 * std::cos(angle), 0.0, 12.0 * std::sin(angle)}, 4.0);
  }
  ring.lumens = {{"cavity", {}, 1500.0, 0.0}};
  const Image image = render(ring, from_front(ring, true));
  const auto near = [](const Rgb& a, const Rgb& b) { return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) < 0.02f; };
  EXPECT_TRUE(near(image.at(100, 100), kFluidColor));
  EXPECT_TRUE(near(image.at(100, 70), kFluidColor)) << "up to the cells";
  EXPECT_EQ(image.at(5, 5), kPaper) << "and not outside";
  // A gap in the ring: a disc of the cavity's volume, radius 7.1 µm.
  ring.cells.erase(ring.cells.begin());
  const Image open = render(ring, from_front(ring, true));
  EXPECT_TRUE(near(open.at(100, 100), kFluidColor));
  EXPECT_EQ(open.at(195, 100), kPaper);
  EXPECT_EQ(surroundings_legend(ring, true).back().text, "fluid of cavity");
}

TEST(PicturesColours, OneColourHasOneMeaning) {
  const auto apart = [](const Rgb& a, const Rgb& b) { return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b); };
  for (std::size_t type = 0; type < 7; ++type) {
    for (const bool shell : {false, true}) EXPECT_GT(apart(categorical_color(type), body_color(shell)), 0.25f) << type;
    for (std::size_t mark = 0; mark < 6; ++mark) EXPECT_GT(apart(categorical_color(type), mark_color(mark)), 0.2f) << type << ' ' << mark;
    EXPECT_GT(apart(categorical_color(type), kFluidColor), 0.25f);
  }
}

TEST(PicturesColours, TypesTakeTheColoursTheyAreGiven) {
  Snapshot snapshot;
  add_sphere(snapshot, {}, 5.0);
  snapshot.type_names = {"liver"};
  const TypeColors given{color_of_text("#d55e00")};
  ASSERT_TRUE(given[0]);
  EXPECT_EQ(legend_entries(snapshot, ColorBy::kType, given)[0].color, *given[0]);
  EXPECT_EQ(*color_of_text("vermilion"), *given[0]);
  for (const char* wrong : {"", "red!", "#d55e0", "#d55e0g", "d55e00"}) EXPECT_FALSE(color_of_text(wrong)) << wrong;
}

TEST(PicturesColours, ScaleKnowsTheRangeOfItsData) {
  Snapshot snapshot;
  for (int i = 0; i < 200; ++i) add_sphere(snapshot, {}, 5.0), snapshot.cells.back().pressure = 0.001 * i;
  snapshot.cells.back().pressure = 5.0;  // beyond the 99th percentile
  const ColorScale scale = common_scale(std::span(&snapshot, 1), ColorBy::kPressure);
  EXPECT_LT(scale.high, 1.0);
  EXPECT_EQ(scale.data_high, 5.0);
  EXPECT_EQ(scale.data_low, 0.0);
}

TEST(PicturesColours, PressureBelowZeroIsBlueAndZeroWhiteAlsoWhereNoneIsAbove) {
  Snapshot snapshot;
  for (const double pressure : {-0.0047, -0.001, 0.0}) add_sphere(snapshot, {}, 5.0), snapshot.cells.back().pressure = pressure;
  const ColorScale scale = common_scale(std::span(&snapshot, 1), ColorBy::kPressure);
  EXPECT_TRUE(scale.diverging);
  EXPECT_EQ(scale.low, -scale.high);
  const Rgb tension = scale_color(scale, -0.0047), none = scale_color(scale, 0.0);
  EXPECT_GT(tension.b - tension.r, 0.3f);
  EXPECT_NEAR(none.r, none.b, 0.01f);
}

TEST(PicturesColours, ScaleOfOneValueStartsAtZeroAndIsRound) {
  Snapshot snapshot;
  add_sphere(snapshot, {}, 5.0);
  snapshot.cells[0].pressure = 0.0999;
  const ColorScale scale = common_scale(std::span(&snapshot, 1), ColorBy::kPressure);
  EXPECT_EQ(scale.low, 0.0);
  EXPECT_NEAR(scale.high, 0.1, 1e-12);
}

/// What a solver leaves of no pressure at all is no picture of yellow and violet cells.
TEST(PicturesColours, RoundingHasNoScaleOfItsOwn) {
  Snapshot snapshot;
  for (const double pressure : {0.0, 3.5e-25, -1e-25}) add_sphere(snapshot, {}, 5.0), snapshot.cells.back().pressure = pressure;
  const ColorScale scale = common_scale(std::span(&snapshot, 1), ColorBy::kPressure);
  EXPECT_EQ(scale.low, 0.0);
  EXPECT_DOUBLE_EQ(scale.high * scale.per_unit, 1.0);
  EXPECT_EQ(scale.unit, "Pa");
}

TEST(PicturesText, UnitsReadAsPeopleWriteThem) {
  EXPECT_EQ(display_text("<= 0.3 um"), "<= 0.3 µm");
  EXPECT_EQ(display_text("um^2"), "µm²");
  EXPECT_EQ(display_text("nN um"), "nN µm");
  EXPECT_EQ(display_text("tension 30 uN/m"), "tension 30 µN/m");
  EXPECT_EQ(display_text("angle [deg]"), "angle [°]");
  EXPECT_EQ(display_text("number, umbrella, um_x, maximum, degree"), "number, umbrella, um_x, maximum, degree");
}

TEST(Ticks, OfValuesThatDifferInTheirLastDigitsAreAFewAroundThem) {
  for (const double value : {20.0, -3e-9, 7e250}) {
    const double next = std::nextafter(value, 2.0 * value);
    const Ticks found = linear_ticks(std::min(value, next), std::max(value, next), 7, true);
    EXPECT_LT(found.low, value);
    EXPECT_GT(found.high, value);
    EXPECT_GE(found.at.size(), 2u) << value;
    EXPECT_LE(found.at.size(), 20u) << value;
  }
}

TEST(PicturesTicks, TimesAreThoseOfClocks) {
  EXPECT_EQ(time_ticks(0, 24, 7, "h").at, (std::vector<double>{0, 6, 12, 18, 24}));
  EXPECT_EQ(time_ticks(0, 4, 7, "h").at, (std::vector<double>{0, 1, 2, 3, 4}));
  EXPECT_EQ(time_ticks(0, 90, 7, "min").at, (std::vector<double>{0, 15, 30, 45, 60, 75, 90}));
  EXPECT_EQ(time_ticks(0, 10, 7, "s").at, linear_ticks(0, 10, 7, false).at);
}

}  // namespace
}  // namespace morula::scenarios
