// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>

namespace plotscan {

// Whether an errno means no room: a full disk, a quota or a limit on file sizes is reached.
inline bool is_full(int error) { return error == ENOSPC || error == EDQUOT || error == EFBIG; }

// Whether an errno means that the disk is full, read only or broken, so that the input is not to
// blame.
inline bool is_of_disk(int error) { return is_full(error) || error == EROFS || error == EIO; }

}  // namespace plotscan
