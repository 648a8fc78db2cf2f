// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace plotscan::testing {

// A point as a reader of others took it from a cloud's message.
struct ReadPoint {
  double cloud, x, y, z, intensity, ring, time, return_number, return_count, label, plot, plant;
};

// A bag or an MCAP file as readers of others see it (tests/readers).
struct ReadFile {
  nlohmann::json document;
  std::vector<ReadPoint> points;

  std::vector<nlohmann::json> messages(const std::string& topic) const {
    std::vector<nlohmann::json> found;
    for (const auto& message : document["messages"])
      if (message["topic"] == topic) found.push_back(message);
    return found;
  }
};

inline std::filesystem::path readers_folder() {
  return std::filesystem::path(PLOTSCAN_SOURCE_DIR) / "tests/readers";
}

inline bool succeeds(const std::string& command) { return std::system(command.c_str()) == 0; }

// Why the reader of a kind of file cannot run here; "" when it can.
inline std::string why_no_reader(const std::string& extension) {
  if (extension == ".bag") {
    if (succeeds("/usr/bin/python3 -c 'import rosbag, sensor_msgs.point_cloud2' 2>/dev/null"))
      return "";
    return "Debian's python3-rosbag and python3-sensor-msgs are not installed (scripts/setup)";
  }
  if (std::filesystem::exists(readers_folder() / "node_modules/@mcap/core") &&
      succeeds("node --version >/dev/null 2>&1"))
    return "";
  return "node or the packages of tests/readers are not installed (scripts/setup)";
}

inline ReadFile read_by_others(const std::filesystem::path& file) {
  const std::string reader =
      file.extension() == ".bag"
          ? "/usr/bin/python3 '" + (readers_folder() / "read_bag.py").string()
          : "node '" + (readers_folder() / "read_mcap.mjs").string();
  const std::string out = file.string() + ".read";
  EXPECT_TRUE(succeeds(reader + "' '" + file.string() + "' '" + out + "'"));
  ReadFile read;
  std::ifstream(out + ".json") >> read.document;
  read.points.resize(std::filesystem::file_size(out + ".points") / sizeof(ReadPoint));
  std::ifstream(out + ".points", std::ios::binary)
      .read(reinterpret_cast<char*>(read.points.data()),
            static_cast<std::streamsize>(read.points.size() * sizeof(ReadPoint)));
  return read;
}

}  // namespace plotscan::testing
