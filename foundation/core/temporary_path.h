// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace plotscan {

// A file or folder of unfinished work: removed when this object goes, and when the program is
// interrupted (Program watches for SIGINT and SIGTERM).
class TemporaryPath {
 public:
  // Creates nothing. Where the path is hidden and has this process' number in its name, removes
  // what a killed run left of the same work: what differs in that number alone, which is no living
  // process' number.
  explicit TemporaryPath(std::filesystem::path path);
  ~TemporaryPath();
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // Removes what every living TemporaryPath of the process names: the last thing before the process
  // ends. `halt` is called when no path comes or goes any more; it sees to it that no other thread
  // runs on.
  static void remove_all(void (*halt)());

 private:
  std::filesystem::path path_;
};

// Where this process writes what becomes `final_path`: hidden, beside it, with its extension.
std::filesystem::path partial_path(const std::filesystem::path& final_path);

// The way back, for a partial path of this process and what lies in it; other paths stay. Errors
// name files so: who writes one knows its partial path alone, and the user only the final one.
std::filesystem::path shown_path(const std::filesystem::path& path);

}  // namespace plotscan
