// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <vector>

#include "ground/surface.h"
#include <Eigen/Core>

#include "estimate/cloud_map.h"
#include "farm/farm.h"
#include "farm/plot_table.h"
#include "farm/terrain.h"
#include "farm/terrain_ply.h"

namespace {
using namespace plotscan;

struct PlotError {
  double mean = 0, rms = 0, sd = 0, worst = 0;
  double seen = 0;
};

PlotError error_of(const ground::Surface& surface, const farm::Terrain& terrain, const PlotBox& box,
                   const Eigen::Vector3d& origin) {
  PlotError e;
  int n = 0;
  for (double a = -0.5 * box.length_m + 0.025; a < 0.5 * box.length_m; a += 0.05) {
    for (double b = -0.5 * box.width_m + 0.025; b < 0.5 * box.width_m; b += 0.05) {
      const Eigen::Vector2d p = box.center + a * box.length_axis() + b * box.width_axis();
      const double off =
          surface.height(p) + origin.z() - *terrain.height(p.x() + origin.x(), p.y() + origin.y());
      e.mean += off;
      e.rms += off * off;
      e.worst = std::max(e.worst, std::abs(off));
      ++n;
    }
  }
  e.mean /= n;
  e.rms /= n;
  return e;
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i + 1 < argc; i += 2) {
    const estimate::CloudMap map =
        estimate::read_map(std::filesystem::path(argv[i + 1]) / "cloud.pcd", {});
    const auto& points = map.points();
    const auto terrain = farm::read_terrain(std::filesystem::path(argv[i]) / "truth/terrain.ply");
    auto plots = farm::read_plots(std::filesystem::path(argv[i]) / "truth/plots.geojson");
    const std::clock_t c0 = std::clock();
    const auto t0 = std::chrono::steady_clock::now();
    auto surface = ground::fit_surface(points, {.cell_m = 0.2, .noise_m = {}, .threads = 2});
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
    for (auto& plot : plots) plot.box.center -= map.origin().head<2>();

    const double cpu = double(std::clock() - c0) / CLOCKS_PER_SEC;
    double sum = 0, squares = 0, point_squares = 0, worst = 0, worst_point = 0;
    int covered = 0;
    for (const auto& plot : plots) {
      PlotError e = error_of(surface, terrain, plot.box, map.origin());
      e.sd = surface.mean_standard_error(plot.box);
      if (getenv("EACH"))
        std::printf("  %u %.2f sd %.2f rms %.2f worst %.2f\n", plot.id, 100 * e.mean, 100 * e.sd,
                    100 * std::sqrt(e.rms), 100 * e.worst);
      sum += e.mean;
      squares += e.mean * e.mean;
      point_squares += e.rms;
      worst = std::max(worst, std::abs(e.mean));
      worst_point = std::max(worst_point, e.worst);
      covered += std::abs(e.mean) < 1.96 * e.sd;
    }
    const double n = plots.size();
    std::printf(
        "%s points %.2fM grid %dx%d noise %.4f time %.2f cpu %.2f plots %.0f bias %.2f rms %.2f "
        "worst %.2f "
        "point rms %.2f worst %.2f cover %.2f\n",
        argv[i], 1e-6 * points.size(), surface.columns, surface.rows, surface.noise_m, seconds, cpu,
        n, 100 * sum / n, 100 * std::sqrt(squares / n), 100 * worst,
        100 * std::sqrt(point_squares / n), 100 * worst_point, covered / n);
  }
}
