#pragma once
#include <gmock/gmock.h>

#include "results/file_io.h"
#include "results/series_reader.h"
#include "scenarios/run/driver.h"
#include "study/catalogue.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {

/// Runs of studies that name things which the test brings: what a program does that has laws of its own.
class OwnParts : public ::testing::Test {
 protected:
  explicit OwnParts(const std::function<void(Laws&)>& add) {
    Laws laws = *builtin_laws();
    add(laws);
    laws_ = std::make_shared<const Laws>(std::move(laws));
  }

  [[nodiscard]] ReadOptions options() const {
    ReadOptions out;
    out.laws = laws_;
    return out;
  }
  Study study(const std::string& text) {
    auto found = read(text, options(), folder_.path());
    EXPECT_TRUE(found.ok()) << found.error().text();
    return std::move(found).value();
  }
  RunSummary run_whole(const std::string& text, const std::string& name, int threads = 1, std::optional<double> until = {}) {
    RunRequest request;
    request.out = folder_.path() / name;
    request.threads = threads;
    request.until = until;
    auto done = run(study(text), request, Comm());
    EXPECT_TRUE(done.ok()) << done.error().message;
    return done.ok() ? std::move(done).value() : RunSummary{};
  }
  /// To `until`, then on to the end.
  RunSummary run_split(const std::string& text, const std::string& name, double until) {
    run_whole(text, name, 1, until);
    return go_on(name);
  }
  /// A run that was broken off, to `until` or its end.
  RunSummary go_on(const std::string& name, std::optional<double> until = {}) {
    ResumeRequest request;
    request.until = until;
    request.laws = laws_;
    auto done = resume(folder_.path() / name, request, Comm());
    EXPECT_TRUE(done.ok()) << done.error().message;
    return done.ok() ? std::move(done).value() : RunSummary{};
  }
  std::vector<double> column(const std::string& run, const std::string& name) {
    const auto series = read_series(folder_.path() / run / "series.csv");
    EXPECT_TRUE(series.ok());
    const SeriesColumn* values = series->find(name);
    EXPECT_NE(values, nullptr) << name;
    return values != nullptr ? values->values : std::vector<double>{};
  }
  std::string file(const std::string& run, const std::string& name) {
    auto text = read_file(folder_.path() / run / name);
    return text.ok() ? *text : "";
  }
  [[nodiscard]] std::string explain(const std::string& id) const { return explain_study(id, *laws_).value_or(""); }

  std::shared_ptr<const Laws> laws_;
  Folder folder_;
};

}  // namespace morula::scenarios::test
