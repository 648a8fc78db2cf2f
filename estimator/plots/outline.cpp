// SPDX-License-Identifier: Apache-2.0
#include "plots/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace plotscan::plots {
namespace {

struct Profile {
  std::vector<double> x_m, depth;  // from the plots' centre; optical depth of the pooled cover
};

Profile pooled_profile(const Lattice& lattice, bool along_r, double reach_m) {
  const double cell_m = lattice.view.cell_m();
  const int bins = static_cast<int>(reach_m / cell_m);
  std::vector<double> cover(static_cast<std::size_t>(2 * bins + 1)), count(cover);
  const double other_half_m = (along_r ? lattice.c_size_m : lattice.r_size_m) * 0.4;
  for (const Place& place : lattice.places) {
    const double center = (along_r ? place.r_m : place.c_m) / cell_m;
    const double other = along_r ? place.c_m : place.r_m;
    const int low = static_cast<int>(std::lround((other - other_half_m) / cell_m));
    const int high = static_cast<int>(std::lround((other + other_half_m) / cell_m));
    for (int bin = -bins; bin <= bins; ++bin) {
      // Cell i has its middle at i + 1/2.
      const int cell = static_cast<int>(std::lround(center + bin - 0.5));
      const auto& view = lattice.view;
      const double seen = along_r ? view.seen_cells(cell, cell + 1, low, high)
                                  : view.seen_cells(low, high, cell, cell + 1);
      if (seen == 0) continue;
      const auto at = static_cast<std::size_t>(bin + bins);
      cover[at] += along_r ? view.cover(cell, cell + 1, low, high) : view.cover(low, high, cell, cell + 1);
      count[at] += 1;
    }
  }
  Profile profile;
  for (int bin = -bins; bin <= bins; ++bin) {
    const auto at = static_cast<std::size_t>(bin + bins);
    if (count[at] == 0) continue;
    profile.x_m.push_back(bin * cell_m);
    profile.depth.push_back(-std::log(1 - std::min(0.98, cover[at] / count[at])));
  }
  return profile;
}

double blurred_box(double x, double size, double blur) {
  const double scale = 1 / (blur * std::sqrt(2.0));
  return 0.5 * (std::erf((x + size / 2) * scale) - std::erf((x - size / 2) * scale));
}

// Share of the plots that have a neighbour one pitch further.
double neighbour_share(const Lattice& lattice, bool along_r) {
  double with = 0;
  for (const Place& place : lattice.places) {
    with += std::ranges::any_of(lattice.places, [&](const Place& other) {
      const double step = along_r ? other.r_m - place.r_m : other.c_m - place.c_m;
      const double aside = along_r ? other.c_m - place.c_m : other.r_m - place.r_m;
      const double pitch = along_r ? lattice.r_pitch_m : lattice.c_pitch_m;
      return std::abs(step - pitch) < 0.2 * pitch &&
             std::abs(aside) < 0.5 * (along_r ? lattice.c_size_m : lattice.r_size_m);
    });
  }
  return with / std::max<double>(1, static_cast<double>(lattice.places.size()));
}

struct Model {
  double squares = std::numeric_limits<double>::infinity();
  double depth = 0;
};

// Squares about depth * box + level, level at least 0.
Model squares_of(const Profile& profile, double size, double blur, double pitch, double share) {
  double n = 0, g = 0, gg = 0, y = 0, gy = 0, yy = 0;
  for (std::size_t i = 0; i < profile.x_m.size(); ++i) {
    const double x = profile.x_m[i];
    double box = blurred_box(x, size, blur);
    if (pitch > 0) {
      box += share * (blurred_box(x - pitch, size, blur) + blurred_box(x + pitch, size, blur));
    }
    n += 1;
    g += box;
    gg += box * box;
    y += profile.depth[i];
    gy += box * profile.depth[i];
    yy += profile.depth[i] * profile.depth[i];
  }
  const double spread = gg - g * g / n;
  if (spread <= 0) return {};
  double depth = (gy - g * y / n) / spread;
  double level = (y - depth * g) / n;
  if (level < 0) {
    level = 0;
    depth = gy / gg;
  }
  const double squares = yy - 2 * depth * gy - 2 * level * y + depth * depth * gg +
                         2 * depth * level * g + n * level * level;
  return {squares, depth};
}

}  // namespace

EdgeFit fit_edges(const Lattice& lattice, bool along_r) {
  const double size_m = along_r ? lattice.r_size_m : lattice.c_size_m;
  const double pitch_m = along_r ? lattice.r_pitch_m : lattice.c_pitch_m;
  const double gap_m = pitch_m > 0 ? std::max(0.1, pitch_m - size_m) : 1.0;
  const Profile profile = pooled_profile(lattice, along_r, size_m / 2 + std::clamp(gap_m / 2, 0.2, 0.5));
  const double share = pitch_m > 0 ? neighbour_share(lattice, along_r) : 0;
  EdgeFit best{.size_m = size_m};
  double best_squares = std::numeric_limits<double>::infinity();
  for (double size = size_m - 0.35; size <= size_m + 0.35; size += 0.01) {
    if (size < 0.2) continue;
    for (double blur = 0.03; blur <= 0.25; blur += 0.02) {
      const Model model = squares_of(profile, size, blur, pitch_m, share);
      if (!(model.squares < best_squares)) continue;
      best_squares = model.squares;
      best = {.size_m = size, .blur_m = blur,
              .rms = std::sqrt(std::max(0.0, model.squares) / static_cast<double>(profile.x_m.size())) /
                     std::max(1e-6, model.depth)};
    }
  }
  return best;
}

}  // namespace plotscan::plots
