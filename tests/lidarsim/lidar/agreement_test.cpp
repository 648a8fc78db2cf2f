// SPDX-License-Identifier: Apache-2.0
// A farm and the worlds exported from it, read back, are the same to a laser.
#include <cmath>

#include <gtest/gtest.h>

#include "description/load_description.h"
#include "farmfolder/read_farm.h"
#include "farmfolder/write_farm.h"
#include "farmgen/example_farm.h"
#include "gazebo/export_world.h"
#include "gazebo/read_world.h"
#include "planting/generate.h"
#include "simulated.h"

namespace plotscan::lidar {
namespace {

using gazebo::Gazebo;
using gazebo::Merge;
using Points = std::vector<scan::LabelledPoint>;
using testing::TemporaryFolder;

// Five plots and weeds in and between them, as read back from its folder.
farm::Farm farm_with_weeds(const TemporaryFolder& folder) {
  const auto description =
      folder.write("weedy.yaml", testing::example_description() +
                                     "weeds: {per_m2: 2, models: [{crop: wheat, name: weed}]}\n");
  farmfolder::write_farm(planting::generate(description::load_description(description), 3),
                         folder.path() / "farm", {.command = "farmgen generate"});
  return farmfolder::read_farm(folder.path() / "farm");
}

Points scan_of(const SceneContent& content) {
  const sensor::Sensor sensor = testing::exact_vlp16();
  const scan::Trajectory flight(
      {{.time_s = 0, .position_m = {-5, -2, 7}}, {.time_s = 2, .position_m = {6, -2, 7}}});
  const sensor::ShotPlan plan(sensor, 10, testing::spin_along_flight(), flight);
  Points points;
  simulate(Scene(content), sensor, {.fired = plan, .placed = plan},
           {.range_noise_m = 0, .seed = 1, .threads = 2},
           [&](std::span<const scan::LabelledPoint> piece) {
             points.insert(points.end(), piece.begin(), piece.end());
           });
  return points;
}

// Points of two scans, matched by their shot.
struct Agreement {
  std::size_t points = 0;
  std::size_t elsewhere = 0;    // more than kRounding_m apart, or seen in one scan alone
  std::size_t labels = 0;       // of those that are not elsewhere: another class or plot
  std::size_t intensities = 0;  // of those: by more than 1, what rounding may do
  std::size_t plants = 0;       // and another plant
  double furthest_m = 0;        // of those that are not elsewhere
};

constexpr double kRounding_m = 1e-4;

Agreement compared(const Points& a, const Points& b) {
  Agreement found{.points = a.size()};
  std::size_t k = 0;
  for (const scan::LabelledPoint& point : a) {
    while (k < b.size() && b[k].time < point.time) {
      ++found.elsewhere;
      ++k;
    }
    if (k == b.size() || b[k].time != point.time) {
      ++found.elsewhere;
      continue;
    }
    const scan::LabelledPoint& other = b[k++];
    const double apart = (testing::position(point) - testing::position(other)).norm();
    if (apart > kRounding_m) {
      ++found.elsewhere;
      continue;
    }
    found.furthest_m = std::max(found.furthest_m, apart);
    if (point.label != other.label || point.plot != other.plot) ++found.labels;
    if (point.plant != other.plant) ++found.plants;
    if (std::abs(point.intensity - other.intensity) > 1) ++found.intensities;
  }
  found.elsewhere += b.size() - k;
  return found;
}

using Exported = std::tuple<Gazebo, Merge>;

std::string name_of(const Exported& exported) {
  const auto [gazebo, merge] = exported;
  return std::string(gazebo == Gazebo::sim ? "Sim" : "Classic") + (merge == Merge::plot  ? "Plot"
                                                                   : merge == Merge::row ? "Row"
                                                                                         : "None");
}

class ScansAgree : public ::testing::TestWithParam<Exported> {};

// Where a ray passes within rounding of a leaf's edge, it may meet the leaf in one scene and what
// is behind it in the other.
TEST_P(ScansAgree, OfAFarmAndItsExportedWorld) {
  const TemporaryFolder folder;
  const farm::Farm farm = farm_with_weeds(folder);
  const auto [gazebo, merge] = GetParam();
  gazebo::export_world(
      farm, folder.path() / "farm", folder.path() / "export",
      {.gazebo = gazebo, .merge = merge, .lod = gazebo::Detail::scan, .drone = false},
      {.command = "farmgen export"});
  const auto world = gazebo::read_world(folder.path() / "export/world.sdf");
  const Points of_farm = scan_of(scene_content(farm));
  const Agreement found = compared(of_farm, scan_of(scene_content(world)));
  std::printf("%zu points, %zu elsewhere, furthest %.2g m, %zu other labels\n", found.points,
              found.elsewhere, found.furthest_m, found.labels);
  EXPECT_GT(found.points, 150000u);
  EXPECT_LE(static_cast<double>(found.elsewhere), 1e-4 * static_cast<double>(found.points));
  EXPECT_EQ(found.labels, 0u);
  EXPECT_EQ(found.intensities, 0u);
  if (merge == Merge::none) {
    EXPECT_EQ(found.plants, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Exports, ScansAgree,
                         ::testing::Combine(::testing::Values(Gazebo::classic, Gazebo::sim),
                                            ::testing::Values(Merge::plot, Merge::row,
                                                              Merge::none)),
                         [](const auto& tested) { return name_of(tested.param); });

TEST(ScanAgrees, OfAFarmAndItsOwnWorld) {
  const TemporaryFolder folder;
  const farm::Farm farm = farm_with_weeds(folder);
  const auto world = gazebo::read_world(folder.path() / "farm/world.sdf");
  const Agreement found = compared(scan_of(scene_content(farm)), scan_of(scene_content(world)));
  std::printf("%zu points, %zu elsewhere, furthest %.2g m, %zu other labels\n", found.points,
              found.elsewhere, found.furthest_m, found.labels);
  EXPECT_LE(static_cast<double>(found.elsewhere), 1e-4 * static_cast<double>(found.points));
  EXPECT_EQ(found.labels, 0u) << "the weeds too";
  EXPECT_EQ(found.intensities, 0u);
  EXPECT_EQ(found.plants, 0u);
}

}  // namespace
}  // namespace plotscan::lidar
