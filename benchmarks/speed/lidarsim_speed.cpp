// SPDX-License-Identifier: Apache-2.0
// Rays per second of the whole simulator (pose, ray, cast, noise, labels, file) as a ratio to a
// bare loop of rtcIntersect1 over the very same rays, both in one run. See README.md.
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include "comparison.h"
#include "core/angle.h"
#include "core/temporary_path.h"
#include "farm/farm.h"
#include "farmfolder/read_farm.h"
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
             Eigen::Isometry3d(Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitY())), trajectory) {
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

void simulate_to_file(const Work& work, int threads, const std::filesystem::path& file) {
  scan::PcdWriter cloud(file);
  lidar::simulate(work.scene, work.sensor, {.fired = work.plan, .placed = work.plan},
                  {.threads = threads},
                  [&](std::span<const scan::LabelledPoint> points) { cloud.write(points); });
  cloud.close();
}

void add_comparison(const Work& work, int threads, const std::filesystem::path& file) {
  const speed::Comparison comparison{
      .ours = [&work, threads, file] { simulate_to_file(work, threads, file); },
      .reference = [&work, threads] { cast_bare(work, threads); },
      .reference_name = "bare loop of Embree",
      .items = "rays",
      .count = static_cast<double>(work.rays.size()),
      .now_s = threads == 1 ? processor_time_s : speed::wall_s};
  const std::string name =
      "simulator, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
  speed::add_benchmark(name, comparison);
}

int run(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    std::cerr << "usage: lidarsim_speed FARM [FLIGHT] [--benchmark_...]\n";
    return 2;
  }
  const farm::Farm farm = farmfolder::read_farm(argv[1]);
  const Work work(farm, argc == 3 ? scan::read_trajectory(argv[2]) : middle_strip(farm));
  const TemporaryPath file(std::filesystem::temp_directory_path() /
                           ("lidarsim_speed-" + std::to_string(getpid()) + ".pcd"));
  for (const int threads : {1, 2}) add_comparison(work, threads, file.path());
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return plotscan::speed::run_program("lidarsim_speed", run, argc, argv);
}
