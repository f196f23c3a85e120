#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/parallel/comm.h"
#include "core/result.h"

namespace morula::scenarios {

/// The error for a failed system call on a file: kResources when disk, quota or size limit ran out, else kFile.
Error file_error(const std::filesystem::path& path, std::string_view doing, int error_number);

/// A regular file open for writing at given places, never through a symbolic link. Failures are values; nothing is buffered here.
class OutputFile {
 public:
  /// Opens, with `create` also creates or empties.
  static Result<OutputFile> open(const std::filesystem::path& path, bool create);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  ~OutputFile();

  [[nodiscard]] Status write_at(std::uint64_t place, std::span<const std::byte> bytes);
  /// Sets the length of the file.
  [[nodiscard]] Status resize(std::uint64_t bytes);
  /// Returns when the bytes are on the disk.
  [[nodiscard]] Status sync();

 private:
  OutputFile(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  std::filesystem::path path_;
  int descriptor_;
};

/// The bytes of a regular file: a pipe or device, which could hold us up for ever, is an error.
Result<std::string> read_file(const std::filesystem::path& path);
/// Makes a folder of a run where it is missing, with its parents. A symbolic link in its place is an error: a run writes through none.
Status make_folder(const std::filesystem::path& path);
/// Writes aside (`.tmp`), syncs and renames: a reader sees the old or the new text, never a part.
Status write_file_atomically(const std::filesystem::path& path, std::string_view text);
/// Adds to the end of a regular file (created if missing; never through a symbolic link).
Status append_to_text(const std::filesystem::path& path, std::string_view text);
/// Makes the entries of the folder that a file is in last. Not every file system lets a folder be synced: what it cannot is left.
void sync_folder_of(const std::filesystem::path& path);
/// Makes what was added to a text last; its length in bytes, 0 if it is not there.
Result<std::uint64_t> sync_text(const std::filesystem::path& path);
/// Renames and makes the renaming last (fsync of the folder).
Status rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);
/// SHA-256 of a file's bytes, 64 hexadecimal digits (FIPS 180-4).
Result<std::string> sha256_of_file(const std::filesystem::path& path);
/// SHA-256 of a text.
Result<std::string> sha256_of_text(std::string_view text);

/// Collective. The same outcome on every rank: success where all succeeded, else the error of the lowest rank that failed.
Status agree(Status local, const Comm& comm);

}  // namespace morula::scenarios
