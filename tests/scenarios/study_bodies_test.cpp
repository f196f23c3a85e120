// What a body cannot do yet, or only outside the range of its law, is told by `check`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenarios/study_fixture.h"

namespace morula::scenarios {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kStudy = R"(schema: 1
study: bodies
time: {end: 10 h}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell:
    radius: 6 um
    dcm:
      nodes: 162
initial:
  - {type: cell, count: 10, fill: sphere, radius: 40 um}
)";

std::string with(const std::string& key, const std::string& text = kStudy) {
  return test::changed("    dcm:", "    " + key + "\n    dcm:", text);
}
const std::string kAsShell = "radius: 40 um, as: shell}";

TEST(Bodies, NoiseOfANucleusOrOfLinksIsRefused) {
  const std::string noise = with("fluctuations: {energy: 4e-18 J}");
  const std::string shells = test::changed("radius: 40 um}", kAsShell, noise);
  EXPECT_TRUE(test::read(shells).ok());
  for (const char* inside : {"nucleus: {kind: rigid, radius: 3 um}", "nucleus: {kind: shell, radius: 3 um}",
                             "cytoskeleton: {cortex_links: {number: 40, stiffness: 0.01 mN/m}}"}) {
    const std::string text = test::errors_of(test::changed("nodes: 162", std::string("nodes: 162\n      ") + inside, shells));
    EXPECT_THAT(text, HasSubstr("[E645]")) << inside;
    EXPECT_THAT(text, HasSubstr("study.yaml:8:28")) << inside;
  }
  EXPECT_TRUE(test::read(test::changed("nodes: 162", "nodes: 162\n      nucleus: {kind: rigid, radius: 3 um}", noise)).ok())
      << "spheres have no nucleus";
}

TEST(Bodies, ShellsThatWouldDivideAreToldWhereverTheyComeFrom) {
  const std::string cycle = with("cycle: {duration: 18 h}");
  EXPECT_THAT(test::warnings_of(cycle), Not(HasSubstr("E646")));
  const std::string by_entry = test::warnings_of(test::changed("radius: 40 um}", kAsShell, cycle));
  EXPECT_THAT(by_entry, HasSubstr("[E646]"));
  EXPECT_THAT(by_entry, HasSubstr("study.yaml:8:23"));
  const std::string coupling = "coupling:\n  ";
  EXPECT_THAT(test::warnings_of(cycle + coupling + "regions: [{name: core, shape: sphere, radius: 10 um, as: shell}]\n"),
              HasSubstr("[E646]"));
  EXPECT_THAT(test::warnings_of(cycle + coupling + "triggers: [{promote: pressure > 1 kPa, demote: pressure < 500 Pa}]\n"),
              HasSubstr("[E646]"));
  EXPECT_THAT(test::warnings_of(test::changed("radius: 6 um", "radius: 6 um\n    body: shell", cycle)), HasSubstr("[E646]"));
}

TEST(Bodies, ShellsThatOnlyGrowAreNotWarnedOf) {
  const std::string grows = test::changed("radius: 40 um}", "radius: 40 um, as: shell, age: birth}", with("cycle: {duration: 18 h}"));
  EXPECT_THAT(test::warnings_of(grows), Not(HasSubstr("E646")));
  EXPECT_THAT(test::warnings_of(test::changed("10 h", "20 h", grows)), HasSubstr("E646"));
}

}  // namespace
}  // namespace morula::scenarios
