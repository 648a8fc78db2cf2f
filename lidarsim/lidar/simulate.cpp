// SPDX-License-Identifier: Apache-2.0
#include "lidar/simulate.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "core/error.h"
#include "lidar/internal/beam.h"
#include "lidar/internal/range_noise.h"
#include "lidar/internal/rounded.h"

namespace plotscan::lidar {
namespace {

// Firing sequences per task: about a millisecond of ray casting, unless there are very many
// sub-rays. A laser's sub-rays in a batch, some hundred, fill Embree's packets.
std::uint64_t batch_sequences(int sub_rays) {
  return static_cast<std::uint64_t>(sub_rays == 1 ? 64 : std::max(1, 160 / sub_rays));
}

// Batches in flight per thread: some milliseconds of work, so that a thread that waits for the disk
// or a processor does not stop the others. At most 50 kB each.
constexpr std::size_t kBatchesPerThread = 32;
// Hits are looked for this many standard deviations beyond the sensor's range: noise may bring them
// back into it.
constexpr double kNoiseReach = 6;

struct Batch {
  std::uint64_t end_sequence = 0;
  std::vector<scan::LabelledPoint> points;
};

class Simulator {
 public:
  Simulator(const Scene& scene, const sensor::Sensor& sensor, const Shots& shots,
            const SimulateOptions& options, std::uint64_t end_sequence)
      : scene_(scene),
        sensor_(sensor),
        shots_(shots),
        options_(options),
        end_sequence_(end_sequence) {
    if (options.sub_rays == 1) return;
    check(sensor.beam.has_value(), "the sensor's file states a beam");
    sub_rays_.emplace(*sensor.beam, options.sub_rays);
  }

  Batch run(std::uint64_t begin) const {
    const std::uint64_t end = std::min(begin + batch_sequences(options_.sub_rays), end_sequence_);
    std::vector<Ray> axes = fire(shots_.fired, begin, end);
    const std::vector<Hit> hits = sub_rays_ ? cast_beams(begin, axes) : cast(axes);
    if (&shots_.placed != &shots_.fired) axes = fire(shots_.placed, begin, end);
    return {.end_sequence = end,
            .points = sub_rays_ ? measure_beams(begin, axes, hits) : measure(begin, axes, hits)};
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

  float reach_m() const {
    return static_cast<float>(sensor_.max_range_m + kNoiseReach * options_.range_noise_m);
  }

  // Laser by laser: where plants stand close, a laser's next ray meets nearly the same ones, which
  // are then still in the processor's cache.
  std::vector<Hit> cast(const std::vector<Ray>& axes) const {
    const std::size_t lasers = shots_.fired.lasers();
    std::vector<Ray> by_laser;
    by_laser.reserve(axes.size());
    for (std::size_t laser = 0; laser < lasers; ++laser)
      for (std::size_t i = laser; i < axes.size(); i += lasers) by_laser.push_back(axes[i]);
    std::vector<Hit> met(axes.size());
    scene_.cast(by_laser, reach_m(), met);
    std::vector<Hit> hits(axes.size());
    auto next = met.begin();
    for (std::size_t laser = 0; laser < lasers; ++laser)
      for (std::size_t i = laser; i < axes.size(); i += lasers) hits[i] = *next++;
    return hits;
  }

  // Hits of the sub-rays, grouped by laser, then shot by shot: a laser turns by only about a beam's
  // width between shots, so that such a bundle lies close together.
  std::vector<Hit> cast_beams(std::uint64_t begin_sequence, const std::vector<Ray>& axes) const {
    RayArrays rays(axes.size() * sub_rays_->count());
    const std::size_t lasers = shots_.fired.lasers();
    Eigen::Vector3f spin_axis;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const std::uint64_t sequence = begin_sequence + i / lasers;
      if (i % lasers == 0) spin_axis = shots_.fired.spin_axis(sequence).cast<float>();
      sub_rays_->spread(axes[i], spin_axis, sequence * lasers + i % lasers, rays,
                        first_sub_ray(i, axes.size()));
    }
    std::vector<Hit> hits(rays.size());
    scene_.cast_bundles(rays, rays.size() / lasers, reach_m(), hits);
    return hits;
  }

  // The index of the i-th axis' first sub-ray among all of a batch.
  std::size_t first_sub_ray(std::size_t i, std::size_t axes) const {
    const std::size_t lasers = shots_.fired.lasers();
    const std::size_t sequences = axes / lasers;
    return (i % lasers * sequences + i / lasers) * sub_rays_->count();
  }

  // The points of the axes' hits, placed along the axes.
  std::vector<scan::LabelledPoint> measure(std::uint64_t begin_sequence,
                                           const std::vector<Ray>& axes,
                                           const std::vector<Hit>& hits) const {
    RangeNoise noise(options_.seed, options_.range_noise_m);
    std::vector<scan::LabelledPoint> points;
    points.reserve(static_cast<std::size_t>(std::count_if(
        hits.begin(), hits.end(), [](const Hit& hit) { return std::isfinite(hit.range_m); })));
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const Hit& hit = hits[i];
      if (!std::isfinite(hit.range_m)) continue;
      const std::uint64_t shot = begin_sequence * shots_.fired.lasers() + i;
      add_point(shot, axes[i],
                {.range_m = hit.range_m,
                 .intensity = return_intensity(hit.reflectance, hit.cos_incidence),
                 .hit = hit},
                noise.of_shot(shot), points);
    }
    return points;
  }

  // The same for `hits` of all sub-rays of the axes.
  std::vector<scan::LabelledPoint> measure_beams(std::uint64_t begin_sequence,
                                                 const std::vector<Ray>& axes,
                                                 const std::vector<Hit>& hits) const {
    RangeNoise noise(options_.seed, options_.range_noise_m);
    Detector detector(*sensor_.beam, options_.returns);
    std::vector<scan::LabelledPoint> points;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const std::uint64_t shot = begin_sequence * shots_.fired.lasers() + i;
      const auto returns = detector.detect(
          std::span(hits).subspan(first_sub_ray(i, axes.size()), sub_rays_->count()));
      const std::size_t first = points.size();
      for (std::size_t k = 0; k < returns.size(); ++k) {
        add_point(shot, axes[i], returns[k],
                  k == 0 ? noise.of_shot(shot) : noise.of_second_return(shot), points);
      }
      number_returns(axes[i].origin_m, std::span(points).subspan(first));
    }
    return points;
  }

  // Orders and numbers a shot's returns from the nearest: noise may have put the farther one
  // nearer.
  static void number_returns(const Eigen::Vector3f& origin_m,
                             std::span<scan::LabelledPoint> returns) {
    const auto square_range = [&](const scan::LabelledPoint& point) {
      return (Eigen::Vector3f(point.x, point.y, point.z) - origin_m).squaredNorm();
    };
    if (returns.size() > 1) std::ranges::stable_sort(returns, {}, square_range);
    for (std::size_t k = 0; k < returns.size(); ++k) {
      returns[k].return_number = static_cast<std::uint8_t>(1 + k);
      returns[k].return_count = static_cast<std::uint8_t>(returns.size());
    }
  }

  void add_point(std::uint64_t shot, const Ray& axis, const Return& seen, double noise_m,
                 std::vector<scan::LabelledPoint>& points) const {
    const double range = measured_range(seen.range_m + noise_m);
    if (range <= 0 || range < sensor_.min_range_m || range > sensor_.max_range_m) return;
    const std::uint64_t sequence = shot / shots_.fired.lasers();
    const std::size_t laser = shot % shots_.fired.lasers();
    const Eigen::Vector3f position = axis.origin_m + static_cast<float>(range) * axis.direction;
    const Surface& surface = scene_.surface(seen.hit);
    points.push_back({.x = position.x(),
                      .y = position.y(),
                      .z = position.z(),
                      .intensity = seen.intensity,
                      .ring = sensor_.lasers[laser].ring,
                      .time = shots_.fired.time_s(sequence, laser),
                      .label = surface.label,
                      .plot = surface.plot,
                      .plant = surface.plant});
  }

  // The range that the sensor reports, quantised; 0, which is no return, if noise puts it behind
  // the sensor.
  double measured_range(double range_m) const {
    if (range_m <= 0) return 0;
    if (sensor_.range_step_m == 0) return range_m;
    return sensor_.range_step_m * rounded(range_m / sensor_.range_step_m);
  }

  const Scene& scene_;
  const sensor::Sensor& sensor_;
  const Shots& shots_;
  const SimulateOptions& options_;
  std::uint64_t end_sequence_;  // end of the range that is fired
  std::optional<SubRays> sub_rays_;
};

}  // namespace

// Parts begin at batches of the whole flight, since a batch's rays are cast together.
SequenceRange fired_sequences(std::uint64_t sequences, const SimulateOptions& options) {
  return sequences_of(options.part, sequences, batch_sequences(options.sub_rays));
}

Ray ray_of(const sensor::SequenceShots& shots, std::size_t laser) {
  const auto k = static_cast<Eigen::Index>(laser);
  const auto vector = [k](const std::array<sensor::PerLaser, 3>& v) -> Eigen::Vector3f {
    return Eigen::Vector3d(v[0][k], v[1][k], v[2][k]).cast<float>();
  };
  return {vector(shots.origin_m), vector(shots.direction)};
}

void simulate(const Scene& scene, const sensor::Sensor& sensor, const Shots& shots,
              const SimulateOptions& options, const scan::PointSink& sink,
              const ProgressReport& progress) {
  const SequenceRange fired = fired_sequences(shots.fired.sequences(), options);
  const Simulator simulator(scene, sensor, shots, options, fired.end);
  if (progress) progress(0);  // the time left counts from here, not from the scene's loading
  std::uint64_t next_sequence = fired.begin;
  const auto take = [&](tbb::flow_control& control) {
    const std::uint64_t begin = next_sequence;
    if (begin >= fired.end) control.stop();
    next_sequence += batch_sequences(options.sub_rays);
    return begin;
  };
  const auto run = [&](std::uint64_t begin) { return simulator.run(begin); };
  const auto hand_on = [&](const Batch& batch) {
    sink(batch.points);
    if (progress)
      progress(static_cast<double>(batch.end_sequence - fired.begin) /
               static_cast<double>(fired.end - fired.begin));
  };
  // oneTBB uses at most the number of processors unless asked for more. Asking for fewer here would
  // also limit other work of the process.
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
