#include "results/hdf5_reader.h"

#include <algorithm>
#include <sstream>

#include "core/numbers/hash128.h"
#include "results/file_io.h"
#include "results/hash_sums.h"
#include "results/hdf5_handle.h"
#include "results/hdf5_journal.h"
#include "results/hdf5_overlay.h"
#include "results/hdf5_types.h"

namespace morula::scenarios {
namespace fs = std::filesystem;

struct Hdf5Reader::State {
  fs::path path;
  std::unique_ptr<Overlay> overlay;
  Hdf5Handle file;  // goes before the overlay that it reads through
  // The dataset that was asked for last: HDF5 reads its whole head when it is opened, which takes longer than a small dataset itself.
  std::string last_path;
  Hdf5Handle last;

  const Hdf5Handle& dataset(const std::string& wanted) {
    if (last.ok() && wanted == last_path) return last;
    last = Hdf5Handle(H5Dopen2(file.get(), wanted.c_str(), H5P_DEFAULT), H5Dclose);
    last_path = wanted;
    return last;
  }
};

namespace {

/// Rows and values a row of a dataset; nothing if it is not such a table.
struct Shape {
  std::uint64_t rows = 0, width = 1;
};
std::optional<Shape> shape_of(const Hdf5Handle& dataset) {
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const int rank = space.ok() ? H5Sget_simple_extent_ndims(space.get()) : -1;
  if (rank != 1 && rank != 2) return std::nullopt;
  hsize_t dims[2] = {0, 1};
  H5Sget_simple_extent_dims(space.get(), dims, nullptr);
  Shape shape{dims[0], dims[1]};
  const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose);
  if (rank == 1 && H5Tget_class(type.get()) == H5T_STRING) shape.width = H5Tget_size(type.get());
  return shape;
}

std::string text_attribute(hid_t object, const char* name) {
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.ok()) return "";
  const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose);
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0) return "";
  std::string value(H5Tget_size(type.get()), '\0');
  if (H5Aread(attribute.get(), type.get(), value.data()) < 0) return "";
  return value.substr(0, value.find('\0'));
}

/// The type of the stored values: that of the numbers below an enumeration.
Hdf5Handle value_type(const Hdf5Handle& dataset) {
  Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose);
  return H5Tget_class(type.get()) == H5T_ENUM ? Hdf5Handle(H5Tget_super(type.get()), H5Tclose) : std::move(type);
}

}  // namespace

Hdf5Reader::Hdf5Reader(std::unique_ptr<State> state) : state_(std::move(state)) {}
Hdf5Reader::Hdf5Reader(Hdf5Reader&&) noexcept = default;
Hdf5Reader::~Hdf5Reader() = default;

Error Hdf5Reader::damaged(const std::string& what) const {
  return Error{ErrorKind::kFile, "'" + state_->path.string() + "' is damaged: " + what, ""};
}

Result<Hdf5Reader> Hdf5Reader::open(const fs::path& path) {
  MORULA_TRY_ASSIGN(std::unique_ptr<Overlay> overlay, Overlay::over(path));
  if (const auto journal = read_journal(path))  // the writer was killed between journal and file: see what it meant
    for (const Overlay::Range& range : journal->ranges) overlay->patch(range);
  Overlay* raw = overlay.get();
  auto state = std::make_unique<State>(State{path, std::move(overlay), Hdf5Handle(raw->open(false), Overlay::close), "", {-1, H5Dclose}});
  Hdf5Reader reader(std::move(state));
  if (!reader.state_->file.ok()) return reader.damaged(hdf5_reason());
  return reader;
}

bool Hdf5Reader::exists(const std::string& path) const {
  for (std::size_t slash = path.find('/'); slash != std::string::npos; slash = path.find('/', slash + 1))
    if (slash != 0 && H5Lexists(state_->file.get(), path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(state_->file.get(), path.c_str(), H5P_DEFAULT) > 0;
}

Result<std::uint64_t> Hdf5Reader::links(const std::string& group) const {
  // Counted, not walked: HDF5 1.10 frees a list of names twice where the group is damaged.
  H5G_info_t info{};
  if (H5Gget_info_by_name(state_->file.get(), group.c_str(), &info, H5P_DEFAULT) < 0) return damaged("no group '" + group + "'");
  return info.nlinks;
}

Result<std::uint64_t> Hdf5Reader::rows(const std::string& path) const {
  const Hdf5Handle& dataset = state_->dataset(path);
  const auto shape = dataset.ok() ? shape_of(dataset) : std::nullopt;
  if (!shape) return damaged("no dataset '" + path + "'");
  return shape->rows;
}

Result<std::string> Hdf5Reader::units(const std::string& path) const {
  const Hdf5Handle& dataset = state_->dataset(path);
  if (!dataset.ok()) return damaged("no dataset '" + path + "'");
  return text_attribute(dataset.get(), "units");
}

Result<std::string> Hdf5Reader::description(const std::string& path) const {
  const Hdf5Handle& dataset = state_->dataset(path);
  if (!dataset.ok()) return damaged("no dataset '" + path + "'");
  return text_attribute(dataset.get(), "description");
}

Result<std::vector<std::string>> Hdf5Reader::kinds(const std::string& path) const {
  const Hdf5Handle& dataset = state_->dataset(path);
  if (!dataset.ok()) return damaged("no dataset '" + path + "'");
  const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose);
  std::vector<std::string> names;
  const int count = H5Tget_class(type.get()) == H5T_ENUM ? H5Tget_nmembers(type.get()) : 0;
  for (int i = 0; i < count; ++i) {
    char* name = H5Tget_member_name(type.get(), static_cast<unsigned>(i));
    names.emplace_back(name == nullptr ? "" : name);
    H5free_memory(name);
  }
  return names;
}

std::optional<std::uint64_t> Hdf5Reader::root_number(const std::string& name) const {
  const Hdf5Handle attribute(H5Aopen(state_->file.get(), name.c_str(), H5P_DEFAULT), H5Aclose);
  std::uint64_t value = 0;
  if (!attribute.ok() || H5Aread(attribute.get(), H5T_NATIVE_UINT64, &value) < 0) return std::nullopt;
  return value;
}

std::string Hdf5Reader::root_text(const std::string& name) const { return text_attribute(state_->file.get(), name.c_str()); }

bool Hdf5Reader::is_group(const std::string& path) const {
  return Hdf5Handle(H5Gopen2(state_->file.get(), path.c_str(), H5P_DEFAULT), H5Gclose).ok();
}

Status Hdf5Reader::check_share(const std::string& path, StoredType type, std::uint32_t width, std::uint64_t first,
                               std::uint64_t count) const {
  const Hdf5Handle& dataset = state_->dataset(path);
  const auto shape = dataset.ok() ? shape_of(dataset) : std::nullopt;
  if (!shape) return damaged("no dataset '" + path + "'");
  const Hdf5Handle stored = value_type(dataset), wanted(file_type(type, width), H5Tclose);
  if (shape->width != width || H5Tequal(stored.get(), wanted.get()) <= 0) return damaged("dataset '" + path + "' is of another type");
  if (first > shape->rows || count > shape->rows - first) return damaged("dataset '" + path + "' is too short");
  return {};
}

Status Hdf5Reader::read_raw(const std::string& path, StoredType type, std::uint32_t width, std::uint64_t first, std::uint64_t count,
                            std::byte* out) const {
  if (count == 0) return {};
  MORULA_TRY(check_share(path, type, width, first, count));
  const Hdf5Handle& dataset = state_->dataset(path);
  const bool wide = type != StoredType::kText && width > 1;
  const hsize_t begin[2] = {first, 0}, size[2] = {count, width};
  const Hdf5Handle file_space(H5Dget_space(dataset.get()), H5Sclose);
  H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, begin, nullptr, size, nullptr);
  const Hdf5Handle memory_space(H5Screate_simple(wide ? 2 : 1, size, nullptr), H5Sclose);
  const Hdf5Handle memory_type(H5Dget_type(dataset.get()), H5Tclose);  // check_share has seen that it is laid out as `type` is
  if (H5Dread(dataset.get(), memory_type.get(), memory_space.get(), file_space.get(), H5P_DEFAULT, out) < 0)
    return damaged("dataset '" + path + "': " + hdf5_reason());
  const auto shape = shape_of(dataset);
  if (first != 0 || !shape || count != shape->rows) return {};
  const std::string checksum = text_attribute(dataset.get(), kChecksumAttribute);
  const std::size_t row = size_of(type) * width;
  if (!checksum.empty() && checksum != table_checksum({out, count * row}, row, 0).hex())
    return damaged("dataset '" + path + "' is altered (its checksum does not match)");
  return {};
}

Result<std::vector<std::string>> Hdf5Reader::texts(const std::string& path) const {
  const Hdf5Handle& dataset = state_->dataset(path);
  const auto shape = dataset.ok() ? shape_of(dataset) : std::nullopt;
  if (!shape) return damaged("no dataset '" + path + "'");
  std::vector<std::byte> bytes(shape->rows * shape->width);
  MORULA_TRY(read_raw(path, StoredType::kText, static_cast<std::uint32_t>(shape->width), 0, shape->rows, bytes.data()));
  std::vector<std::string> out;
  for (std::uint64_t row = 0; row < shape->rows; ++row) {
    const std::string text(reinterpret_cast<const char*>(bytes.data()) + row * shape->width, shape->width);
    out.push_back(text.substr(0, text.find('\0')));
  }
  return out;
}

Result<std::string> Hdf5Reader::text(const std::string& path) const {
  MORULA_TRY_ASSIGN(const std::vector<std::string> all, texts(path));
  if (all.size() != 1) return damaged("dataset '" + path + "' is not one text");
  return all.front();
}

Status Hdf5Reader::verify(const Comm& comm) const {
  constexpr std::uint64_t kBlock = 1 << 20;
  struct Line {
    std::string path, checksum;
  };
  std::vector<Line> lines;
  std::vector<Hash128> sums;
  const auto read_my_share = [&]() -> Status {
    MORULA_TRY_ASSIGN(const std::string manifest, text("manifest"));
    if (text_attribute(state_->file.get(), "manifest_checksum") != hash128(std::as_bytes(std::span(manifest))).hex())
      return damaged("its table of contents is altered");
    std::istringstream stream(manifest);
    std::string line;
    while (std::getline(stream, line)) {
      std::istringstream words(line);
      Line entry;
      int type = 0;
      std::uint32_t width = 0;
      std::uint64_t count = 0;
      std::string units_word;
      words >> entry.checksum >> type >> width >> count >> entry.path;
      std::getline(words >> std::ws, units_word);
      MORULA_TRY_ASSIGN(const std::string stored_units, units(entry.path));
      if (stored_units != units_word) return damaged("the units of dataset '" + entry.path + "' are altered");
      const auto rank = static_cast<std::uint64_t>(comm.rank()), ranks = static_cast<std::uint64_t>(comm.size());
      const std::uint64_t begin = count * rank / ranks, end = count * (rank + 1) / ranks;
      const std::size_t size = size_of(static_cast<StoredType>(type)) * width;
      const std::uint64_t step = std::max<std::uint64_t>(1, kBlock / std::max<std::size_t>(size, 1));
      std::vector<std::byte> block;
      Hash128 sum;
      for (std::uint64_t first = begin; first < end; first += step) {
        const std::uint64_t now = std::min(step, end - first);
        block.resize(now * size);
        MORULA_TRY(read_raw(entry.path, static_cast<StoredType>(type), width, first, now, block.data()));
        sum += table_checksum(block, size, first);
      }
      sums.push_back(sum);
      lines.push_back(entry);
    }
    return {};
  };
  MORULA_TRY(agree(read_my_share(), comm));
  sum_over_ranks(sums, comm);
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (sums[i].hex() != lines[i].checksum) return damaged("dataset '" + lines[i].path + "' is altered (its checksum does not match)");
  return {};
}

}  // namespace morula::scenarios
