// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/progress.h"
#include "lidar/scene.h"
#include "scan/point.h"
#include "sensor/sensor.h"
#include "sensor/shots.h"

namespace plotscan::lidar {

struct SimulateOptions {
  double range_noise_m = 0.03;  // standard deviation
  std::uint64_t seed = 1;       // of the noise
  int threads = 1;
};

// The same shots twice: as they truly were fired, which decides what they meet, and as the drone's
// reported poses and the sensor's stated mount have them, which decides where their points are put.
struct Shots {
  const sensor::ShotPlan& fired;
  const sensor::ShotPlan& placed;
};

// Fires every shot of the plan at the scene and hands the returns on. Memory does not grow with the
// number of shots; the points are the same for any number of threads. Shots that meet nothing, or
// whose measured range is beyond the sensor's limits, leave no point.
void simulate(const Scene& scene, const sensor::Sensor& sensor, const Shots& shots,
              const SimulateOptions& options, const scan::PointSink& sink,
              const ProgressReport& progress = {});

// A shot as the ray tracer takes it.
Ray ray_of(const sensor::SequenceShots& shots, std::size_t laser);

// The intensity of a return, a calibrated reflectivity as the VLP-16 reports it: percent of a
// diffuse white target's, by Lambert's cosine law.
float return_intensity(float reflectance, float cos_incidence);

}  // namespace plotscan::lidar
