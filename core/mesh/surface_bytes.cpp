#include "core/mesh/surface_bytes.h"

#include <fstream>
#include <iterator>

namespace morula {

Result<std::string> read_surface_bytes(const std::filesystem::path& file) {
  const auto file_error = [&](const char* what, const char* help) { return Error{ErrorKind::kFile, file.string() + ": " + what, help}; };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) return file_error("there is no such file", "check the path; it is relative to the study file");
  if (std::filesystem::is_directory(status)) return file_error("is a folder", "name an STL, OBJ or VTK file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return file_error("cannot be opened", "check its permissions");
  std::string content{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) return file_error("cannot be read to its end", "check the disk");
  if (content.empty()) return file_error("is empty", "write the surface again");
  return content;
}

}  // namespace morula
