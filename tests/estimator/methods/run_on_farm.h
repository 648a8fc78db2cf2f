// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "estimator/synthetic_farm.h"
#include "methods/run.h"
#include "temporary_folder.h"

namespace plotscan::testing {

// A binary PCD written by the test, with labels that an estimator must not need.
inline std::filesystem::path write_cloud(const std::filesystem::path& file,
                                         const std::vector<Eigen::Vector3d>& points) {
  const std::string count = std::to_string(points.size());
  std::string body = "VERSION 0.7\nFIELDS x y z plot\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n";
  body +=
      "WIDTH " + count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3f xyz = point.cast<float>();
    const std::uint32_t label = 7;
    char record[16];
    std::memcpy(record, xyz.data(), 12);
    std::memcpy(record + 12, &label, 4);
    body.append(record, sizeof record);
  }
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << body;
  return file;
}

inline methods::RunOptions small_run(const TemporaryFolder& folder, const SyntheticFarm& farm) {
  methods::RunOptions options{
      .cloud = write_cloud(folder.path() / "scan" / "cloud.pcd", farm.points()),
      .output = folder.path() / "estimate"};
  options.method = "dhami2020";
  options.dhami2020.plots = 8;
  return options;
}

inline const SyntheticFarm kFarm{.rows = 2, .columns = 4};

}  // namespace plotscan::testing
