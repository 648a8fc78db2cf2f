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
  // Rays that stand for a beam (docs/beam.md), 1 to kMaxSubRays. One means the beam's axis alone:
  // the first surface it hits, however faint, gives the shot's only return.
  int sub_rays = 1;
  ReturnMode returns = ReturnMode::strongest;
  FlightPart part = {};  // the part of the flight whose shots are fired
};

// The same shots twice. `fired`: as they truly were, which decides what they hit. `placed`: by the
// drone's reported poses and the sensor's stated mount, which decides where their points are put.
struct Shots {
  const sensor::ShotPlan& fired;
  const sensor::ShotPlan& placed;
};

// Fires every shot of the part at the scene and passes the returns to `sink` as points. Memory does
// not grow with the number of shots. The points do not depend on the number of threads, and those
// of all parts, in order, equal those of the whole flight. Shots that meet nothing, and returns
// whose measured range is beyond the sensor's limits, leave no point. A shot's points follow each
// other, the nearest first. More than one sub-ray needs a sensor whose file states a beam.
void simulate(const Scene& scene, const sensor::Sensor& sensor, const Shots& shots,
              const SimulateOptions& options, const scan::PointSink& sink,
              const ProgressReport& progress = {});

// The firing sequences of options.part in a flight that has `sequences` of them.
SequenceRange fired_sequences(std::uint64_t sequences, const SimulateOptions& options);

// A shot as a ray for the ray tracer; its time_s stays 0.
Ray ray_of(const sensor::SequenceShots& shots, std::size_t laser);

}  // namespace plotscan::lidar
