// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace plotscan {

// A file or folder of unfinished work: removed when this object goes, and when the program is
// interrupted (Program watches for SIGINT and SIGTERM).
class TemporaryPath {
 public:
  // Creates nothing.
  explicit TemporaryPath(std::filesystem::path path);
  ~TemporaryPath();
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // Removes what every living TemporaryPath of the process names: the last thing before the process
  // ends.
  static void remove_all();

 private:
  std::filesystem::path path_;
};

// Where this process writes what becomes `final_path`: hidden, beside it, with its extension.
std::filesystem::path partial_path(const std::filesystem::path& final_path);

}  // namespace plotscan
