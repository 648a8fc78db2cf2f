// SPDX-License-Identifier: Apache-2.0
#include "terrain/internal/grey_image.h"

#include <csetjmp>
#include <cstdio>
#include <memory>
#include <string>

#include <png.h>

#include "core/error.h"
#include "core/list_of.h"

namespace plotscan::terrain {
namespace {

void keep_error(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

class PngReader {
 public:
  explicit PngReader(const std::filesystem::path& path)
      : path_(path), file_(std::fopen(path.c_str(), "rb"), &std::fclose) {
    if (!file_) throw InputError(path, "cannot be read");
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &error_, keep_error, ignore_warning);
    check(png_ != nullptr, "libpng does not start");
    info_ = png_create_info_struct(png_);
    check(info_ != nullptr, "libpng does not start");
    png_init_io(png_, file_.get());
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  // Before all else.
  void start() {
    if (!read_header()) fail();
  }
  std::size_t width() const { return png_get_image_width(png_, info_); }
  std::size_t height() const { return png_get_image_height(png_, info_); }
  int bits() const { return png_get_bit_depth(png_, info_); }
  bool is_grey() const { return (png_get_color_type(png_, info_) & ~PNG_COLOR_MASK_ALPHA) == 0; }

  // The rows' bytes, 1 or 2 a pixel, the higher one first.
  std::vector<std::vector<png_byte>> rows() {
    const std::vector<png_byte> row(width() * (bits() == 16 ? 2 : 1));
    std::vector<std::vector<png_byte>> rows(height(), row);
    std::vector<png_bytep> places = list_of(rows, [](auto& each) { return each.data(); });
    if (!read_rows(places.data())) fail();
    return rows;
  }

 private:
  // libpng leaves these by longjmp when something is wrong: they hold nothing to be destroyed.
  bool read_header() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_info(png_, info_);
    return true;
  }
  bool read_rows(png_bytepp places) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_packing(png_);  // a byte for each pixel of fewer bits, its value kept
    png_set_strip_alpha(png_);
    png_read_image(png_, places);
    png_read_end(png_, nullptr);
    return true;
  }

  [[noreturn]] void fail() const { throw InputError(path_, "is not a sound PNG: {}", error_); }

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::string error_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

GreyImage read_grey_png(const std::filesystem::path& path, std::size_t most_pixels) {
  require_file(path);
  PngReader reader(path);
  reader.start();
  if (!reader.is_grey()) throw InputError(path, "is an image in colour; a grey one is expected");
  GreyImage image{.width = reader.width(), .height = reader.height(), .white = 0, .pixels = {}};
  if (image.width * image.height > most_pixels) {
    throw InputError(path, "has {} x {} pixels; at most {} are allowed", image.width, image.height,
                     most_pixels);
  }
  const int bits = reader.bits();
  image.white = (1U << bits) - 1;
  for (const auto& row : reader.rows()) {
    for (std::size_t i = 0; i < image.width; ++i) {
      const bool two_bytes = bits == 16;
      image.pixels.push_back(
          static_cast<std::uint16_t>(two_bytes ? row[2 * i] << 8 | row[2 * i + 1] : row[i]));
    }
  }
  return image;
}

}  // namespace plotscan::terrain
