#include "results/hdf5_overlay.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "results/file_io.h"
#include "results/hdf5_handle.h"

namespace morula::scenarios {
namespace {

/// What HDF5 holds of a file that it opened through an overlay.
struct DriverFile {
  H5FD_t base;  // must come first
  Overlay* overlay;
  haddr_t end_of_allocation;
};

DriverFile* as_driver_file(H5FD_t* file) { return reinterpret_cast<DriverFile*>(file); }
const DriverFile* as_driver_file(const H5FD_t* file) { return reinterpret_cast<const DriverFile*>(file); }

H5FD_t* driver_open(const char*, unsigned flags, hid_t access, haddr_t) {
  const void* info = H5Pget_driver_info(access);
  if (info == nullptr) return nullptr;
  Overlay* overlay = *static_cast<Overlay* const*>(info);
  if ((flags & H5F_ACC_TRUNC) != 0) overlay->forget();
  auto* file = new DriverFile{};
  file->overlay = overlay;
  return &file->base;
}

herr_t driver_close(H5FD_t* file) {
  delete as_driver_file(file);
  return 0;
}

int driver_compare(const H5FD_t* a, const H5FD_t* b) {
  const Overlay *first = as_driver_file(a)->overlay, *second = as_driver_file(b)->overlay;
  return std::less<>()(first, second) ? -1 : first != second;
}

herr_t driver_query(const H5FD_t*, unsigned long* flags) {
  if (flags != nullptr) *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t driver_get_eoa(const H5FD_t* file, H5FD_mem_t) { return as_driver_file(file)->end_of_allocation; }
herr_t driver_set_eoa(H5FD_t* file, H5FD_mem_t, haddr_t place) {
  as_driver_file(file)->end_of_allocation = place;
  as_driver_file(file)->overlay->set_used_end(place);
  return 0;
}
haddr_t driver_get_eof(const H5FD_t* file, H5FD_mem_t) { return as_driver_file(file)->overlay->new_length(); }

herr_t driver_read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t place, size_t size, void* buffer) {
  return as_driver_file(file)->overlay->read(place, std::span(static_cast<std::byte*>(buffer), size)) ? 0 : -1;
}
herr_t driver_write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t place, size_t size, const void* buffer) {
  return as_driver_file(file)->overlay->write(place, std::span(static_cast<const std::byte*>(buffer), size)) ? 0 : -1;
}
herr_t driver_truncate(H5FD_t* file, hid_t, hbool_t) {
  DriverFile* mine = as_driver_file(file);
  mine->overlay->set_length(mine->end_of_allocation);
  return 0;
}

const H5FD_class_t& driver_class() {
  static const H5FD_class_t driver = [] {
    H5FD_class_t c{};
    c.name = "morula_overlay";
    c.maxaddr = (haddr_t{1} << 62) - 1;
    c.fc_degree = H5F_CLOSE_STRONG;
    c.fapl_size = sizeof(Overlay*);
    c.open = driver_open;
    c.close = driver_close;
    c.cmp = driver_compare;
    c.query = driver_query;
    c.get_eoa = driver_get_eoa;
    c.set_eoa = driver_set_eoa;
    c.get_eof = driver_get_eof;
    c.read = driver_read;
    c.write = driver_write;
    c.truncate = driver_truncate;
    const H5FD_mem_t map[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(map), std::end(map), std::begin(c.fl_map));
    return c;
  }();
  return driver;
}

/// The driver, registered once and kept: H5Fclose gives the file's reference back before it calls the driver's close, so that a driver held by its files
/// alone would be freed before it is called (1.10).
hid_t registered_driver() {
  static const hid_t driver = H5FDregister(&driver_class());
  return driver;
}

/// Opens or creates through the driver; the newest file version, whose structure carries HDF5's own checksums.
template <class Opening>
hid_t with_driver(Overlay* overlay, Opening opening) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors come back as values; HDF5 prints nothing
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_driver(access, registered_driver(), &overlay);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
  const hid_t file = opening(access);
  H5Pclose(access);
  return file;
}

}  // namespace

Overlay::Overlay() = default;

Result<std::unique_ptr<Overlay>> Overlay::over(const std::filesystem::path& path) {
  auto overlay = std::make_unique<Overlay>();
  overlay->descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // does not wait at a pipe
  if (overlay->descriptor_ < 0) return file_error(path, "open", errno);
  struct stat info {};
  if (::fstat(overlay->descriptor_, &info) != 0) return file_error(path, "open", errno);
  if (!S_ISREG(info.st_mode)) return Error{ErrorKind::kFile, "'" + path.string() + "' is not a file", ""};
  overlay->base_length_ = overlay->length_ = static_cast<std::uint64_t>(info.st_size);
  return overlay;
}

Overlay::~Overlay() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

hid_t Overlay::create() {
  return with_driver(this, [](hid_t access) {
    const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation.get(), false);  // of the root group
    return H5Fcreate("new", H5F_ACC_TRUNC, creation.get(), access);
  });
}

hid_t Overlay::open(bool for_writing) {
  return with_driver(this, [&](hid_t access) { return H5Fopen("existing", for_writing ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access); });
}

herr_t Overlay::close(hid_t file) {
  const herr_t done = H5Fclose(file);
  // HDF5 1.10 frees a damaged file that it cannot flush, and keeps its identifier: when the process ends it would close it once more, and crash. Its own
  // function takes the identifier back; it is not in its headers.
  if (done < 0 && H5Iis_valid(file) > 0)
    if (const auto take_back = reinterpret_cast<void* (*)(hid_t)>(::dlsym(RTLD_DEFAULT, "H5I_remove"))) take_back(file);
  return done;
}

void Overlay::forget() {
  pages_.clear();
  length_ = 0;
}

bool Overlay::read_base(std::uint64_t place, std::span<std::byte> out) const {
  std::fill(out.begin(), out.end(), std::byte{0});
  std::size_t done = 0;
  while (descriptor_ >= 0 && done < out.size() && place + done < base_length_) {
    const ssize_t got = ::pread(descriptor_, out.data() + done, out.size() - done, static_cast<off_t>(place + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return false;
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return true;
}

bool Overlay::read(std::uint64_t place, std::span<std::byte> out) const {
  if (!read_base(place, out)) return false;
  const std::uint64_t end = place + out.size();
  for (auto page = pages_.lower_bound(place / kPage); page != pages_.end() && page->first * kPage < end; ++page) {
    const std::uint64_t page_begin = page->first * kPage;
    const std::uint64_t from = std::max(place, page_begin), to = std::min(end, page_begin + kPage);
    std::memcpy(out.data() + (from - place), page->second.bytes.data() + (from - page_begin), to - from);
  }
  return true;
}

bool Overlay::write(std::uint64_t place, std::span<const std::byte> bytes) {
  length_ = std::max(length_, place + bytes.size());
  while (!bytes.empty()) {
    const std::uint64_t number = place / kPage;
    const std::size_t offset = place % kPage;
    const std::size_t count = std::min(bytes.size(), kPage - offset);
    const auto [page, is_new] = pages_.try_emplace(number);
    if (is_new && !read_base(number * kPage, page->second.bytes)) return false;
    std::memcpy(page->second.bytes.data() + offset, bytes.data(), count);
    for (std::size_t i = 0; i < count; ++i) page->second.changed.set(offset + i);
    place += count;
    bytes = bytes.subspan(count);
  }
  return true;
}

void Overlay::patch(const Range& range) {
  // A page that cannot be read stays zero around the patch, and HDF5 or a checksum refuses it.
  (void)write(range.place, range.bytes);
}

std::vector<Overlay::Range> Overlay::changes() const {
  std::vector<Range> out;
  for (const auto& [number, page] : pages_) {
    for (std::size_t i = 0; i < kPage; ++i) {
      if (!page.changed[i]) continue;
      const std::uint64_t place = number * kPage + i;
      if (out.empty() || out.back().place + out.back().bytes.size() != place) out.push_back({place, {}});
      out.back().bytes.push_back(page.bytes[i]);
    }
  }
  return out;
}

}  // namespace morula::scenarios
