// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <sys/syscall.h>
#include <unistd.h>

namespace plotscan {

// Calls `visit` with the name of each entry of an open folder, "." and ".." left out. Allocates
// nothing and takes no lock, unlike the standard library's iterators.
template <class Visit>
void for_each_name(int folder, Visit&& visit) {
  // The kernel's layout of an entry: inode (8 bytes), offset (8), length (2), kind (1), name.
  constexpr std::size_t kLength = 16;
  constexpr std::size_t kName = 19;
  alignas(8) std::array<char, 2048> entries;
  for (;;) {
    const long bytes = syscall(SYS_getdents64, folder, entries.data(), entries.size());
    if (bytes <= 0) return;
    for (long at = 0; at < bytes;) {
      const char* entry = entries.data() + at;
      std::uint16_t length = 0;
      std::memcpy(&length, entry + kLength, sizeof length);
      const char* name = entry + kName;
      if (std::strcmp(name, ".") != 0 && std::strcmp(name, "..") != 0) visit(name);
      at += length;
    }
  }
}

// Removes a file, a link, or a folder with all below it, with `name` relative to an open folder (or
// AT_FDCWD); what cannot be removed stays. Allocates nothing and takes no lock.
void remove_tree(int folder, const char* name);

}  // namespace plotscan
