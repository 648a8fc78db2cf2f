// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace plotscan {

// Makes `count` texts on up to `threads` threads and hands them on in their order, number by
// number. A few texts a thread are held at a time. What `make` and `take` throw is thrown.
void make_in_order(std::size_t count, int threads,
                   const std::function<std::string(std::size_t number)>& make,
                   const std::function<void(std::size_t number, const std::string& text)>& take);

}  // namespace plotscan
