// What contact takes from the tension of a fluid surface is what it adheres by (physics/dcm.md §4; decision 0084).
#include <cmath>
#include <numbers>

#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

class LateralTension : public OwnParts {
 protected:
  LateralTension() : OwnParts([](Laws&) {}) {}

  /// Angle of two cells at rest, default numerics [deg]; a criterion of the study judges it against Young's law, too.
  double angle(const std::string& adhesion, const std::string& regions) {
    const std::string study = R"(schema: 1
study: doublet
time: {end: 3 h, output: 15 min, rest: 1e-5 um/s}
domain: {size: [80 um, 80 um, 80 um]}
cell_types:
  a:
    body: shell
    radius: 6 um
    adhesion: {a: @W mJ/m^2}
    dcm: {cortex: {elastic: none, tension: 0.3 mN/m, regions: {@R}}}
initial: [{type: a, at: [[-6 um, 0 um, 0 um], [6 um, 0 um, 0 um]]}]
output: {report: false}
criteria:
  - {id: angle, measure: cap.angle, of: {pair: [a, a]}, at: end, below: 180 deg}
  - {id: law, measure: cap.angle, of: {pair: [a, a]}, at: end, against: youngs_law, within: 1.5 deg}
)";
    const RunSummary done = run_whole(changed("@R", regions, changed("@W", adhesion, study)), "run" + std::to_string(runs_++));
    double angle = std::nan("");
    for (const Verdict& verdict : done.verdicts) {
      if (verdict.id == "angle") angle = verdict.value;
      if (verdict.id == "law") {
        EXPECT_TRUE(verdict.passed) << regions;
      }
    }
    return angle;
  }
  /// cos θ = (γ_lateral − W/2)/γ [deg].
  static double young(double adhesion, double lateral, double free = 0.3) {
    return std::acos((lateral - 0.5 * adhesion) / free) * 180.0 / std::numbers::pi;
  }

  int runs_ = 0;
};

TEST_F(LateralTension, GivesFluidsYoungsAngle) {
  EXPECT_NEAR(angle("0.1", "lateral: {tension: 0.2 mN/m}"), young(0.1, 0.2), 1.2);
  EXPECT_NEAR(angle("0.1", "lateral: {tension: 0.1 mN/m}"), young(0.1, 0.1), 1.2);
  EXPECT_NEAR(angle("0.4", "lateral: {tension: 0.4 mN/m}"), young(0.4, 0.4), 1.2) << "more than the free one";
  EXPECT_NEAR(angle("0.1", "lateral: {tension: 0.2 mN/m}, whole: {tension: 0.4 mN/m}"), young(0.1, 0.2, 0.4), 1.2);
}

TEST_F(LateralTension, HoldsCellsThatDoNotAdhere) { EXPECT_NEAR(angle("0", "lateral: {tension: 0.2 mN/m}"), young(0.0, 0.2), 1.2); }

TEST_F(LateralTension, FollowsItsCourse) {
  const double less = angle("0.1", "lateral: {tension: 0.1 mN/m, course: [{time: 0 h, factor: 3}, {time: 1 h, factor: 1}]}");
  EXPECT_NEAR(less, young(0.1, 0.1), 1.2) << "compaction";
  const double more = angle("0.1", "lateral: {tension: 0.1 mN/m, course: [{time: 1 h, factor: 1}, {time: 70 min, factor: 3}]}");
  EXPECT_NEAR(more, young(0.1, 0.3), 1.2) << "and back";
}

/// As cells without adhesion do, to the bit: where no force brings them together, a tension that contact raises finds nothing to act on.
TEST_F(LateralTension, ThatNoAdhesionBearsLetsCellsGo) {
  const auto area = [&](const std::string& adhesion, const std::string& regions, const std::string& name) {
    run_whole(R"(schema: 1
study: parted
time: {end: 1 h, output: 15 min}
domain: {size: [80 um, 80 um, 80 um]}
cell_types:
  a: {body: shell, radius: 6 um, adhesion: {a: )" +
                  adhesion + R"( mJ/m^2}, dcm: {cortex: {elastic: none, tension: 0.3 mN/m)" + regions + R"(}}}
initial: [{type: a, at: [[-6 um, 0 um, 0 um], [6 um, 0 um, 0 um]]}]
output: {report: false}
)",
              name);
    return column(name, "mean_contact_area").back();
  };
  const double tense = area("0.1", ", regions: {lateral: {tension: 0.4 mN/m}}", "tense");
  EXPECT_EQ(tense, area("0", "", "free"));
  EXPECT_LT(tense, 0.3 * area("0.1", "", "adhering"));
}

}  // namespace
}  // namespace morula::scenarios::test
