#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include "core/numbers/hash128.h"
#include "results/file_io.h"
#include "results/hash_sums.h"
#include "results/hdf5_handle.h"
#include "results/hdf5_journal.h"
#include "results/hdf5_overlay.h"
#include "results/hdf5_plan.h"
#include "results/hdf5_types.h"
#include "results/parcels.h"

namespace morula::scenarios {
namespace fs = std::filesystem;
namespace {

using Dataset = StoragePlan::Dataset;

/// Where a dataset's rows lie: over all ranks and in the file.
struct Extent {
  std::uint64_t rows = 0;       ///< of all ranks
  std::uint64_t first_row = 0;  ///< of this rank's slice
  std::uint64_t place = 0;      ///< in the file
  std::string checksum;         ///< of all rows, kept with the dataset; empty where the file's manifest has it
};

std::size_t row_size(const Dataset& dataset) { return size_of(dataset.type) * dataset.width; }

std::vector<Extent> extents_over_ranks(const std::vector<Dataset>& datasets, const Comm& comm) {
  std::vector<std::int64_t> rows;
  for (const Dataset& d : datasets) rows.push_back(static_cast<std::int64_t>(d.bytes.size() / row_size(d)));
  std::vector<std::int64_t> before = rows;
  comm.exclusive_scan(before);
  comm.sum(rows);
  std::vector<Extent> extents(datasets.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    extents[i].first_row = static_cast<std::uint64_t>(before[i]);
    extents[i].rows = static_cast<std::uint64_t>(rows[i]);
  }
  return extents;
}

/// Checksums of the whole tables, on every rank.
std::vector<Hash128> checksums_over_ranks(const std::vector<Dataset>& datasets, const std::vector<Extent>& extents, const Comm& comm) {
  std::vector<Hash128> sums;
  for (std::size_t i = 0; i < datasets.size(); ++i)
    sums.push_back(table_checksum(datasets[i].bytes, row_size(datasets[i]), extents[i].first_row));
  sum_over_ranks(sums, comm);
  return sums;
}

/// Extents of datasets that carry their checksums themselves.
std::vector<Extent> signed_extents(const std::vector<Dataset>& datasets, const Comm& comm) {
  std::vector<Extent> extents = extents_over_ranks(datasets, comm);
  const std::vector<Hash128> sums = checksums_over_ranks(datasets, extents, comm);
  for (std::size_t i = 0; i < extents.size(); ++i) extents[i].checksum = sums[i].hex();
  return extents;
}

/// A table of contents that a reader can check everything against.
std::string manifest_text(const std::vector<Dataset>& datasets, const std::vector<Extent>& extents, const std::vector<Hash128>& checksums) {
  std::string text;
  for (std::size_t i = 0; i < datasets.size(); ++i) {
    const Dataset& d = datasets[i];
    text += checksums[i].hex() + ' ' + std::to_string(static_cast<int>(d.type)) + ' ' + std::to_string(d.width) + ' ' +
            std::to_string(extents[i].rows) + ' ' + d.path + ' ' + d.label.units + '\n';
  }
  return text;
}

Error hdf5_error(const fs::path& path, const std::string& doing) {
  return Error{ErrorKind::kFile, "cannot " + doing + " '" + path.string() + "': " + hdf5_reason(), ""};
}

bool write_text_attribute(hid_t object, const char* name, const std::string& value) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), std::max<std::size_t>(value.size(), 1));
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(object, name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.ok() && H5Awrite(attribute.get(), type.get(), value.empty() ? "\0" : value.data()) >= 0;
}

bool write_number_attribute(hid_t object, const char* name, std::uint64_t value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(object, name, H5T_STD_U64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.ok() && H5Awrite(attribute.get(), H5T_STD_U64LE, &value) >= 0;
}

bool write_label(hid_t dataset, const DatasetLabel& label) {
  return write_text_attribute(dataset, "units", label.units) &&
         (label.description.empty() || write_text_attribute(dataset, "description", label.description));
}

/// Makes the groups above a dataset that are missing, without times: HDF5 would note the second in which it makes them itself.
bool make_groups(hid_t file, const std::string& path) {
  const Hdf5Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  for (std::size_t end = path.find('/', 1); end != std::string::npos; end = path.find('/', end + 1)) {
    const std::string group = path.substr(0, end);
    if (H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0) continue;
    if (!Hdf5Handle(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), H5Gclose).ok()) return false;
  }
  return true;
}

/// Makes the datasets, without their values, and notes where in the file the values belong.
Status declare(hid_t file, const fs::path& path, const std::vector<Dataset>& datasets, std::vector<Extent>& extents) {
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_layout(creation.get(), H5D_CONTIGUOUS);
  H5Pset_alloc_time(creation.get(), H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(creation.get(), H5D_FILL_TIME_NEVER);
  H5Pset_obj_track_times(creation.get(), false);  // the same content gives the same file
  for (std::size_t i = 0; i < datasets.size(); ++i) {
    const Dataset& d = datasets[i];
    const Hdf5Handle type(file_type(d.type, d.width, d.label.kinds), H5Tclose);
    const hsize_t dims[2] = {extents[i].rows, d.width};
    const Hdf5Handle space(H5Screate_simple(d.type != StoredType::kText && d.width > 1 ? 2 : 1, dims, nullptr), H5Sclose);
    if (!make_groups(file, d.path)) return hdf5_error(path, "make the group of " + d.path + " in");
    const Hdf5Handle dataset(H5Dcreate2(file, d.path.c_str(), type.get(), space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), H5Dclose);
    if (!dataset.ok() || !write_label(dataset.get(), d.label)) return hdf5_error(path, "make dataset " + d.path + " in");
    if (!extents[i].checksum.empty() && !write_text_attribute(dataset.get(), kChecksumAttribute, extents[i].checksum))
      return hdf5_error(path, "sign dataset " + d.path + " in");
    const haddr_t place = H5Dget_offset(dataset.get());
    if (extents[i].rows != 0 && place == HADDR_UNDEF) return hdf5_error(path, "find room for dataset " + d.path + " in");
    extents[i].place = extents[i].rows == 0 ? 0 : place;
  }
  return {};
}

/// The root's places on every rank.
void share_places(std::vector<Extent>& extents, const Comm& comm) {
  ByteWriter writer;
  for (const Extent& extent : extents) writer.put(extent.place);
  std::vector<std::byte> bytes(writer.bytes().begin(), writer.bytes().end());
  comm.broadcast(bytes);
  ByteReader reader(bytes);
  for (Extent& extent : extents) extent.place = reader.get<std::uint64_t>();
}

/// This rank's slices, and for the root what HDF5 wrote, go into the file.
Status write_slices(OutputFile& out, const std::vector<Dataset>& datasets, const std::vector<Extent>& extents) {
  for (std::size_t i = 0; i < datasets.size(); ++i)
    MORULA_TRY(out.write_at(extents[i].place + extents[i].first_row * row_size(datasets[i]), datasets[i].bytes));
  return {};
}

/// All ranks write the values into `path`, the root also `structure`, and sets the length. Collective.
Status write_all(const fs::path& path, bool create, const std::vector<Dataset>& datasets, std::vector<Extent>& extents,
                 std::span<const Overlay::Range> structure, std::uint64_t length, const Comm& comm) {
  share_places(extents, comm);
  const auto write_as_root = [&]() -> Status {
    MORULA_TRY_ASSIGN(OutputFile out, OutputFile::open(path, create));
    for (const Overlay::Range& range : structure) MORULA_TRY(out.write_at(range.place, range.bytes));
    MORULA_TRY(out.resize(length));
    MORULA_TRY(write_slices(out, datasets, extents));
    return out.sync();
  };
  const auto write_as_other = [&]() -> Status {
    MORULA_TRY_ASSIGN(OutputFile out, OutputFile::open(path, false));
    MORULA_TRY(write_slices(out, datasets, extents));
    return out.sync();
  };
  MORULA_TRY(agree(comm.is_root() ? write_as_root() : Status{}, comm));  // the file is there before the others open it
  return agree(comm.is_root() ? Status{} : write_as_other(), comm);
}

/// Parts of the changes from `place` on.
std::vector<Overlay::Range> part(const std::vector<Overlay::Range>& changes, std::uint64_t from, std::uint64_t to) {
  std::vector<Overlay::Range> out;
  for (const Overlay::Range& range : changes) {
    const std::uint64_t begin = std::max(from, range.place), end = std::min(to, range.place + range.bytes.size());
    if (begin >= end) continue;
    const auto first = range.bytes.begin() + static_cast<std::ptrdiff_t>(begin - range.place);
    out.push_back({begin, {first, first + static_cast<std::ptrdiff_t>(end - begin)}});
  }
  return out;
}

/// What the root found out about the file to be added to.
struct Addition {
  std::vector<Overlay::Range> changes;
  std::uint64_t old_end = 0, new_end = 0;
};

/// Lets HDF5 take out groups and declare datasets, in memory only.
Result<Addition> plan_addition(const fs::path& path, const std::vector<Dataset>& datasets, std::span<const std::string> removed,
                               std::vector<Extent>& extents) {
  MORULA_TRY_ASSIGN(const std::unique_ptr<Overlay> overlay, Overlay::over(path));
  Hdf5Handle file(overlay->open(true), Overlay::close);
  if (!file.ok()) return hdf5_error(path, "open");
  const std::uint64_t end = overlay->used_end();
  for (const std::string& group : removed)
    if (H5Ldelete(file.get(), group.c_str(), H5P_DEFAULT) < 0) return hdf5_error(path, "remove " + group + " from");
  MORULA_TRY(declare(file.get(), path, datasets, extents));
  if (!file.close()) return hdf5_error(path, "add to");
  for (std::size_t i = 0; i < datasets.size(); ++i)
    if (extents[i].rows != 0 && extents[i].place < end)
      return Error{ErrorKind::kInternal, "new values would lie over old ones in '" + path.string() + "'", ""};
  return Addition{overlay->changes(), end, overlay->new_length()};
}

/// One change of an existing file: new parts first, then the old part through the journal. Collective.
Status change_file(const fs::path& path, const std::vector<Dataset>& datasets, std::span<const std::string> removed, const Comm& comm) {
  std::vector<Extent> extents = signed_extents(datasets, comm);
  Addition addition;
  const auto prepare = [&]() -> Status {
    MORULA_TRY(finish_journal(path));
    MORULA_TRY_ASSIGN(addition, plan_addition(path, datasets, removed, extents));
    return {};
  };
  MORULA_TRY(agree(comm.is_root() ? prepare() : Status{}, comm));
  const auto new_parts = part(addition.changes, addition.old_end, UINT64_MAX);
  Status status = write_all(path, false, datasets, extents, new_parts, std::max(addition.new_end, addition.old_end), comm);
  if (status.ok()) {
    const Journal journal{addition.new_end, part(addition.changes, 0, addition.old_end)};
    status = agree(comm.is_root() ? write_journal(path, journal) : Status{}, comm);
    if (status.ok()) return agree(comm.is_root() ? apply_journal(path, journal) : Status{}, comm);
  }
  if (comm.is_root()) (void)::truncate(path.c_str(), static_cast<off_t>(addition.old_end));
  comm.barrier();
  return status;
}

Status create_new(const fs::path& path, const StoragePlan& plan, const std::string& manifest_checksum, const Comm& comm) {
  const std::vector<Dataset>& datasets = plan.datasets();
  fs::path aside = path;
  aside += ".tmp";
  std::vector<Extent> extents = manifest_checksum.empty() ? signed_extents(datasets, comm) : extents_over_ranks(datasets, comm);
  std::vector<Overlay::Range> structure;
  std::uint64_t length = 0;
  const auto prepare = [&]() -> Status {
    Overlay overlay;
    Hdf5Handle file(overlay.create(), Overlay::close);
    if (!file.ok()) return hdf5_error(path, "create");
    MORULA_TRY(declare(file.get(), path, datasets, extents));
    if (!manifest_checksum.empty() && !write_text_attribute(file.get(), "manifest_checksum", manifest_checksum))
      return hdf5_error(path, "create");
    for (const StoragePlan::Attribute& a : plan.attributes())
      if (!(a.is_text ? write_text_attribute(file.get(), a.name.c_str(), a.text)
                      : write_number_attribute(file.get(), a.name.c_str(), a.number)))
        return hdf5_error(path, "create");
    if (!file.close()) return hdf5_error(path, "create");
    structure = overlay.changes();
    length = overlay.new_length();
    return {};
  };
  MORULA_TRY(agree(comm.is_root() ? prepare() : Status{}, comm));
  Status status = write_all(aside, true, datasets, extents, structure, length, comm);
  if (status.ok()) status = agree(comm.is_root() ? rename_durably(aside, path) : Status{}, comm);
  if (!status.ok() && comm.is_root()) ::unlink(aside.c_str());
  return status;
}

}  // namespace

Status create_file(const fs::path& path, StoragePlan plan, const Comm& comm) {
  const std::vector<Extent> extents = extents_over_ranks(plan.datasets(), comm);
  const std::string manifest = manifest_text(plan.datasets(), extents, checksums_over_ranks(plan.datasets(), extents, comm));
  plan.add_text("manifest", manifest);
  return create_new(path, plan, hash128(std::as_bytes(std::span(manifest))).hex(), comm);
}

Status add_to_file(const fs::path& path, StoragePlan plan, std::span<const std::string> removed, const Comm& comm) {
  std::error_code ignored;
  if (!comm.any(fs::exists(path, ignored))) return create_new(path, plan, "", comm);
  // Taking out comes first and on its own: new values must never lie where a killed process would still look for old ones.
  if (!removed.empty()) MORULA_TRY(change_file(path, {}, removed, comm));
  if (plan.datasets().empty()) return {};
  return change_file(path, plan.datasets(), {}, comm);
}

Status finish_journal(const fs::path& path) {
  if (const std::optional<Journal> journal = read_journal(path)) return apply_journal(path, *journal);
  if (::unlink(journal_path(path).c_str()) != 0 && errno != ENOENT) return file_error(journal_path(path), "remove", errno);
  return {};
}

}  // namespace morula::scenarios
