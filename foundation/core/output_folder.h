// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/temporary_path.h"

namespace plotscan {

// An output folder that appears whole or not at all: it is written beside its final place (where a
// link leads) and renamed by commit(). Without commit() it leaves nothing behind.
class OutputFolder {
 public:
  // `inputs`: files and folders that the command reads; a folder's manifest.json stands for the
  // folder. Throws InputError
  // - when `final_path` exists and is not an empty folder, unless `replace` is set, `command`
  //   wrote it (its manifest.json says so), and it holds no file that the manifest does not list;
  // - when it is one of the inputs, lies in one, or has one below it;
  // - when its parent cannot be written; WriteError where the disk is full, read only or broken.
  OutputFolder(const std::filesystem::path& final_path, bool replace, const std::string& command,
               std::span<const std::filesystem::path> inputs = {});

  // Where to write until commit().
  const std::filesystem::path& path() const { return temporary_.path(); }
  // Throws InputError when foreign files have come into the old folder meanwhile, and WriteError
  // when the new one cannot be renamed.
  void commit();

 private:
  std::filesystem::path final_;
  std::string command_;
  TemporaryPath temporary_;
};

// Throws InputError unless the folder may hold the output of `command`: it is absent, empty, or was
// written by the same command.
void require_own_folder(const std::filesystem::path& folder, const std::string& command);

// As require_own_folder, for a folder that is to be replaced as a whole: it must also hold no file
// that its manifest does not list.
void require_replaceable_folder(const std::filesystem::path& folder, const std::string& command);

// Throws InputError when `output` is one of the inputs, lies in one, or has one below it.
void require_apart(const std::filesystem::path& output,
                   std::span<const std::filesystem::path> inputs);

}  // namespace plotscan
