// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "core/temporary_path.h"

namespace plotscan {

// An output folder that appears whole or not at all: it is written beside its final place and
// renamed by commit(). Without commit() it leaves nothing behind.
class OutputFolder {
 public:
  // Throws InputError when `final_path` exists and is not an empty folder, unless `replace` is set
  // and the same command wrote it (its manifest.json says so): the folder that a command reads is
  // thus never replaced by what the command writes. Throws InputError when its parent cannot be
  // written.
  OutputFolder(const std::filesystem::path& final_path, bool replace, const std::string& command);

  // Where to write until commit().
  const std::filesystem::path& path() const { return temporary_.path(); }
  void commit();

 private:
  std::filesystem::path final_;
  TemporaryPath temporary_;
};

// Throws InputError unless the folder may hold the output of `command`: it is absent, empty, or was
// written by the same command.
void require_own_folder(const std::filesystem::path& folder, const std::string& command);

}  // namespace plotscan
