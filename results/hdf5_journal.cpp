#include "results/hdf5_journal.h"

#include <unistd.h>

#include <cerrno>
#include <string_view>

#include "core/numbers/hash128.h"
#include "results/file_io.h"
#include "results/parcels.h"

namespace morula::scenarios {
namespace fs = std::filesystem;
namespace {
constexpr std::uint64_t kMagic = 0x314e4c414e554f4au;  // marks the first format
constexpr std::size_t kHead = 3 * sizeof(std::uint64_t), kHash = sizeof(Hash128);
}  // namespace

fs::path journal_path(const fs::path& file) {
  fs::path path = file;
  path += ".journal";
  return path;
}

Status write_journal(const fs::path& file, const Journal& journal) {
  ByteWriter writer;
  writer.put(kMagic);
  writer.put(journal.new_length);
  writer.put(std::uint64_t{journal.ranges.size()});
  for (const Overlay::Range& range : journal.ranges) {
    writer.put(range.place);
    writer.put(std::uint64_t{range.bytes.size()});
    writer.put_all(std::span(range.bytes));
  }
  writer.put(hash128(writer.bytes()));
  const auto write = [&]() -> Status {
    MORULA_TRY_ASSIGN(OutputFile out, OutputFile::open(journal_path(file), true));
    MORULA_TRY(out.write_at(0, writer.bytes()));
    MORULA_TRY(out.sync());
    sync_folder_of(journal_path(file));  // the file must not change on the disk before its journal can be found there
    return {};
  };
  Status status = write();
  if (!status.ok()) ::unlink(journal_path(file).c_str());
  return status;
}

std::optional<Journal> read_journal(const fs::path& file) {
  const Result<std::string> text = read_file(journal_path(file));
  if (!text.ok() || text.value().size() < kHead + kHash) return std::nullopt;
  const auto all = std::as_bytes(std::span(text.value()));
  const auto content = all.first(all.size() - kHash);
  ByteReader reader(content);
  const auto stored = ByteReader(all.last(kHash)).get<Hash128>();
  if (stored != hash128(content) || reader.get<std::uint64_t>() != kMagic) return std::nullopt;
  Journal journal;
  journal.new_length = reader.get<std::uint64_t>();
  journal.ranges.resize(reader.get<std::uint64_t>());
  for (Overlay::Range& range : journal.ranges) {
    range.place = reader.get<std::uint64_t>();
    reader.get_all(reader.get<std::uint64_t>(), range.bytes);
  }
  return journal;
}

Status apply_journal(const fs::path& file, const Journal& journal) {
  {
    MORULA_TRY_ASSIGN(OutputFile out, OutputFile::open(file, false));
    for (const Overlay::Range& range : journal.ranges) MORULA_TRY(out.write_at(range.place, range.bytes));
    MORULA_TRY(out.resize(journal.new_length));
    MORULA_TRY(out.sync());
  }
  if (::unlink(journal_path(file).c_str()) != 0 && errno != ENOENT) return file_error(journal_path(file), "remove", errno);
  return {};
}

}  // namespace morula::scenarios
