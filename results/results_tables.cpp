#include <cstring>
#include <limits>

#include "results/checkpoint.h"
#include "results/run_record.h"
#include "results/series_reader.h"
#include "results/snapshot_columns.h"
#include "results/snapshot_file.h"

namespace morula::scenarios {
namespace {

/// The root's text on every rank.
std::string from_root(const std::string& text, const Comm& comm) {
  std::vector<std::byte> bytes(comm.is_root() ? text.size() : 0);
  if (!bytes.empty()) std::memcpy(bytes.data(), text.data(), bytes.size());
  comm.broadcast(bytes);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<std::string> event_kinds() {
  std::vector<std::string> names;
  for (int kind = 0; kind <= static_cast<int>(EventKind::kWarning); ++kind) names.push_back(name_of(static_cast<EventKind>(kind)));
  return names;
}

/// Lines that are not whole are left out.
void add_events(StoragePlan& plan, const std::string& lines) {
  const std::vector<std::string> kinds = event_kinds();
  std::vector<double> time;
  std::vector<std::uint8_t> kind;
  std::vector<std::string> cell, daughters, text;
  for (const EventLine& event : events_of_lines(lines)) {
    const auto found = std::find(kinds.begin(), kinds.end(), event.kind);
    if (found == kinds.end()) continue;
    time.push_back(event.time);
    kind.push_back(static_cast<std::uint8_t>(found - kinds.begin()));
    cell.push_back(event.cell);
    std::string& names = daughters.emplace_back();
    for (const std::string& name : event.daughters) names += (names.empty() ? "" : " ") + name;
    text.push_back(event.text);
  }
  plan.add_from_root(results::kEventTime.path, results::kEventTime.label(), std::span<const double>(time));
  plan.add_from_root(results::kEventKind.path, {results::kEventKind.units, results::kEventKind.description, kinds},
                     std::span<const std::uint8_t>(kind));
  plan.add_text(results::kEventCell.path, cell, results::kEventCell.label());
  plan.add_text(results::kEventDaughters.path, daughters, results::kEventDaughters.label());
  plan.add_text(results::kEventText.path, text, results::kEventText.label());
}

}  // namespace

Status write_results_tables(const std::filesystem::path& path, const std::string& series_csv, const std::string& event_lines,
                            const std::map<std::string, std::string>& descriptions, const Comm& comm) {
  // Every rank must plan the same datasets: it sees the root's texts.
  MORULA_TRY_ASSIGN(const SeriesTable series, parse_series(from_root(series_csv, comm), "series.csv"));
  const std::string events = from_root(event_lines, comm);
  // Taking out what is later than any time takes out the tables that are there.
  MORULA_TRY(truncate_snapshots(path, std::numeric_limits<double>::infinity(), comm));
  StoragePlan plan(comm);
  for (const SeriesColumn& column : series.columns) {
    const auto found = descriptions.find(column.name);
    plan.add_from_root("series/" + column.name, {column.unit, found == descriptions.end() ? "" : found->second},
                       std::span<const double>(column.values));
  }
  add_events(plan, events);
  return add_to_file(path, std::move(plan), {}, comm);
}

}  // namespace morula::scenarios
