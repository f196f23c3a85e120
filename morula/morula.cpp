#include "morula/morula.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "coupling/simulation.h"
#include "results/build_info.h"
#include "results/hdf5_reader.h"
#include "results/observables/local_snapshot.h"
#include "results/snapshot_columns.h"
#include "results/snapshot_file.h"
#include "results/state_hash.h"
#include "scenarios/run/run_loop.h"
#include "study/initial/make_tissue.h"
#include "study/study.h"

namespace morula::api {
namespace {

constexpr Version kLibraryVersion{MORULA_VERSION_MAJOR, MORULA_VERSION_MINOR, MORULA_VERSION_PATCH};
static_assert(kHeaderVersion == kLibraryVersion, "morula.h tells another version than CMakeLists.txt");

Point point_of(const Vec3d& p) { return {p.x, p.y, p.z}; }

Cell cell_of(const scenarios::Snapshot::Cell& from) {
  Cell cell;
  cell.id = from.id.bits();
  cell.parent = from.parent.bits();
  cell.type = from.type;
  cell.body = from.body == BodyKind::kShell ? Body::kShell : Body::kSphere;
  cell.centre = point_of(from.centroid);
  cell.radius = from.radius;
  cell.volume = from.volume;
  cell.area = from.area;
  cell.contact_area = from.contact_area;
  cell.pressure = from.pressure;
  cell.inner_pressure = from.inner_pressure;
  cell.age = from.age;
  return cell;
}

/// A moment as the public interface shows it: cells and surfaces by increasing id, and what the surfaces refer to.
struct Moment {
  std::vector<Cell> cells;
  std::vector<Surface> surfaces;
  std::vector<Point> nodes;
  std::vector<std::vector<Triangle>> faces;
};

Moment moment_of(const scenarios::Snapshot& snapshot) {
  Moment out;
  for (const auto& cell : snapshot.cells) out.cells.push_back(cell_of(cell));
  for (const Vec3d& p : snapshot.nodes) out.nodes.push_back(point_of(p));
  out.faces = snapshot.topologies;
  for (const auto& shell : snapshot.shells)
    out.surfaces.push_back(
        {out.cells[shell.cell].id, std::span(out.nodes).subspan(shell.first_node, shell.node_count), out.faces[shell.topology]});
  std::ranges::sort(out.cells, {}, &Cell::id);
  std::ranges::sort(out.surfaces, {}, &Surface::cell);
  return out;
}

}  // namespace

Version version() { return kLibraryVersion; }
std::string licence() { return scenarios::build_info().licence; }

struct Study::Content {
  scenarios::Study study;
  std::vector<std::string> type_names;
};

namespace {

/// The study, or one error with all messages of the check.
Result<scenarios::Study> checked(Result<scenarios::Study, scenarios::Diagnostics> read) {
  if (!read.ok()) return Error{ErrorKind::kInput, read.error().text(), "see docs/study_reference.md"};
  return std::move(read).value();
}

scenarios::ReadOptions options_of(const std::vector<std::string>& overrides, std::shared_ptr<const Laws> laws) {
  scenarios::ReadOptions options;
  if (laws != nullptr) options.laws = std::move(laws);
  options.overrides = overrides;
  return options;
}

std::vector<std::string> names_of_types(const Model& model) {
  std::vector<std::string> out;
  for (const CellType& type : model.types) out.push_back(type.name);
  return out;
}

}  // namespace

Result<Study> Study::read(const std::filesystem::path& file, const std::vector<std::string>& overrides, std::shared_ptr<const Laws> laws) {
  MORULA_TRY_ASSIGN(scenarios::Study study, checked(scenarios::read_study(file, options_of(overrides, std::move(laws)))));
  Study out;
  std::vector<std::string> names = names_of_types(study.model);
  out.content_ = std::make_shared<const Content>(Content{std::move(study), std::move(names)});
  return out;
}

Result<Study> Study::from_text(const std::string& text, const std::filesystem::path& folder, const std::vector<std::string>& overrides,
                               std::shared_ptr<const Laws> laws) {
  MORULA_TRY_ASSIGN(scenarios::Study study,
                    checked(scenarios::read_study_text("study", text, folder, options_of(overrides, std::move(laws)))));
  Study out;
  std::vector<std::string> names = names_of_types(study.model);
  out.content_ = std::make_shared<const Content>(Content{std::move(study), std::move(names)});
  return out;
}

const std::string& Study::name() const { return content_->study.name; }
double Study::end() const { return content_->study.time.end; }
double Study::output_interval() const { return content_->study.time.output; }
std::span<const std::string> Study::type_names() const { return content_->type_names; }
const std::string& Study::resolved_text() const { return content_->study.resolved_text; }
std::string Study::warnings() const { return content_->study.warnings.text(); }

struct Simulation::Content {
  std::shared_ptr<const Study::Content> study;
  std::unique_ptr<morula::Simulation> simulation;
  std::optional<scenarios::Snapshot> snapshot;  ///< of the present state, once it was asked for
  std::optional<Moment> moment;                 ///< likewise

  const scenarios::Snapshot& present() {
    if (!snapshot) snapshot = scenarios::local_snapshot(*simulation);
    return *snapshot;
  }
  const Moment& shown() {
    if (!moment) moment = moment_of(present());
    return *moment;
  }
};

Simulation::Simulation(std::unique_ptr<Content> content) : content_(std::move(content)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Result<Simulation> Simulation::create(const Study& study, int threads) {
  constexpr int kMostThreads = 1024;
  if (threads < 1 || threads > kMostThreads)
    return Error{ErrorKind::kInput, std::to_string(threads) + " threads are asked for", "from 1 to " + std::to_string(kMostThreads)};
  auto content = std::make_unique<Content>();
  content->study = study.content_;
  ShapeLibrary shapes;
  MORULA_TRY_ASSIGN(scenarios::InitialTissue initial, scenarios::make_tissue(content->study->study, shapes, Comm()));
  MORULA_TRY_ASSIGN(content->simulation,
                    morula::Simulation::create(content->study->study.model, std::move(initial.tissue), Comm(), threads));
  MORULA_TRY(content->simulation->first_swaps());
  return Simulation(std::move(content));
}

double Simulation::time() const { return content_->simulation->tissue().clock.time; }
bool Simulation::done() const { return time() >= content_->study->study.time.end; }

Result<Step> Simulation::step() {
  if (done()) return Step{};
  const scenarios::TimeSpec& spec = content_->study->study.time;
  content_->snapshot.reset();
  content_->moment.reset();
  MORULA_TRY_ASSIGN(const StepOutcome outcome, content_->simulation->step(scenarios::next_output(time(), spec.output, spec.end)));
  return Step{outcome.mechanics.step, outcome.retries, outcome.mechanics.newton, outcome.mechanics.energy};
}

Status Simulation::advance_to(double time) {
  if (std::isnan(time)) return Error{ErrorKind::kInput, "the time to advance to is not a number", "a time in seconds"};
  while (this->time() < time && !done()) MORULA_TRY(step());
  return {};
}

std::span<const Cell> Simulation::cells() const { return content_->shown().cells; }
std::span<const Surface> Simulation::surfaces() const { return content_->shown().surfaces; }
std::string Simulation::state_hash() const { return scenarios::state_hash(content_->simulation->tissue(), Comm()).hex(); }

namespace {

/// Whether a file of snapshots is new, or has those of this study; kInput if not.
Status is_of_study(const std::filesystem::path& file, const scenarios::Study& study) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  MORULA_TRY_ASSIGN(const scenarios::Hdf5Reader there, scenarios::Hdf5Reader::open(file));
  MORULA_TRY_ASSIGN(const std::string resolved, there.text(scenarios::results::kResolvedStudy.path));
  if (resolved == study.resolved_text) return {};
  return Error{ErrorKind::kInput, "'" + file.string() + "' has snapshots of another study ('" + there.root_text("study") + "')",
               "give a file of its own to every study, and to every seed"};
}

}  // namespace

Status Simulation::write_snapshot(const std::filesystem::path& file) const {
  MORULA_TRY(is_of_study(file, content_->study->study));
  MORULA_TRY(scenarios::begin_results(file, scenarios::results_head(content_->study->study), Comm()));
  return scenarios::append_snapshot(file, content_->present(), content_->simulation->tissue().fields, Comm());
}

}  // namespace morula::api
