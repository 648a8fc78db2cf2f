// SPDX-License-Identifier: Apache-2.0
#include "core/utc_time.h"

#include <gtest/gtest.h>

namespace plotscan {
namespace {

TEST(UtcTime, ReadsWhatItWrites) {
  for (const char* text : {"2026-06-01T10:00:00Z", "2000-02-29T23:59:59.25Z",
                           "1980-01-06T00:00:00Z", "2099-12-31T00:00:00.000001Z"}) {
    ASSERT_TRUE(parse_utc(text)) << text;
    EXPECT_EQ(format_utc(*parse_utc(text)), text);
  }
}

TEST(UtcTime, WhatIsNoInstantIsRefused) {
  for (const char* text : {"", "2026-06-01", "2026-06-01T10:00:00", "2026-02-29T10:00:00Z",
                           "2026-06-01T24:00:00Z", "2026-06-01T10:60:00Z", "1979-06-01T10:00:00Z",
                           "2026-06-01T10:00:00.0000001Z", "2026-13-01T10:00:00Z"})
    EXPECT_FALSE(parse_utc(text)) << text;
}

TEST(UtcTime, LaterRoundsToMicrosecondsAndStaysWithinWhatATimeHolds) {
  const UtcTime time = *parse_utc("2026-06-01T10:00:00Z");
  EXPECT_EQ(format_utc(later(time, 0.25000049)), "2026-06-01T10:00:00.25Z");
  EXPECT_EQ(format_utc(later(time, -3600)), "2026-06-01T09:00:00Z");
  EXPECT_EQ(later(time, 1e300), later(time, 1e11));
  EXPECT_EQ(later(time, -1e300), later(time, -1e11));
  EXPECT_EQ(format_utc(later(*parse_utc("2026-12-31T23:59:59Z"), 1.5)), "2027-01-01T00:00:00.5Z");
}

// From the tables of the US Naval Observatory: Unix time of the instant, GPS weeks, and TAI - UTC,
// of which GPS time began with 19 s.
TEST(UtcTime, GpsTimeIsAheadByTheLeapSecondsUntilThen) {
  EXPECT_EQ(gps_seconds(*parse_utc("1980-01-06T00:00:00Z")), 0);
  // Week 2238 began on 2022-11-27.
  EXPECT_EQ(gps_seconds(*parse_utc("2022-11-27T00:00:00Z")), 2238 * 604800.0 + 18);
  EXPECT_EQ(parse_utc("2022-11-27T00:00:00Z")->time_since_epoch().count(), 1669507200000000);
  const auto ahead_s = [](const char* text) {
    const UtcTime time = *parse_utc(text);
    return gps_seconds(time) -
           1e-6 * static_cast<double>((time - *parse_utc("1980-01-06T00:00:00Z")).count());
  };
  EXPECT_EQ(ahead_s("1981-06-30T23:59:59Z"), 0);
  EXPECT_EQ(ahead_s("1981-07-01T00:00:00Z"), 20 - 19);
  EXPECT_EQ(ahead_s("1990-01-01T00:00:00Z"), 25 - 19);
  EXPECT_EQ(ahead_s("2010-06-01T00:00:00Z"), 34 - 19);
  EXPECT_EQ(ahead_s("2016-12-31T23:59:59.999999Z"), 36 - 19);
  EXPECT_EQ(ahead_s("2017-01-01T00:00:00Z"), 37 - 19);
}

TEST(UtcTime, ComesBackFromGpsTime) {
  for (const char* text : {"1980-01-06T00:00:00Z", "1999-01-01T00:00:00Z", "2016-12-31T23:59:59Z",
                           "2017-01-01T00:00:00Z", "2017-01-01T00:00:01Z", "2026-06-01T10:00:00Z"})
    EXPECT_EQ(format_utc(utc_of_gps(gps_seconds(*parse_utc(text)))), text);
}

}  // namespace
}  // namespace plotscan
