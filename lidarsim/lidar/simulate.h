// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "core/progress.h"
#include "lidar/scene.h"
#include "lidar/sensor.h"
#include "lidar/shots.h"
#include "scan/point.h"

namespace plotscan::lidar {

struct SimulateOptions {
  double range_noise_m = 0.03;  // standard deviation
  std::uint64_t seed = 1;       // of the noise
  int threads = 1;
};

// Receives the returns piece by piece in the order of firing, from one thread at a time.
using PointSink = std::function<void(std::span<const scan::LabelledPoint>)>;

// Fires every shot of the plan at the scene and hands the returns on. Memory does not grow with the
// number of shots; the points are the same for any number of threads. Shots that meet nothing, or
// whose measured range is beyond the sensor's limits, leave no point.
void simulate(const Scene& scene, const SpinningLidar& sensor, const ShotPlan& plan,
              const SimulateOptions& options, const PointSink& sink,
              const ProgressReport& progress = {});

// A shot as the ray tracer takes it.
Ray ray_of(const SequenceShots& shots, std::size_t laser);

// The intensity of a return, a calibrated reflectivity as the VLP-16 reports it: percent of a
// diffuse white target's, from the class's reflectance near 903 nm and Lambert's cosine law.
float return_intensity(scan::PointClass label, float cos_incidence);

}  // namespace plotscan::lidar
