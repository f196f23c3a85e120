#include "core/mesh/surface_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace morula {

Result<std::string> read_surface_bytes(const std::filesystem::path& file) {
  const auto file_error = [&](const std::string& what, const char* help) {
    return Error{ErrorKind::kFile, file.string() + ": " + what, help};
  };
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR))
    return file_error("there is no such file", "check the path; it is relative to the study file");
  if (descriptor < 0) return file_error("cannot be opened", "check its permissions");
  const struct Closer {
    int descriptor;
    ~Closer() { ::close(descriptor); }
  } closer{descriptor};
  struct stat info {};
  if (::fstat(descriptor, &info) != 0) return file_error("cannot be looked at", "check the disk");
  if (S_ISDIR(info.st_mode)) return file_error("is a folder", "name an STL, OBJ or VTK file");
  if (!S_ISREG(info.st_mode)) return file_error("is a pipe or device, not a regular file", "name an STL, OBJ or VTK file");
  const auto size = static_cast<std::uintmax_t>(info.st_size);
  if (size > kMaxSurfaceBytes)
    return file_error("is too large: " + std::to_string(size >> 20) + " MiB, at most " + std::to_string(kMaxSurfaceBytes >> 20) + " MiB",
                      "use a coarser mesh, or several files");
  if (size == 0) return file_error("is empty", "write the surface again");
  std::string content(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got = ::read(descriptor, content.data() + done, size - done);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return file_error("cannot be read to its end", "check the disk");
    done += static_cast<std::size_t>(got);
  }
  return content;
}

}  // namespace morula
