// SPDX-License-Identifier: Apache-2.0
#include "core/cloud_files.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <utility>

#include "core/contains.h"
#include "core/error.h"
#include "core/text.h"

namespace plotscan {
namespace fs = std::filesystem;
namespace {

bool is_cloud(const fs::path& file) {
  // Text by other names, .txt and .csv, may be anything.
  static constexpr std::array kExtensions = {".las", ".laz", ".pcd", ".ply",
                                             ".xyz", ".asc", ".pts"};
  return contains(kExtensions, lower_extension(file));
}

std::vector<fs::path> tiles_of(const fs::path& folder) {
  std::vector<fs::path> tiles;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && is_cloud(entry.path())) tiles.push_back(entry.path());
  if (tiles.empty())
    throw InputError(folder,
                     "is neither a scan folder nor one with clouds in it (.las, .pcd, ...)");
  std::ranges::sort(tiles);
  return tiles;
}

}  // namespace

CloudFiles::CloudFiles(fs::path file) : files{std::move(file)} {}

CloudFiles::CloudFiles(std::vector<fs::path> several) : files(std::move(several)) {}

std::string CloudFiles::name() const {
  if (files.empty()) return "the cloud";
  const std::string first = files.front().string();
  return files.size() == 1 ? first : first + " and " + std::to_string(files.size() - 1) + " more";
}

std::vector<fs::path> cloud_files_of(const std::vector<fs::path>& paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    if (fs::is_regular_file(path / "cloud.pcd")) {
      files.push_back(path / "cloud.pcd");
    } else if (fs::is_directory(path)) {
      std::ranges::move(tiles_of(path), std::back_inserter(files));
    } else {
      require_file(path);
      files.push_back(path);
    }
  }
  std::set<fs::path> met;
  for (const fs::path& file : files)
    if (!met.insert(fs::canonical(file)).second) throw InputError(file, "is given twice");
  return files;
}

}  // namespace plotscan
