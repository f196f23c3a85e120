#include "results/file_io.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <span>

namespace morula::scenarios {
namespace fs = std::filesystem;

Error file_error(const fs::path& path, std::string_view doing, int error_number) {
  Error error;
  if (error_number == ELOOP)
    return {ErrorKind::kFile, "cannot " + std::string(doing) + " '" + path.string() + "': it is a symbolic link",
            "a run writes its files through no link: remove it, or move the run's folder as a whole"};
  const bool no_room = error_number == ENOSPC || error_number == EDQUOT || error_number == EFBIG;
  error.kind = no_room ? ErrorKind::kResources : ErrorKind::kFile;
  error.message = "cannot " + std::string(doing) + " '" + path.string() + "': " + std::strerror(error_number);
  if (no_room)
    error.help = "free some disk space (or raise the quota or file size limit) and resume the run";
  else if (error_number == EACCES || error_number == EPERM || error_number == EROFS)
    error.help = "its permissions do not allow it: change them, or use another folder (most commands that write one take --out)";
  return error;
}

namespace {

/// A descriptor to write with; never through a link, never into a pipe or device (which could hold us up for ever).
Result<int> open_to_write(const fs::path& path, int flags, std::string_view doing) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | flags, 0644);
  if (descriptor < 0) return file_error(path, doing, errno);
  struct stat info {};
  if (::fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode)) return descriptor;
  ::close(descriptor);
  return Error{ErrorKind::kFile, "cannot " + std::string(doing) + " '" + path.string() + "': it is not a regular file", "remove it"};
}

}  // namespace

Result<OutputFile> OutputFile::open(const fs::path& path, bool create) {
  MORULA_TRY_ASSIGN(const int descriptor, open_to_write(path, create ? O_CREAT | O_TRUNC : 0, create ? "create" : "open"));
  return OutputFile(path, descriptor);
}

OutputFile::OutputFile(OutputFile&& other) noexcept : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Status OutputFile::write_at(std::uint64_t place, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(place));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return file_error(path_, "write", errno);
    if (written == 0) return file_error(path_, "write", ENOSPC);
    place += static_cast<std::uint64_t>(written);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return {};
}

Status OutputFile::resize(std::uint64_t bytes) {
  if (::ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0) return file_error(path_, "resize", errno);
  return {};
}

Status OutputFile::sync() {
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) return file_error(path_, "write", errno);
  return {};
}

Result<std::string> read_file(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return file_error(path, "read", errno);
  struct stat info {};
  if (::fstat(descriptor, &info) != 0 || !S_ISREG(info.st_mode)) {
    ::close(descriptor);
    return Error{ErrorKind::kFile, "cannot read '" + path.string() + "': it is not a regular file", ""};
  }
  std::string text;
  std::array<char, 65536> block;
  ssize_t got = 0;
  while ((got = ::read(descriptor, block.data(), block.size())) != 0) {
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      const int reason = errno;
      ::close(descriptor);
      return file_error(path, "read", reason);
    }
    text.append(block.data(), static_cast<std::size_t>(got));
  }
  ::close(descriptor);
  return text;
}

Status make_folder(const fs::path& path) {
  std::error_code error;
  if (fs::is_symlink(path, error)) return file_error(path, "create folder", ELOOP);
  fs::create_directories(path, error);
  return error ? Status(file_error(path, "create folder", error.value())) : Status{};
}

void sync_folder_of(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

Status rename_durably(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) return file_error(to, "write", errno);
  sync_folder_of(to);
  return {};
}

Result<std::uint64_t> sync_text(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0 && errno == ENOENT) return std::uint64_t{0};
  if (descriptor < 0) return file_error(path, "write", errno);
  struct stat info {};
  const bool synced = ::fstat(descriptor, &info) == 0 && (::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS);
  const int reason = errno;
  ::close(descriptor);
  if (!synced) return file_error(path, "write", reason);
  return static_cast<std::uint64_t>(info.st_size);
}

Status write_file_atomically(const fs::path& path, std::string_view text) {
  fs::path aside = path;
  aside += ".tmp";
  const auto write = [&]() -> Status {
    MORULA_TRY_ASSIGN(OutputFile file, OutputFile::open(aside, true));
    MORULA_TRY(file.write_at(0, std::as_bytes(std::span(text))));
    return file.sync();
  };
  Status status = write();
  if (status.ok()) status = rename_durably(aside, path);
  if (!status.ok()) ::unlink(aside.c_str());
  return status;
}

Status append_to_text(const fs::path& path, std::string_view text) {
  MORULA_TRY_ASSIGN(const int descriptor, open_to_write(path, O_CREAT | O_APPEND, "write"));
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const int reason = written < 0 ? errno : ENOSPC;
      ::close(descriptor);
      return file_error(path, "write", reason);
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  ::close(descriptor);
  return {};
}

Result<std::string> sha256_of_text(std::string_view text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int length = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
    return Error{ErrorKind::kInternal, "the SHA-256 of the crypto library failed", ""};
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (unsigned int i = 0; i < length; ++i) {
    out += kDigits[digest[i] >> 4];
    out += kDigits[digest[i] & 15];
  }
  return out;
}

Result<std::string> sha256_of_file(const fs::path& path) {
  MORULA_TRY_ASSIGN(const std::string text, read_file(path));
  return sha256_of_text(text);
}

Status agree(Status local, const Comm& comm) {
  if (comm.size() == 1) return local;
  const std::int64_t first_is_largest = comm.size() - comm.rank();
  const std::int64_t failed = comm.max(local.ok() ? 0 : first_is_largest);
  if (failed == 0) return {};
  std::vector<std::byte> bytes;  // kind, message, help of the first rank that failed
  if (failed == first_is_largest) {
    const std::string message = static_cast<char>(local.error().kind) + local.error().message + '\0' + local.error().help;
    const auto raw = std::as_bytes(std::span(message));
    bytes.assign(raw.begin(), raw.end());
  }
  comm.broadcast(bytes, static_cast<int>(comm.size() - failed));
  const std::string message(reinterpret_cast<const char*>(bytes.data()), bytes.size());  // NOLINT: characters
  const std::size_t end = message.find('\0', 1);
  return Error{static_cast<ErrorKind>(message[0]), message.substr(1, end - 1), message.substr(end + 1)};
}

}  // namespace morula::scenarios
