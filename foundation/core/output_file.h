// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "core/temporary_path.h"

namespace plotscan {

// An output file that appears whole or not at all: it is written beside its final place and renamed
// by commit(). Without commit() it leaves nothing behind.
class OutputFile {
 public:
  // Throws InputError when `final_path` exists and `replace` is not set, when it is a folder or has
  // no name, and when the folder that it is to lie in does not exist.
  OutputFile(const std::filesystem::path& final_path, bool replace);

  // Where to write until commit(); it has the final name's extension.
  const std::filesystem::path& path() const { return temporary_.path(); }
  // Throws WriteError when it cannot be renamed.
  void commit();

 private:
  std::filesystem::path final_;
  TemporaryPath temporary_;
};

// Writes a file that holds the text, whole or not at all, in place of one that is there. Throws
// WriteError when it cannot be written.
void write_whole_file(const std::filesystem::path& path, std::string_view text);

}  // namespace plotscan
