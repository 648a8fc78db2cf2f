// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>

namespace plotscan {

// Whether an error, as in errno, says that there is no room: a disk, a quota or a limit of files'
// sizes is reached.
inline bool is_full(int error) { return error == ENOSPC || error == EDQUOT || error == EFBIG; }

// Whether it says that the disk is full, read only or broken: nothing is wrong with the input.
inline bool is_of_disk(int error) { return is_full(error) || error == EROFS || error == EIO; }

}  // namespace plotscan
