// SPDX-License-Identifier: Apache-2.0
// field_method CLOUD.pcd BOXES.csv OUT.csv
//
// What a user would build from libraries: the ground by PCL's approximate progressive morphological
// filter (Zhang et al., IEEE TGRS 41(4), 2003), a raster of it, plots where they were drawn by
// hand, and of each the 99th percentile of the points' heights above the raster. An entry to the
// benchmark by its command line alone (docs/leaderboard.md).
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include <pcl/filters/voxel_grid.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/approximate_progressive_morphological_filter.h>

#include "core/angle.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/plot_box.h"
#include "core/statistics.h"
#include "core/text_file.h"
#include "fieldmethod/ground_raster.h"

namespace {

using namespace plotscan;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

constexpr float kThinning_m = 0.05F;
constexpr double kCell_m = 0.25;
// Wider than the plots are, so that the filter sees past them; steps beyond these are not ground.
constexpr int kWindow_m = 6;
constexpr float kSlope = 0.15F;
constexpr float kFirstStep_m = 0.1F;
constexpr float kLargestStep_m = 0.3F;

Cloud::Ptr read_thinned(const char* file) {
  const Cloud::Ptr all(new Cloud);
  if (pcl::io::loadPCDFile(file, *all) != 0) throw InputError(file, "cannot be read");
  if (all->empty()) throw InputError(file, "holds no points");
  Cloud::Ptr thinned(new Cloud);
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(all);
  grid.setLeafSize(kThinning_m, kThinning_m, kThinning_m);
  grid.filter(*thinned);
  return thinned;
}

Cloud ground_of(const Cloud::Ptr& cloud) {
  pcl::ApproximateProgressiveMorphologicalFilter<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setCellSize(static_cast<float>(kCell_m));
  filter.setMaxWindowSize(kWindow_m);
  filter.setSlope(kSlope);
  filter.setInitialDistance(kFirstStep_m);
  filter.setMaxDistance(kLargestStep_m);
  pcl::Indices ground;
  filter.extract(ground);
  return {*cloud, ground};
}

struct DrawnPlot {
  std::string number;
  PlotBox box;
};

std::vector<DrawnPlot> read_plots(const char* boxes) {
  std::vector<DrawnPlot> plots;
  read_csv(boxes, {"plot_number", "center_x_m", "center_y_m", "width_m", "length_m", "heading_deg"},
           {}, [&](const CsvRow& row) {
             const PlotBox box{.center = {row.number(1), row.number(2)},
                               .width_m = row.number(3),
                               .length_m = row.number(4),
                               .heading_rad = radians(row.number(5))};
             plots.push_back({.number = std::string(row.text(0)), .box = box});
           });
  return plots;
}

void write_heights(const Cloud& cloud, const fieldmethod::GroundRaster& ground,
                   const std::vector<DrawnPlot>& plots, const char* out) {
  TextFile table(out);
  table << "plot_number,height_p99_m\n";
  for (const DrawnPlot& plot : plots) {
    std::vector<double> heights_m;
    for (const pcl::PointXYZ& point : cloud) {
      if (plot.box.contains({point.x, point.y}))
        heights_m.push_back(static_cast<double>(point.z) - ground.z_m(point.x, point.y));
    }
    table << plot.number << ",";
    if (!heights_m.empty()) table << quantile(heights_m, 0.99);
    table << "\n";
  }
  table.close();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: field_method CLOUD.pcd BOXES.csv OUT.csv\n", stderr);
    return 2;
  }
  try {
    const Cloud::Ptr cloud = read_thinned(argv[1]);
    const std::vector<DrawnPlot> plots = read_plots(argv[2]);
    write_heights(*cloud, fieldmethod::GroundRaster(ground_of(cloud), kCell_m), plots, argv[3]);
    return 0;
  } catch (const InputError& error) {
    std::fprintf(stderr, "field_method: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "field_method: %s\n", error.what());
    return 1;
  }
}
