#pragma once
#include <hdf5.h>

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/result.h"

namespace morula::scenarios {

/// What HDF5 would write into a file, held in memory: the file below is only read.
///
/// HDF5 cannot be stopped half way: a write that fails inside it leaves a file that cannot be closed, and a process that dies inside it
/// leaves a broken file. So it never writes. It sees the file through this overlay (a virtual file driver); what it changed comes
/// out as ranges of bytes, and we write them with ordinary calls, in an order of our choice, and see every failure.
/// Only what HDF5 touches is held, that is the structure and not the data.
class Overlay {
 public:
  struct Range {
    std::uint64_t place = 0;
    std::vector<std::byte> bytes;
  };

  /// Over nothing: a new file.
  Overlay();
  /// Over an existing file.
  static Result<std::unique_ptr<Overlay>> over(const std::filesystem::path& path);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// HDF5's handle on the file as seen through the overlay, or a negative number. The overlay must outlive it.
  [[nodiscard]] hid_t create();
  [[nodiscard]] hid_t open(bool for_writing);
  /// Closes such a handle; negative if HDF5 could not finish, which leaves nothing behind either.
  static herr_t close(hid_t file);

  /// What was changed, in increasing order of place, neighbours merged.
  [[nodiscard]] std::vector<Range> changes() const;
  /// Lays a change over the file, as if HDF5 had made it.
  void patch(const Range& range);
  /// Length of the file below; of the file as HDF5 left it.
  [[nodiscard]] std::uint64_t old_length() const { return base_length_; }
  [[nodiscard]] std::uint64_t new_length() const { return length_; }
  /// Where the part of the file that HDF5 uses ends at the moment.
  [[nodiscard]] std::uint64_t used_end() const { return used_end_; }

  // for the driver
  [[nodiscard]] bool read(std::uint64_t place, std::span<std::byte> out) const;
  [[nodiscard]] bool write(std::uint64_t place, std::span<const std::byte> bytes);
  void set_length(std::uint64_t length) { length_ = length; }
  void set_used_end(std::uint64_t place) { used_end_ = place; }
  void forget();

 private:
  static constexpr std::size_t kPage = 4096;
  struct Page {
    std::array<std::byte, kPage> bytes{};
    std::bitset<kPage> changed;
  };
  [[nodiscard]] bool read_base(std::uint64_t place, std::span<std::byte> out) const;

  int descriptor_ = -1;
  std::uint64_t base_length_ = 0;
  std::uint64_t length_ = 0;
  std::uint64_t used_end_ = 0;
  std::map<std::uint64_t, Page> pages_;
};

}  // namespace morula::scenarios
