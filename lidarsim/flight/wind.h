// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace plotscan::flight {

// A steady wind with the gusts of the Dryden model at low altitude (MIL-F-8785C, 1980, 3.7.1.2 and
// 3.7.3.4; the same in MIL-HDBK-1797). As in the specification, gust intensities are shares of the
// wind speed: no wind, no gusts.
struct WindOptions {
  double mean_m_s = 0;    // horizontal, the same everywhere
  double from_deg = 270;  // where it blows from, clockwise from north (meteorological)
  // Standard deviation of the gusts along the wind, as a share of the mean. The specification's own
  // at 8 m is 0.19; 1 / ln(8 m / z0), its value in a neutral wind over fields of the roughness z0,
  // is 0.18 (grass, z0 3 cm) to 0.23 (crops, z0 10 cm).
  double turbulence = 0.2;
  double height_m = 8;  // above ground; sets the gusts' sizes; clamped to [3.05, 304.8]
  std::uint64_t seed = 1;
};

// Standard deviations and length scales of the gusts: along the wind, across it, up.
struct GustScales {
  Eigen::Vector3d sigma_m_s;
  Eigen::Vector3d length_m;
};

GustScales gust_scales(const WindOptions& options);

// The wind at any time of a flight. The same seed gives the same wind, whatever was asked before
// and however long the flight is. Gusts are frozen in the air that the mean wind carries past
// (Taylor's hypothesis) and much larger than the drone's surroundings, so that one series in time,
// sampled each kStep_s and linear between samples, is felt everywhere. Along the wind they are an
// Ornstein-Uhlenbeck process, of the autocorrelation sigma^2 exp(-t/T) with T = length / mean;
// across and up the second-order filter of the model, sigma^2 (1 - t/2T) exp(-t/T). Both are
// discretised exactly.
class Wind {
 public:
  static constexpr double kStep_s = 0.02;
  static constexpr double kLeadIn_s = 30;  // wind before the flight, so that what it moves settles

  // Makes the wind from -kLeadIn_s to duration_s; beyond, it keeps its first or last value.
  Wind(const WindOptions& options, double duration_s);

  // The velocity of the air (mean and gusts), world frame.
  Eigen::Vector3d velocity_m_s(double time_s) const;
  Eigen::Vector3d mean_m_s() const { return mean_m_s_; }

 private:
  Eigen::Vector3d mean_m_s_;
  std::vector<Eigen::Vector3d> gusts_m_s_;  // world frame, from -kLeadIn_s; empty without gusts
};

}  // namespace plotscan::flight
