// SPDX-License-Identifier: Apache-2.0
// One farm under several sensors: sensor_study FARM FOLDER SENSOR...
#include <cstdio>
#include <filesystem>

#include <plotscan/clouds.h>
#include <plotscan/flight.h>
#include <plotscan/score.h>

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  try {
    for (int i = 3; i < argc; ++i) {
      const std::filesystem::path scan = std::filesystem::path(argv[2]) / argv[i];
      const auto flight = plotscan::fly(argv[1], scan, {.settings = {{"sensor", argv[i]}}});
      const auto estimate = plotscan::estimate_field(plotscan::read_cloud(scan).positions());
      const auto scores = plotscan::score_estimate(estimate, argv[1]);
      std::printf("%s: %zu of %zu plots in %.2f million points\n", argv[i], scores.found,
                  scores.plots, 1e-6 * static_cast<double>(flight.points));
    }
  } catch (const plotscan::BadInput& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
