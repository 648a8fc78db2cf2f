// SPDX-License-Identifier: Apache-2.0
// A simulated scan without its ground, in another format: crop_only SCAN OUT.las
#include <cstdio>
#include <vector>

#include <plotscan/clouds.h>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  constexpr int kCrop = 2;
  try {
    plotscan::Cloud cloud = plotscan::read_cloud(argv[1]);
    std::erase_if(cloud.points, [](const plotscan::Point& point) { return point.label != kCrop; });
    plotscan::write_cloud(argv[2], cloud.points, {.origin_m = cloud.origin_m});
    std::printf("%zu points\n", cloud.points.size());
  } catch (const plotscan::BadInput& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
