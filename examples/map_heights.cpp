// SPDX-License-Identifier: Apache-2.0
// Heights in boxes of your own: map_heights CLOUD X Y WIDTH LENGTH HEADING
// The box is in the cloud's frame: centre, sides in metres, degrees counter-clockwise from x.
#include <cstdio>
#include <cstdlib>

#include <plotscan/clouds.h>
#include <plotscan/estimate.h>

int main(int argc, char** argv) {
  if (argc != 7) return 2;
  try {
    const plotscan::Cloud cloud = plotscan::read_cloud(argv[1]);
    plotscan::EstimateOptions options;
    options.boxes = {{.center_x_m = std::atof(argv[2]),
                      .center_y_m = std::atof(argv[3]),
                      .width_m = std::atof(argv[4]),
                      .length_m = std::atof(argv[5]),
                      .heading_deg = std::atof(argv[6])}};
    const auto field = plotscan::estimate_field(cloud.positions(), options);
    for (const auto& [name, height] : field.plots.front().heights)
      std::printf("%-10s %.3f m +- %.3f\n", name.c_str(), height.value_m, height.standard_error_m);
    for (const std::string& flag : field.plots.front().flags) std::printf("! %s\n", flag.c_str());
  } catch (const plotscan::BadInput& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
