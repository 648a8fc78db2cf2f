// SPDX-License-Identifier: Apache-2.0
#include "heights/height_profile.h"

#include <algorithm>
#include <cmath>

#include "heights/internal/box_cells.h"

namespace plotscan::heights {
namespace {

constexpr double kBin_m = 0.005;
// Returns wanted in a weighting cell on average: with few, a cell's weight rests on chance.
constexpr double kReturnsPerCell = 30;
constexpr double kShortestCell_m = 0.05;
constexpr double kLongestCell_m = 0.5;

}  // namespace

double HeightProfile::quantile(double area_share) const {
  double below = 0;
  for (std::size_t bin = 0; bin < share.size(); ++bin) {
    if (share[bin] > 0 && below + share[bin] >= area_share) {
      const double within = std::clamp((area_share - below) / share[bin], 0.0, 1.0);
      return low_m + bin_m * (static_cast<double>(bin) + within);
    }
    below += share[bin];
  }
  return low_m + bin_m * static_cast<double>(share.size());
}

double HeightProfile::share_above(double height_m) const {
  const double position = (height_m - low_m) / bin_m;
  double above = 0;
  for (std::size_t bin = 0; bin < share.size(); ++bin) {
    above += share[bin] * std::clamp(static_cast<double>(bin) + 1 - position, 0.0, 1.0);
  }
  return above;
}

HeightProfile height_profile(const PlotBox& box, std::span<const Eigen::Vector3f> points,
                             double margin_m) {
  HeightProfile profile{.low_m = 0, .bin_m = kBin_m, .share = {}, .returns = points.size()};
  if (points.empty()) return profile;
  const double cell_m =
      std::clamp(std::sqrt(kReturnsPerCell * box.area_m2() / static_cast<double>(points.size())),
                 kShortestCell_m, kLongestCell_m);
  const BoxCells cells(box, cell_m);
  std::vector<std::uint32_t> returns(cells.count(), 0);
  for (const Eigen::Vector3f& point : points) ++returns[cells.index(point)];
  const auto seen = std::ranges::count_if(returns, [](std::uint32_t n) { return n > 0; });
  profile.seen_share = static_cast<double>(seen) / static_cast<double>(cells.count());

  const auto height = [](const Eigen::Vector3f& point) { return point.z(); };
  const float low = height(*std::ranges::min_element(points, {}, height));
  const float high = height(*std::ranges::max_element(points, {}, height));
  profile.low_m = kBin_m * std::floor((low - margin_m) / kBin_m);
  const auto bins = static_cast<std::size_t>((high + margin_m - profile.low_m) / kBin_m) + 1;
  profile.share.assign(bins, 0);
  for (const Eigen::Vector3f& point : points) {
    const auto bin = static_cast<std::size_t>((point.z() - profile.low_m) / kBin_m);
    profile.share[std::min(bin, bins - 1)] +=
        1.0 / (static_cast<double>(returns[cells.index(point)]) * static_cast<double>(seen));
  }
  return profile;
}

}  // namespace plotscan::heights
