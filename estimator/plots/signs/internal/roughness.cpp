// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

#include "core/statistics.h"
#include "plots/canopy/patch.h"
#include "plots/signs/internal/plot_shape.h"

namespace plotscan::plots {
namespace {

constexpr double kMargin =
    0.1;  // of a place's smaller side: the edges belong to what stands beside
constexpr double kTopQuantile = 0.95;
constexpr double kUpper = 0.5;          // of the height
constexpr double kNoiseOfHeight = 0.1;  // above which roughness and noise are not told apart
// Leaves scatter by 0.0097 of the height and more about a plane of this size (17 fields of maize;
// 0.006 where giants stand beside dwarfs; in most crops more): at this noise by 1.4 sigmas with it.
constexpr double kNoiseHidesLeaves = 0.01;
constexpr double kLeastPatch_m = 0.2, kMostPatch_m = 0.35;
constexpr double kReturnsOfPatch = 16;     // of the usual patch
constexpr float kLeastReturnsOfPatch = 8;  // of a patch that is judged
constexpr std::size_t kLeastPatches = 10;  // of a place
constexpr double kPatchQuantile = 0.5;     // edges and steps lie in some patches
constexpr std::size_t kLeastReturns = 20;
constexpr std::size_t kMostReturns = 1'000'000;  // looked at, of the field

// The raster's cells, each with the number of the place that it lies in.
class PlaceOfCell {
 public:
  explicit PlaceOfCell(const Lattice& lattice)
      : raster_(*lattice.view.raster), ab_from_world_(raster_.frame().ab_from_world()) {
    number_.assign(cells(raster_.a_cells()) * cells(raster_.b_cells()), kNone);
    const double inset_m = -kMargin * std::min(lattice.r.size_m, lattice.c.size_m);
    for (std::size_t i = 0; i < lattice.places.size(); ++i) {
      const Place& place = lattice.places[i];
      const CellBox box = cells_about(lattice, place, inset_m);
      for (int r = box.r0; r < box.r1; ++r) {
        for (int c = box.c0; c < box.c1; ++c) {
          const int a = lattice.view.swapped ? c : r, b = lattice.view.swapped ? r : c;
          if (is_in(a, b)) number_[at(a, b)] = static_cast<std::int32_t>(i);
        }
      }
    }
  }

  static constexpr std::int32_t kNone = -1;
  std::int32_t of(const Eigen::Vector3f& point) const {
    const Eigen::Vector2d ab = ab_from_world_ *
                               (point.head<2>().cast<double>() - raster_.frame().origin) /
                               raster_.cell_m();
    const int a = static_cast<int>(std::floor(ab.x())), b = static_cast<int>(std::floor(ab.y()));
    return is_in(a, b) ? number_[at(a, b)] : kNone;
  }

 private:
  static std::size_t cells(int count) { return static_cast<std::size_t>(count); }
  bool is_in(int a, int b) const {
    return a >= 0 && a < raster_.a_cells() && b >= 0 && b < raster_.b_cells();
  }
  std::size_t at(int a, int b) const { return cells(a) * cells(raster_.b_cells()) + cells(b); }

  const CanopyRaster& raster_;
  Eigen::Matrix2d ab_from_world_;
  std::vector<std::int32_t> number_;
};

// Samples the points by place. The step is odd, so that it meets all lasers of a sensor, which fire
// in turn.
std::vector<std::vector<Eigen::Vector3f>> returns_by_place(
    const Lattice& lattice, std::span<const Eigen::Vector3f> points) {
  const PlaceOfCell place_of(lattice);
  std::vector<std::vector<Eigen::Vector3f>> returns(lattice.places.size());
  const std::size_t step = points.size() / kMostReturns | 1;
  for (std::size_t i = 0; i < points.size(); i += step) {
    if (!points[i].allFinite()) continue;
    const std::int32_t place = place_of.of(points[i]);
    if (place != PlaceOfCell::kNone) returns[static_cast<std::size_t>(place)].push_back(points[i]);
  }
  return returns;
}

// Scatter of the heights about the plane that fits them best, metres.
double scatter_about_plane(std::span<const Eigen::Vector3f> points) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& point : points) middle += point.cast<double>();
  middle /= static_cast<double>(points.size());
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3d from_middle = point.cast<double>() - middle;
    products += from_middle * from_middle.transpose();
  }
  const Eigen::Vector2d slope =
      products.topLeftCorner<2, 2>().ldlt().solve(products.topRightCorner<2, 1>());
  const double left = products(2, 2) - slope.dot(products.topRightCorner<2, 1>());
  return std::sqrt(std::max(0.0, left) / static_cast<double>(points.size() - 3));
}

// Of a place.
struct UpperReturns {
  double top_m = 0;
  std::vector<Eigen::Vector3f> returns;
};

UpperReturns upper_of(const std::vector<Eigen::Vector3f>& returns) {
  std::vector<double> heights;
  heights.reserve(returns.size());
  for (const Eigen::Vector3f& point : returns) heights.push_back(point.z());
  UpperReturns upper{.top_m = quantile(std::move(heights), kTopQuantile), .returns = {}};
  std::ranges::copy_if(
      returns, std::back_inserter(upper.returns),
      [&](const Eigen::Vector3f& point) { return point.z() > kUpper * upper.top_m; });
  return upper;
}

double scatter_of_height(const UpperReturns& upper, double noise_m) {
  if (upper.returns.size() < kLeastReturns) return kNaN;
  const double known_noise_m = noise_m < kNoiseOfHeight * upper.top_m ? noise_m : 0;
  const double scatter_m = scatter_about_plane(upper.returns);
  return std::sqrt(std::max(0.0, scatter_m * scatter_m - known_noise_m * known_noise_m)) /
         upper.top_m;
}

double scatter_in_patches(const UpperReturns& upper, double place_m2, double noise_m) {
  if (noise_m > kNoiseHidesLeaves * upper.top_m) return kNaN;
  const double patch_m = std::max(
      kLeastPatch_m,
      std::sqrt(kReturnsOfPatch * place_m2 / static_cast<double>(upper.returns.size() + 1)));
  if (patch_m > kMostPatch_m) return kNaN;
  std::map<std::pair<int, int>, Patch> patches;
  for (const Eigen::Vector3f& point : upper.returns) {
    const Eigen::Vector2d at = point.head<2>().cast<double>() / patch_m;
    const Eigen::Vector2d corner = at.array().floor();
    const Eigen::Vector2f within = ((at - corner) * patch_m).cast<float>();
    const Eigen::Vector2i number = corner.cast<int>();
    patches[{number.x(), number.y()}].add({within.x(), within.y(), point.z()});
  }
  std::vector<double> scatters;
  for (const auto& [number, patch] : patches)
    if (patch.count() >= kLeastReturnsOfPatch) scatters.push_back(patch.sd_about_plane());
  if (scatters.size() < kLeastPatches) return kNaN;
  return quantile(std::move(scatters), kPatchQuantile) / noise_m;
}

double median_of_known(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  return quantile(std::move(values), 0.5);
}

}  // namespace

Roughness roughness(const Lattice& lattice, std::span<const Eigen::Vector3f> points,
                    double noise_m) {
  const double inset_m = 2 * kMargin * std::min(lattice.r.size_m, lattice.c.size_m);
  const double place_m2 = (lattice.r.size_m - inset_m) * (lattice.c.size_m - inset_m);
  std::vector<double> of_height, in_patches;
  for (const std::vector<Eigen::Vector3f>& returns : returns_by_place(lattice, points)) {
    if (returns.empty()) continue;
    const UpperReturns upper = upper_of(returns);
    of_height.push_back(scatter_of_height(upper, noise_m));
    in_patches.push_back(scatter_in_patches(upper, place_m2, noise_m));
  }
  return {.of_height = median_of_known(std::move(of_height)),
          .in_patches = median_of_known(std::move(in_patches))};
}

}  // namespace plotscan::plots
