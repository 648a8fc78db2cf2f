// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.h"

namespace plotscan::mesh {

// Where a surface is opaque: an image each texel of which either stops rays or lets them through.
class AlphaMask {
 public:
  // Made from the image's alpha, or from its brightness where it has no alpha. Texels below
  // `cutoff`, in [0, 1], let rays through. Throws InputError, naming the image as `file`, when it
  // is broken or has more than kMostTexels.
  AlphaMask(std::shared_ptr<const Image> image, float cutoff, const std::filesystem::path& file);

  // Whether the texel nearest to (u, v) is opaque, v upward from the image's lower edge; the image
  // is repeated.
  bool is_opaque(const Eigen::Vector2f& uv) const;
  // Share of all texels that are opaque.
  double opaque_share() const;

  const std::shared_ptr<const Image>& image() const { return image_; }
  // The same mask, of an image of the same bytes.
  AlphaMask with_image(std::shared_ptr<const Image> image) const;
  float cutoff() const { return cutoff_; }

  static constexpr std::size_t kMostTexels = std::size_t{1} << 26;  // 8192 x 8192: a leaf's scan

 private:
  std::shared_ptr<const Image> image_;
  float cutoff_;
  std::size_t width_ = 0;
  std::size_t height_ = 0;
  std::vector<bool> opaque_;  // row by row from the top
};

// Whether the image's header says that it has alpha; only a PNG may have it.
bool may_have_alpha(const Image& image);

inline constexpr float kAlphaCutoff = 0.5F;  // where a file states none; as glTF has it

}  // namespace plotscan::mesh
