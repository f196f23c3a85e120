#include "results/lineage.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "core/numbers/number_text.h"
#include "results/file_io.h"
#include "results/run_record.h"
#include "results/snapshot_file.h"

namespace morula::scenarios {
namespace fs = std::filesystem;
namespace {

const char* word_of(LifeEnd how) {
  switch (how) {
    case LifeEnd::kAlive:
      return "alive";
    case LifeEnd::kDivided:
      return "divided";
    case LifeEnd::kDying:
      return "dying";
    case LifeEnd::kDied:
      return "died";
  }
  return "";
}

/// The lives of a run by id, as its events tell them.
class Lives {
 public:
  Lives(const Snapshot& first, double end) : end_(end) {
    for (const Snapshot::Cell& cell : first.cells) {
      const std::string type = cell.type < first.type_names.size() ? first.type_names[cell.type] : std::string();
      begin({cell.id.text(), cell.parent.valid() ? cell.parent.text() : std::string(), type, first.time - cell.age, end});
    }
  }

  void note(const EventLine& event) {
    const auto at = place_.find(event.cell);
    if (at == place_.end()) return;
    CellLife& life = lives_[at->second];
    if (event.kind == name_of(EventKind::kDeath)) life.how = LifeEnd::kDying;
    if (event.kind == name_of(EventKind::kRemoval)) life.how = LifeEnd::kDied, life.end = event.time;
    if (event.kind != name_of(EventKind::kDivision)) return;
    life.how = LifeEnd::kDivided, life.end = event.time;
    const std::string type = life.type;  // begin() moves the lives
    life.division_volume = event.volume;
    for (std::size_t which = 0; which < event.daughters.size(); ++which) {
      begin({event.daughters[which], event.cell, which < event.birth_types.size() ? event.birth_types[which] : type, event.time, end_});
      if (which < event.birth_volumes.size()) lives_.back().birth_volume = event.birth_volumes[which];
    }
  }

  /// In the order of founders, and of each the mother before her daughters.
  std::vector<CellLife> in_order() && {
    const auto generation = [](const CellLife& life) { return life.id.size(); };
    std::ranges::stable_sort(lives_, [&](const CellLife& a, const CellLife& b) {
      const auto founder_a = founder(a), founder_b = founder(b);
      if (founder_a != founder_b) return founder_a < founder_b;
      return generation(a) != generation(b) ? generation(a) < generation(b) : a.id < b.id;
    });
    return std::move(lives_);
  }

 private:
  static std::uint64_t founder(const CellLife& life) { return std::stoull(life.id); }
  void begin(CellLife life) {
    place_.emplace(life.id, lives_.size());
    lives_.push_back(std::move(life));
  }

  double end_;
  std::vector<CellLife> lives_;
  std::map<std::string, std::size_t> place_;
};

/// A cell and what came of it, without the end of the line.
void put_tree(std::span<const CellLife> lives, const std::multimap<std::string, std::size_t>& daughters, std::size_t cell,
              std::string& out) {
  const CellLife& life = lives[cell];
  const auto [begin, end] = daughters.equal_range(life.id);
  if (begin != end) {
    out += '(';
    for (auto at = begin; at != end; ++at) {
      if (at != begin) out += ',';
      put_tree(lives, daughters, at->second, out);
    }
    out += ')';
  }
  out += life.id + ':' + shortest_text((life.end - life.birth) / 3600.0);
}

}  // namespace

namespace {

/// The cells that live by the events are those of the last snapshot.
Status agree_on_who_lives(std::span<const CellLife> lives, const Snapshot& last, const fs::path& events) {
  std::set<std::string> told, there;
  for (const CellLife& life : lives)
    if (life.how == LifeEnd::kAlive || life.how == LifeEnd::kDying) told.insert(life.id);
  for (const auto& cell : last.cells) there.insert(cell.id.text());
  std::vector<std::string> odd;
  std::set_symmetric_difference(told.begin(), told.end(), there.begin(), there.end(), std::back_inserter(odd));
  if (odd.empty()) return {};
  return Error{ErrorKind::kFile,
               "'" + events.string() + "' and the last snapshot differ in who lives: " + std::to_string(odd.size()) + " cells, " +
                   odd.front() + " among them",
               "divisions or deaths were lost from the file, and without them there is no lineage"};
}

}  // namespace

Result<std::vector<CellLife>> read_lineage(const fs::path& results, const fs::path& events) {
  MORULA_TRY_ASSIGN(const auto entries, list_snapshots(results));
  if (entries.empty())
    return Error{ErrorKind::kInput, "'" + results.string() + "' holds no snapshot", "the founders are those of the first"};
  MORULA_TRY_ASSIGN(const Snapshot first, read_snapshot(results, 0));
  MORULA_TRY_ASSIGN(const std::string text, read_file(events));
  Lives lives(first, entries.back().time);
  for (const EventLine& event : events_of_lines(text))
    if (event.time <= entries.back().time) lives.note(event);
  std::vector<CellLife> out = std::move(lives).in_order();
  MORULA_TRY_ASSIGN(const Snapshot last, read_snapshot(results, entries.size() - 1));
  MORULA_TRY(agree_on_who_lives(out, last, events));
  return out;
}

std::string lineage_csv(std::span<const CellLife> lives) {
  const auto known = [](double volume) { return volume > 0.0 ? shortest_text(volume) : std::string(); };
  std::string out = "id,parent,type,birth [s],end [s],how,birth volume [um^3],division volume [um^3]\n";
  for (const CellLife& life : lives)
    out += life.id + ',' + (life.parent.empty() ? "0" : life.parent) + ',' + csv_field(life.type) + ',' + shortest_text(life.birth) + ',' +
           shortest_text(life.end) + ',' + word_of(life.how) + ',' + known(life.birth_volume) + ',' + known(life.division_volume) + '\n';
  return out;
}

std::string lineage_newick(std::span<const CellLife> lives) {
  std::multimap<std::string, std::size_t> daughters;
  for (std::size_t k = 0; k < lives.size(); ++k)
    if (!lives[k].parent.empty()) daughters.emplace(lives[k].parent, k);
  std::string out;
  std::set<std::string> known;  // mothers come before their daughters
  for (std::size_t k = 0; k < lives.size(); ++k) {
    known.insert(lives[k].id);
    if (known.contains(lives[k].parent)) continue;
    put_tree(lives, daughters, k, out);
    out += ";\n";
  }
  return out;
}

Result<std::size_t> export_lineage(const fs::path& results, const fs::path& events, const fs::path& folder) {
  MORULA_TRY_ASSIGN(const auto lives, read_lineage(results, events));
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Error{ErrorKind::kFile, "'" + folder.string() + "' cannot be made: " + error.message(), {}};
  MORULA_TRY(write_file_atomically(folder / "lineage.csv", lineage_csv(lives)));
  MORULA_TRY(write_file_atomically(folder / "lineage.nwk", lineage_newick(lives)));
  return lives.size();
}

}  // namespace morula::scenarios
