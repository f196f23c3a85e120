#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/verbs.h"
#include "app/words.h"
#include "core/numbers/number_text.h"
#include "scenarios/verify/verify.h"
#include "study/diagnostics.h"

namespace morula::app {
namespace fs = std::filesystem;
namespace {

using scenarios::VerifiedRow;

std::string json_of(const scenarios::VerifySuite& suite, const std::vector<VerifiedRow>& rows, bool found = true) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const VerifiedRow& row : rows) {
    nlohmann::ordered_json one{{"id", row.id}, {"quantity", row.quantity}};
    one["reference"] = row.reference ? nlohmann::ordered_json(*row.reference) : nlohmann::ordered_json(nullptr);
    one["value"] = std::isfinite(row.value) ? nlohmann::ordered_json(row.value) : nlohmann::ordered_json(nullptr);
    one["tolerance"] = row.tolerance;
    one["passed"] = found ? nlohmann::ordered_json(row.passed) : nlohmann::ordered_json(nullptr);
    one["source"] = row.source;
    list.push_back(std::move(one));
  }
  return nlohmann::ordered_json{{"suite", suite.name}, {"rows", list}}.dump(2) + "\n";
}

std::string table_of(const std::vector<VerifiedRow>& rows) {
  std::vector<std::vector<std::string>> table{{"id", "quantity", "reference", "ours", "difference", "tolerance", "", "source"}};
  for (const VerifiedRow& row : rows)
    table.push_back({row.id, row.quantity, row.reference ? number_text("%.7g", *row.reference) : "", number_text("%.7g", row.value),
                     row.reference ? number_text("%.2g", row.value - *row.reference) : "", row.tolerance, row.passed ? "ok" : "FAILED",
                     row.source});
  return table_text(table);
}

std::string table_of_references(const std::vector<VerifiedRow>& rows) {
  std::vector<std::vector<std::string>> table{{"id", "quantity", "reference", "tolerance", "source"}};
  for (const VerifiedRow& row : rows)
    table.push_back({row.id, row.quantity, number_text("%.7g", *row.reference), row.tolerance, row.source});
  return table_text(table);
}

std::string suites_text(bool as_json) {
  std::vector<std::vector<std::string>> table;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const scenarios::VerifySuite& suite : scenarios::verify_suites()) {
    table.push_back({std::string(suite.name), std::string(suite.what)});
    list.push_back({{"name", suite.name}, {"what", suite.what}});
  }
  return as_json ? nlohmann::ordered_json{{"suites", list}}.dump(2) + "\n" : table_text(table);
}

/// A folder that is gone when this object is.
class Scratch {
 public:
  Scratch() : path_(fs::temp_directory_path() / ("morula-verify-" + std::to_string(getpid()))) {}
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

Status verify(const VerifyOptions& options, const Context& context) {
  if (options.list && options.suite.empty()) {
    context.console.result(suites_text(options.json));
    return {};
  }
  const scenarios::VerifySuite& suite = options.suite.empty() ? scenarios::verify_suites().front() : *scenarios::find_suite(options.suite);
  if (options.list) {
    context.console.result(options.json ? json_of(suite, scenarios::rows_of(suite), false)
                                        : table_of_references(scenarios::rows_of(suite)));
    return {};
  }
  if (options.studies && suite.name != "physics")
    return Error{ErrorKind::kInput, "--studies belongs to the suite `physics`", "`morula verify physics --studies`"};
  std::vector<std::string> ids;
  for (const VerifiedRow& row : scenarios::rows_of(suite))
    if (std::ranges::find(ids, row.id) == ids.end()) ids.push_back(row.id);
  for (const std::string& id : options.only)
    if (std::ranges::find(ids, id) == ids.end())
      return Error{ErrorKind::kInput, "the suite `" + std::string(suite.name) + "` has no number '" + id + "'",
                   scenarios::suggest(id, ids)};
  std::vector<VerifiedRow> rows = scenarios::verify(suite, options.only);
  if (options.studies) {
    const Scratch scratch;
    MORULA_TRY_ASSIGN(const auto more, scenarios::verify_single_cell_studies(
                                           scratch.path(), [&](const std::string& name) { context.console.note("study " + name); }));
    rows.insert(rows.end(), more.begin(), more.end());
  }
  const auto failed = static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [](const VerifiedRow& r) { return !r.passed; }));
  context.console.result(options.json ? json_of(suite, rows) : table_of(rows));
  if (failed == 0) {
    context.console.note("all " + count_words(rows.size(), "row", "rows") + " within tolerance");
    return {};
  }
  return Error{ErrorKind::kVerification,
               count_words(failed, "row", "rows") + " of " + std::to_string(rows.size()) + " outside the tolerance", ""};
}

}  // namespace morula::app
