// SPDX-License-Identifier: Apache-2.0
#include "heights/known_returns.h"

#include <algorithm>
#include <cmath>

#include "core/list_of.h"
#include "core/statistics.h"
#include "heights/internal/box_cells.h"

namespace plotscan::heights {
namespace {

// A place of a plot: the 5 % and 95 % quantiles of its returns' heights.
struct Place {
  double low_m = kNaN;
  double high_m = kNaN;
};

std::vector<double> ground_errors(std::span<const Eigen::Vector3f> points,
                                  const ground::Surface& surface) {
  return list_of(points, [&](const Eigen::Vector3f& point) {
    return surface.standard_error(point.head<2>().cast<double>());
  });
}

// The largest standard error with which the ground counts as known, metres.
double largest_known_error(std::vector<double> errors_m) {
  constexpr double kKnown_m = 0.05;
  constexpr double kTimesMedian = 1.5;  // so at least half of the plot is kept
  std::erase_if(errors_m, [](double error_m) { return std::isnan(error_m); });
  if (errors_m.empty()) return kKnown_m;
  return std::max(kKnown_m, kTimesMedian * quantile(std::move(errors_m), 0.5));
}

std::vector<Place> places_of(const BoxCells& cells, std::span<const Eigen::Vector3f> points) {
  constexpr std::size_t kLeastReturns = 5;
  constexpr double kTail = 0.05;
  std::vector<std::vector<double>> heights_m(cells.count());
  for (const Eigen::Vector3f& point : points) heights_m[cells.index(point)].push_back(point.z());
  std::vector<Place> places(cells.count());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (heights_m[i].size() < kLeastReturns) continue;
    places[i].low_m = quantile(heights_m[i], kTail);
    places[i].high_m = quantile(std::move(heights_m[i]), 1 - kTail);
  }
  return places;
}

// Values above this stand out from the others: median + 2.5 sigma, with sigma taken from the values
// below the median, where there is no ridge.
double highest_usual(std::vector<double> values_m) {
  constexpr double kSigmas = 2.5;
  constexpr double kLeastSigma_m = 0.02;
  constexpr double kOneSigmaBelow = 0.16;
  const double middle_m = quantile(values_m, 0.5);
  const double sigma_m = middle_m - quantile(std::move(values_m), kOneSigmaBelow);
  return middle_m + kSigmas * std::max(kLeastSigma_m, sigma_m);
}

// The places whose highest returns stand out from the plot's, if the lowest returns stand out as
// well: their own, or those of a neighbour that is on a ridge.
std::vector<bool> on_ridge(const BoxCells& cells, std::span<const Place> places) {
  constexpr std::size_t kLeastPlaces = 12;
  std::vector<double> lows_m;
  std::vector<double> highs_m;
  for (const Place& place : places) {
    if (std::isnan(place.low_m)) continue;
    lows_m.push_back(place.low_m);
    highs_m.push_back(place.high_m);
  }
  std::vector<bool> ridge(places.size(), false);
  if (lows_m.size() < kLeastPlaces) return ridge;
  const double usual_low_m = highest_usual(std::move(lows_m));
  const double usual_high_m = highest_usual(std::move(highs_m));
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!(places[i].low_m > usual_low_m && places[i].high_m > usual_high_m)) continue;
    for (const std::size_t near : cells.around(i))
      if (places[near].high_m > usual_high_m) ridge[near] = true;
  }
  return ridge;
}

std::vector<Eigen::Vector3f> without_ridges(const PlotBox& box,
                                            std::vector<Eigen::Vector3f> points) {
  constexpr double kPlace_m = 0.3;
  constexpr double kMostShare = 0.25;  // of the plot; more is a part that is taller, not a ridge
  const BoxCells cells(box, kPlace_m);
  const std::vector<bool> ridge = on_ridge(cells, places_of(cells, points));
  const auto places = static_cast<double>(std::ranges::count(ridge, true));
  if (places > kMostShare * static_cast<double>(ridge.size())) return points;
  std::erase_if(points, [&](const Eigen::Vector3f& point) { return ridge[cells.index(point)]; });
  return points;
}

}  // namespace

KnownReturns known_returns(const PlotBox& box, std::span<const Eigen::Vector3f> points,
                           const ground::Surface& surface) {
  const std::vector<double> errors_m = ground_errors(points, surface);
  const double largest_m = largest_known_error(errors_m);
  std::vector<Eigen::Vector3f> known;
  known.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!(errors_m[i] > largest_m)) known.push_back(points[i]);
  return {.points = without_ridges(box, std::move(known)),
          .ground = ground_under(box, surface, largest_m)};
}

}  // namespace plotscan::heights
