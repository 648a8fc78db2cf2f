// SPDX-License-Identifier: Apache-2.0
// field_method CLOUD.pcd BOXES.csv OUT.csv
//
// What a user would build from libraries: the ground by PCL's approximate progressive morphological
// filter (Zhang et al., IEEE TGRS 41(4), 2003), a raster of it, plots where they were drawn by
// hand, and of each the 99th percentile of the points' heights above the raster. An entry to the
// benchmark by its command line alone (docs/leaderboard.md).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include <pcl/common/common.h>
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
  if (ground.empty()) throw InputError("no ground was found");
  return {*cloud, ground};
}

// Mean heights of the ground's points in square cells; a cell without any takes the mean of its
// neighbours, cell after cell inwards.
class Raster {
 public:
  explicit Raster(const Cloud& ground) {
    pcl::PointXYZ low, high;
    pcl::getMinMax3D(ground, low, high);
    low_x_ = static_cast<double>(low.x);
    low_y_ = static_cast<double>(low.y);
    columns_ = column(high.x) + 1;
    rows_ = row(high.y) + 1;
    std::vector<double> sums(columns_ * rows_, 0);
    std::vector<int> counts(columns_ * rows_, 0);
    for (const pcl::PointXYZ& point : ground) {
      const std::size_t cell = row(point.y) * columns_ + column(point.x);
      sums[cell] += static_cast<double>(point.z);
      ++counts[cell];
    }
    z_m_.assign(sums.size(), kNaN);
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (counts[i] > 0) z_m_[i] = sums[i] / counts[i];
    while (fill_rim()) {
    }
  }

  // Bilinear between the cells' centres.
  double z_m(double x, double y) const {
    const double u =
        std::clamp((x - low_x_) / kCell_m - 0.5, 0.0, static_cast<double>(columns_ - 1));
    const double v = std::clamp((y - low_y_) / kCell_m - 0.5, 0.0, static_cast<double>(rows_ - 1));
    const auto c =
        std::min(static_cast<std::size_t>(u), columns_ - std::min<std::size_t>(2, columns_));
    const auto r = std::min(static_cast<std::size_t>(v), rows_ - std::min<std::size_t>(2, rows_));
    const std::size_t next_c = std::min(c + 1, columns_ - 1);
    const std::size_t next_r = std::min(r + 1, rows_ - 1);
    const double s = u - static_cast<double>(c);
    const double t = v - static_cast<double>(r);
    return (1 - t) * ((1 - s) * at(r, c) + s * at(r, next_c)) +
           t * ((1 - s) * at(next_r, c) + s * at(next_r, next_c));
  }

 private:
  std::size_t column(double x) const { return static_cast<std::size_t>((x - low_x_) / kCell_m); }
  std::size_t row(double y) const { return static_cast<std::size_t>((y - low_y_) / kCell_m); }
  double at(std::size_t r, std::size_t c) const { return z_m_[r * columns_ + c]; }

  bool fill_rim() {
    const std::vector<double> before = z_m_;
    bool changed = false;
    for (std::size_t cell = 0; cell < before.size(); ++cell) {
      if (!std::isnan(before[cell])) continue;
      std::vector<double> around;
      const std::size_t r = cell / columns_;
      const std::size_t c = cell % columns_;
      if (r > 0) around.push_back(before[cell - columns_]);
      if (r + 1 < rows_) around.push_back(before[cell + columns_]);
      if (c > 0) around.push_back(before[cell - 1]);
      if (c + 1 < columns_) around.push_back(before[cell + 1]);
      std::erase_if(around, [](double z) { return std::isnan(z); });
      if (around.empty()) continue;
      z_m_[cell] = mean(around);
      changed = true;
    }
    return changed;
  }

  double low_x_ = 0;
  double low_y_ = 0;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<double> z_m_;
};

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

void write_heights(const Cloud& cloud, const Raster& ground, const std::vector<DrawnPlot>& plots,
                   const char* out) {
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
    write_heights(*cloud, Raster(ground_of(cloud)), plots, argv[3]);
    return 0;
  } catch (const InputError& error) {
    std::fprintf(stderr, "field_method: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "field_method: %s\n", error.what());
    return 1;
  }
}
