// SPDX-License-Identifier: Apache-2.0
#include "plots/signs/internal/roughness.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Cholesky>

#include "core/statistics.h"

namespace plotscan::plots {
namespace {

constexpr double kMargin =
    0.1;  // of a place's smaller side: the edges belong to what stands beside
constexpr double kTopQuantile = 0.95;
constexpr double kUpper = 0.5;          // of the height
constexpr double kNoiseOfHeight = 0.1;  // above which roughness and noise are not told apart
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

// NaN where there are too few returns.
double roughness_of(const std::vector<Eigen::Vector3f>& returns, double noise_m) {
  std::vector<double> heights;
  heights.reserve(returns.size());
  for (const Eigen::Vector3f& point : returns) heights.push_back(point.z());
  const double top_m = quantile(std::move(heights), kTopQuantile);
  std::vector<Eigen::Vector3f> upper;
  std::ranges::copy_if(returns, std::back_inserter(upper),
                       [&](const Eigen::Vector3f& point) { return point.z() > kUpper * top_m; });
  if (upper.size() < kLeastReturns) return kNaN;
  const double known_noise_m = noise_m < kNoiseOfHeight * top_m ? noise_m : 0;
  const double scatter_m = scatter_about_plane(upper);
  return std::sqrt(std::max(0.0, scatter_m * scatter_m - known_noise_m * known_noise_m)) / top_m;
}

}  // namespace

double roughness(const Lattice& lattice, std::span<const Eigen::Vector3f> points, double noise_m) {
  std::vector<double> of_places;
  for (const std::vector<Eigen::Vector3f>& returns : returns_by_place(lattice, points)) {
    const double of_place = roughness_of(returns, noise_m);
    if (std::isfinite(of_place)) of_places.push_back(of_place);
  }
  return quantile(std::move(of_places), 0.5);
}

}  // namespace plotscan::plots
