// SPDX-License-Identifier: Apache-2.0
#include "terrain/internal/plane_waves.h"

#include <cmath>

#include "core/angle.h"
#include "core/random.h"

namespace plotscan::terrain {
namespace {

// Enough that heights are normally distributed and no pattern repeats.
constexpr int kWaves = 256;
constexpr double kTurn = 2 * kPi;
// Clods: the greatest product of wave number and size.
constexpr double kFinestClods = 4;

// `wave_number_at` is the inverse of the wave numbers' cumulative distribution.
template <class Quantile>
std::vector<PlaneWave> random_waves(double rms_m, std::uint64_t seed, std::uint32_t purpose,
                                    Quantile wave_number_at) {
  std::vector<PlaneWave> waves;
  waves.reserve(kWaves);
  for (int i = 0; i < kWaves; ++i) {
    RandomStream random(seed, purpose, static_cast<std::uint64_t>(i));
    const double wave_number = wave_number_at((i + random.uniform()) / kWaves);
    const double direction = random.uniform(0, kTurn);
    waves.push_back(
        {.wave_number = wave_number * Eigen::Vector2d(std::cos(direction), std::sin(direction)),
         .phase_rad = random.uniform(0, kTurn),
         .amplitude_m = rms_m * std::sqrt(2.0 / kWaves)});
  }
  return waves;
}

}  // namespace

std::vector<PlaneWave> rolling_waves(const RollingDescription& rolling, std::uint64_t seed) {
  return random_waves(rolling.rms_m, seed, random_purpose("terrain/rolling"), [&](double share) {
    return kTurn / rolling.longest_m * std::pow(rolling.longest_m / rolling.shortest_m, share);
  });
}

std::vector<PlaneWave> clod_waves(const ClodsDescription& clods, std::uint64_t seed) {
  // The spectrum of exp(-(r / l)^2) makes (k l)^2 / 4 exponentially distributed.
  const double covered = 1 - std::exp(-kFinestClods * kFinestClods / 4);
  return random_waves(clods.height_m, seed, random_purpose("terrain/clods"), [&](double share) {
    return 2 * std::sqrt(-std::log(1 - covered * share)) / clods.size_m;
  });
}

double shortest_clod_wave_m(const ClodsDescription& clods) {
  return kTurn * clods.size_m / kFinestClods;
}

double wave_height(const std::vector<PlaneWave>& waves, const Eigen::Vector2d& point) {
  double height_m = 0;
  for (const PlaneWave& wave : waves)
    height_m += wave.amplitude_m * std::cos(wave.wave_number.dot(point) + wave.phase_rad);
  return height_m;
}

Eigen::MatrixXd wave_heights(const std::vector<PlaneWave>& waves, const Lattice& lattice) {
  const auto count = static_cast<Eigen::Index>(waves.size());
  // cos(a + b) = cos(a) cos(b) - sin(a) sin(b), a of the row and b of the column.
  Eigen::MatrixXd of_rows(lattice.rows, 2 * count);
  Eigen::MatrixXd of_columns(2 * count, lattice.columns);
  for (Eigen::Index i = 0; i < count; ++i) {
    const PlaneWave& wave = waves[static_cast<std::size_t>(i)];
    for (Eigen::Index row = 0; row < lattice.rows; ++row) {
      const double angle = wave.wave_number.dot(lattice.row_start(row)) + wave.phase_rad;
      of_rows(row, i) = wave.amplitude_m * std::cos(angle);
      of_rows(row, count + i) = -wave.amplitude_m * std::sin(angle);
    }
    const double step = wave.wave_number.dot(lattice.along);
    for (Eigen::Index column = 0; column < lattice.columns; ++column) {
      of_columns(i, column) = std::cos(step * static_cast<double>(column));
      of_columns(count + i, column) = std::sin(step * static_cast<double>(column));
    }
  }
  return of_rows * of_columns;
}

}  // namespace plotscan::terrain
