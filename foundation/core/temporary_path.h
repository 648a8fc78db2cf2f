// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace plotscan {

// A file or folder of unfinished work: removed when this object goes, and when the program is
// interrupted (Program watches for SIGINT and SIGTERM).
class TemporaryPath {
 public:
  // Creates nothing. If the path is hidden and its name has this process' number, removes what
  // killed runs left: paths that differ only in the number, which no living process has.
  explicit TemporaryPath(std::filesystem::path path);
  ~TemporaryPath();
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // Removes what every living TemporaryPath of the process names; to be called last, before the
  // process ends. Calls `halt`, which must stop all other threads, once no path can be added or
  // removed.
  static void remove_all(void (*halt)());

 private:
  std::filesystem::path path_;
};

// The path to which this process writes until the work becomes `final_path`: a hidden one beside
// it, with its extension.
std::filesystem::path partial_path(const std::filesystem::path& final_path);

// Where a link leads; other paths stay.
std::filesystem::path behind_link(const std::filesystem::path& path);

// The inverse of partial_path, for a partial path of this process and what lies in it; other paths
// stay. Errors name files this way: a writer knows only the partial path, the user only the final
// one.
std::filesystem::path shown_path(const std::filesystem::path& path);

}  // namespace plotscan
