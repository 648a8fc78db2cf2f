// SPDX-License-Identifier: Apache-2.0
#pragma once

// A scan of the small farm to convert, and what its conversions hold.

#include <cstddef>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"
#include "lidar/fly.h"
#include "lidarsim/lidar/small_farm.h"
#include "record/convert.h"
#include "record/open_source.h"
#include "scan/cloud_writer.h"
#include "temporary_folder.h"

namespace plotscan::record {

class Convert : public ::testing::Test {
 protected:
  static std::vector<scan::LabelledPoint> points_of(const std::filesystem::path& file) {
    std::vector<scan::LabelledPoint> points;
    scan::read_points(file, scan::read_cloud_info(file),
                      [&](auto piece) { points.insert(points.end(), piece.begin(), piece.end()); });
    return points;
  }

  static void write_pcd(const std::filesystem::path& file,
                        const std::vector<scan::LabelledPoint>& points,
                        const scan::CloudWriteOptions& options = {}) {
    scan::PcdWriter writer(file, options);
    writer.write(points);
    writer.close();
  }

  struct Recorded {
    std::optional<UtcTime> start;
    std::vector<scan::LabelledPoint> points;
  };

  // Of any format.
  static Recorded recorded(const std::filesystem::path& file) {
    const Source source = open_source(file, {});
    Recorded read{.start = source.info.start, .points = {}};
    source.stream(
        [&](auto piece) { read.points.insert(read.points.end(), piece.begin(), piece.end()); });
    return read;
  }

  // Within the steps of LAS: 0.1 mm, 60 ns, and 1/257 of intensity.
  static void expect_same(const std::vector<scan::LabelledPoint>& read,
                          const std::vector<scan::LabelledPoint>& expected) {
    ASSERT_EQ(read.size(), expected.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      scan::LabelledPoint point = read[i];
      ASSERT_NEAR(point.x, expected[i].x, 1.1e-4);
      ASSERT_NEAR(point.y, expected[i].y, 1.1e-4);
      ASSERT_NEAR(point.z, expected[i].z, 1.1e-4);
      ASSERT_NEAR(point.intensity, expected[i].intensity, 1e-2);
      ASSERT_NEAR(point.time, expected[i].time, 1e-7);
      point.x = expected[i].x;
      point.y = expected[i].y;
      point.z = expected[i].z;
      point.intensity = expected[i].intensity;
      point.time = expected[i].time;
      ASSERT_EQ(point, expected[i]) << "point " << i;
    }
  }

  Convert() { lidar::fly(testing::small_farm(), scan_, {}); }

  std::string refusal(const std::filesystem::path& in, const std::string& out,
                      const ConvertOptions& options = {}) {
    return testing::message_of<InputError>([&] { convert(in, folder_.path() / out, options); });
  }
  std::ptrdiff_t files() const {
    return std::distance(std::filesystem::directory_iterator(folder_.path()), {});
  }

  testing::TemporaryFolder folder_;
  const std::filesystem::path scan_ = folder_.path() / "scan";
};

}  // namespace plotscan::record
