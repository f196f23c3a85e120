/// `morula compare` as a user calls it, on runs of seconds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/system/morula_command.h"

namespace morula::test {
namespace {

using testing::HasSubstr;
using testing::Not;

// Cells of random sizes: every seed has another volume. The growth of all is the same.
constexpr const char* kStudy =
    "schema: 1\nstudy: small\ntime: {end: 20 min, output: 5 min}\ndomain: {size: [120 um, 120 um, 120 um]}\n"
    "cell_types: {cell: {radius: {mean: 5 um, spread: 3 %}, cycle: {duration: 20 h}}}\n"
    "initial: [{type: cell, count: 12, fill: sphere, radius: 16 um, age: birth}]\noutput: {report: false}\n";

/// The runs s1, s2, s3 of three seeds and t1, t2, t3 of the same seeds with one thing changed.
class Compare : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("study.yaml", kStudy);
    for (const char* seed : {"1", "2", "3"}) {
      run(std::string("s") + seed, seed, {});
      run(std::string("t") + seed, seed, {"cell_types.cell.radius.mean=5.5 um"});
    }
  }
  void run(const std::string& out, const std::string& seed, std::vector<std::string> more) {
    std::vector<std::string> command{"run", "study.yaml", "--out", out, "--seed", seed};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome done = run_morula(command, folder_.path());
    ASSERT_EQ(done.exit_code, 0) << done.all();
  }
  [[nodiscard]] Outcome compare(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "compare");
    return run_morula(arguments, folder_.path());
  }
  TestFolder folder_;
};

TEST_F(Compare, TellsWhatDiffersByMoreThanSeedsSpreadAndWhatWasSetOtherwise) {
  const Outcome done = compare({"s1", "t1", "s2", "t2", "s3", "t3", "--json", "--out", "both"});  // single runs find their group
  ASSERT_EQ(done.exit_code, 0) << done.all();
  const auto json = nlohmann::json::parse(done.out);
  ASSERT_EQ(json["groups"].size(), 2u);
  EXPECT_EQ(json["groups"][0]["runs"].size(), 3u);
  EXPECT_EQ(json["until"], 1200.0);
  ASSERT_EQ(json["settings"].size(), 1u);
  EXPECT_EQ(json["settings"][0]["key"], "cell_types.cell.radius.mean");
  EXPECT_EQ(json["settings"][0]["values"]["t1"], "5.5 um");
  const auto column = [&](const std::string& name) {
    for (const auto& one : json["columns"])
      if (one["name"] == name) return one;
    ADD_FAILURE() << name;
    return nlohmann::json();
  };
  // The same seed draws the same factors of size: each run's volume is (5.5/5)^3 times that of its partner.
  EXPECT_NEAR(column("total_volume")["relative"].get<double>(), 0.331, 0.002);
  EXPECT_EQ(column("total_volume")["verdict"], "differs");
  EXPECT_EQ(column("cell_count")["verdict"], "same");
  const std::string page = read_text(folder_ / "both/compare.html");
  EXPECT_THAT(page, testing::AllOf(HasSubstr("total_volume"), HasSubstr("cell_types.cell.radius.mean"), HasSubstr("5.5 um"),
                                   HasSubstr("<svg"), HasSubstr("data:image/png")));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "both/plots/spheroid_radius.svg"));
}

TEST_F(Compare, JudgesWhatIsAsked) {
  const std::vector<std::string> groups{"a=s1,s2,s3", "b=t1,t2,t3"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = groups;
    all.insert(all.end(), more.begin(), more.end());
    return compare(all);
  };
  EXPECT_EQ(with({"--only", "cell_count", "--within", "3%", "--json"}).exit_code, 0);
  const Outcome far = with({"--only", "cell_count,total_volume", "--within", "3%"});
  EXPECT_EQ(far.exit_code, 5) << far.all();
  EXPECT_THAT(far.err, HasSubstr("1 difference of 2 not shown to be within 3%"));
  EXPECT_THAT(far.out, testing::AllOf(HasSubstr("beyond 3 %"), HasSubstr("comparisons/a_b/compare.html")));
  EXPECT_THAT(with({"--only", "cell_count"}).out, HasSubstr("comparisons/a_b-2/compare.html"));  // nothing is overwritten
  EXPECT_EQ(with({"--only", "total_volume", "--within", "60%", "--json"}).exit_code, 0);
  EXPECT_EQ(with({"--only", "total_volume", "--within", "60%", "--every", "--from", "5min", "--json"}).exit_code, 0);
  const Outcome spread = compare({"a=s1,s3", "b=s2", "--only", "total_volume", "--within", "0.001%"});  // three draws of one study
  EXPECT_EQ(spread.exit_code, 5);
  EXPECT_THAT(spread.out, HasSubstr("undecided"));
  EXPECT_THAT(spread.err, HasSubstr("'b' is one run"));
}

TEST_F(Compare, RefusesWhatCannotBeCompared) {
  const auto refused = [&](const std::vector<std::string>& arguments, int code, const std::string& why) {
    const Outcome done = compare(arguments);
    EXPECT_EQ(done.exit_code, code) << done.all();
    EXPECT_THAT(done.err, HasSubstr(why));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "comparisons")) << why;
  };
  refused({"s1", "none"}, 3, "there is no run 'none'");
  refused({"s1"}, 2, "a comparison needs two");
  refused({"s1", "s2"}, 2, "differ in nothing but the seed");
  refused({"a=s1,t1", "b=s2"}, 2, "`cell_types.cell.radius.mean` is '5 um' in s1 and '5.5 um' in t1");
  refused({"a=s1", "b=./s1"}, 2, "is given twice");
  refused({"a=s1", "a=t1"}, 2, "two groups are called 'a'");
  refused({"=s1", "b=t1"}, 2, "a group without a name");
  refused({"a=s1,", "b=t1"}, 2, "a run without a name");
  refused({"s1", "t1", "--only", "pressur"}, 2, "not all runs have a column 'pressur'");
  refused({"s1", "t1", "--within", "5 um"}, 2, "--within");
  refused({"s1", "t1", "--within", "0"}, 2, "must be above 0");
  refused({"s1", "t1", "--within", "3"}, 2, "for example `--within 3%`");
  refused({"s1", "t1", "--out", "s1"}, 3, "exists already");
  run("again", "1", {"title=again"});
  refused({"a=s1,again", "b=t1"}, 2, "have the seed 1");
  run("late", "1", {"time.output=7 min", "time.end=7 min"});
  refused({"s1", "late", "--from", "6min"}, 2, "the last output that all runs have is at 0");
  run("units", "2", {"cell_types.cell.radius.mean=6 um"});
  const std::string series = read_text(folder_ / "units/series.csv");
  folder_.write("units/series.csv", std::string(series).replace(series.find("[um^3]"), 6, "[mm^3]"));
  refused({"s1", "units"}, 2, "'total_volume' is in um^3 in s1 and in mm^3 in units");
  folder_.write("units/series.csv", "time [s],cell_count [1]\n0,1,2\n");
  refused({"s1", "units"}, 3, "units/series.csv:2: this row has 3 fields");
}

TEST_F(Compare, GoesAsFarAsAllRunsDo) {
  run("short", "4", {"time.end=10 min", "cell_types.cell.radius.mean=5.5 um"});
  const Outcome done = compare({"s1", "short", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.all();
  EXPECT_EQ(nlohmann::json::parse(done.out)["until"], 600.0);
  EXPECT_THAT(done.err, HasSubstr("s1 goes on to 20 min; compared is up to 10 min"));
}

}  // namespace
}  // namespace morula::test
