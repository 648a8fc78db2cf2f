// SPDX-License-Identifier: Apache-2.0
// ground_error [--each] (FARM SCAN)...: the error of the ground under the plots of simulated farms,
// by method, against the true terrain (docs/ground.md).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "cloud/cloud_map.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "farmfolder/plot_table.h"
#include "farmfolder/terrain_ply.h"
#include "ground_methods.h"

namespace {

using namespace plotscan;

// Error of one plot's ground: its mean, the mean of its square.
struct PlotError {
  double mean_m = 0;
  double square_m2 = 0;
};

PlotError error_of(const ground_error::PlotGround& ground, const PlotBox& box,
                   const terrain::Terrain& terrain, const Eigen::Vector3d& origin) {
  constexpr double kStep_m = 0.05;
  PlotError error;
  int count = 0;
  for (double a = 0.5 * (kStep_m - box.length_m); a < 0.5 * box.length_m; a += kStep_m) {
    for (double b = 0.5 * (kStep_m - box.width_m); b < 0.5 * box.width_m; b += kStep_m) {
      const Eigen::Vector2d place = box.center + a * box.length_axis() + b * box.width_axis();
      const Eigen::Vector2d world = place + origin.head<2>();
      const std::optional<double> truth_m = terrain.height(world.x(), world.y());
      if (!truth_m) throw InputError("a plot lies beside the terrain");
      const double off = ground.height(place) + origin.z() - *truth_m;
      error.mean_m += off;
      error.square_m2 += off * off;
      ++count;
    }
  }
  return {.mean_m = error.mean_m / count, .square_m2 = error.square_m2 / count};
}

// Sums over the plots of all farms, by method.
struct Score {
  int plots = 0, without = 0, inside = 0, over_1cm = 0;
  double sum_m = 0, squares_m2 = 0, point_squares_m2 = 0, worst_m = 0, seconds = 0;

  void add(const PlotError& error, double standard_error_m) {
    if (!std::isfinite(error.mean_m)) {
      ++without;
      return;
    }
    ++plots;
    sum_m += error.mean_m;
    squares_m2 += error.mean_m * error.mean_m;
    point_squares_m2 += error.square_m2;
    worst_m = std::max(worst_m, std::abs(error.mean_m));
    over_1cm += std::abs(error.mean_m) > 0.01;
    inside += std::abs(error.mean_m) < 1.96 * standard_error_m;
  }
};

void measure(const std::filesystem::path& farm, const std::filesystem::path& scan, bool each,
             std::map<std::string, Score>& scores) {
  const cloud::CloudMap map = cloud::read_map(scan / "cloud.pcd", {});
  const terrain::Terrain terrain = farmfolder::read_terrain(farm / "truth/terrain.ply");
  std::vector<PlotBox> boxes;
  for (const farm::Plot& plot : farmfolder::read_plots(farm / "truth/plots.geojson")) {
    boxes.push_back(plot.box);
    boxes.back().center -= map.origin().head<2>();
  }
  for (const ground_error::Method& method : ground_error::methods(2)) {
    const Stopwatch watch;
    const std::vector<ground_error::PlotGround> grounds = method.ground(map.points(), boxes);
    Score& score = scores[method.name];
    score.seconds += watch.seconds();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const PlotError error = error_of(grounds[i], boxes[i], terrain, map.origin());
      score.add(error, grounds[i].standard_error_m);
      if (!each) continue;
      std::printf("%s %s %zu mean_cm %.2f point_rms_cm %.2f standard_error_cm %.2f\n", farm.c_str(),
                  method.name.c_str(), i + 1, 100 * error.mean_m, 100 * std::sqrt(error.square_m2),
                  100 * grounds[i].standard_error_m);
    }
  }
}

void print(const std::map<std::string, Score>& scores) {
  std::printf("method plots without bias_cm rms_cm worst_cm over_1cm point_rms_cm inside_95 s\n");
  for (const auto& [method, score] : scores) {
    const double n = score.plots;
    std::printf("%s %d %d %.2f %.2f %.2f %.3f %.2f %.3f %.1f\n", method.c_str(), score.plots,
                score.without, 100 * score.sum_m / n, 100 * std::sqrt(score.squares_m2 / n),
                100 * score.worst_m, score.over_1cm / n,
                100 * std::sqrt(score.point_squares_m2 / n), score.inside / n, score.seconds);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool each = argc > 1 && std::string_view(argv[1]) == "--each";
  const int first = each ? 2 : 1;
  if (argc <= first || (argc - first) % 2 != 0) {
    std::fprintf(stderr, "usage: ground_error [--each] (FARM SCAN)...\n");
    return 2;
  }
  try {
    std::map<std::string, Score> scores;
    for (int i = first; i < argc; i += 2) measure(argv[i], argv[i + 1], each, scores);
    print(scores);
  } catch (const InputError& error) {
    std::fprintf(stderr, "ground_error: %s\n", error.what());
    return 2;
  }
}
