// SPDX-License-Identifier: Apache-2.0
#include "lidar/waveform.h"

#include <algorithm>
#include <cmath>

namespace plotscan::lidar {
namespace {

// Lengths in standard deviations of the pulse. Beyond its reach a pulse adds nothing (exp(-18) =
// 1.5e-8 of its maximum), so echoes further apart are treated separately.
constexpr double kReach = 6;
constexpr double kStep = 0.125;
constexpr double kRangeTolerance_m = 1e-6;

// The received power at one range, and its derivatives, which lead to the extrema.
struct Sample {
  double power = 0;
  double slope = 0;  // of the power, times the pulse's variance
  double bend = 0;   // of the slope
};

struct Extremum {
  double range_m = 0;
  double power = 0;
};

class Waveform {
 public:
  // All echoes lie between the nearest and the farthest range. They must be sorted if these are
  // more than kReach sigmas apart.
  Waveform(std::span<const Echo> echoes, double nearest_m, double farthest_m, double sigma_m)
      : echoes_(echoes),
        sigma_m_(sigma_m),
        all_within_reach_(farthest_m - nearest_m <= kReach * sigma_m) {}

  // The waveform at a range between the nearest and the farthest.
  Sample at(double range_m) const {
    Sample sample;
    for (const Echo& echo : within_reach(range_m)) {
      const double away_m = echo.range_m - range_m;
      const double square = away_m * away_m / (sigma_m_ * sigma_m_);
      const double power = echo.power * std::exp(-0.5 * square);
      sample.power += power;
      sample.slope += power * away_m;
      sample.bend += power * (square - 1);
    }
    return sample;
  }

  // The maximum (or minimum) between two ranges at which the slopes have the signs for one.
  // Newton's method, from the echoes' mean range (or the middle); bisection keeps it within the
  // bracket.
  Extremum extremum(double near_m, double far_m, bool is_maximum) const {
    double range_m = is_maximum ? mean_range(near_m, far_m) : 0.5 * (near_m + far_m);
    Sample sample = at(range_m);
    while (far_m - near_m > kRangeTolerance_m) {
      ((sample.slope > 0) == is_maximum ? near_m : far_m) = range_m;
      const double next_m = range_m - sample.slope / sample.bend;
      const bool is_within = next_m > near_m && next_m < far_m;
      if (is_within && std::abs(next_m - range_m) < kRangeTolerance_m)
        return {.range_m = next_m, .power = sample.power};
      range_m = is_within ? next_m : 0.5 * (near_m + far_m);
      sample = at(range_m);
    }
    return {.range_m = range_m, .power = sample.power};
  }

 private:
  std::span<const Echo> within_reach(double range_m) const {
    if (all_within_reach_) return echoes_;
    const double reach_m = kReach * sigma_m_;
    const auto begin = std::ranges::lower_bound(echoes_, range_m - reach_m, {}, &Echo::range_m);
    const auto end = std::ranges::upper_bound(echoes_, range_m + reach_m, {}, &Echo::range_m);
    return {begin, end};
  }

  // The echoes' mean range, weighted by power, if it lies between the two ranges; else their
  // middle. It is the maximum when the echoes are much closer together than the pulse is long.
  double mean_range(double near_m, double far_m) const {
    double power = 0, moment = 0;
    for (const Echo& echo : echoes_) {
      power += echo.power;
      moment += echo.power * echo.range_m;
    }
    const double mean_m = moment / power;
    return mean_m > near_m && mean_m < far_m ? mean_m : 0.5 * (near_m + far_m);
  }

  std::span<const Echo> echoes_;
  double sigma_m_;
  bool all_within_reach_;
};

// Finds the maxima of the overlapping echoes [begin, end), and which echoes belong to which.
void find_in_group(std::span<const Echo> echoes, std::size_t begin, std::size_t end, double sigma_m,
                   std::vector<Peak>& peaks) {
  const auto group = echoes.subspan(begin, end - begin);
  const double first_m = group.front().range_m;
  const double last_m = group.back().range_m;
  const double length_m = last_m - first_m;
  if (length_m <= kOnePeak * sigma_m) {
    const Peak peak = only_peak(group, first_m, last_m, sigma_m);
    peaks.push_back({.range_m = peak.range_m, .power = peak.power, .begin = begin, .end = end});
    return;
  }
  const Waveform waveform(group, first_m, last_m, sigma_m);
  const int steps = static_cast<int>(std::ceil(length_m / (kStep * sigma_m)));
  // Before the first echo the power rises, after the last it falls.
  bool was_rising = true;
  double before_m = first_m;
  std::size_t peak_begin = begin;
  for (int i = 1; i <= steps; ++i) {
    const double here_m = i == steps ? last_m : first_m + i * length_m / steps;
    const bool rising = i < steps && waveform.at(here_m).slope > 0;
    if (was_rising && !rising) {
      const Extremum top = waveform.extremum(before_m, here_m, true);
      peaks.push_back(
          {.range_m = top.range_m, .power = top.power, .begin = peak_begin, .end = end});
    } else if (!was_rising && rising) {
      const double dip_m = waveform.extremum(before_m, here_m, false).range_m;
      const auto after = std::ranges::lower_bound(group, dip_m, {}, &Echo::range_m);
      peak_begin = begin + static_cast<std::size_t>(after - group.begin());
      peaks.back().end = peak_begin;
    }
    was_rising = rising;
    before_m = here_m;
  }
}

}  // namespace

Peak only_peak(std::span<const Echo> echoes, double nearest_m, double farthest_m, double sigma_m) {
  const Extremum top =
      Waveform(echoes, nearest_m, farthest_m, sigma_m).extremum(nearest_m, farthest_m, true);
  return {.range_m = top.range_m, .power = top.power, .begin = 0, .end = echoes.size()};
}

std::vector<Peak> find_peaks(std::span<const Echo> echoes, double sigma_m) {
  std::vector<Peak> peaks;
  for (std::size_t begin = 0; begin < echoes.size();) {
    std::size_t end = begin + 1;
    while (end < echoes.size() && echoes[end].range_m - echoes[end - 1].range_m <= kReach * sigma_m)
      ++end;
    find_in_group(echoes, begin, end, sigma_m, peaks);
    begin = end;
  }
  return peaks;
}

}  // namespace plotscan::lidar
