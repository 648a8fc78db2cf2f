// SPDX-License-Identifier: Apache-2.0
#include "core/output_file.h"

#include "core/error.h"
#include "core/text_file.h"

namespace plotscan {
namespace fs = std::filesystem;

OutputFile::OutputFile(const fs::path& final_path, bool replace)
    : final_(behind_link(fs::absolute(final_path))), temporary_(partial_path(final_)) {
  if (!final_path.has_filename()) throw InputError(final_path, "is no name of a file");
  std::error_code ignored;
  if (fs::is_directory(final_, ignored)) throw InputError(final_path, "is a folder");
  if (fs::exists(final_, ignored) && !replace)
    throw InputError(final_path, "exists; --force replaces it");
  if (!fs::is_directory(final_.parent_path(), ignored))
    throw InputError(final_path, "cannot be created: there is no such folder");
}

void OutputFile::commit() {
  std::error_code error;
  fs::rename(path(), final_, error);
  if (error) throw WriteError(final_, error.value());
}

void write_whole_file(const fs::path& path, std::string_view text) {
  OutputFile file(path, true);
  write_text_file(file.path(), text);
  file.commit();
}

}  // namespace plotscan
