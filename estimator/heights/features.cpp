// SPDX-License-Identifier: Apache-2.0
#include "heights/features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include "core/csv.h"
#include "heights/internal/box_cells.h"
#include "heights/internal/deconvolve.h"
#include "heights/internal/semivariogram.h"

namespace plotscan::heights {
namespace {

// Shares of the area, whose heights are compared with the top.
constexpr std::array kAreaShares = {0.3,  0.5,   0.65, 0.75,  0.85,  0.9,  0.93,
                                    0.95, 0.965, 0.98, 0.995, 0.998, 0.999};
// Shares of the top, over which the area is measured.
constexpr std::array kHeightShares = {0.08, 0.15, 0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 1.05};
// Cells whose highest returns are compared, metres.
constexpr std::array kCells_m = {0.1, 0.2, 0.4};
// A cell's top is the highest of this many returns drawn from the cell, averaged over all such
// draws, so that it does not rise with the density of returns.
constexpr int kDrawn = 4;
constexpr double kLeastTop_m = 0.02;
// Cells this high over the ground, as a share of the top, are canopy.
constexpr double kCanopyShare = 0.3;
constexpr double kStrip_m = 0.05;

// What the cells of one width show, over the top.
struct Tops {
  double mean = 0;
  double sd = 0;
  double peaks_m2 = 0;  // cells higher than their neighbours, per area
  double peak_mean = 0;
  double peak_sd = 0;
  double peak_high = 0;  // the highest
  double peak_five = 0;  // mean of the five highest
  double depth = 0;      // mean distance from a cell's top to its returns' mean
};

struct CellHeights {
  std::vector<double> top;   // NaN in cells with fewer than kDrawn returns
  std::vector<double> mean;  // of the returns
};

// `descending` are the returns from the highest to the lowest. The i-th of n in a cell from below
// is the highest of m drawn with probability C(i - 1, m - 1) / C(n, m).
CellHeights cell_heights(const BoxCells& cells, std::span<const Eigen::Vector3f> descending,
                         int drawn) {
  std::vector<std::uint32_t> counts(cells.count(), 0);
  std::vector<std::uint32_t> index(descending.size());
  CellHeights heights{.top = std::vector<double>(cells.count(), 0),
                      .mean = std::vector<double>(cells.count(), 0)};
  for (std::size_t k = 0; k < descending.size(); ++k) {
    index[k] = static_cast<std::uint32_t>(cells.index(descending[k]));
    ++counts[index[k]];
    heights.mean[index[k]] += descending[k].z();
  }
  std::vector<double> weight(cells.count(), 0);
  std::vector<std::uint32_t> below(counts);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    heights.mean[i] /= std::max(1U, counts[i]);
    weight[i] = static_cast<double>(drawn) / std::max(1U, counts[i]);
    if (counts[i] < static_cast<std::uint32_t>(drawn)) heights.top[i] = NAN;
  }
  for (std::size_t k = 0; k < descending.size(); ++k) {
    const std::uint32_t i = index[k];
    if (std::isnan(heights.top[i]) || below[i] < static_cast<std::uint32_t>(drawn)) continue;
    heights.top[i] += weight[i] * descending[k].z();
    if (below[i] > 1) weight[i] *= static_cast<double>(below[i] - drawn) / (below[i] - 1);
    --below[i];
  }
  return heights;
}

bool is_peak(const BoxCells& cells, const std::vector<double>& tops, std::size_t cell) {
  return !std::isnan(tops[cell]) && std::ranges::none_of(cells.around(cell), [&](std::size_t near) {
    return near != cell && tops[near] >= tops[cell];
  });
}

std::pair<double, double> mean_and_sd(std::span<const double> values) {
  if (values.empty()) return {0, 0};
  double sum = 0;
  for (const double value : values) sum += value;
  const double mean = sum / static_cast<double>(values.size());
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / static_cast<double>(values.size()))};
}

Tops tops_of(const BoxCells& cells, std::span<const Eigen::Vector3f> descending, double top_m,
             double area_m2) {
  const CellHeights heights = cell_heights(cells, descending, kDrawn);
  std::vector<double> canopy;
  std::vector<double> depths;
  std::vector<double> peaks;
  for (std::size_t cell = 0; cell < cells.count(); ++cell) {
    const double top = heights.top[cell] / top_m;
    if (!(top > kCanopyShare)) continue;
    canopy.push_back(top);
    depths.push_back(top - heights.mean[cell] / top_m);
    if (is_peak(cells, heights.top, cell)) peaks.push_back(top);
  }
  std::ranges::sort(peaks, std::greater());
  const auto [mean, sd] = mean_and_sd(canopy);
  const auto [peak_mean, peak_sd] = mean_and_sd(peaks);
  const auto five = std::span(peaks).first(std::min<std::size_t>(5, peaks.size()));
  return {.mean = mean,
          .sd = sd,
          .peaks_m2 = static_cast<double>(peaks.size()) / area_m2,
          .peak_mean = peak_mean,
          .peak_sd = peak_sd,
          .peak_high = peaks.empty() ? 0 : peaks.front(),
          .peak_five = mean_and_sd(five).first,
          .depth = mean_and_sd(depths).first};
}

// Spread over strips of the share of returns above half of the top: rows show in strips along them.
double strip_sd(const PlotBox& box, std::span<const Eigen::Vector3f> points, double top_m,
                bool across) {
  const double side_m = across ? box.width_m : box.length_m;
  const auto count = static_cast<std::size_t>(std::max(2L, std::lround(side_m / kStrip_m)));
  const Eigen::Vector2d axis = across ? box.width_axis() : box.length_axis();
  std::vector<double> high(count, 0);
  std::vector<double> all(count, 0);
  for (const Eigen::Vector3f& point : points) {
    const double place = (point.head<2>().cast<double>() - box.center).dot(axis) / side_m + 0.5;
    const auto strip =
        static_cast<std::size_t>(std::clamp(place, 0.0, 1 - 1e-9) * static_cast<double>(count));
    all[strip] += 1;
    high[strip] += point.z() > 0.5 * top_m ? 1 : 0;
  }
  std::vector<double> shares;
  for (std::size_t i = 0; i < count; ++i)
    if (all[i] > 0) shares.push_back(high[i] / all[i]);
  return mean_and_sd(shares).second;
}

std::vector<std::string> make_names() {
  std::vector<std::string> names;
  names.reserve(kAreaShares.size() + kHeightShares.size());
  for (const double share : kAreaShares) names.push_back("q" + format_number(100 * share));
  for (const double share : kHeightShares) names.push_back("above" + format_number(100 * share));
  for (const double cell_m : kCells_m) {
    const std::string cell = format_number(100 * cell_m);
    for (const char* what :
         {"mean", "sd", "peaks", "peak_mean", "peak_sd", "peak_high", "peak_five", "depth"})
      names.push_back("tops" + cell + "_" + what);
  }
  for (const char* name :
       {"rows", "along", "highest", "noise", "slope", "slope2", "density", "height"})
    names.emplace_back(name);
  for (std::string& name : semivariance_names()) names.push_back(std::move(name));
  return names;
}

CanopyFeatures canopy_features(const PlotBox& box, std::span<const Eigen::Vector3f> points,
                               const HeightProfile& profile, double noise_m, double slope) {
  const double area_m2 = profile.seen_share * box.area_m2();
  const double top_m = std::max(kLeastTop_m, profile.quantile(0.99));
  std::vector<Eigen::Vector3f> descending(points.begin(), points.end());
  std::ranges::sort(descending, std::greater(), [](const auto& point) { return point.z(); });
  std::vector<double> values;
  values.reserve(feature_names().size());
  for (const double share : kAreaShares) values.push_back(profile.quantile(share) / top_m);
  for (const double share : kHeightShares) values.push_back(profile.share_above(share * top_m));
  for (const double cell_m : kCells_m) {
    const Tops tops = tops_of(BoxCells(box, cell_m), descending, top_m, area_m2);
    for (const double value : {tops.mean, tops.sd, tops.peaks_m2, tops.peak_mean, tops.peak_sd,
                               tops.peak_high, tops.peak_five, tops.depth})
      values.push_back(value);
  }
  values.push_back(strip_sd(box, points, top_m, true));
  values.push_back(strip_sd(box, points, top_m, false));
  values.push_back(descending[std::min<std::size_t>(2, descending.size() - 1)].z() / top_m);
  values.push_back(noise_m / top_m);
  values.push_back(slope);
  values.push_back(slope * slope);
  values.push_back(std::log(static_cast<double>(points.size()) / area_m2));
  values.push_back(std::log(top_m));
  for (const double value : relative_semivariances(box, descending, top_m, noise_m))
    values.push_back(value);
  return {.top_m = top_m,
          .values = Eigen::Map<const Eigen::VectorXd>(values.data(),
                                                      static_cast<Eigen::Index>(values.size()))};
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

SeenCanopy see_canopy(const PlotBox& box, std::span<const Eigen::Vector3f> points, double noise_m,
                      double slope) {
  constexpr double kMarginSigmas = 5;  // room for noise beyond the lowest and the highest return
  const HeightProfile profile =
      without_noise(height_profile(box, points, kMarginSigmas * noise_m), noise_m);
  return {.profile = profile, .features = canopy_features(box, points, profile, noise_m, slope)};
}

}  // namespace plotscan::heights
