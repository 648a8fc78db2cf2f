// SPDX-License-Identifier: Apache-2.0
#include "mesh/internal/image_pixels.h"

#include <csetjmp>
#include <cstdio>

#include <jpeglib.h>
#include <png.h>

#include "core/error.h"

namespace plotscan::mesh {
namespace {

bool is_jpeg(const std::string& bytes) { return bytes.starts_with("\xff\xd8\xff"); }

void require_size(std::size_t width, std::size_t height, std::size_t most_pixels,
                  const std::filesystem::path& file) {
  if (width > 0 && height > 0 && width <= most_pixels / height) return;
  throw InputError(file, "has {} x {} pixels; at most {} are allowed", width, height, most_pixels);
}

// libpng's simplified reader; it keeps what it allocates until it is freed.
class PngReader {
 public:
  explicit PngReader(const std::string& bytes) {
    image_.version = PNG_IMAGE_VERSION;
    begun_ = png_image_begin_read_from_memory(&image_, bytes.data(), bytes.size()) != 0;
  }
  ~PngReader() { png_image_free(&image_); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  bool begun() const { return begun_; }
  bool has_alpha() const { return (image_.format & PNG_FORMAT_FLAG_ALPHA) != 0; }
  std::size_t width() const { return image_.width; }
  std::size_t height() const { return image_.height; }
  std::string message() const { return image_.message; }

  // Grey and alpha of every pixel; false when the file is broken.
  bool read(std::vector<std::uint8_t>& grey_alpha) {
    image_.format = PNG_FORMAT_GA;
    grey_alpha.resize(PNG_IMAGE_SIZE(image_));
    return png_image_finish_read(&image_, nullptr, grey_alpha.data(), 0, nullptr) != 0;
  }

 private:
  png_image image_{};
  bool begun_ = false;
};

Coverage decode_png(const std::string& bytes, std::size_t most_pixels,
                    const std::filesystem::path& file) {
  PngReader reader(bytes);
  if (!reader.begun()) throw InputError(file, "is not a sound PNG: {}", reader.message());
  require_size(reader.width(), reader.height(), most_pixels, file);
  const std::size_t wanted = reader.has_alpha() ? 1 : 0;
  std::vector<std::uint8_t> pixels;
  if (!reader.read(pixels)) throw InputError(file, "is not a sound PNG: {}", reader.message());
  Coverage coverage{.width = reader.width(), .height = reader.height(), .values = {}};
  coverage.values.reserve(pixels.size() / 2);
  for (std::size_t i = wanted; i < pixels.size(); i += 2) coverage.values.push_back(pixels[i]);
  return coverage;
}

// libjpeg leaves by longjmp when something is wrong, and takes a cut-off file for a warning.
struct JpegErrors {
  jpeg_error_mgr manager{};  // the first member: libjpeg hands out its address
  std::jmp_buf place{};
  char message[JMSG_LENGTH_MAX] = {};
};

void leave(j_common_ptr jpeg) {
  auto* errors = reinterpret_cast<JpegErrors*>(jpeg->err);
  errors->manager.format_message(jpeg, errors->message);
  std::longjmp(errors->place, 1);
}

void leave_at_warning(j_common_ptr jpeg, int level) {
  if (level < 0) leave(jpeg);
}

class JpegReader {
 public:
  explicit JpegReader(const std::string& bytes) : bytes_(bytes) {
    jpeg_.err = jpeg_std_error(&errors_.manager);
    errors_.manager.error_exit = leave;
    errors_.manager.emit_message = leave_at_warning;
  }
  ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  // These hold nothing to be destroyed, since longjmp leaves them.
  bool begin() {
    if (setjmp(errors_.place) != 0) return false;
    jpeg_create_decompress(&jpeg_);
    jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
    jpeg_read_header(&jpeg_, TRUE);
    return true;
  }
  bool read(std::uint8_t* values) {
    if (setjmp(errors_.place) != 0) return false;
    jpeg_.out_color_space = JCS_GRAYSCALE;
    jpeg_start_decompress(&jpeg_);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = values + static_cast<std::size_t>(jpeg_.output_scanline) * jpeg_.output_width;
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
  }
  std::size_t width() const { return jpeg_.image_width; }
  std::size_t height() const { return jpeg_.image_height; }
  std::string message() const { return errors_.message; }

 private:
  const std::string& bytes_;
  JpegErrors errors_;
  jpeg_decompress_struct jpeg_{};
};

Coverage decode_jpeg(const std::string& bytes, std::size_t most_pixels,
                     const std::filesystem::path& file) {
  JpegReader reader(bytes);
  if (!reader.begin()) throw InputError(file, "is not a sound JPEG: {}", reader.message());
  require_size(reader.width(), reader.height(), most_pixels, file);
  Coverage coverage{.width = reader.width(), .height = reader.height(), .values = {}};
  coverage.values.resize(coverage.width * coverage.height);
  if (!reader.read(coverage.values.data()))
    throw InputError(file, "is not a sound JPEG: {}", reader.message());
  return coverage;
}

}  // namespace

Coverage decode_coverage(const std::string& bytes, std::size_t most_pixels,
                         const std::filesystem::path& file) {
  return is_jpeg(bytes) ? decode_jpeg(bytes, most_pixels, file)
                        : decode_png(bytes, most_pixels, file);
}

bool png_has_alpha(const std::string& bytes) {
  const PngReader reader(bytes);
  return reader.begun() && reader.has_alpha();
}

}  // namespace plotscan::mesh
