// SPDX-License-Identifier: Apache-2.0
// Rays per second of the whole simulator (pose, ray, cast, noise, labels, file) as a ratio to a
// bare loop of rtcIntersect1 over the very same rays, both in one run. See README.md.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>
#include <vector>

#include "farmfolder/read_farm.h"
#include <benchmark/benchmark.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include "core/error.h"
#include "farm/farm.h"
#include "flight/route.h"
#include "lidar/embree.h"
#include "lidar/flight_plan.h"
#include "lidar/scene.h"
#include "lidar/simulate.h"
#include "scan/cloud_writer.h"
#include "scan/trajectory.h"
#include "sensor/sensor.h"
#include "sensor/shots.h"

namespace {

using namespace plotscan;

constexpr double kSpin_hz = 10;

// One strip over the middle of the plots.
scan::Trajectory middle_strip(const farm::Farm& farm) {
  const lidar::Scene scene(lidar::scene_content(farm));
  const auto waypoints =
      lidar::plan_strips(lidar::site_of(farm), scene, {.altitude_m = 8, .spacing_m = 1000});
  const flight::Quadrotor quadrotor;
  return flight::fly_exactly(quadrotor,
                             flight::Route(quadrotor, flight::waypoints_at(waypoints), 2.0));
}

struct Work {
  Work(const farm::Farm& farm, const scan::Trajectory& trajectory)
      : sensor(sensor::load_sensor("vlp16")),
        scene(lidar::scene_content(farm)),
        plan(sensor, kSpin_hz,
             Eigen::Isometry3d(Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitY())),
             trajectory) {
    sensor::SequenceShots shots;
    for (std::uint64_t sequence = 0; sequence < plan.sequences(); ++sequence) {
      plan.fire(sequence, shots);
      for (std::size_t k = 0; k < plan.lasers(); ++k) rays.push_back(lidar::ray_of(shots, k));
    }
  }

  sensor::Sensor sensor;
  lidar::Scene scene;
  sensor::ShotPlan plan;
  std::vector<lidar::Ray> rays;
};

// Set before the benchmarks run, which take no arguments of their own.
const Work* work_at_hand = nullptr;

template <class Action>
double seconds(Action&& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void cast_bare(const Work& work, int threads) {
  auto* const scene = static_cast<RTCScene>(work.scene.native());
  const auto cast = [&](const tbb::blocked_range<std::size_t>& range) {
    RTCRayHit query;
    query.ray.time = 0;
    query.ray.mask = ~0u;
    query.ray.flags = 0;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const lidar::Ray& ray = work.rays[i];
      query.ray.org_x = ray.origin_m.x();
      query.ray.org_y = ray.origin_m.y();
      query.ray.org_z = ray.origin_m.z();
      query.ray.tnear = 0;
      query.ray.dir_x = ray.direction.x();
      query.ray.dir_y = ray.direction.y();
      query.ray.dir_z = ray.direction.z();
      query.ray.tfar = static_cast<float>(work.sensor.max_range_m);
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      lidar::intersect(scene, query);
    }
  };
  tbb::task_arena arena(threads);
  arena.execute(
      [&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(0, work.rays.size(), 1024), cast); });
}

std::uint64_t simulate_to_file(const Work& work, int threads, const std::filesystem::path& file) {
  scan::PcdWriter cloud(file);
  lidar::simulate(work.scene, work.sensor, {.fired = work.plan, .placed = work.plan},
                  {.threads = threads},
                  [&](std::span<const scan::LabelledPoint> points) { cloud.write(points); });
  cloud.close();
  return cloud.points();
}

// Both alternate, so that whatever else the machine does slows both.
void simulator_and_bare_loop(benchmark::State& state) {
  const Work& work = *work_at_hand;
  const int threads = static_cast<int>(state.range(0));
  const auto file = std::filesystem::temp_directory_path() /
                    ("lidarsim_speed-" + std::to_string(getpid()) + ".pcd");
  double bare_s = 0;
  double simulator_s = 0;
  std::uint64_t points = 0;
  for (auto _ : state) {  // NOLINT(clang-analyzer-deadcode.DeadStores): the library's idiom
    bare_s += seconds([&] { cast_bare(work, threads); });
    const double run_s = seconds([&] { points = simulate_to_file(work, threads, file); });
    simulator_s += run_s;
    state.SetIterationTime(run_s);
  }
  std::filesystem::remove(file);
  const double rays = static_cast<double>(work.rays.size() * state.iterations());
  state.counters["rays"] = static_cast<double>(work.rays.size());
  state.counters["points"] = static_cast<double>(points);
  state.counters["bare_rays/s"] = rays / bare_s;
  state.counters["simulator_rays/s"] = rays / simulator_s;
  state.counters["ratio"] = bare_s / simulator_s;
}

BENCHMARK(simulator_and_bare_loop)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 2 && argc != 3) {
    std::cerr << "usage: lidarsim_speed FARM [FLIGHT] [--benchmark_...]\n";
    return 2;
  }
  const farm::Farm farm = farmfolder::read_farm(argv[1]);
  const Work work(farm, argc == 3 ? scan::read_trajectory(argv[2]) : middle_strip(farm));
  work_at_hand = &work;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "lidarsim_speed: " << error.what() << '\n';
    return 1;
  }
}
