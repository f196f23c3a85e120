#include "report/pictures/png.h"

#include <png.h>

#include "results/file_io.h"

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
  png_set_compression_level(png, 4);
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

Status write_png(const std::vector<std::uint8_t>& png, const std::filesystem::path& path) {
  return write_file_atomically(path, {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace morula::scenarios
