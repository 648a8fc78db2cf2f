// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace plotscan {

// An output folder that appears whole or not at all: it is written beside its final place and
// renamed by commit(). Destroyed without commit(), it leaves nothing behind.
class OutputFolder {
 public:
  // Throws InputError when `final_path` exists and is not an empty folder, unless `replace` is set
  // and the folder is one of Plotscan's own (it has a manifest.json); when its parent cannot be
  // written.
  OutputFolder(const std::filesystem::path& final_path, bool replace);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  // Where to write until commit().
  const std::filesystem::path& path() const { return temporary_; }
  void commit();

 private:
  std::filesystem::path final_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

}  // namespace plotscan
