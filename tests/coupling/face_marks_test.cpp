#include "coupling/face_marks.h"

#include <gtest/gtest.h>

#include "coupling/cell_record.h"
#include "coupling/simulation.h"
#include "coupling/swaps.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

double part_marked(const FaceMark& rule, const Vec3d& polarity = {}, const Space& space = {}) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(2562).value();
  std::vector<Vec3d> x;
  for (const Vec3d& p : shape->position) x.push_back(Vec3d{5, -7, 11} + normalized(p) * 6.0);
  const auto faces = faces_by_place(rule, space, *shape->topology, x, polarity);
  const std::vector<std::uint8_t> marks(faces.begin(), faces.end());
  const std::vector<std::uint8_t> all(faces.size(), 1);
  return marked_area(*shape->topology, x, {marks, marks.size()}, 0) / marked_area(*shape->topology, x, {all, all.size()}, 0);
}

TEST(FaceMarks, ConeAndBandHaveTheAreasOfCapAndZone) {  // of a sphere: (1 − cos α)/2 and h/R
  FaceMark cone;
  for (const double angle : {0.4, 1.0, 2.5}) {
    cone.angle = angle;
    EXPECT_NEAR(part_marked(cone), 0.5 * (1.0 - std::cos(angle)), 0.008) << angle;
  }
  FaceMark band;
  band.rule = FaceMark::Rule::kBand;
  band.axis = normalized(Vec3d{1, 1, 0});
  band.half_width = 1.5;
  EXPECT_NEAR(part_marked(band), 0.25, 0.01);
}

TEST(FaceMarks, PolarityAndPointGiveTheAxis) {
  FaceMark rule;
  rule.angle = 1.0;
  rule.axis_from = FaceMark::Axis::kPolarity;
  EXPECT_EQ(part_marked(rule), 0.0) << "a cell without polarity";
  EXPECT_NEAR(part_marked(rule, {0, 3, 0}), 0.5 * (1.0 - std::cos(1.0)), 0.008);
  rule.axis_from = FaceMark::Axis::kTowardPoint;
  rule.center = {5, -7, -100};
  rule.angle = 0.1;
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(642).value();
  std::vector<Vec3d> x;
  for (const Vec3d& p : shape->position) x.push_back(Vec3d{5, -7, 11} + p * 10.0);
  const auto faces = faces_by_place(rule, Space(), *shape->topology, x, {});
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (faces[f]) {
      EXPECT_LT(x[shape->topology->faces()[f][0]].z, 11.0 - 5.0);
    }
  }
  EXPECT_GT(std::count(faces.begin(), faces.end(), 1), 0);
}

TEST(FaceMarks, PlacesAreSeenAcrossPeriodicFaces) {
  Space around;
  around.box = {{-15, -20, -20}, {15, 20, 20}};
  around.boundary[0] = {BoundaryKind::kPeriodic, BoundaryKind::kPeriodic};
  for (const FaceMark::Rule kind : {FaceMark::Rule::kBall, FaceMark::Rule::kBox}) {
    FaceMark rule;
    rule.rule = kind;
    rule.radius = 4.0;
    rule.size = {8, 8, 8};
    rule.center = {-1, -7, 11};
    const double part = part_marked(rule);
    EXPECT_GT(part, 0.05);
    rule.center.x += 30.0;
    EXPECT_EQ(part_marked(rule), 0.0);
    EXPECT_EQ(part_marked(rule, {}, around), part);
  }
}

Model marked_model() {
  Model model = test::clusters_model();
  model.mark_names = {"top", "near"};
  FaceMark cone, ball;
  cone.angle = 1.0;
  ball.mark = 1;
  ball.rule = FaceMark::Rule::kBall;
  ball.radius = 5.0;
  ball.center = {6, 0, 0};
  model.marks = {cone, ball};
  return model;
}

TEST(FaceMarks, AreGivenOnceAndGoWithTheMesh) {
  const Model model = marked_model();
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {40, 0, 0}}, {BodyKind::kShell, BodyKind::kSphere});
  mark_new_shells(model, tissue);
  const std::vector<std::uint8_t> marks = tissue.shells.faces_of(0).mark;
  ASSERT_EQ(marks.size(), 320u);
  for (const int bit : {0, 1})
    EXPECT_GT(marked_area(tissue.shells.topology(0), tissue.shells.position, tissue.shells.marks_of(0), bit), 30.0);
  for (Vec3d& x : tissue.shells.position) x = {x.z, x.x, x.y + 50.0};  // turned and moved: the faces keep their marks
  mark_new_shells(model, tissue);
  EXPECT_EQ(tissue.shells.faces_of(0).mark, marks);

  tissue.shells.faces_of(0).contact.assign(320, 0.25f);
  std::vector<std::byte> bytes;
  for (const CellRecord& cell : take_apart(tissue)) append_bytes(cell, bytes);
  std::vector<CellRecord> cells = read_records(bytes, shapes);
  EXPECT_EQ(cells[0].shell->face.mark, marks);
  promote(cells[1], model.types[0], 0.0, 10.0, shapes, 1);
  put_together(tissue, std::move(cells));
  mark_new_shells(model, tissue);
  EXPECT_EQ(tissue.shells.faces_of(0).mark, marks);
  EXPECT_EQ(tissue.shells.faces_of(0).contact, std::vector<float>(320, 0.25f));
  const std::vector<std::uint8_t>& fresh = tissue.shells.faces_of(1).mark;
  ASSERT_EQ(fresh.size(), 320u) << "a cell that became a shell gets its marks then";
  EXPECT_GT(std::count(fresh.begin(), fresh.end(), 1), 20);
  EXPECT_EQ(std::count_if(fresh.begin(), fresh.end(), [](std::uint8_t m) { return m & 2; }), 0) << "it is far from the ball";
}

TEST(FaceMarks, AreAsManyAsTheStudyNames) {
  Model model = marked_model();
  model.mark_names.clear();
  for (int k = 0; k < 20; ++k) model.mark_names.push_back("m" + std::to_string(k));
  model.marks[0].mark = 7, model.marks[1].mark = 19;
  ShapeLibrary shapes;
  Tissue many = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}), few = many;
  mark_new_shells(model, many);
  mark_new_shells(marked_model(), few);
  const MarkSets sets = many.shells.marks_of(0), two = few.shells.marks_of(0);
  ASSERT_EQ(sets.width(), 3u);
  ASSERT_EQ(sets.size(), 320u);
  for (std::size_t face = 0; face < 320; ++face)
    for (int k = 0; k < 20; ++k)
      EXPECT_EQ(sets.has(face, k),
                k == 7 ? two.has(face, marked_model().marks[0].mark) : k == 19 && two.has(face, marked_model().marks[1].mark));
  std::vector<std::byte> bytes;
  for (const CellRecord& cell : take_apart(many)) append_bytes(cell, bytes);
  EXPECT_EQ(read_records(bytes, shapes)[0].shell->face.mark.size(), 960u);
}

TEST(FaceMarks, OfTheFirstShellLeaveTheOthersWithout) {
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(test::clusters_model(), shapes, {{0, 0, 0}, {40, 0, 0}}, {BodyKind::kShell, BodyKind::kShell});
  std::vector<CellRecord> cells = take_apart(tissue);
  cells[0].shell->face.mark.assign(320, 1);
  put_together(tissue, std::move(cells));
  EXPECT_EQ(std::as_const(tissue.shells).faces_of(0).mark.size(), 320u);
  EXPECT_TRUE(std::as_const(tissue.shells).faces_of(1).empty());
  const std::vector<CellRecord> again = take_apart(tissue);
  EXPECT_EQ(again[0].shell->face.mark.size(), 320u);
  EXPECT_TRUE(again[1].shell->face.empty());
}

TEST(FaceMarks, ByTouchFollowTheContactAndMayBeKept) {
  Model model = test::clusters_model();
  model.types.push_back(model.types[0]);
  model.pairs.assign(4, ContactPair{0.1, 50.0, 50.0});
  model.mark_names = {"now", "ever"};
  FaceMark now;
  now.rule = FaceMark::Rule::kTouched;
  now.material = 1;
  now.always = true;
  FaceMark ever = now;
  ever.mark = 1;
  ever.keep = true;
  model.marks = {now, ever};
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {0, 0, 12.0}}, {BodyKind::kShell, BodyKind::kShell});
  tissue.cells.rows[1].type = 1;
  tissue.shells.type[1] = 1;
  auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
  ASSERT_TRUE(simulation->step(1.0).ok());
  const dcm::Shells& shells = simulation->tissue().shells;
  const std::size_t a = shells.type[0] == 0 ? 0 : 1;
  const auto count = [&](int bit) {
    const auto& m = shells.faces_of(a).mark;
    return std::count_if(m.begin(), m.end(), [bit](std::uint8_t set) { return set >> bit & 1; });
  };
  EXPECT_GT(count(0), 0);
  EXPECT_EQ(count(0), count(1));
  const auto& other = shells.faces_of(1 - a).mark;
  EXPECT_EQ(std::count(other.begin(), other.end(), 0), static_cast<long>(other.size())) << "the rule is for the first type";

  Tissue apart = simulation->tissue();  // the same cells, far from each other
  for (std::uint32_t i = apart.shells.first_node[1 - a]; i < apart.shells.first_node[2 - a]; ++i) apart.shells.position[i].z += 20.0;
  const auto kept = count(1);
  auto later = Simulation::create(model, std::move(apart), Comm(), 1).value();
  ASSERT_TRUE(later->step(2.0).ok());
  const auto& m = later->tissue().shells.faces_of(a).mark;
  EXPECT_EQ(std::count_if(m.begin(), m.end(), [](std::uint8_t set) { return set & 1; }), 0);
  EXPECT_EQ(std::count_if(m.begin(), m.end(), [](std::uint8_t set) { return set & 2; }), kept);
}

}  // namespace
}  // namespace morula
