// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lidar/scene.h"
#include "lidar/waveform.h"
#include "sensor/return_mode.h"
#include "sensor/sensor.h"

namespace plotscan::lidar {

using sensor::ReturnMode;

// A return as the sensor sees it, before its range is noisy and quantised.
struct Return {
  double range_m = 0;
  float intensity = 0;  // calibrated reflectivity, see return_intensity
  Hit hit;              // the strongest on the surface that gave most of its energy
};

// The intensity of a return, a calibrated reflectivity as the VLP-16 reports it: percent of a
// diffuse white target that fills the beam, by Lambert's cosine law; a whole number in 0..255.
float return_intensity(double reflectance, double cos_incidence);

// Makes returns of a beam's echoes (docs/beam.md). Holds its workspace: one for each thread.
class Detector {
 public:
  Detector(const sensor::Beam& beam, ReturnMode mode);

  // The returns that the sensor reports of a shot whose sub-rays, of equal energy, met `hits`: at
  // most two, the nearest first. Valid until the next call.
  std::span<const Return> detect(std::span<const Hit> hits);

 private:
  // Makes the echoes of hits_, of a shot of so many sub-rays.
  void listen(std::size_t sub_rays);
  std::vector<Peak> detected_peaks() const;
  Return return_of(const Peak& peak);
  Hit main_hit(const Peak& peak);

  ReturnMode mode_;
  double sigma_m_;  // of the pulse, in range
  double threshold_;
  double least_separation_m_;
  std::vector<Hit> hits_;  // those that echo; by range where they have more than one maximum
  std::vector<Echo> echoes_;
  std::vector<std::size_t> by_surface_;  // the echoes of one return
  std::vector<Return> returns_;
};

}  // namespace plotscan::lidar
