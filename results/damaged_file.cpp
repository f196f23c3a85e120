#include "results/damaged_file.h"

#include <cstring>

#include "results/file_io.h"
#include "results/hdf5_journal.h"

namespace morula::scenarios {
namespace fs = std::filesystem;
namespace {

Result<fs::path> set_aside_as_root(const fs::path& path) {
  if (!OutputFile::open(path, false).ok()) return fs::path();
  std::error_code ignored;
  for (int number = 1;; ++number) {
    fs::path aside = path;
    aside.replace_filename(path.stem().string() + ".damaged-" + std::to_string(number) + path.extension().string());
    if (fs::exists(fs::symlink_status(aside, ignored))) continue;
    // The journal first: without it the file is as the last writer left it, and a new file must never meet the old one's journal.
    if (fs::exists(journal_path(path), ignored)) MORULA_TRY(rename_durably(journal_path(path), journal_path(aside)));
    MORULA_TRY(rename_durably(path, aside));
    return aside;
  }
}

}  // namespace

Result<fs::path> set_aside(const fs::path& path, const Comm& comm) {
  std::string name;
  Status status;
  if (comm.is_root()) {
    auto aside = set_aside_as_root(path);
    if (aside.ok())
      name = aside->string();
    else
      status = std::move(aside).error();
  }
  MORULA_TRY(agree(std::move(status), comm));
  std::vector<std::byte> bytes(name.size());
  if (!name.empty()) std::memcpy(bytes.data(), name.data(), name.size());
  comm.broadcast(bytes);
  return fs::path(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace morula::scenarios
