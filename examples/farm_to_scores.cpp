// SPDX-License-Identifier: Apache-2.0
// A farm, a flight over it, its plots from the points, and how right they are:
//   farm_to_scores FOLDER [KEY=VALUE]...
// The values replace those of the shipped description paper_flat.
#include <cstdio>
#include <filesystem>

#include <plotscan/clouds.h>
#include <plotscan/farm.h>
#include <plotscan/flight.h>
#include <plotscan/score.h>

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const std::filesystem::path folder = argv[1];
  try {
    const auto farm = plotscan::generate_farm("paper_flat", folder / "farm",
                                              {.set = {argv + 2, argv + argc}, .seed = 7});
    plotscan::fly(folder / "farm", folder / "scan", {.settings = {{"altitude_m", 8.0}}});
    const plotscan::Cloud cloud = plotscan::read_cloud(folder / "scan");
    const auto estimate = plotscan::estimate_field(cloud.positions());
    const auto scores = plotscan::score_estimate(estimate, folder / "farm");
    std::printf("%zu of %zu plots found, %zu invented\n", scores.found, farm.plots, scores.extra);
    for (const plotscan::HeightScore& score : scores.heights) {
      if (score.height == "max" && score.truth == "height_max_m")
        std::printf("tallest plants: RMSE %.1f cm\n", 100 * score.rmse_m);
    }
  } catch (const plotscan::BadInput& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
