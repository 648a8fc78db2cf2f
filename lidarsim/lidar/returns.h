// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lidar/scene.h"
#include "lidar/waveform.h"
#include "sensor/return_mode.h"
#include "sensor/sensor.h"

namespace plotscan::lidar {

using sensor::ReturnMode;

// A return as the sensor sees it, before noise and quantisation of its range.
struct Return {
  double range_m = 0;
  float intensity = 0;  // calibrated reflectivity, see return_intensity
  Hit hit;              // the strongest hit on the surface that gave most energy
};

// The intensity of a return, a calibrated reflectivity as the VLP-16 reports it: percent of what a
// diffuse white target that fills the beam returns, by Lambert's cosine law; a whole number in
// 0..255.
float return_intensity(double reflectance, double cos_incidence);

// Turns a beam's echoes into returns (docs/beam.md). Not thread-safe: each thread needs its own.
class Detector {
 public:
  Detector(const sensor::Beam& beam, ReturnMode mode);

  // The returns that the sensor reports for a shot whose sub-rays, all of equal energy, have these
  // hits: at most two, the nearest first. The span is valid until the next call.
  std::span<const Return> detect(std::span<const Hit> hits);

 private:
  // Makes echoes_ from hits_, for a shot of `sub_rays` sub-rays.
  void listen(std::size_t sub_rays);
  std::vector<Peak> detected_peaks() const;
  Return return_of(const Peak& peak);
  Hit main_hit(const Peak& peak);

  ReturnMode mode_;
  double sigma_m_;  // of the pulse, in range
  double threshold_;
  double least_separation_m_;
  std::vector<Hit> hits_;  // those that echo; sorted by range if there may be several maxima
  std::vector<Echo> echoes_;
  std::vector<std::size_t> by_surface_;  // the echoes of one return
  std::vector<Return> returns_;
};

}  // namespace plotscan::lidar
