#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <ctime>

#include "study/catalogue.h"
#include "study/key_range.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

void collect(const Declaration& from, std::vector<const Declaration*>& out) {
  for (const Declaration& child : from.children) {
    out.push_back(&child);
    collect(child, out);
  }
}

TEST(Ranges, OfEveryKeyHaveBothEndsAndHoldItsDefaultAndExample) {
  const Declaration root = study_declarations(*builtin_laws());
  std::vector<const Declaration*> all;
  collect(root, all);
  const UnitSystem units;
  int numbers = 0;
  for (const Declaration* d : all) {
    using Kind = Declaration::Kind;
    const bool number = d->kind == Kind::kQuantity || d->kind == Kind::kVector || d->kind == Kind::kVectors ||
                        d->kind == Kind::kQuantities || (d->kind == Kind::kWhole && d->spec.words.empty());
    if (!number) continue;
    ++numbers;
    const KeyRange range = range_of(d->spec);
    EXPECT_TRUE(std::isfinite(range.low) && std::isfinite(range.high)) << d->path;
    // Nobody could choose a value of a key that allows only one; of the file's format there is only one version yet.
    if (d->path == "schema")
      EXPECT_EQ(range.low, range.high);
    else
      EXPECT_LT(range.low, range.high) << d->path;
    EXPECT_FALSE(range.holds(1e300)) << d->path;
    EXPECT_FALSE(range.holds(-1e300)) << d->path;
    if (d->kind == Kind::kWhole) continue;
    if (d->spec.low == 0.0 && d->spec.low_open) {
      EXPECT_FALSE(range.holds(1e-300)) << d->path;
    }
    for (const char* text : {d->spec.fallback, d->spec.example}) {
      const auto value = units.parse(text ? text : "", d->spec.quantity);
      EXPECT_TRUE(!value.ok() || range.holds(*value)) << d->path << " " << text;
    }
  }
  EXPECT_GT(numbers, 150);
}

struct Huge {
  const char *from, *to, *message;
};

TEST(Ranges, RefuseWhatNoTissueHas) {
  for (const Huge& huge : {Huge{"end: 96 h", "end: 1e300 s", "'end' is 1e300 s, but must be between 1e-09 s and 3.2e+09 s"},
                           {"size: [400 um, 400 um, 400 um]", "size: [1e300 um, 400 um, 400 um]", "'size' is 1e300 um"},
                           {"initial: 0.2 mM", "initial: 1e300 mM", "the water in water"},
                           {"medium: 1e8 N s/m^3", "medium: 1e300 N s/m^3", "'medium' is 1e300 N s/m^3"},
                           {"thickness: 200 nm", "thickness: 1e300 nm", "'thickness' is 1e300 nm"},
                           {"diffusion: 2e-9 m^2/s", "diffusion: 1e290 m^2/s", "hydrogen in air"},
                           {"step: auto", "step: 1e-300 s", "'step' is 1e-300 s, but must be between 1e-09 s"}})
    EXPECT_THAT(errors_of(changed(huge.from, huge.to)), AllOf(HasSubstr(huge.message), HasSubstr("[E302]"))) << huge.to;
}

TEST(Ranges, TakeTheNamesOfUnitsThatUdunitsTakes) {
  for (const char* length :
       {"6 micron", "6 microns", "6 micrometer", "6 micrometers", "6 micrometre", "6 µm", "60000 angstrom", "6e-3 millimeter"}) {
    const auto study = read(changed("{mean: 6 um, spread: 10 %}", length));
    ASSERT_TRUE(study.ok()) << length << study.error().text();
    EXPECT_DOUBLE_EQ(study->model.types[0].radius.mean, 6.0) << length;
  }
  EXPECT_DOUBLE_EQ(read(changed("persistence: 30 min", "persistence: 1800 sec"))->model.types[0].migration.own("persistence"), 1800.0);
}

TEST(Messages, AboutABareValueNameTheKeyThatIsThere) {
  const std::string message = errors_of(changed("radius: {mean: 6 um, spread: 10 %}", "radius: 6"));
  EXPECT_THAT(message, AllOf(HasSubstr("'radius' is a length and needs a unit, but is '6'"), Not(HasSubstr("mean"))));
  EXPECT_THAT(errors_of(changed("boundary: {all: 0.2 mM}", "boundary: 0.2 kPa")), HasSubstr("'boundary' is a concentration"));
  EXPECT_THAT(errors_of(changed("boundary: open", "boundary: opne")), HasSubstr("'boundary' cannot be 'opne'"));
  EXPECT_THAT(errors_of(changed("mean: 6 um", "mean: 6")), HasSubstr("'mean' is a length and needs a unit"));
}

/// CPU seconds of this thread: other processes share the machine.
double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::string many_keys(int count, const char* separator) {
  std::string text;
  for (int i = 0; i < count; ++i) text += (i ? separator : "") + ("k" + std::to_string(100000 + i)) + ": 1";
  return text;
}

TEST(Messages, OfVeryManyMistakesAreAHundredAndTheirNumberAtOnce) {
  for (const std::string& text : {std::string(kGoodStudy) + many_keys(400'000, "\n") + "\n",
                                  changed("title: Spheroid", "tittle: {" + many_keys(400'000, ", ") + "} #")}) {
    const double start = cpu_seconds();
    const auto study = read(text);
    ASSERT_FALSE(study.ok());
    const std::string messages = study.error().text();
    EXPECT_LT(cpu_seconds() - start, 1.0);
    std::size_t told = 0;
    for (std::size_t at = 0; (at = messages.find("error: ", at)) != std::string::npos; ++at) ++told;
    EXPECT_LE(told, 100u);
    EXPECT_LT(messages.size(), 100000u);
    EXPECT_THAT(messages, AllOf(HasSubstr("[E690]"), HasSubstr("are not read"), Not(HasSubstr("is missing"))));
  }
  const auto study = read(std::string(kGoodStudy) + many_keys(40'000, "\n") + "\n");
  EXPECT_EQ(study.error().error_count(), 40000u);
  EXPECT_THAT(study.error().text(), HasSubstr("and 39,900 more\n"));
}

TEST(Messages, OfWhatStandsBeforeTheUnreadPartAreTold) {
  // The first mistakes, and how many lines were not reached; nothing that the unread part may hold is said to be missing.
  const std::string good(kGoodStudy), wrong = "wrong: 1\n" + many_keys(150'000, "\n") + "\n";
  const auto lines = std::to_string(std::count(wrong.begin(), wrong.end(), '\n') + std::count(good.begin(), good.end(), '\n') + 1);
  const auto study = read(wrong + good);
  ASSERT_FALSE(study.ok());
  EXPECT_THAT(study.error().text(), AllOf(HasSubstr("of its " + lines + " lines, those from line 1000"), HasSubstr("unknown key 'wrong'"),
                                          HasSubstr("unknown key 'k100000'"), HasSubstr("csv: cells.csv"), Not(HasSubstr("is missing"))));
}

TEST(Messages, AThousandTypesAreRefusedAndNotHeld) {
  std::string types = "cell_types:\n";
  for (int i = 0; i < 100000; ++i) types += "  t" + std::to_string(i) + ": {}\n";
  const std::string message = errors_of("schema: 1\nstudy: many\ntime: {end: 1 h}\ndomain: {size: [1 mm, 1 mm, 1 mm]}\n" + types +
                                        "initial: [{type: t0, at: [[0 um, 0 um, 0 um]]}]\n");
  EXPECT_THAT(message, HasSubstr("[E404]"));
}

}  // namespace
}  // namespace morula::scenarios::test
