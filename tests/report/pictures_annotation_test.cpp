// What is written beside a picture: legend, colour bar, axes; and the slice of a field.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "report/pictures/annotate.h"
#include "report/pictures/field_slice.h"
#include "report/pictures/font.h"
#include "report/pictures/renderer.h"
#include "report/pictures/standard_pictures.h"
#include "tests/report/pictures_scene.h"

namespace morula::scenarios {
namespace {

using test::add_sphere;

constexpr Rgb kPaper{1.0f, 1.0f, 1.0f};

Snapshot row_of_types(int count) {
  Snapshot out;
  for (int i = 0; i < count; ++i) {
    add_sphere(out, {14.0 * i, 0.0, 0.0}, 6.0);
    out.cells.back().type = static_cast<std::uint16_t>(i);
    out.type_names.push_back("a_type_with_a_name_" + std::to_string(i));
  }
  return out;
}

RenderOptions options_for(const Snapshot& snapshot) {
  RenderOptions options;
  options.width = 500;
  options.height = 400;
  options.samples = 1;
  options.title = "t = 119.9 min";
  options.camera = make_camera(0.0, 0.0);
  options.legend_rows = rows_of_legend(snapshot, options);
  fit_camera(options.camera, std::span(&snapshot, 1), options.width, view_height(options));
  return options;
}

TEST(PicturesLegend, NeverLiesOverTheTissue) {
  for (const int types : {1, 5, 12, 40}) {
    const Snapshot snapshot = row_of_types(types);
    const RenderOptions options = options_for(snapshot);
    RenderOptions bare = options;
    bare.annotations = false;
    bare.height = view_height(options);
    const Image with = render(snapshot, options), without = render(snapshot, bare);
    const int top = options.height - view_height(options) - static_cast<int>(7.4 * std::max(8.0, options.width / 72.0));
    ASSERT_GE(top, 0);
    for (int y = 0; y < bare.height; ++y)
      for (int x = 0; x < bare.width; ++x) ASSERT_EQ(with.at(x, top + y), without.at(x, y)) << types << " types: " << x << ' ' << y;
  }
  EXPECT_GT(options_for(row_of_types(12)).legend_rows, 3u);
  EXPECT_LT(options_for(row_of_types(40)).legend_rows, 15u) << "the last entry says how many more there are";
}

TEST(PicturesLegend, RowsHoldWhatFitsAndEveryEntryOnce) {
  const std::vector<LegendEntry> entries(7, LegendEntry{"0123456789", {}});
  const double width = text_width("0123456789", 10.0) + 34.0;  // of an entry with its dot and gap
  const auto rows = legend_rows(entries, 1.5 * width, 3.5 * width, 10.0);
  EXPECT_EQ(rows, (std::vector<std::size_t>{1, 3, 3}));
  EXPECT_EQ(legend_rows(entries, 0.5 * width, 9.0 * width, 10.0), (std::vector<std::size_t>{0, 7})) << "none fits beside the title";
  EXPECT_EQ(legend_rows(entries, 0.5 * width, 0.6 * width, 10.0).size(), 8u) << "one a row where even one is too wide";
  EXPECT_TRUE(legend_rows({}, 1.0, 1.0, 10.0).empty());
}

TEST(PicturesColourBar, NumbersAreRoundEvenAndHoldBothEnds) {
  const auto numbers = [](double low, double high, bool diverging = false) {
    ColorScale scale;
    scale.low = low, scale.high = high, scale.diverging = diverging;
    return color_bar_numbers(scale);
  };
  EXPECT_EQ(numbers(-6, 6, true), (std::vector<double>{-6, -3, 0, 3, 6}));
  EXPECT_EQ(numbers(0, 100), (std::vector<double>{0, 25, 50, 75, 100}));
  EXPECT_EQ(numbers(-14, -2), (std::vector<double>{-14, -12, -10, -8, -6, -4, -2}));
  EXPECT_EQ(numbers(-7, 7, true), (std::vector<double>{-7, 0, 7}));
  EXPECT_EQ(numbers(0.13, 0.9), (std::vector<double>{0.13, 0.9}));
}

TEST(PicturesColourBar, ItsTextIsWholeWithinThePicture) {
  Snapshot snapshot = row_of_types(2);
  snapshot.cells[0].pressure = -0.2;
  snapshot.cells[1].pressure = 0.7;
  RenderOptions options = options_for(snapshot);
  options.color_by = ColorBy::kPressure;
  for (const int width : {320, 500, 900}) {
    options.width = width;
    options.scale = common_scale(std::span(&snapshot, 1), ColorBy::kPressure);
    const Image image = render(snapshot, options);
    for (int x = 0; x < image.width; ++x)
      for (const int y : {0, image.height - 2, image.height - 1}) ASSERT_EQ(image.at(x, y), kPaper) << width << ": " << x << ' ' << y;
  }
}

/// Ink within two pixels of a place.
bool ink_at(const Image& image, double x, double y) {
  for (int dy = -2; dy <= 2; ++dy)
    for (int dx = -2; dx <= 2; ++dx)
      if (image.at(static_cast<int>(x) + dx, static_cast<int>(y) + dy).g < 0.6f) return true;
  return false;
}

TEST(PicturesTriad, ShowsHowTheAxesLie) {
  const auto triad = [](const Camera& camera) {
    Image image(120, 120, kPaper);
    draw_triad(image, 60, 60, 30, camera, 8.0);
    return image;
  };
  const Image front = triad(make_camera(0.0, 0.0));  // x to the right, z up
  EXPECT_TRUE(ink_at(front, 80, 60));
  EXPECT_TRUE(ink_at(front, 60, 40));
  EXPECT_FALSE(ink_at(front, 40, 60));
  EXPECT_FALSE(ink_at(front, 60, 80));
  EXPECT_EQ(triad(make_camera(0.0, 0.05)).rgb == front.rgb, false);
  Camera behind;  // x to the left
  behind.right = {-1, 0, 0}, behind.toward = {0, 1, 0};
  EXPECT_TRUE(ink_at(triad(behind), 40, 60));
  EXPECT_FALSE(ink_at(triad(behind), 80, 60));
}

/// c = 1 + 2 x + 3 y − z at the centres of voxels.
Snapshot::Grid linear_grid() {
  Snapshot::Grid grid{"oxygen", {-10, -20, -10}, {2, 4, 2.5}, {10, 10, 8}, {}};
  for (int z = 0; z < 8; ++z)
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 10; ++x)
        grid.concentration.push_back(1.0 + 2.0 * (-10 + 2 * (x + 0.5)) + 3.0 * (-20 + 4 * (y + 0.5)) - (-10 + 2.5 * (z + 0.5)));
  return grid;
}

TEST(PicturesFieldSlice, IsLinearBetweenCentresAndNothingOutside) {
  const Snapshot::Grid grid = linear_grid();
  for (const Vec3d& p : {Vec3d{0, 0, 0}, Vec3d{-8.9, 17.0, 3.3}, Vec3d{5.5, -11.2, -8.7}})
    EXPECT_NEAR(concentration_at(grid, p), 1.0 + 2.0 * p.x + 3.0 * p.y - p.z, 1e-12);
  EXPECT_NEAR(concentration_at(grid, {-10, 0, 0}), concentration_at(grid, {-9, 0, 0}), 1e-12) << "the last half voxel";
  for (const Vec3d& p : {Vec3d{-10.1, 0, 0}, Vec3d{0, 20.1, 0}, Vec3d{0, 0, 10.1}}) EXPECT_TRUE(std::isnan(concentration_at(grid, p)));
}

TEST(PicturesFieldSlice, ShowsTheColourOfTheBarInThePlaneOfTheCut) {
  Snapshot snapshot;
  add_sphere(snapshot, {0, 0, 0}, 4.0);
  snapshot.fields = {linear_grid()};
  RenderOptions options;
  options.width = options.height = 300;
  options.samples = 1;
  options.annotations = false;
  options.camera = make_camera(0.0, 0.0);
  options.camera.pixels_per_um = 10.0;
  options.color_by = ColorBy::kField;
  options.scale = field_scale(snapshot, 0);
  options.cut = CutPlane{{0, 1.0, 0}, options.camera.toward};
  EXPECT_EQ(options.scale.quantity, "oxygen");
  EXPECT_EQ(options.scale.data_low, 1.0 - 18.0 - 54.0 - 8.75);
  const Image image = render(snapshot, options);
  for (const Vec3d& p : {Vec3d{0.05, 1.0, 0.05}, Vec3d{-6.05, 1.0, 4.05}, Vec3d{7.05, 1.0, -7.05}}) {
    const Rgb seen = image.at(static_cast<int>(150 + 10 * p.x), static_cast<int>(150 - 10 * p.z));
    const Rgb bar = scale_color(options.scale, 1.0 + 2.0 * p.x + 3.0 * p.y - p.z);
    EXPECT_NEAR(seen.r, bar.r, 0.01) << p.x;
    EXPECT_NEAR(seen.g, bar.g, 0.01) << p.x;
    EXPECT_NEAR(seen.b, bar.b, 0.01) << p.x;
  }
  EXPECT_EQ(image.at(20, 150), kPaper) << "13 µm to the left the grid has ended";
  // The outline of the cell in the plane: its radius there is √(4² − 1²) µm.
  const int edge = static_cast<int>(150 + 10 * std::sqrt(15.0));
  int changed = 0;
  for (int x = edge - 3; x <= edge + 3; ++x) changed += std::abs(image.at(x, 150).g - image.at(x - 8, 150).g) > 0.1f;
  EXPECT_GT(changed, 0);
}

TEST(StandardPictures, HaveASliceOfEveryFieldWithTheScaleOfItsCells) {
  Snapshot snapshot = row_of_types(3);
  snapshot.fields = {linear_grid(), linear_grid()};
  snapshot.fields[1].name = "glucose";
  std::set<std::string> names;
  for (const Picture& picture : standard_pictures(std::span(&snapshot, 1))) names.insert(picture.name);
  for (const char* name : {"slice_oxygen_final", "slice_glucose_final", "cut_oxygen_final"}) EXPECT_EQ(names.count(name), 1u) << name;
}

TEST(StandardPictures, TheLastStateHasAScaleOfItsOwn) {
  std::vector<Snapshot> snapshots(2, row_of_types(2));
  snapshots[0].cells[0].pressure = snapshots[0].cells[1].pressure = 100.0;  // a state far from rest at the start
  snapshots[1].cells[0].pressure = 1.0, snapshots[1].cells[1].pressure = 2.0;
  snapshots[1].time = 60.0;
  const auto difference = [&](const std::string& name) {
    for (const Picture& picture : standard_pictures(snapshots))
      if (picture.name == name) {
        const Rgb a = picture.image.at(picture.image.width / 4, picture.image.height / 2 - 20),
                  b = picture.image.at(3 * picture.image.width / 4, picture.image.height / 2 - 20);
        return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
      }
    return -1.0f;
  };
  EXPECT_GT(difference("cut_pressure_final"), 0.3f);
  EXPECT_LT(difference("cut_pressure_01"), 0.1f) << "frames have one scale";
  snapshots[1].cells[0].pressure = -1e-6, snapshots[1].cells[1].pressure = 2e-6;  // free cells: errors of the solver
  EXPECT_LT(difference("cut_pressure_final"), 0.1f);
}

}  // namespace
}  // namespace morula::scenarios
