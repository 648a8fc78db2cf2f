// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/progress.h"
#include "lidar/flight_part.h"
#include "lidar/returns.h"
#include "lidar/scene.h"
#include "scan/point.h"
#include "sensor/sensor.h"
#include "sensor/shots.h"

namespace plotscan::lidar {

struct SimulateOptions {
  double range_noise_m = 0.03;  // standard deviation
  std::uint64_t seed = 1;       // of the noise
  int threads = 1;
  // Rays that stand for a beam (docs/beam.md), 1 to kMaxSubRays. One is the beam's axis: the first
  // surface it meets, however faint, is the shot's only return.
  int sub_rays = 1;
  ReturnMode returns = ReturnMode::strongest;
  FlightPart part = {};  // whose shots are fired
};

// The same shots twice: as they truly were fired, which decides what they meet, and as the drone's
// reported poses and the sensor's stated mount have them, which decides where their points are put.
struct Shots {
  const sensor::ShotPlan& fired;
  const sensor::ShotPlan& placed;
};

// Fires every shot of the plan at the scene and hands the returns on. Memory does not grow with the
// number of shots; the points are the same for any number of threads, and those of all parts, one
// after the other, the whole flight's. Shots that meet nothing, and returns whose measured range is
// beyond the sensor's limits, leave no point. A shot's points follow each other, the nearest first.
// Several sub-rays need the sensor's beam.
void simulate(const Scene& scene, const sensor::Sensor& sensor, const Shots& shots,
              const SimulateOptions& options, const scan::PointSink& sink,
              const ProgressReport& progress = {});

// The firing sequences of the options' part of a flight with so many.
SequenceRange fired_sequences(std::uint64_t sequences, const SimulateOptions& options);

// A shot as the ray tracer takes it.
Ray ray_of(const sensor::SequenceShots& shots, std::size_t laser);

}  // namespace plotscan::lidar
