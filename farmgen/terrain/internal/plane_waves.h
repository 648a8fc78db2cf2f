// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "terrain/internal/lattice.h"
#include "terrain/terrain_description.h"

namespace plotscan::terrain {

// Random surfaces with a known spectrum: sums of plane waves of random directions and phases (the
// spectral representation: Shinozuka and Jan, Digital simulation of random processes, 1972). The
// waves have equal amplitudes, so that the surface's variance is exactly the one asked for; their
// wave numbers are spread evenly over the spectrum's distribution.

// Heights amplitude_m * cos(wave_number . point + phase).
struct PlaneWave {
  Eigen::Vector2d wave_number;  // radians a metre
  double phase_rad = 0;
  double amplitude_m = 0;
};

// Waves with standard deviation rms_m and wavelengths only in [shortest_m, longest_m], with equal
// variance in each octave.
std::vector<PlaneWave> rolling_waves(const RollingDescription& rolling, std::uint64_t seed);

// Standard deviation height_m (the random roughness of soil: Allmaras et al., Total porosity and
// random roughness of the interrow zone, 1966) and correlation exp(-(r / size_m)^2), except that
// waves shorter than shortest_clod_wave_m, 1.8 % of the variance, are left out, since vertices
// cannot be close enough for them.
std::vector<PlaneWave> clod_waves(const ClodsDescription& clods, std::uint64_t seed);
double shortest_clod_wave_m(const ClodsDescription& clods);

// The sum of the waves at a point.
double wave_height(const std::vector<PlaneWave>& waves, const Eigen::Vector2d& point);

// The same at every point of a lattice, rows x columns: a wave is a product of a row's and a
// column's part, the sum a product of two matrices.
Eigen::MatrixXd wave_heights(const std::vector<PlaneWave>& waves, const Lattice& lattice);

}  // namespace plotscan::terrain
