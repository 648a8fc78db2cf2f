// SPDX-License-Identifier: Apache-2.0
#include "estimate/internal/esri_grid.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "estimate/ground_grids.h"
#include "temporary_folder.h"

namespace plotscan::estimate {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

const std::string kHead = "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 0.5\n";

std::string refusal(const std::string& text) {
  const TemporaryFolder folder;
  const auto file = folder.write("grid.asc", text);
  return message_of<InputError>([&] { read_esri_grid(file); });
}

TEST(EsriGrid, IsReadFromNorthToSouth) {
  const TemporaryFolder folder;
  const EsriGrid grid = read_esri_grid(folder.write("a.asc", kHead + "4 5 6\n1 2 3\n"));
  EXPECT_EQ(grid.columns, 3);
  EXPECT_EQ(grid.rows, 2);
  EXPECT_EQ(grid.cell, 0.5);
  EXPECT_EQ(grid.first, Eigen::Vector2d(10.25, 20.25));
  EXPECT_THAT(grid.values, ElementsAre(1, 2, 3, 4, 5, 6));
}

// As other programs write them: capitals, centres, Windows' line ends, values broken anywhere.
TEST(EsriGrid, IsReadAsOthersWriteIt) {
  const TemporaryFolder folder;
  const EsriGrid grid = read_esri_grid(
      folder.write("a.asc",
                   "NCOLS 2\r\nNROWS 2\r\nXLLCENTER 4.5e5\r\nYLLCENTER -7\r\nCELLSIZE 1\r\n"
                   "NODATA_value -1\r\n  +1.5 -1\r\n2e1\r\n\r\n-3"));
  EXPECT_EQ(grid.first, Eigen::Vector2d(450000, -7));
  EXPECT_EQ(grid.values[2], 1.5F);
  EXPECT_TRUE(std::isnan(grid.values[3]));
  EXPECT_EQ(grid.values[0], 20);
  EXPECT_EQ(grid.values[1], -3);
}

TEST(EsriGrid, RefusesWhatIsNone) {
  EXPECT_THAT(refusal(""), HasSubstr("has no cellsize"));
  EXPECT_THAT(refusal("ply\nformat ascii 1.0\n"), HasSubstr(":1: 'ply' is no word"));
  EXPECT_THAT(refusal(std::string("\0\x01\xff", 3)), HasSubstr("has no cellsize"));
  EXPECT_THAT(refusal(kHead + "1 2 3\n4 5\n"), HasSubstr("is missing"));
  EXPECT_THAT(refusal(kHead + "1 2 3\n4 5 6 7\n"), HasSubstr(":7: has more values"));
  EXPECT_THAT(refusal(kHead + "1 2 3\n4 five 6\n"), HasSubstr(":7: a value of the grid is 'five'"));
  EXPECT_THAT(refusal(kHead + "nan 2 3\n4 5 6\n"), HasSubstr("'nan'"));
  EXPECT_THAT(refusal(kHead + "1 2 1e999\n4 5 6\n"), HasSubstr("'1e999'"));
  EXPECT_THAT(refusal("ncols 3\n" + kHead + "1 2 3 4 5 6"),
              HasSubstr(":2: ncols stands there twice"));
  EXPECT_THAT(refusal("ncols 2.5\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3 4"),
              HasSubstr("ncols is not a whole number"));
  EXPECT_THAT(refusal("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize -1\n1 2 3 4"),
              HasSubstr("cellsize is out of range"));
  // Nothing of that size is set aside.
  EXPECT_THAT(refusal("ncols 1000000000\nnrows 1000000000\nxllcorner 0\nyllcorner 0\n"
                      "cellsize 1\n1 2 3 4"),
              HasSubstr("has fewer values"));
}

// Half a cell's z as a plane, its error and what was seen, with one node out of reach.
ground::Surface surface() {
  ground::Surface made{{.origin = {552000.125, 4128000.5}, .cell_m = 0.2, .columns = 7, .rows = 5}};
  for (int row = 0; row < made.rows; ++row) {
    for (int column = 0; column < made.columns; ++column) {
      made.z_m.push_back(static_cast<float>(312 + 0.1 * column - 0.03 * row));
      made.sd_m.push_back(0.01F * static_cast<float>(row + 1));
      made.seen.push_back(column % 2 == 0);
    }
  }
  made.z_m[9] = made.sd_m[9] = std::numeric_limits<float>::quiet_NaN();
  made.seen[9] = 0;
  return made;
}

TEST(GroundGrids, AreReadBackAsWritten) {
  const TemporaryFolder folder;
  const ground::Surface written = surface();
  write_ground(folder.path(), written);
  const ground::Surface read = read_ground(folder.path());
  EXPECT_EQ(read.columns, written.columns);
  EXPECT_EQ(read.rows, written.rows);
  EXPECT_EQ(read.cell_m, written.cell_m);
  EXPECT_LT((read.origin - written.origin).norm(), 1e-8);
  EXPECT_EQ(read.seen, written.seen);
  for (std::size_t node = 0; node < written.z_m.size(); ++node) {
    EXPECT_EQ(std::isnan(read.z_m[node]), node == 9);
    if (node == 9) continue;
    EXPECT_NEAR(read.z_m[node], written.z_m[node], 0.8e-4);  // four decimals, and a float's step
    EXPECT_NEAR(read.sd_m[node], written.sd_m[node], 0.5e-4);
  }
}

TEST(GroundGrids, MustBeThreeOfTheSameNodes) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of<InputError>([&] { read_ground(folder.path()); }), HasSubstr("ground.asc"));
  write_ground(folder.path(), surface());
  folder.write("ground_se.asc", kHead + "4 5 6\n1 2 3\n");
  EXPECT_THAT(message_of<InputError>([&] { read_ground(folder.path()); }),
              HasSubstr("ground_se.asc: has other columns"));
}

}  // namespace
}  // namespace plotscan::estimate
