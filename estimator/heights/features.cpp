// SPDX-License-Identifier: Apache-2.0
#include "heights/features.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/csv.h"
#include "heights/box_cells.h"
#include "heights/deconvolve.h"

namespace plotscan::heights {
namespace {

// Shares of the area, whose heights are compared with the top.
constexpr std::array kAreaShares = {0.5, 0.75, 0.9, 0.95, 0.98, 0.995, 0.999};
// Shares of the top, over which the area is measured.
constexpr std::array kHeightShares = {0.15, 0.3, 0.5, 0.6, 0.7, 0.8, 0.9};
// Cells whose highest returns are compared, metres.
constexpr std::array kCells_m = {0.1, 0.2, 0.4};
// Of a cell's returns, what stands for its top.
constexpr double kCellTop = 0.9;
constexpr double kLeastTop_m = 0.02;

struct Tops {
  double mean = 0;
  double sd = 0;
  double peaks_m2 = 0;  // cells higher than their neighbours, per area
  double peak_mean = 0;
  double peak_sd = 0;
};

// The height of the top of each cell; NaN in cells with fewer than 4 returns.
std::vector<double> cell_tops(const BoxCells& cells, std::span<const Eigen::Vector3f> points) {
  std::vector<std::vector<float>> heights(cells.count());
  for (const Eigen::Vector3f& point : points) heights[cells.index(point)].push_back(point.z());
  constexpr std::size_t kLeast = 4;
  std::vector<double> tops(cells.count(), NAN);
  for (std::size_t i = 0; i < tops.size(); ++i) {
    if (heights[i].size() < kLeast) continue;
    const auto rank =
        static_cast<std::ptrdiff_t>(kCellTop * static_cast<double>(heights[i].size() - 1));
    std::nth_element(heights[i].begin(), heights[i].begin() + rank, heights[i].end());
    tops[i] = heights[i][static_cast<std::size_t>(rank)];
  }
  return tops;
}

bool is_peak(const BoxCells& cells, const std::vector<double>& tops, int i, int j) {
  const auto at = [&](int a, int b) {
    return tops[static_cast<std::size_t>(a) * static_cast<std::size_t>(cells.across()) +
                static_cast<std::size_t>(b)];
  };
  for (int a = std::max(0, i - 1); a <= std::min(cells.along() - 1, i + 1); ++a) {
    for (int b = std::max(0, j - 1); b <= std::min(cells.across() - 1, j + 1); ++b) {
      if ((a != i || b != j) && at(a, b) >= at(i, j)) return false;
    }
  }
  return !std::isnan(at(i, j));
}

std::pair<double, double> mean_and_sd(const std::vector<double>& values) {
  if (values.empty()) return {0, 0};
  double sum = 0;
  for (const double value : values) sum += value;
  const double mean = sum / static_cast<double>(values.size());
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / static_cast<double>(values.size()))};
}

Tops tops_of(const PlotBox& box, std::span<const Eigen::Vector3f> points, double cell_m,
             double top_m) {
  const BoxCells cells(box, cell_m);
  const std::vector<double> tops = cell_tops(cells, points);
  std::vector<double> canopy;
  std::vector<double> peaks;
  for (int i = 0; i < cells.along(); ++i) {
    for (int j = 0; j < cells.across(); ++j) {
      const double top =
          tops[static_cast<std::size_t>(i) * static_cast<std::size_t>(cells.across()) +
               static_cast<std::size_t>(j)] /
          top_m;
      if (!(top > 0.3)) continue;
      canopy.push_back(top);
      if (is_peak(cells, tops, i, j)) peaks.push_back(top);
    }
  }
  const auto [mean, sd] = mean_and_sd(canopy);
  const auto [peak_mean, peak_sd] = mean_and_sd(peaks);
  return {.mean = mean,
          .sd = sd,
          .peaks_m2 = static_cast<double>(peaks.size()) / box.area_m2(),
          .peak_mean = peak_mean,
          .peak_sd = peak_sd};
}

std::vector<std::string> make_names() {
  std::vector<std::string> names;
  for (const double share : kAreaShares) names.push_back("q" + format_number(100 * share));
  for (const double share : kHeightShares) names.push_back("above" + format_number(100 * share));
  for (const double cell_m : kCells_m) {
    const std::string cell = format_number(100 * cell_m);
    for (const char* what : {"mean", "sd", "peaks", "peak_mean", "peak_sd"})
      names.push_back("tops" + cell + "_" + what);
  }
  for (const char* name : {"noise", "slope", "density"}) names.emplace_back(name);
  return names;
}

}  // namespace

const std::vector<std::string>& feature_names() {
  static const std::vector<std::string> names = make_names();
  return names;
}

HeightProfile without_noise(HeightProfile profile, double noise_m) {
  profile.share = deconvolve(profile.share, noise_m / profile.bin_m);
  return profile;
}

CanopyFeatures canopy_features(const PlotBox& box, std::span<const Eigen::Vector3f> points,
                               const HeightProfile& profile, double noise_m, double slope) {
  const double top_m = std::max(kLeastTop_m, profile.quantile(0.99));
  std::vector<double> values;
  for (const double share : kAreaShares) values.push_back(profile.quantile(share) / top_m);
  for (const double share : kHeightShares) values.push_back(profile.share_above(share * top_m));
  for (const double cell_m : kCells_m) {
    const Tops tops = tops_of(box, points, cell_m, top_m);
    for (const double value : {tops.mean, tops.sd, tops.peaks_m2, tops.peak_mean, tops.peak_sd})
      values.push_back(value);
  }
  values.push_back(noise_m / top_m);
  values.push_back(slope);
  values.push_back(std::log(static_cast<double>(points.size()) / box.area_m2()));
  return {.top_m = top_m,
          .values = Eigen::Map<const Eigen::VectorXd>(values.data(),
                                                      static_cast<Eigen::Index>(values.size()))};
}

}  // namespace plotscan::heights
