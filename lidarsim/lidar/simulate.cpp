// SPDX-License-Identifier: Apache-2.0
#include "lidar/simulate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "core/error.h"
#include "core/random.h"

namespace plotscan::lidar {
namespace {

// Firing sequences that one task takes: a fraction of a millisecond of casting.
constexpr std::uint64_t kBatchSequences = 64;
// Batches under way for each thread: work for some milliseconds, so that one thread that waits for
// the disk or a processor does not stop the others. At most 50 kB each.
constexpr std::size_t kBatchesPerThread = 32;
// Hits are looked for this many standard deviations beyond the sensor's range: noise may bring them
// back into it.
constexpr double kNoiseReach = 6;

struct Batch {
  std::uint64_t end_sequence = 0;
  std::vector<scan::LabelledPoint> points;
};

// Gaussian range noise that belongs to the shot, not to the order of asking. Neighbouring shots
// share a draw of two independent numbers.
class RangeNoise {
 public:
  RangeNoise(std::uint64_t seed, double sigma_m) : seed_(seed), sigma_m_(sigma_m) {}

  double of_shot(std::uint64_t shot) {
    if (sigma_m_ == 0) return 0;
    if (shot / 2 != pair_) {
      pair_ = shot / 2;
      normals_ = RandomStream(seed_, random_purpose("range noise"), pair_).normal_pair();
    }
    return sigma_m_ * (shot % 2 == 0 ? normals_.first : normals_.second);
  }

 private:
  std::uint64_t seed_;
  double sigma_m_;
  std::uint64_t pair_ = std::numeric_limits<std::uint64_t>::max();
  std::pair<double, double> normals_;
};

// The nearest whole number to a value that is not negative; std::nearbyint is a library call.
double rounded(double value) {
  return static_cast<double>(
      static_cast<std::int64_t>(value + 0.5));  // NOLINT(bugprone-incorrect-roundings)
}

class Simulator {
 public:
  Simulator(const Scene& scene, const sensor::Sensor& sensor, const Shots& shots,
            const SimulateOptions& options)
      : scene_(scene), sensor_(sensor), shots_(shots), options_(options) {}

  Batch run(std::uint64_t begin_sequence) const {
    const std::uint64_t end = std::min(begin_sequence + kBatchSequences, shots_.fired.sequences());
    std::vector<Ray> rays = fire(shots_.fired, begin_sequence, end);
    std::vector<Hit> hits(rays.size());
    const double reach_m = sensor_.max_range_m + kNoiseReach * options_.range_noise_m;
    scene_.cast(rays, static_cast<float>(reach_m), hits);
    if (&shots_.placed != &shots_.fired) rays = fire(shots_.placed, begin_sequence, end);
    return {.end_sequence = end, .points = measure(begin_sequence, rays, hits)};
  }

 private:
  static std::vector<Ray> fire(const sensor::ShotPlan& plan, std::uint64_t begin,
                               std::uint64_t end) {
    std::vector<Ray> rays;
    rays.reserve((end - begin) * plan.lasers());
    sensor::SequenceShots shots;
    for (std::uint64_t sequence = begin; sequence < end; ++sequence) {
      plan.fire(sequence, shots);
      for (std::size_t k = 0; k < plan.lasers(); ++k) {
        rays.push_back(ray_of(shots, k));
        rays.back().time_s = plan.time_s(sequence, k);
      }
    }
    return rays;
  }

  // The rays say where the points are put.
  std::vector<scan::LabelledPoint> measure(std::uint64_t begin_sequence,
                                           const std::vector<Ray>& rays,
                                           const std::vector<Hit>& hits) const {
    RangeNoise noise(options_.seed, options_.range_noise_m);
    std::vector<scan::LabelledPoint> points;
    points.reserve(static_cast<std::size_t>(std::count_if(
        hits.begin(), hits.end(), [](const Hit& hit) { return std::isfinite(hit.range_m); })));
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const Hit& hit = hits[i];
      if (!std::isfinite(hit.range_m)) continue;
      const std::uint64_t sequence = begin_sequence + i / shots_.fired.lasers();
      const std::size_t laser = i % shots_.fired.lasers();
      const double range =
          measured_range(hit.range_m + noise.of_shot(sequence * shots_.fired.lasers() + laser));
      if (range < sensor_.min_range_m || range > sensor_.max_range_m) continue;
      const Eigen::Vector3f position =
          rays[i].origin_m + static_cast<float>(range) * rays[i].direction;
      const Surface& surface = scene_.surface(hit);
      points.push_back({.x = position.x(),
                        .y = position.y(),
                        .z = position.z(),
                        .intensity = return_intensity(hit.reflectance, hit.cos_incidence),
                        .ring = sensor_.lasers[laser].ring,
                        .time = shots_.fired.time_s(sequence, laser),
                        .label = surface.label,
                        .plot = surface.plot,
                        .plant = surface.plant});
    }
    return points;
  }

  // What the sensor reports for a range; 0 where noise takes it behind the sensor.
  double measured_range(double range_m) const {
    if (range_m <= 0) return 0;
    if (sensor_.range_step_m == 0) return range_m;
    return sensor_.range_step_m * rounded(range_m / sensor_.range_step_m);
  }

  const Scene& scene_;
  const sensor::Sensor& sensor_;
  const Shots& shots_;
  const SimulateOptions& options_;
};

}  // namespace

Ray ray_of(const sensor::SequenceShots& shots, std::size_t laser) {
  const auto k = static_cast<Eigen::Index>(laser);
  const auto vector = [k](const std::array<sensor::PerLaser, 3>& v) -> Eigen::Vector3f {
    return Eigen::Vector3d(v[0][k], v[1][k], v[2][k]).cast<float>();
  };
  return {vector(shots.origin_m), vector(shots.direction)};
}

float return_intensity(float reflectance, float cos_incidence) {
  return static_cast<float>(rounded(100.0 * reflectance * cos_incidence));
}

void simulate(const Scene& scene, const sensor::Sensor& sensor, const Shots& shots,
              const SimulateOptions& options, const scan::PointSink& sink,
              const ProgressReport& progress) {
  const Simulator simulator(scene, sensor, shots, options);
  const std::uint64_t sequences = shots.fired.sequences();
  std::uint64_t next_sequence = 0;
  const auto take = [&](tbb::flow_control& control) {
    const std::uint64_t begin = next_sequence;
    if (begin >= sequences) control.stop();
    next_sequence += kBatchSequences;
    return begin;
  };
  const auto run = [&](std::uint64_t begin) { return simulator.run(begin); };
  const auto hand_on = [&](const Batch& batch) {
    sink(batch.points);
    if (progress)
      progress(static_cast<double>(batch.end_sequence) / static_cast<double>(sequences));
  };
  // oneTBB keeps to the number of processors unless it is asked for more; asking for less here
  // would bind other work of the process too.
  std::optional<tbb::global_control> more_threads;
  if (options.threads > tbb::info::default_concurrency()) {
    more_threads.emplace(tbb::global_control::max_allowed_parallelism,
                         static_cast<std::size_t>(options.threads));
  }
  tbb::task_arena arena(options.threads);
  arena.execute([&] {
    tbb::parallel_pipeline(
        kBatchesPerThread * static_cast<std::size_t>(options.threads),
        tbb::make_filter<void, std::uint64_t>(tbb::filter_mode::serial_in_order, take) &
            tbb::make_filter<std::uint64_t, Batch>(tbb::filter_mode::parallel, run) &
            tbb::make_filter<Batch, void>(tbb::filter_mode::serial_in_order, hand_on));
  });
}

}  // namespace plotscan::lidar
