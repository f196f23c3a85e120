#include <gtest/gtest.h>

#include <numbers>

#include "report/pictures/annotate.h"
#include "report/pictures/rasterize.h"
#include "report/pictures/renderer.h"
#include "report/pictures/standard_pictures.h"
#include "tests/report/pictures_scene.h"

namespace morula::scenarios {
namespace {

using test::add_shell;
using test::add_sphere;

constexpr double kPi = std::numbers::pi;

Camera straight(double pixels_per_um) {
  Camera camera = make_camera(0.0, 0.0);
  camera.pixels_per_um = pixels_per_um;
  return camera;
}

double count(const PixelBuffer& pixels, std::int32_t surface) {
  return static_cast<double>(std::count(pixels.surface.begin(), pixels.surface.end(), surface));
}

TEST(PicturesGeometry, SphereCoversTheAreaOfItsDisc) {
  Snapshot snapshot;
  add_sphere(snapshot, {1.0, 2.0, -0.5}, 6.0);
  PixelBuffer pixels(400, 400);
  rasterize(snapshot, straight(20.0), std::nullopt, pixels);
  EXPECT_NEAR(count(pixels, 0), kPi * 36.0 * 400.0, 0.01 * kPi * 36.0 * 400.0);
}

TEST(PicturesGeometry, ShellCoversTheAreaOfItsDisc) {
  Snapshot snapshot;
  add_shell(snapshot, {1.0, 2.0, -0.5}, 6.0);
  PixelBuffer pixels(400, 400);
  rasterize(snapshot, straight(20.0), std::nullopt, pixels);
  EXPECT_NEAR(count(pixels, 0), kPi * 36.0 * 400.0, 0.01 * kPi * 36.0 * 400.0);
}

TEST(PicturesGeometry, DepthAndNormalOfASphereAreThoseOfTheFormula) {
  Snapshot snapshot;
  add_sphere(snapshot, {0.0, 3.0, 0.0}, 5.0);
  PixelBuffer pixels(201, 201);
  rasterize(snapshot, straight(10.0), std::nullopt, pixels);
  const std::size_t i = pixels.index(100 + 30, 100);  // 3 µm to the right of the centre; the eye looks along +y
  EXPECT_NEAR(pixels.depth[i], -3.0 + 4.0, 1e-5);
  EXPECT_NEAR(pixels.normal_x[i] / 32767.0, 0.6, 1e-4);
  EXPECT_NEAR(pixels.normal_y[i] / 32767.0, 0.0, 1e-4);
}

TEST(PicturesGeometry, CutAboveTheCentreLeavesADiscOfTheRightArea) {
  for (const bool shell : {false, true}) {
    Snapshot snapshot;
    shell ? add_shell(snapshot, {}, 6.0) : add_sphere(snapshot, {}, 6.0);
    PixelBuffer pixels(400, 400);
    rasterize(snapshot, straight(20.0), CutPlane{{0.0, -3.0, 0.0}, {0.0, -1.0, 0.0}}, pixels);
    const double disc = kPi * (36.0 - 9.0) * 400.0;
    EXPECT_NEAR(count(pixels, 1), disc, 0.01 * disc) << (shell ? "shell" : "sphere");
    EXPECT_NEAR(count(pixels, 0), kPi * 36.0 * 400.0 - disc, 0.02 * disc) << (shell ? "shell" : "sphere");
  }
}

TEST(PicturesGeometry, ObliqueCutIsForeshortenedByItsCosine) {
  for (const bool shell : {false, true}) {
    Snapshot snapshot;
    shell ? add_shell(snapshot, {}, 6.0) : add_sphere(snapshot, {}, 6.0);
    PixelBuffer pixels(400, 400);
    const double angle = 0.6;
    rasterize(snapshot, straight(20.0), CutPlane{{}, {std::sin(angle), -std::cos(angle), 0.0}}, pixels);
    const double ellipse = kPi * 36.0 * 400.0 * std::cos(angle);
    EXPECT_NEAR(count(pixels, 1), ellipse, 0.01 * ellipse) << (shell ? "shell" : "sphere");
  }
}

/// Two shells side by side; marks by face: of the first none, of the second `mark` on the upper half.
Snapshot half_marked(std::uint8_t mark) {
  Snapshot snapshot;
  add_shell(snapshot, {-8.0, 0.0, 0.0}, 6.0);
  add_shell(snapshot, {8.0, 0.0, 0.0}, 6.0);
  snapshot.mark_names = {"basal", "apical"};
  for (const Snapshot::Shell& shell : snapshot.shells)
    for (const Triangle& t : snapshot.topologies[shell.topology]) {
      double height = 0.0;
      for (const std::uint32_t node : t) height += snapshot.nodes[shell.first_node + node].z / 3.0;
      snapshot.face_marks.push_back(shell.cell == 1 && height > 0.0 ? mark : std::uint8_t{0});
    }
  return snapshot;
}

TEST(PicturesGeometry, PixelsKnowTheirFace) {
  PixelBuffer pixels(400, 400);
  const Snapshot snapshot = half_marked(2);
  rasterize(snapshot, straight(10.0), std::nullopt, pixels);
  double marked = 0.0;
  for (std::size_t i = 0; i < pixels.face.size(); ++i) {
    if (pixels.face[i] == PixelBuffer::kNoFace || snapshot.face_marks[pixels.face[i]] == 0) continue;
    ++marked;
    EXPECT_EQ(snapshot.face_marks[pixels.face[i]], 2);
    EXPECT_EQ(pixels.surface[i], 2) << "the second cell";
  }
  EXPECT_NEAR(marked, 0.5 * kPi * 36.0 * 100.0, 0.04 * kPi * 36.0 * 100.0);
  rasterize(half_marked(2), straight(10.0), CutPlane{{0.0, -5.0, 0.0}, {0.0, -1.0, 0.0}}, pixels = PixelBuffer(400, 400));
  for (std::size_t i = 0; i < pixels.face.size(); ++i)
    if (pixels.surface[i] == 3) {
      EXPECT_EQ(pixels.face[i], PixelBuffer::kNoFace) << "a cut face is none";
    }
}

TEST(PicturesGeometry, MarksThatAreThereGetPicturesAndALegend) {
  const Snapshot with[] = {half_marked(2)}, without[] = {half_marked(0)};
  const auto legend = legend_entries(with[0], ColorBy::kMarks);
  ASSERT_EQ(legend.size(), 1u) << "only marks that occur";
  EXPECT_EQ(legend[0].text, "apical");
  const auto has = [](std::span<const Snapshot> snapshots) {
    const auto pictures = standard_pictures(snapshots);
    return std::count_if(pictures.begin(), pictures.end(), [](const Picture& p) { return p.name.find("marks") != std::string::npos; });
  };
  EXPECT_EQ(has(with), 2);
  EXPECT_EQ(has(without), 0);
}

TEST(PicturesGeometry, NothingIsSeenOfWhatTheCutRemoves) {
  Snapshot snapshot;
  add_sphere(snapshot, {0.0, -10.0, 0.0}, 6.0);
  add_shell(snapshot, {4.0, -10.0, 0.0}, 6.0);
  PixelBuffer pixels(400, 400);
  rasterize(snapshot, straight(10.0), CutPlane{{}, {0.0, -1.0, 0.0}}, pixels);
  EXPECT_EQ(count(pixels, PixelBuffer::kNothing), 160000.0);
}

TEST(PicturesGeometry, OverlappingSpheresMeetOnTheirRadicalLine) {
  // x of equal power: x² − 25 = (x − 6)² − 9, x = 52/12
  Snapshot snapshot;
  add_sphere(snapshot, {0.0, 0.0, 0.0}, 5.0);
  add_sphere(snapshot, {6.0, 0.0, 0.0}, 3.0);
  PixelBuffer pixels(600, 600);
  rasterize(snapshot, straight(40.0), CutPlane{{}, {0.0, -1.0, 0.0}}, pixels);
  const double border = 300.0 + 40.0 * 52.0 / 12.0;
  for (const int y : {300 - 60, 300, 300 + 60}) {
    int last_first = 0, first_second = 600;
    for (int x = 0; x < 600; ++x) {
      const auto surface = pixels.surface[pixels.index(x, y)];
      if (surface == 1) last_first = x;
      if (surface == 3) first_second = std::min(first_second, x);
    }
    EXPECT_EQ(first_second, last_first + 1);
    EXPECT_NEAR(first_second, border, 1.0);
  }
}

TEST(PicturesGeometry, ShellWinsOverSphereInTheCut) {
  Snapshot snapshot;
  add_sphere(snapshot, {1.0, 0.0, 0.0}, 6.0);
  add_shell(snapshot, {0.0, 0.0, 0.0}, 4.0);
  PixelBuffer pixels(400, 400);
  rasterize(snapshot, straight(20.0), CutPlane{{}, {0.0, -1.0, 0.0}}, pixels);
  EXPECT_NEAR(count(pixels, 3), kPi * 16.0 * 400.0, 0.01 * kPi * 16.0 * 400.0);
}

TEST(PicturesGeometry, CutThroughNodesOfTheMeshLeavesNoHoles) {
  // the icosphere has nodes on the planes of symmetry: the cut goes exactly through them
  Snapshot snapshot;
  add_shell(snapshot, {}, 6.0);
  PixelBuffer pixels(300, 300);
  rasterize(snapshot, straight(20.0), CutPlane{{}, {0.0, -1.0, 0.0}}, pixels);
  for (int x = 40; x < 260; ++x) EXPECT_EQ(pixels.surface[pixels.index(x, 150)], 1) << x;
  for (int y = 40; y < 260; ++y) EXPECT_EQ(pixels.surface[pixels.index(150, y)], 1) << y;
}

TEST(PicturesGeometry, ScaleBarIsAsLongAsItSays) {
  for (const double pixels_per_um : {0.013, 0.7, 3.1, 55.0}) {
    const ScaleBar bar = make_scale_bar(pixels_per_um, 200.0);
    EXPECT_DOUBLE_EQ(bar.pixels, bar.length * pixels_per_um);
    EXPECT_LE(bar.pixels, 200.0 * (1.0 + 1e-12));
    EXPECT_GE(bar.pixels, 200.0 / 2.5 * (1.0 - 1e-12));
  }
  EXPECT_EQ(make_scale_bar(3.1, 200.0).label, "50 µm");
  EXPECT_EQ(make_scale_bar(0.1, 200.0).label, "2 mm");
  EXPECT_EQ(make_scale_bar(900.0, 200.0).label, "200 nm");
}

TEST(PicturesGeometry, ScaleBarIsDrawnAsLongAsTheSphereItMeasures) {
  // a sphere of 20 µm radius and no outline is 40 µm wide: compare its drawn width with that of the bar
  Snapshot snapshot;
  add_sphere(snapshot, {}, 20.0);
  RenderOptions options;
  options.outlines = false;
  options.camera = straight(7.3);
  const Image image = render(snapshot, options);
  const auto darkness = [&](int y, int from, int to) {
    double sum = 0.0;
    for (int x = from; x < to; ++x) sum += 1.0 - image.at(x, y).g;
    return sum;
  };
  int longest_row = 0;
  for (int y = options.height - 1; y > view_height(options); --y)
    if (darkness(y, 0, 250) > darkness(longest_row == 0 ? options.height - 1 : longest_row, 0, 250)) longest_row = y;
  const double ink = 1.0 - 0.14;                              // of the bar, in green
  const double bar_px = darkness(longest_row, 0, 250) / ink;  // the triad stands to the right of it
  const ScaleBar bar = make_scale_bar(7.3, 0.24 * options.width);
  EXPECT_EQ(bar.label, "20 µm");
  EXPECT_NEAR(bar_px, 20.0 * 7.3, 1.0);

  int widest = 0;
  for (int y = 60; y < 60 + view_height(options); ++y) {
    int width = 0;
    for (int x = 0; x < options.width; ++x) width += image.at(x, y).g < 0.999f;
    widest = std::max(widest, width);
  }
  EXPECT_NEAR(widest, 2.0 * bar_px, 3.0);
}

TEST(PicturesGeometry, CameraFitsTheLargestSnapshotAndStaysTheSame) {
  std::vector<Snapshot> snapshots(2);
  add_sphere(snapshots[0], {}, 5.0);
  add_sphere(snapshots[1], {40.0, 0.0, 0.0}, 10.0);
  add_sphere(snapshots[1], {-40.0, 0.0, 0.0}, 10.0);
  Camera camera = make_camera(0.0, 0.0);
  fit_camera(camera, snapshots, 900.0, 700.0);
  EXPECT_NEAR(camera.pixels_per_um * 100.0, 0.95 * 900.0, 1e-9);
  for (const auto& snapshot : snapshots)
    for (const auto& cell : snapshot.cells) EXPECT_LE(std::abs(camera.view(cell.centroid).x) + cell.radius, 450.0 / camera.pixels_per_um);
}

TEST(PicturesGeometry, CameraAxesAreRightHanded) {
  for (const double azimuth : {0.0, 0.5, 2.0})
    for (const double elevation : {0.0, 0.4, -0.3}) {
      const Camera camera = make_camera(azimuth, elevation);
      EXPECT_NEAR(norm(cross(camera.right, camera.up) - camera.toward), 0.0, 1e-14);
      EXPECT_GT(camera.up.z, 0.0);
    }
}

}  // namespace
}  // namespace morula::scenarios
