#include "results/checkpoint_folder.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <span>

#include "results/file_io.h"
#include "results/hdf5_reader.h"

namespace morula::scenarios {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kKept = 2;

/// The number in `cp_000012.h5`, or −1.
long number_of(const fs::path& path) {
  long number = -1;
  int end = 0;
  const std::string name = path.filename().string();
  if (std::sscanf(name.c_str(), "cp_%ld.h5%n", &number, &end) != 1 || end != static_cast<int>(name.size())) return -1;
  return number;
}

/// The root's list of checkpoints on every rank, newest first.
std::vector<fs::path> shared_list(const fs::path& folder, const Comm& comm) {
  std::string text;
  if (comm.is_root())
    for (const fs::path& path : checkpoints_in(folder)) text += path.string() + '\n';
  const auto whole = std::as_bytes(std::span(text));
  std::vector<std::byte> bytes(whole.begin(), whole.end());
  comm.broadcast(bytes);
  std::vector<fs::path> out;
  std::string line;
  for (const std::byte b : bytes) {
    if (static_cast<char>(b) != '\n')
      line += static_cast<char>(b);
    else
      out.emplace_back(std::exchange(line, {}));
  }
  return out;
}

/// Tries the checkpoints from the newest on; `use` says whether one is good. Collective, as `use` is.
Result<GoodCheckpoint> first_good(const fs::path& folder, const Comm& comm, const std::function<Status(const fs::path&)>& use) {
  GoodCheckpoint good;
  for (const fs::path& path : shared_list(folder, comm)) {
    const Status status = use(path);
    if (status.ok()) {
      good.path = path;
      if (!good.warnings.empty()) good.warnings.push_back("using the older checkpoint '" + path.string() + "' instead");
      return good;
    }
    if (status.error().kind != ErrorKind::kFile) return status.error();
    good.warnings.push_back("checkpoint passed over: " + status.error().message);
    good.damaged.push_back(path);
  }
  std::string message = "no usable checkpoint in '" + folder.string() + "'";
  for (const std::string& warning : good.warnings) message += "\n  " + warning;
  return Error{ErrorKind::kFile, message, "start the run anew with `morula run`"};
}

}  // namespace

std::vector<fs::path> checkpoints_in(const fs::path& folder) {
  std::vector<fs::path> out;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (number_of(entry->path()) >= 0) out.push_back(entry->path());
  std::sort(out.begin(), out.end(), [](const fs::path& a, const fs::path& b) { return number_of(a) > number_of(b); });
  return out;
}

Result<fs::path> save_checkpoint(const fs::path& folder, const Tissue& tissue, const CheckpointInfo& info, const Comm& comm) {
  Status made;
  if (comm.is_root()) made = make_folder(folder);
  MORULA_TRY(agree(std::move(made), comm));
  const std::vector<fs::path> old = shared_list(folder, comm);
  char name[32];
  std::snprintf(name, sizeof name, "cp_%06ld.h5", old.empty() ? 1 : number_of(old.front()) + 1);
  const fs::path path = folder / name;
  MORULA_TRY(write_checkpoint(path, tissue, info, comm));
  std::error_code ignored;
  if (comm.is_root())
    for (std::size_t i = kKept - 1; i < old.size(); ++i) fs::remove(old[i], ignored);
  return path;
}

Result<RestoredCheckpoint> load_newest_checkpoint(const fs::path& folder, const Model& model, ShapeLibrary& shapes, const Comm& comm) {
  RestoredCheckpoint out;
  MORULA_TRY_ASSIGN(GoodCheckpoint good, first_good(folder, comm, [&](const fs::path& path) -> Status {
                      MORULA_TRY_ASSIGN(out.checkpoint, read_checkpoint(path, model, shapes, comm));
                      return {};
                    }));
  out.path = std::move(good.path);
  out.warnings = std::move(good.warnings);
  out.damaged = std::move(good.damaged);
  return out;
}

Result<GoodCheckpoint> newest_good_checkpoint(const fs::path& folder, const Comm& comm) {
  return first_good(folder, comm, [&](const fs::path& path) -> Status {
    auto opened = Hdf5Reader::open(path);
    MORULA_TRY(agree(opened.ok() ? Status{} : Status(opened.error()), comm));
    MORULA_TRY(agree(check_checkpoint_version(path, *opened), comm));
    return opened->verify(comm);
  });
}

}  // namespace morula::scenarios
