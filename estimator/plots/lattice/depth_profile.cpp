// SPDX-License-Identifier: Apache-2.0
#include "plots/lattice/depth_profile.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plotscan::plots {
namespace {

constexpr double kMostCover = 0.98;  // deeper is not measured
constexpr double kMiddle = 0.8;      // of the other side: the rest is blurred by its own edges

double depth_of(double cover) { return -std::log(1 - std::min(kMostCover, cover)); }

// Cells across the plot's other side.
Band strip_of(const Lattice& lattice, const Place& place) {
  const double half_m = 0.5 * kMiddle * lattice.c.size_m;
  const double cell_m = lattice.view.cell_m();
  return {static_cast<int>(std::lround((place.c_m - half_m) / cell_m)),
          static_cast<int>(std::lround((place.c_m + half_m) / cell_m))};
}

double cover_at(const Lattice& lattice, int cell, const Band& strip) {
  return lattice.view.cover(cell, cell + 1, strip.begin, strip.end);
}

bool seen_at(const Lattice& lattice, int cell, const Band& strip) {
  return lattice.view.seen_cells(cell, cell + 1, strip.begin, strip.end) > 0;
}

// Normal distribution function at multiples of 1/100 within 4.
constexpr int kTableSteps = 400;
const std::array<double, 2 * kTableSteps + 2>& normal_table() {
  static const auto table = [] {
    std::array<double, 2 * kTableSteps + 2> values{};
    for (int i = 0; i < 2 * kTableSteps + 2; ++i) {
      values[static_cast<std::size_t>(i)] =
          0.5 * std::erfc(-(i - kTableSteps) / 100.0 / std::sqrt(2.0));
    }
    return values;
  }();
  return table;
}

}  // namespace

DepthProfile profile_of(const Lattice& lattice, const Place& place, double reach_m) {
  const double cell_m = lattice.view.cell_m();
  const Band strip = strip_of(lattice, place);
  DepthProfile profile;
  const int last = static_cast<int>(std::floor((place.r_m + reach_m) / cell_m));
  for (int cell = static_cast<int>(std::floor((place.r_m - reach_m) / cell_m)); cell <= last;
       ++cell) {
    if (!seen_at(lattice, cell, strip)) continue;
    profile.x_m.push_back((cell + 0.5) * cell_m - place.r_m);
    profile.depth.push_back(depth_of(cover_at(lattice, cell, strip)));
  }
  return profile;
}

DepthProfile pooled_profile(const Lattice& lattice, double reach_m) {
  const double cell_m = lattice.view.cell_m();
  const auto bins = static_cast<std::ptrdiff_t>(reach_m / cell_m);
  std::vector<double> cover(static_cast<std::size_t>(2 * bins + 1)), count(cover);
  for (const Place& place : lattice.places) {
    const double center = place.r_m / cell_m;
    const Band strip = strip_of(lattice, place);
    for (std::ptrdiff_t bin = -bins; bin <= bins; ++bin) {
      // A cell's middle is at + 1/2.
      const int cell = static_cast<int>(std::lround(center + static_cast<double>(bin) - 0.5));
      if (!seen_at(lattice, cell, strip)) continue;
      cover[static_cast<std::size_t>(bin + bins)] += cover_at(lattice, cell, strip);
      count[static_cast<std::size_t>(bin + bins)] += 1;
    }
  }
  DepthProfile profile;
  for (std::ptrdiff_t bin = -bins; bin <= bins; ++bin) {
    const auto at = static_cast<std::size_t>(bin + bins);
    if (count[at] == 0) continue;
    profile.x_m.push_back(static_cast<double>(bin) * cell_m);
    profile.depth.push_back(depth_of(cover[at] / count[at]));
  }
  return profile;
}

Neighbours neighbours_of(const Lattice& lattice) {
  const double pitch_m = lattice.r.pitch_m;
  if (!(pitch_m > 0)) return {};
  double with = 0;
  for (const Place& place : lattice.places) {
    with += std::ranges::any_of(lattice.places, [&](const Place& other) {
      return std::abs(other.r_m - place.r_m - pitch_m) < 0.2 * pitch_m &&
             std::abs(other.c_m - place.c_m) < 0.5 * lattice.c.size_m;
    });
  }
  return {pitch_m, with / std::max<double>(1, static_cast<double>(lattice.places.size()))};
}

DepthProfile profile_with_gaps(const Lattice& lattice) {
  const double size_m = lattice.r.size_m, pitch_m = lattice.r.pitch_m;
  const double gap_m = pitch_m > 0 ? std::max(0.1, pitch_m - size_m) : 1.0;
  return pooled_profile(lattice, size_m / 2 + std::clamp(gap_m / 2, 0.2, 0.5));
}

double plateau_depth(const DepthProfile& profile, double size_m) {
  const double half_m = std::max(size_m / 4, size_m / 2 - 0.35);
  double transmitted = 0, count = 0;
  for (std::size_t i = 0; i < profile.x_m.size(); ++i) {
    if (std::abs(profile.x_m[i]) > half_m) continue;
    transmitted += std::exp(-profile.depth[i]);
    count += 1;
  }
  return count > 0 ? -std::log(transmitted / count) : 0;
}

std::vector<double> steps_between(double low, double high, double step) {
  std::vector<double> values;
  while (low <= high) {
    values.push_back(low);
    low += step;
  }
  return values;
}

BlurredBox::BlurredBox(double size_m, double blur_m) : half_m_(size_m / 2), per_m_(100 / blur_m) {}

double BlurredBox::edge(double x_m) const {
  const double at = std::clamp(x_m * per_m_ + kTableSteps, 0.0, 2.0 * kTableSteps);
  const auto low = static_cast<std::size_t>(at);
  const double part = at - static_cast<double>(low);
  const auto& table = normal_table();
  return table[low] * (1 - part) + table[low + 1] * part;
}

}  // namespace plotscan::plots
