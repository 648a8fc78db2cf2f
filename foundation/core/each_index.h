// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace plotscan {

// Calls body(i) for every i below `count`, in any order, on so many threads.
template <class Body>
void for_each_index(std::size_t count, int threads, const Body& body) {
  tbb::task_arena arena(threads);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, body); });
}

}  // namespace plotscan
