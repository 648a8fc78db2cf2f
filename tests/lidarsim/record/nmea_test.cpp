// SPDX-License-Identifier: Apache-2.0
#include "record/velodyne/internal/nmea.h"

#include <gtest/gtest.h>

namespace plotscan::record {
namespace {

// Sentences of the NMEA literature: Velodyne's manuals (the first two), the GPS receivers' common
// examples (the next two), u-blox' protocol description.
constexpr const char* kKnownSentences[] = {
    "$GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W*6A",
    "$GPRMC,220516,A,5133.82,N,00042.24,W,173.8,231.8,130694,004.2,W*70",
    "$GPRMC,225446,A,4916.45,N,12311.12,W,000.5,054.7,191194,020.3,E*68",
    "$GPRMC,081836,A,3751.65,S,14507.36,E,000.0,360.0,130998,011.3,E*62",
    "$GPRMC,083559.00,A,4717.11437,N,00833.91522,E,0.004,77.52,091202,,,A*57",
};

TEST(Nmea, ChecksumsAreThoseOfKnownSentences) {
  for (const std::string sentence : kKnownSentences) {
    const auto star = sentence.find('*');
    EXPECT_EQ(nmea_checksum(sentence.substr(1, star - 1)),
              std::stoul(sentence.substr(star + 1), nullptr, 16))
        << sentence;
  }
}

// The exclusive or of what lies between '$' and '*', as two hexadecimal digits behind the latter.
void expect_checksum(const std::string& sentence) {
  const auto star = sentence.find('*');
  ASSERT_EQ(star + 3, sentence.size()) << sentence;
  int sum = 0;
  for (std::size_t i = 1; i < star; ++i) sum ^= sentence[i];
  EXPECT_EQ(std::stoi(sentence.substr(star + 1), nullptr, 16), sum) << sentence;
}

TEST(Nmea, WritesTheRecommendedMinimum) {
  const std::string sentence =
      gprmc({.time = *parse_utc("2026-06-01T09:08:07Z"),
             .position = {{.latitude_deg = -37.2, .longitude_deg = -80.50000125}},
             .speed_m_s = 2,
             .track_deg = 359.97});
  EXPECT_EQ(sentence.substr(0, sentence.find('*')),
            "$GPRMC,090807,A,3712.0000000,S,08030.0000750,W,003.9,000.0,010626,,,A");
  expect_checksum(sentence);
}

TEST(Nmea, NoSentenceSaysSixtyMinutes) {
  const std::string sentence =
      gprmc({.time = *parse_utc("2026-06-01T00:00:00Z"),
             .position = {{.latitude_deg = 9.99999999999, .longitude_deg = 179.99999999999}}});
  EXPECT_NE(sentence.find(",1000.0000000,N,18000.0000000,E,"), std::string::npos) << sentence;
}

TEST(Nmea, WithoutAPositionOnlyTheTimeIsSaid) {
  const std::string sentence = gprmc({.time = *parse_utc("2026-12-31T23:59:59Z")});
  EXPECT_TRUE(sentence.starts_with("$GPRMC,235959,V,,,,,,,311226,,,N*")) << sentence;
  expect_checksum(sentence);
}

}  // namespace
}  // namespace plotscan::record
