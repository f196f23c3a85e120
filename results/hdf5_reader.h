#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/parallel/comm.h"
#include "core/result.h"
#include "results/hdf5_plan.h"

namespace morula::scenarios {

/// Reads a file written by create_file or add_to_file, also one whose writer was killed. Each rank may open and read on its own.
class Hdf5Reader {
 public:
  static Result<Hdf5Reader> open(const std::filesystem::path& path);
  Hdf5Reader(Hdf5Reader&&) noexcept;
  ~Hdf5Reader();

  [[nodiscard]] bool exists(const std::string& path) const;
  /// How many groups and datasets a group holds.
  [[nodiscard]] Result<std::uint64_t> links(const std::string& group) const;
  [[nodiscard]] Result<std::uint64_t> rows(const std::string& path) const;
  /// The attribute `units` of a dataset.
  [[nodiscard]] Result<std::string> units(const std::string& path) const;
  /// The attribute `description` of a dataset; empty if it has none.
  [[nodiscard]] Result<std::string> description(const std::string& path) const;
  /// Names of the values of an enumeration, in the order of their numbers; empty for any other dataset.
  [[nodiscard]] Result<std::vector<std::string>> kinds(const std::string& path) const;
  /// An attribute of the root group.
  [[nodiscard]] std::optional<std::uint64_t> root_number(const std::string& name) const;
  [[nodiscard]] std::string root_text(const std::string& name) const;
  [[nodiscard]] bool is_group(const std::string& path) const;

  /// Rows first .. first+count−1.
  template <class T>
  [[nodiscard]] Result<std::vector<T>> read(const std::string& path, std::uint64_t first, std::uint64_t count) const {
    std::vector<T> out;
    MORULA_TRY(check_share(path, Stored<T>::type, Stored<T>::width, first, count));
    out.resize(count);
    MORULA_TRY(read_raw(path, Stored<T>::type, Stored<T>::width, first, count, reinterpret_cast<std::byte*>(out.data())));
    return out;
  }
  template <class T>
  [[nodiscard]] Result<std::vector<T>> read(const std::string& path) const {
    MORULA_TRY_ASSIGN(const std::uint64_t count, rows(path));
    return read<T>(path, 0, count);
  }
  template <class T>
  [[nodiscard]] Result<T> value(const std::string& path) const {
    MORULA_TRY_ASSIGN(const std::vector<T> one, read<T>(path, 0, 1));
    return one.front();
  }
  [[nodiscard]] Result<std::vector<std::string>> texts(const std::string& path) const;
  [[nodiscard]] Result<std::string> text(const std::string& path) const;

  /// Collective. Every byte of every dataset against the manifest; each rank reads its share. The error says which dataset is damaged.
  [[nodiscard]] Status verify(const Comm& comm) const;

 private:
  struct State;
  explicit Hdf5Reader(std::unique_ptr<State> state);
  [[nodiscard]] Status check_share(const std::string& path, StoredType type, std::uint32_t width, std::uint64_t first,
                                   std::uint64_t count) const;
  [[nodiscard]] Status read_raw(const std::string& path, StoredType type, std::uint32_t width, std::uint64_t first, std::uint64_t count,
                                std::byte* out) const;
  [[nodiscard]] Error damaged(const std::string& what) const;

  std::unique_ptr<State> state_;
};

}  // namespace morula::scenarios
