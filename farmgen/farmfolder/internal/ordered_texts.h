// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace plotscan::farmfolder {

// Makes `count` texts on up to `threads` threads and passes them to `take` in the order of their
// numbers. Holds only a few texts per thread. Exceptions of `make` and `take` pass through.
void make_in_order(std::size_t count, int threads,
                   const std::function<std::string(std::size_t number)>& make,
                   const std::function<void(std::size_t number, const std::string& text)>& take);

}  // namespace plotscan::farmfolder
