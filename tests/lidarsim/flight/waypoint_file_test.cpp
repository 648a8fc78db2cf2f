// SPDX-License-Identifier: Apache-2.0
#include "flight/waypoint_file.h"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan::flight {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(WaypointFile, ReadsEveryKey) {
  const testing::TemporaryFolder folder;
  const auto waypoints = read_waypoints(folder.write("way.yaml", R"(waypoints:
  - {x_m: 1, y_m: -2, z_m: 9}
  - {x_m: 3, y_m: 4, altitude_m: 6, speed_m_s: 1.5, heading_deg: 90, hold_s: 2}
  - {x_m: 0, y_m: 0, z_m: 9}
)"));
  ASSERT_EQ(waypoints.size(), 3u);
  EXPECT_EQ(waypoints[0].waypoint.position_m, Eigen::Vector3d(1, -2, 9));
  EXPECT_FALSE(waypoints[0].altitude_m || waypoints[0].waypoint.speed_m_s);
  EXPECT_EQ(waypoints[1].altitude_m, 6);
  EXPECT_EQ(waypoints[1].waypoint.speed_m_s, 1.5);
  EXPECT_EQ(waypoints[1].waypoint.heading_rad, std::numbers::pi / 2);
  EXPECT_EQ(waypoints[1].waypoint.hold_s, 2);
}

TEST(WaypointFile, BadFilesAreRefusedWithTheirLine) {
  const testing::TemporaryFolder folder;
  const auto refusal = [&](const std::string& second) {
    const auto file =
        folder.write("way.yaml", "waypoints:\n  - {x_m: 1, y_m: 2, z_m: 9}\n  - " + second + "\n");
    return testing::message_of<InputError>([&] { read_waypoints(file); });
  };
  EXPECT_THAT(refusal("{x_m: 1, y_m: 2}"),
              HasSubstr("way.yaml:3: waypoints.1.z_m or altitude_m has to be given, one of the"));
  EXPECT_THAT(refusal("{x_m: 1, y_m: 2, z_m: 3, altitude_m: 4}"),
              HasSubstr("way.yaml:3: waypoints.1.z_m or altitude_m has to be given, one of the"));
  EXPECT_THAT(refusal("{x_m: .nan, y_m: 2, z_m: 3}"), HasSubstr("way.yaml:3"));
  EXPECT_THAT(refusal("{x_m: 1e9, y_m: 2, z_m: 3}"), HasSubstr("way.yaml:3"));
  EXPECT_THAT(refusal("{x_m: 1, z_m: 3}"), HasSubstr("y_m"));
  EXPECT_THAT(refusal("{x_m: 1, y_m: 2, altitude_m: 121}"), HasSubstr("[0.5, 120]"));
  EXPECT_THAT(refusal("{x_m: 1, y_m: 2, z_m: 3, hold_s: -1}"), HasSubstr("hold_s"));
  EXPECT_THAT(refusal("{x_m: 1, y_m: 2, z_m: 3, speed: 2}"), HasSubstr("speed"));
  EXPECT_THAT(refusal("{x_m: 1, y_m: 2, altitute_m: 6}"),
              AllOf(HasSubstr("altitute_m"), HasSubstr("altitude_m")));
  EXPECT_THAT(refusal("{x_m: 1, y_m: 2, z_m: 3, speed_m_s: 2}"), HasSubstr("this is the last"));
  EXPECT_THAT(refusal("{x_m: 5, y_m: 2, z_m: 3, speed_m_s: 7}\n  - {x_m: 1, y_m: 2, z_m: 3}"),
              HasSubstr("[0.01, 6]"));
  const auto one = folder.write("one.yaml", "waypoints: [{x_m: 1, y_m: 2, z_m: 9}]\n");
  EXPECT_THAT(testing::message_of<InputError>([&] { read_waypoints(one); }),
              HasSubstr("at least two"));
}

}  // namespace
}  // namespace plotscan::flight
