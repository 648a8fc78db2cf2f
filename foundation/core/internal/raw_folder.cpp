// SPDX-License-Identifier: Apache-2.0
#include "core/internal/raw_folder.h"

#include <fcntl.h>

namespace plotscan {

void remove_tree(int folder, const char* name) {
  if (unlinkat(folder, name, 0) == 0) return;
  const int opened = openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (opened < 0) return;
  // Removing entries may hide others from the listing, so passes repeat until nothing more can be
  // removed. Their number is limited in case somebody keeps writing into the folder.
  constexpr int kMostPasses = 100;
  bool gone = true;
  for (int pass = 0; gone && pass < kMostPasses; ++pass) {
    gone = false;
    lseek(opened, 0, SEEK_SET);
    for_each_name(opened, [&](const char* entry) {
      remove_tree(opened, entry);
      gone = gone || faccessat(opened, entry, F_OK, AT_SYMLINK_NOFOLLOW) != 0;
    });
  }
  close(opened);
  unlinkat(folder, name, AT_REMOVEDIR);
}

}  // namespace plotscan
