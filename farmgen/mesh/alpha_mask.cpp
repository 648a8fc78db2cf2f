// SPDX-License-Identifier: Apache-2.0
#include "mesh/alpha_mask.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "mesh/internal/image_pixels.h"

namespace plotscan::mesh {
namespace {

// The texel of `count` in which `place` lies, the image repeated.
std::size_t texel(float place, std::size_t count) {
  const double share = static_cast<double>(place) - std::floor(static_cast<double>(place));
  return std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1);
}

}  // namespace

AlphaMask::AlphaMask(std::shared_ptr<const Image> image, float cutoff,
                     const std::filesystem::path& file)
    : image_(std::move(image)), cutoff_(cutoff) {
  const Coverage coverage = decode_coverage(image_->bytes, kMostTexels, file);
  width_ = coverage.width;
  height_ = coverage.height;
  opaque_.reserve(coverage.values.size());
  for (const std::uint8_t value : coverage.values)
    opaque_.push_back(static_cast<float>(value) >= 255 * cutoff);
}

bool AlphaMask::is_opaque(const Eigen::Vector2f& uv) const {
  const std::size_t row = height_ - 1 - texel(uv.y(), height_);
  return opaque_[row * width_ + texel(uv.x(), width_)];
}

AlphaMask AlphaMask::with_image(std::shared_ptr<const Image> image) const {
  check(image->bytes == image_->bytes, "a mask's image");
  AlphaMask mask = *this;
  mask.image_ = std::move(image);
  return mask;
}

double AlphaMask::opaque_share() const {
  const auto opaque = std::count(opaque_.begin(), opaque_.end(), true);
  return static_cast<double>(opaque) / static_cast<double>(opaque_.size());
}

bool may_have_alpha(const Image& image) { return png_has_alpha(image.bytes); }

}  // namespace plotscan::mesh
