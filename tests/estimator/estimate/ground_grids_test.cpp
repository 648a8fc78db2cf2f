// SPDX-License-Identifier: Apache-2.0
#include "estimate/ground_grids.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "temporary_folder.h"

namespace plotscan::estimate {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;

// Nodes at x 500000, 500000.2, 500000.4 and y 40, 40.2; the last node is out of reach.
ground::Surface graded() {
  const float none = std::numeric_limits<float>::quiet_NaN();
  ground::Surface surface{{.origin = {500000, 40}, .cell_m = 0.2, .columns = 3, .rows = 2}};
  surface.z_m = {1, 2, 3, 4, 5, none};
  surface.sd_m = {0.01F, 0.02F, 0.03F, 0.04F, 0.05F, none};
  surface.seen = {1, 0, 1, 0, 1, 0};
  return surface;
}

// By the format's description (Esri, ASCII raster): north first, the corner half a cell outside of
// the first node.
TEST(GroundGrids, AreEsriAsciiRasters) {
  const TemporaryFolder folder;
  write_ground(folder.path(), graded());
  const std::string head =
      "ncols 3\nnrows 2\nxllcorner 499999.9\nyllcorner 39.9\ncellsize 0.2\n"
      "NODATA_value -9999\n";
  EXPECT_EQ(read_text(folder.path() / "ground.asc"),
            head + "4.0000 5.0000 -9999\n1.0000 2.0000 3.0000\n");
  EXPECT_EQ(read_text(folder.path() / "ground_se.asc"),
            head + "0.0400 0.0500 -9999\n0.0100 0.0200 0.0300\n");
  EXPECT_EQ(read_text(folder.path() / "ground_seen.asc"), head + "0 1 -9999\n1 0 1\n");
}

TEST(GroundGrids, AreInTheUnitsOfTheCloud) {
  const TemporaryFolder folder;
  const CoordinateUnits units{.horizontal_m = 0.5, .vertical_m = 0.25};
  write_ground(folder.path(), graded(), units);
  const std::string head =
      "ncols 3\nnrows 2\nxllcorner 999999.8\nyllcorner 79.8\ncellsize 0.4\n"
      "NODATA_value -9999\n";
  EXPECT_EQ(read_text(folder.path() / "ground.asc"),
            head + "16.0000 20.0000 -9999\n4.0000 8.0000 12.0000\n");
  const ground::Surface read = read_ground(folder.path(), units);
  EXPECT_NEAR(read.origin.x(), 500000, 1e-9);
  EXPECT_NEAR(read.cell_m, 0.2, 1e-12);
  EXPECT_NEAR(read.z_m[4], 5, 1e-6);
  EXPECT_NEAR(read.sd_m[4], 0.05, 1e-6);
}

TEST(GroundGrids, TheCanopyIsTheHighestPointOfEachCell) {
  const ground::Grid grid{.origin = {-3.1, 2.3}, .cell_m = 0.25, .columns = 9, .rows = 7};
  std::vector<Eigen::Vector3f> points;
  RandomStream random(5, random_purpose("test/canopy"), 0);
  for (int i = 0; i < 120; ++i)  // of 63 cells; some lie outside of all
    points.emplace_back(random.uniform(-3.5, -0.7), random.uniform(2, 4.2), random.normal());
  const ground::Field highest = highest_in_cells(points, grid);
  int empty = 0;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Vector2d center = grid.origin + grid.cell_m * Eigen::Vector2d(column, row);
      double top = -std::numeric_limits<double>::infinity();
      for (const Eigen::Vector3f& point : points) {
        const Eigen::Vector2d apart = point.head<2>().cast<double>() - center;
        if (apart.cwiseAbs().maxCoeff() < grid.cell_m / 2) top = std::max<double>(top, point.z());
      }
      const float found = highest[grid.index(column, row)];
      empty += std::isnan(found);
      EXPECT_TRUE(std::isnan(found) ? std::isinf(top) : found == top) << column << " " << row;
    }
  }
  EXPECT_GT(empty, 5);
}

TEST(GroundGrids, ACanopyHeightModelLiesOnTheGroundsCells) {
  const TemporaryFolder folder;
  const float none = std::numeric_limits<float>::quiet_NaN();
  write_canopy(folder.path(), graded(), {0.5F, none, -0.02F, 1, 2, 0},
               {.horizontal_m = 0.5, .vertical_m = 0.25});
  EXPECT_EQ(read_text(folder.path() / "chm.asc"),
            "ncols 3\nnrows 2\nxllcorner 999999.8\nyllcorner 79.8\ncellsize 0.4\n"
            "NODATA_value -9999\n4.0000 8.0000 0.0000\n2.0000 -9999 -0.0800\n");
}

TEST(GroundGrids, SayThatTheyCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of<WriteError>([&] { write_ground(folder.path() / "absent", graded()); }),
              ::testing::HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace plotscan::estimate
