#include <gtest/gtest.h>
#include <omp.h>
#include <png.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "report/pictures/annotate.h"
#include "report/pictures/font.h"
#include "report/pictures/palette.h"
#include "report/pictures/png.h"
#include "report/pictures/renderer.h"
#include "report/pictures/standard_pictures.h"
#include "tests/report/pictures_scene.h"

namespace morula::scenarios {
namespace {

using test::add_shell;
using test::add_sphere;

Snapshot small_tissue() {
  Snapshot snapshot;
  snapshot.type_names = {"hepatocyte"};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) add_sphere(snapshot, {10.0 * i, 10.0 * j, 3.0 * ((i + j) % 2)}, 5.5);
  add_shell(snapshot, {15.0, 15.0, 12.0}, 6.0);
  for (std::size_t i = 0; i < snapshot.cells.size(); ++i) snapshot.cells[i].pressure = 0.05 * static_cast<double>(i);
  return snapshot;
}

RenderOptions small_options(const Snapshot& snapshot) {
  RenderOptions options;
  options.width = options.height = 240;
  options.camera = make_camera(0.5, 0.4);
  options.title = "t = 1 h";
  fit_camera(options.camera, std::span(&snapshot, 1), options.width, view_height(options));
  return options;
}

TEST(PicturesImage, PngDecodesToTheSamePixels) {
  const Snapshot snapshot = small_tissue();
  const Image image = render(snapshot, small_options(snapshot));
  const auto bytes = encode_png(image);
  ASSERT_TRUE(bytes.ok());
  ASSERT_EQ(std::memcmp(bytes->data(), "\x89PNG\r\n\x1a\n", 8), 0);
  png_image decoded{};
  decoded.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&decoded, bytes->data(), bytes->size()), 0) << decoded.message;
  EXPECT_EQ(decoded.width, 240u);
  EXPECT_EQ(decoded.height, 240u);
  decoded.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(decoded));
  ASSERT_NE(png_image_finish_read(&decoded, nullptr, pixels.data(), 0, nullptr), 0) << decoded.message;
  EXPECT_EQ(pixels, image.rgb);
}

TEST(PicturesImage, BytesDoNotDependOnThreads) {
  const Snapshot snapshot = small_tissue();
  RenderOptions options = small_options(snapshot);
  options.cut = CutPlane{middle_of(snapshot), options.camera.toward};
  options.color_by = ColorBy::kPressure;
  options.scale = common_scale(std::span(&snapshot, 1), ColorBy::kPressure);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Image one = render(snapshot, options);
  omp_set_num_threads(3);
  const Image three = render(snapshot, options);
  omp_set_num_threads(threads);
  EXPECT_EQ(one.rgb, three.rgb);
}

TEST(PicturesImage, EmptyTissueGivesAPictureWithoutCells) {
  const Snapshot empty;
  const auto pictures = standard_pictures(std::span(&empty, 1));
  ASSERT_FALSE(pictures.empty());
  for (const Picture& picture : pictures) {
    EXPECT_EQ(picture.image.at(picture.image.width / 2, picture.image.height / 2), (Rgb{1.0f, 1.0f, 1.0f}));
    EXPECT_NE(picture.caption.find("0 cells"), std::string::npos);
  }
  EXPECT_TRUE(standard_pictures({}).empty());
}

TEST(PicturesImage, CellsThatAreNotNumbersAreLeftOut) {
  Snapshot snapshot = small_tissue();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  snapshot.cells[3].centroid = {nan, 0.0, 0.0};
  snapshot.cells[4].pressure = nan;
  snapshot.nodes[5] = {nan, nan, nan};
  RenderOptions options = small_options(snapshot);
  options.cut = CutPlane{{15.0, 15.0, 5.0}, options.camera.toward};
  options.color_by = ColorBy::kPressure;
  options.scale = common_scale(std::span(&snapshot, 1), ColorBy::kPressure);
  EXPECT_TRUE(std::isfinite(options.camera.pixels_per_um));
  const Image image = render(snapshot, options);
  EXPECT_NE(image.at(120, 110), (Rgb{1.0f, 1.0f, 1.0f}));
}

TEST(PicturesImage, CutFaceOfANumberShowsTheColourOfTheBar) {
  Snapshot snapshot;
  add_sphere(snapshot, {}, 5.0);
  snapshot.cells[0].pressure = 0.75;
  RenderOptions options;
  options.width = options.height = 200;
  options.camera = make_camera(0.0, 0.0);
  options.color_by = ColorBy::kPressure;
  options.scale = {0.0, 1.0, false, "pressure", "Pa", 1e3};
  options.cut = CutPlane{{}, options.camera.toward};
  fit_camera(options.camera, std::span(&snapshot, 1), 200.0, view_height(options));
  const Rgb seen = render(snapshot, options).at(100, 100), bar = sequential_color(0.75);
  EXPECT_NEAR(seen.r, bar.r, 0.06);
  EXPECT_NEAR(seen.g, bar.g, 0.06);
  EXPECT_NEAR(seen.b, bar.b, 0.06);
}

TEST(PicturesColours, ControlPointsAreThoseOfTheSources) {
  const auto expect_rgb = [](const Rgb& color, int r, int g, int b) {
    EXPECT_NEAR(color.r * 255.0, r, 1.5);
    EXPECT_NEAR(color.g * 255.0, g, 1.5);
    EXPECT_NEAR(color.b * 255.0, b, 1.5);
  };
  expect_rgb(sequential_color(0.0), 0x44, 0x01, 0x54);  // viridis: ends
  expect_rgb(sequential_color(1.0), 0xFD, 0xE7, 0x25);
  expect_rgb(diverging_color(0.0), 59, 76, 192);  // Moreland 2009: ends and middle
  expect_rgb(diverging_color(1.0), 180, 4, 38);
  expect_rgb(diverging_color(0.5), 221, 221, 221);
}

TEST(PicturesColours, SequentialMapBecomesLighterAllTheWay) {
  double before = -1.0;
  for (int i = 0; i <= 64; ++i) {
    const Rgb c = sequential_color(i / 64.0);
    const double luma = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
    EXPECT_GT(luma, before);
    before = luma;
  }
}

TEST(PicturesColours, ScaleIsTheSameForAllSnapshotsAndRound) {
  std::vector<Snapshot> snapshots(2);
  add_sphere(snapshots[0], {}, 5.0);
  add_sphere(snapshots[1], {}, 5.0);
  snapshots[0].cells[0].pressure = 0.013;
  snapshots[1].cells[0].pressure = 0.87;
  const ColorScale scale = common_scale(snapshots, ColorBy::kPressure);
  EXPECT_EQ(scale.low, 0.0);
  EXPECT_NEAR(scale.high, 1.0, 1e-12);
  EXPECT_EQ(scale.unit, "Pa");
  EXPECT_FALSE(scale.diverging);
  snapshots[0].cells[0].pressure = -0.5;
  const ColorScale both = common_scale(snapshots, ColorBy::kPressure);
  EXPECT_TRUE(both.diverging);
  EXPECT_EQ(both.low, -both.high);
}

TEST(PicturesText, NumbersAndTimesReadAsPeopleWriteThem) {
  EXPECT_EQ(short_number(0.1 + 0.2), "0.3");
  EXPECT_EQ(short_number(12345.0), "12345");
  EXPECT_EQ(short_number(-2.5e-7), "-2.5e-07");
  EXPECT_EQ(short_time(40.0), "40 s");
  EXPECT_EQ(short_time(1800.0), "30 min");
  EXPECT_EQ(short_time(36.0 * 3600.0), "36 h");
  EXPECT_EQ(short_time(320.0), "5.33 min");
  EXPECT_EQ(short_time(119.5 * 3600.0), "119.5 h");
}

TEST(PicturesText, BrokenUtf8IsDrawnAsABoxAndEveryGlyphLeavesInk) {
  Image image(60, 40, {1.0f, 1.0f, 1.0f});
  draw_text(image, 5.0, 30.0, "\xC3", 14.0, {});
  EXPECT_NE(image.rgb, Image(60, 40, {1.0f, 1.0f, 1.0f}).rgb);
  for (char c = '!'; c <= '~'; ++c) {
    Image glyph(60, 40, {1.0f, 1.0f, 1.0f});
    draw_text(glyph, 20.0, 25.0, std::string(1, c), 14.0, {});
    EXPECT_NE(glyph.rgb, Image(60, 40, {1.0f, 1.0f, 1.0f}).rgb) << c;
  }
}

TEST(PicturesImage, UnwritableFolderGivesAFileError) {
  const Status status = write_png({1, 2}, "/nonexistent-folder/picture.png");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kFile);
}

}  // namespace
}  // namespace morula::scenarios
