#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/cell_id.h"
#include "core/parallel/comm.h"
#include "core/result.h"
#include "core/vec3.h"

namespace morula::scenarios {

/// Types of stored values. kText is a string of fixed length, filled with zeros.
enum class StoredType : std::uint8_t { kUint8, kUint16, kUint32, kUint64, kInt32, kInt64, kFloat, kDouble, kText };

[[nodiscard]] std::size_t size_of(StoredType type);

/// Attribute of a dataset of add_to_file: the checksum of all its rows, which Hdf5Reader checks whenever it reads them all.
inline constexpr const char* kChecksumAttribute = "checksum";

/// How a C++ type is stored: the type of a value and how many values make a row.
template <class T>
struct Stored {
  static_assert(std::is_enum_v<T>, "only plain values can be stored");
  static constexpr StoredType type = Stored<std::underlying_type_t<T>>::type;
  static constexpr std::uint32_t width = 1;
};
template <StoredType kType>
struct StoredAs {
  static constexpr StoredType type = kType;
  static constexpr std::uint32_t width = 1;
};
template <>
struct Stored<std::uint8_t> : StoredAs<StoredType::kUint8> {};
template <>
struct Stored<bool> : StoredAs<StoredType::kUint8> {};
template <>
struct Stored<std::uint16_t> : StoredAs<StoredType::kUint16> {};
template <>
struct Stored<std::uint32_t> : StoredAs<StoredType::kUint32> {};
template <>
struct Stored<std::uint64_t> : StoredAs<StoredType::kUint64> {};
template <>
struct Stored<std::int32_t> : StoredAs<StoredType::kInt32> {};
template <>
struct Stored<std::int64_t> : StoredAs<StoredType::kInt64> {};
template <>
struct Stored<float> : StoredAs<StoredType::kFloat> {};
template <>
struct Stored<double> : StoredAs<StoredType::kDouble> {};
template <>
struct Stored<CellId> : StoredAs<StoredType::kUint64> {};
template <class T, std::size_t N>
struct Stored<std::array<T, N>> {
  static constexpr StoredType type = Stored<T>::type;
  static constexpr std::uint32_t width = N;
};
template <class Real>
struct Stored<Vec3<Real>> : Stored<std::array<Real, 3>> {};

/// What is said of a dataset inside the file.
struct DatasetLabel {
  std::string units;                 ///< the attribute `units`
  std::string description;           ///< the attribute `description`; empty: none
  std::vector<std::string> kinds{};  ///< names of the values 0, 1, ..: the dataset becomes an HDF5 enumeration; empty: plain numbers

  DatasetLabel(std::string units_, std::string description_ = "", std::vector<std::string> kinds_ = {})
      : units(std::move(units_)), description(std::move(description_)), kinds(std::move(kinds_)) {}
  DatasetLabel(const char* units_) : units(units_) {}
};

/// The datasets that one file, or one addition to a file, is to hold: each rank gives its slice. Written by create_file or add_to_file.
class StoragePlan {
 public:
  struct Dataset {
    std::string path;  ///< from the root of the file, groups are made as needed
    DatasetLabel label;
    StoredType type{};
    std::uint32_t width = 1;       ///< values a row; 1: a one-dimensional dataset
    std::vector<std::byte> bytes;  ///< this rank's rows
  };

  /// `prefix` goes before every path.
  explicit StoragePlan(const Comm& comm, std::string prefix = "") : is_root_(comm.is_root()), prefix_(std::move(prefix)) {}

  /// A table cut over the ranks: slices follow one another in rank order. Collective in the sense that all ranks add the same datasets in the same order.
  template <class T>
  void add(const std::string& path, const DatasetLabel& label, std::span<const T> local) {
    const auto raw = std::as_bytes(local);
    datasets_.push_back({prefix_ + path, label, Stored<T>::type, Stored<T>::width, {raw.begin(), raw.end()}});
  }
  template <class T>
  void add(const std::string& path, const DatasetLabel& label, const std::vector<T>& local) {
    add(path, label, std::span<const T>(local));
  }
  /// A table that the root has whole.
  template <class T>
  void add_from_root(const std::string& path, const DatasetLabel& label, std::span<const T> whole) {
    add(path, label, is_root_ ? whole : std::span<const T>{});
  }
  /// One row, from the root.
  template <class T>
  void add_value(const std::string& path, const DatasetLabel& label, const T& value) {
    add_from_root(path, label, std::span<const T>(&value, 1));
  }
  /// Strings, from the root.
  void add_text(const std::string& path, std::span<const std::string> texts, const DatasetLabel& label = "");
  void add_text(const std::string& path, const std::string& text, const DatasetLabel& label = "") {
    add_text(path, std::span(&text, 1), label);
  }
  /// Strings cut over the ranks like the rows of a table; all ranks give the same `width`, no less than the longest string of any rank
  /// [bytes].
  void add_text_rows(const std::string& path, const DatasetLabel& label, std::span<const std::string> local, std::uint32_t width);
  /// An attribute of the root group: a text or a whole number. Written when the file is made; a file that is there keeps its own.
  void add_attribute(const std::string& name, std::string value) { attributes_.push_back({name, std::move(value), 0, true}); }
  void add_attribute(const std::string& name, std::uint64_t value) { attributes_.push_back({name, "", value, false}); }

  struct Attribute {
    std::string name, text;
    std::uint64_t number = 0;
    bool is_text = true;
  };
  [[nodiscard]] const std::vector<Dataset>& datasets() const { return datasets_; }
  [[nodiscard]] std::vector<Dataset>& datasets() { return datasets_; }
  [[nodiscard]] const std::vector<Attribute>& attributes() const { return attributes_; }

 private:
  bool is_root_;
  std::string prefix_;
  std::vector<Dataset> datasets_;
  std::vector<Attribute> attributes_;
};

/// Collective. Writes a new file with a `manifest` (the list of datasets with their checksums) and its checksum: aside as `.tmp`, synced,
/// then renamed over `path`. Every rank writes its slices straight into the file. On failure `path` is as it was before, and all ranks get the same error:
/// kResources when the disk, a quota or a file size limit is full, else kFile.
Status create_file(const std::filesystem::path& path, StoragePlan plan, const Comm& comm);

/// Collective. Adds datasets, each with its checksum, to a file (made if missing), after taking the groups `removed` out of it. A process that is killed at any moment leaves
/// the file as it was or with everything added: changes to the existing part go through a journal beside the file (`.journal`). On failure
/// the file is as it was before.
Status add_to_file(const std::filesystem::path& path, StoragePlan plan, std::span<const std::string> removed, const Comm& comm);

/// The root's part before a file is added to: finishes or drops what a killed process left in the journal. Readers see the finished state without it.
Status finish_journal(const std::filesystem::path& path);

}  // namespace morula::scenarios
