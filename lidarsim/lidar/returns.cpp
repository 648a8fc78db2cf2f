// SPDX-License-Identifier: Apache-2.0
#include "lidar/returns.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

#include "lidar/internal/rounded.h"

namespace plotscan::lidar {
namespace {

constexpr double kLight_m_s = 299'792'458;
// A Gaussian's full width at half maximum over its standard deviation: 2 sqrt(2 ln 2).
constexpr double kWidthOfSigma = 2.3548200450309493;
// The least range of a hit: nothing is nearer than the sensor's window.
constexpr double kNearest_m = 0.01;

double square(double value) { return value * value; }

// The returns that the mode reports: two in dual mode (fewer if there are not two), else one.
std::vector<Peak> reported(std::vector<Peak> strongest_first, ReturnMode mode) {
  std::vector<Peak>& peaks = strongest_first;
  if (peaks.size() < 2) return peaks;
  const auto last = std::ranges::max_element(peaks, {}, &Peak::range_m);
  if (mode == ReturnMode::strongest) return {peaks.front()};
  if (mode == ReturnMode::last) return {*last};
  std::vector<Peak> both = {peaks.front(), last == peaks.begin() ? peaks[1] : *last};
  std::ranges::sort(both, {}, &Peak::range_m);
  return both;
}

}  // namespace

float return_intensity(double reflectance, double cos_incidence) {
  return static_cast<float>(std::min(255.0, rounded(100 * reflectance * cos_incidence)));
}

Detector::Detector(const sensor::Beam& beam, ReturnMode mode)
    : mode_(mode),
      sigma_m_(0.5 * kLight_m_s * beam.pulse_s / kWidthOfSigma),
      threshold_(beam.faintest_reflectance / square(beam.faintest_range_m)),
      least_separation_m_(beam.least_separation_m) {}

std::span<const Return> Detector::detect(std::span<const Hit> hits) {
  returns_.clear();
  hits_.clear();
  std::ranges::copy_if(hits, std::back_inserter(hits_), [](const Hit& hit) {
    return std::isfinite(hit.range_m) && hit.reflectance * hit.cos_incidence > 0;
  });
  if (hits_.empty()) return returns_;
  const auto [nearest, farthest] = std::ranges::minmax(hits_, {}, &Hit::range_m);
  const double nearest_m = std::max<double>(kNearest_m, nearest.range_m);
  const double farthest_m = std::max<double>(kNearest_m, farthest.range_m);
  if (farthest_m - nearest_m <= kOnePeak * sigma_m_) {
    listen(hits.size());
    const Peak peak = only_peak(echoes_, nearest_m, farthest_m, sigma_m_);
    if (peak.power >= threshold_) returns_.push_back(return_of(peak));
    return returns_;
  }
  std::ranges::sort(hits_, {}, [](const Hit& hit) {
    return std::tuple(hit.range_m, hit.surface, hit.cos_incidence);
  });
  listen(hits.size());
  for (const Peak& peak : reported(detected_peaks(), mode_)) returns_.push_back(return_of(peak));
  return returns_;
}

// An echo's power is that of a sub-ray from a Lambertian surface. The unit is the whole beam's echo
// from a white surface that faces it 1 m away (the lidar equation: Wagner et al., ISPRS J. 60,
// 2006, for targets that no sub-ray overfills).
void Detector::listen(std::size_t sub_rays) {
  echoes_.clear();
  for (const Hit& hit : hits_) {
    const double range_m = std::max<double>(kNearest_m, hit.range_m);
    const double reflected = static_cast<double>(hit.reflectance) * hit.cos_incidence;
    echoes_.push_back({.range_m = range_m,
                       .power = reflected / (static_cast<double>(sub_rays) * square(range_m))});
  }
}

// The maxima above the threshold, the strongest first. Of two that are closer than the least
// separation only the stronger is kept.
std::vector<Peak> Detector::detected_peaks() const {
  std::vector<Peak> peaks = find_peaks(echoes_, sigma_m_);
  std::erase_if(peaks, [&](const Peak& peak) { return peak.power < threshold_; });
  std::ranges::stable_sort(peaks, std::greater(), &Peak::power);
  std::vector<Peak> apart;
  for (const Peak& peak : peaks) {
    if (std::ranges::none_of(apart, [&](const Peak& stronger) {
          return std::abs(stronger.range_m - peak.range_m) < least_separation_m_;
        }))
      apart.push_back(peak);
  }
  return apart;
}

// The sensor corrects all of a return's energy by the one range that it measured.
Return Detector::return_of(const Peak& peak) {
  double energy = 0;
  for (std::size_t i = peak.begin; i < peak.end; ++i) energy += echoes_[i].power;
  return {.range_m = peak.range_m,
          .intensity = return_intensity(energy * square(peak.range_m), 1),
          .hit = main_hit(peak)};
}

Hit Detector::main_hit(const Peak& peak) {
  const auto hits = std::span(hits_).subspan(peak.begin, peak.end - peak.begin);
  const auto is_of_first = [&](const Hit& hit) { return hit.surface == hits.front().surface; };
  if (std::ranges::all_of(hits, is_of_first)) {
    const auto echoes = std::span(echoes_).subspan(peak.begin, peak.end - peak.begin);
    const auto strongest = std::ranges::max_element(echoes, {}, &Echo::power) - echoes.begin();
    return hits[static_cast<std::size_t>(strongest)];
  }
  by_surface_.resize(peak.end - peak.begin);
  std::iota(by_surface_.begin(), by_surface_.end(), peak.begin);
  std::ranges::sort(by_surface_, {}, [&](std::size_t i) { return std::pair(hits_[i].surface, i); });
  std::size_t main = peak.begin;
  double most = 0;
  for (auto echo = by_surface_.begin(); echo != by_surface_.end();) {
    const std::uint32_t surface = hits_[*echo].surface;
    std::size_t strongest = *echo;
    double sum = 0;
    for (; echo != by_surface_.end() && hits_[*echo].surface == surface; ++echo) {
      sum += echoes_[*echo].power;
      if (echoes_[*echo].power > echoes_[strongest].power) strongest = *echo;
    }
    if (sum > most) main = strongest;
    most = std::max(most, sum);
  }
  return hits_[main];
}

}  // namespace plotscan::lidar
