#include "scenarios/pictures/png.h"

#include <png.h>

#include <cstdio>
#include <cstring>
#include <system_error>

namespace morula::scenarios {
namespace {

void append(png_structp png, png_bytep data, png_size_t size) {
  auto& out = *static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  out.insert(out.end(), data, data + size);
}

// libpng reports errors by longjmp: this function holds no object with a destructor between setjmp and the end of writing.
bool write_rows(png_structp png, png_infop info, const Image& image, std::vector<std::uint8_t>& out) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &out, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_compression_level(png, 6);
  png_write_info(png, info);
  const std::size_t stride = static_cast<std::size_t>(image.width) * 3;
  for (int y = 0; y < image.height; ++y) png_write_row(png, image.rgb.data() + static_cast<std::size_t>(y) * stride);
  png_write_end(png, info);
  return true;
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_png(const Image& image) {
  if (image.width <= 0 || image.height <= 0) return Error{ErrorKind::kInternal, "a picture without pixels cannot be written as PNG", ""};
  std::vector<std::uint8_t> out;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  const bool written = info && write_rows(png, info, image, out);
  png_destroy_write_struct(&png, &info);
  if (!written) return Error{ErrorKind::kResources, "libpng could not encode a picture", "is there enough memory?"};
  return out;
}

Status write_bytes(const std::filesystem::path& path, const void* data, std::size_t size) {
  const std::filesystem::path aside = path.string() + ".part";
  std::FILE* file = std::fopen(aside.c_str(), "wb");
  if (!file)
    return Error{ErrorKind::kFile, "cannot write " + path.string() + ": " + std::strerror(errno), "is the folder there and writable?"};
  bool good = std::fwrite(data, 1, size, file) == size;
  good = std::fclose(file) == 0 && good;
  std::error_code failed;
  if (good) std::filesystem::rename(aside, path, failed);
  if (good && !failed) return {};
  std::error_code ignored;
  std::filesystem::remove(aside, ignored);
  return Error{ErrorKind::kResources, "cannot write all of " + path.string(), "is the disk full?"};
}

Status write_png(const Image& image, const std::filesystem::path& path) {
  MORULA_TRY_ASSIGN(const auto bytes, encode_png(image));
  return write_bytes(path, bytes.data(), bytes.size());
}

}  // namespace morula::scenarios
