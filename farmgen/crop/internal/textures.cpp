// SPDX-License-Identifier: Apache-2.0
#include "crop/internal/textures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/error.h"
#include "core/random.h"
#include "crop/internal/png.h"

namespace plotscan::crop {
namespace {

constexpr double kTurn = 2 * kPi;

// A shade in [0, 1] at a place of the texture, u and v in [0, 1]: 0 the darkest, kPlain the
// organ's own colour, 1 the lightest, as its veins are.
using Shading = std::function<double(double u, double v)>;
constexpr double kPlain = 0.45;

// Smooth noise in [-1, 1] over a lattice of `columns` by `rows` random values that repeats after
// the texture's width and height.
class Noise {
 public:
  Noise(std::uint64_t index, int columns, int rows)
      : columns_(columns), rows_(rows), values_(static_cast<std::size_t>(columns * rows)) {
    RandomStream stream(0, random_purpose("texture/noise"), index);
    for (double& value : values_) value = stream.uniform(-1, 1);
  }

  double operator()(double u, double v) const {
    const double x = u * columns_;
    const double y = v * rows_;
    const double lower = mixed(at(x, y), at(x + 1, y), eased(x));
    const double upper = mixed(at(x, y + 1), at(x + 1, y + 1), eased(x));
    return mixed(lower, upper, eased(y));
  }

 private:
  static double mixed(double a, double b, double share) { return a + share * (b - a); }
  static double eased(double x) {
    const double share = x - std::floor(x);
    return share * share * (3 - 2 * share);
  }
  double at(double x, double y) const {
    const auto wrapped = [](double value, int period) {
      const int cell = static_cast<int>(std::floor(value)) % period;
      return cell < 0 ? cell + period : cell;
    };
    const auto row = static_cast<std::size_t>(wrapped(y, rows_));
    return values_[row * static_cast<std::size_t>(columns_) +
                   static_cast<std::size_t>(wrapped(x, columns_))];
  }

  int columns_;
  int rows_;
  std::vector<double> values_;
};

// 1 on a line, falling to 0 at a few widths from it.
double ridge(double distance, double width) {
  return std::exp(-(distance * distance) / (width * width));
}

// The distance to the nearest whole number.
double to_whole(double value) { return std::abs(value - std::round(value)); }

Shading net_veins() {
  const Noise blotches(1, 6, 12);
  const Noise grain(2, 28, 56);
  return [=](double u, double v) {
    const double aside = 2 * std::abs(u - 0.5);
    const double midrib = ridge(aside, 0.035 * (1.2 - v));
    // Side veins leave the midrib at about 45 degrees, alternate, and curve towards the tip.
    const double rise = v - 0.34 * aside + 0.12 * aside * aside + 0.012 * blotches(u, v);
    const double vein = 8 * rise + (u < 0.5 ? 0.5 : 0.0);
    const double side = ridge(to_whole(vein), 0.06) * (1 - 0.65 * aside);
    // The skin bulges between the veins.
    const double bulge = 0.07 * (1 - std::cos(kTurn * vein)) * (1 - 0.5 * aside);
    const double lamina = kPlain - 0.10 + bulge + 0.11 * blotches(u, v) + 0.07 * grain(u, v);
    return std::max({lamina, 0.95 * midrib, lamina + 0.32 * side});
  };
}

Shading parallel_veins(double midrib_width) {
  const Noise blotches(3, 3, 14);
  const Noise streaks(4, 48, 10);
  return [=](double u, double v) {
    const double aside = 2 * std::abs(u - 0.5);
    const double midrib = ridge(aside, midrib_width * (1.25 - v));
    const double veins = 0.05 * std::cos(14 * kTurn * u);
    const double lamina = kPlain - 0.04 + veins + 0.08 * blotches(u, v) + 0.10 * streaks(u, v);
    return std::max(lamina, 0.92 * midrib);
  };
}

Shading fibres() {
  const Noise stripes(5, 16, 3);
  const Noise blotches(6, 3, 10);
  return [=](double u, double v) { return kPlain + 0.22 * stripes(u, v) + 0.14 * blotches(u, v); };
}

Shading spikelets() {
  const Noise grain(7, 20, 60);
  return [=](double u, double v) {
    // Rows of scales, each row half a scale aside of that below it.
    const double row = 18 * v;
    const double scale = 4 * u + (static_cast<int>(std::floor(row)) % 2 == 0 ? 0.0 : 0.5);
    const double across = 2 * to_whole(scale);     // 0 at the scale's keel, 1 at its edge
    const double along = row - std::floor(row);    // from its base to its tip
    const double tip = 1 - across * across * 0.6;  // where the scale ends
    const double body = 0.30 + 0.45 * along / tip;
    const double shade = along > tip ? 0.12 : body;
    return shade + 0.15 * ridge(across, 0.15) + 0.08 * grain(u, v);
  };
}

Shading pod() {
  const Noise down(8, 24, 72);
  const Noise blotches(9, 4, 8);
  return [=](double u, double v) {
    const double seed = 0.10 * std::cos(3 * kTurn * (v - 1.0 / 6)) * std::abs(std::cos(kTurn * u));
    const double seam = 0.25 * ridge(to_whole(2 * u), 0.06);
    return kPlain - 0.02 + seed + seam + 0.14 * down(u, v) + 0.08 * blotches(u, v);
  };
}

struct Size {
  int width;
  int height;
};

// Pixels as much as the pattern needs.
Size size_of(Pattern pattern) {
  switch (pattern) {
    case Pattern::net_veins:
      return {128, 256};
    case Pattern::parallel_veins:
      return {64, 256};
    default:
      return {64, 128};
  }
}

Shading shading_of(Pattern pattern, Form form) {
  switch (pattern) {
    case Pattern::net_veins:
      return net_veins();
    case Pattern::parallel_veins:
      return parallel_veins(form == Form::maize ? 0.10 : 0.06);
    case Pattern::spikelets:
      return spikelets();
    case Pattern::pod:
      return pod();
    case Pattern::fibres:
      break;
  }
  return fibres();
}

Raster drawn(const Size& size, const Shading& shading) {
  Raster raster{.width = size.width, .height = size.height, .shades = {}};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double v = 1 - (y + 0.5) / size.height;
      const double shade = std::clamp(shading((x + 0.5) / size.width, v), 0.0, 1.0);
      // Fewer shades than 256 are as many as the eye sees, and pack better.
      raster.shades.push_back(static_cast<std::uint8_t>(4 * std::lround(63 * shade)));
    }
  }
  return raster;
}

// Colours from darker through the organ's own to that of veins, which hold less chlorophyll.
Palette palette_about(const Eigen::Vector3f& colour) {
  const Eigen::Vector3f dark = 0.55F * colour;
  const Eigen::Vector3f vein = 0.45F * colour + 0.55F * Eigen::Vector3f(0.78F, 0.82F, 0.52F);
  Palette palette;
  for (std::size_t i = 0; i < palette.size(); ++i) {
    const float shade = static_cast<float>(i) / 252;
    const float plain = static_cast<float>(kPlain);
    palette[i] = shade < plain
                     ? Eigen::Vector3f(dark + shade / plain * (colour - dark))
                     : Eigen::Vector3f(colour + (shade - plain) / (1 - plain) * (vein - colour));
  }
  return palette;
}

std::string hex_of(const Eigen::Vector3f& colour) {
  std::string text;
  for (const float share : colour)
    text += fmt::format("{:02x}",
                        static_cast<unsigned>(std::lround(255 * std::clamp(share, 0.0F, 1.0F))));
  return text;
}

}  // namespace

Pattern pattern_of(Form form, const std::string& material) {
  const auto has = [&](const char* word) { return material.find(word) != std::string::npos; };
  if (form == Form::soybean && (has("leaf") || has("cotyledon"))) return Pattern::net_veins;
  if (form == Form::soybean && has("pod")) return Pattern::pod;
  if (form == Form::wheat && has("ear")) return Pattern::spikelets;
  return has("leaf") || has("dry") ? Pattern::parallel_veins : Pattern::fibres;
}

std::shared_ptr<const mesh::Image> organ_texture(Form form, const std::string& crop,
                                                 const std::string& material,
                                                 const Eigen::Vector3f& colour) {
  const Pattern pattern = pattern_of(form, material);
  return std::make_shared<const mesh::Image>(mesh::Image{
      .name = crop + "_" + material + "_" + hex_of(colour) + ".png",
      .bytes = png_of(drawn(size_of(pattern), shading_of(pattern, form)), palette_about(colour))});
}

void add_textures(mesh::Mesh& mesh, Form form, const std::string& crop) {
  check(mesh.texture_coordinates.size() == mesh.vertices.size(),
        "a mesh to be textured has texture coordinates");
  for (mesh::Material& material : mesh.materials) {
    material.texture = organ_texture(form, crop, material.name, material.colour);
    material.colour = Eigen::Vector3f::Ones();
  }
}

}  // namespace plotscan::crop
