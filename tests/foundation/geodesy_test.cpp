// SPDX-License-Identifier: Apache-2.0
#include "core/geodesy.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

GeodeticPoint place(double latitude_deg, double longitude_deg) {
  return {.latitude_deg = latitude_deg, .longitude_deg = longitude_deg};
}

// The CN Tower in the example of Wikipedia's article on UTM: 43 38 33.24 N, 79 23 13.7 W is zone
// 17, 630084 m east, 4833438 m north.
TEST(Geodesy, UtmOfAPublishedPlace) {
  const GeodeticPoint tower = place(43 + 38 / 60.0 + 33.24 / 3600, -(79 + 23 / 60.0 + 13.7 / 3600));
  const UtmZone zone = utm_zone(tower);
  EXPECT_EQ(zone.number, 17);
  EXPECT_TRUE(zone.north);
  EXPECT_NEAR(utm_from_geodetic(zone, tower).x(), 630084, 1);
  EXPECT_NEAR(utm_from_geodetic(zone, tower).y(), 4833438, 1);
}

// On the central meridian the easting is 500 km, and a metre is 0.9996 m: at the equator an angle's
// northing is a (1 - e2) times it, which in the south counts down from 10000 km.
TEST(Geodesy, UtmOnTheCentralMeridian) {
  const UtmZone zone = utm_zone(place(-1e-3, 9));
  EXPECT_EQ(zone.number, 32);
  EXPECT_FALSE(zone.north);
  EXPECT_EQ(zone.central_meridian_deg(), 9);
  const Eigen::Vector3d utm = utm_from_geodetic(zone, place(-1e-3, 9));
  EXPECT_NEAR(utm.x(), 5e5, 1e-6);
  EXPECT_NEAR(utm.y(), 1e7 - 0.9996 * 110.57427582, 1e-4);
}

TEST(Geodesy, UtmEndsTowardsThePoles) {
  EXPECT_EQ(utm_zone(place(60.4, 5.3)).number, 32);  // western Norway
  EXPECT_THROW(utm_zone(place(85, 0)), InputError);
  EXPECT_THROW(utm_zone(place(-81, 0)), InputError);
}

TEST(Geodesy, UtmComesBack) {
  for (const GeodeticPoint& point : {place(43.6425, -79.3871), place(-33.8, 151.2)}) {
    const UtmZone zone = utm_zone(point);
    const GeodeticPoint back = geodetic_from_utm(zone, utm_from_geodetic(zone, point));
    EXPECT_NEAR(back.latitude_deg, point.latitude_deg, 1e-11);
    EXPECT_NEAR(back.longitude_deg, point.longitude_deg, 1e-11);
  }
}

// Codes and zones as the EPSG registry of PROJ has them.
TEST(Geodesy, UtmSystemsByTheirCodes) {
  const auto zone = [](const std::string& crs) {
    const auto system = utm_system(crs);
    return system ? std::to_string(system->zone.number) + (system->zone.north ? "N " : "S ") +
                        system->datum
                  : "none";
  };
  EXPECT_EQ(zone("EPSG:32617"), "17N WGS 84");
  EXPECT_EQ(zone("EPSG:32760"), "60S WGS 84");
  EXPECT_EQ(zone("EPSG:25832"), "32N ETRS89");
  EXPECT_EQ(zone("EPSG:26917"), "17N NAD83");
  EXPECT_EQ(zone("EPSG:6346"), "17N NAD83(2011)");
  EXPECT_EQ(zone("EPSG:28355"), "55S GDA94");
  EXPECT_EQ(zone("EPSG:7855"), "55S GDA2020");
  for (const char* other : {"", "EPSG:", "EPSG:32661", "EPSG:32600", "EPSG:4326", "EPSG:32617x",
                            "PROJCS[\"no code\"]"}) {
    EXPECT_EQ(zone(other), "none") << other;
  }
}

}  // namespace
}  // namespace plotscan
