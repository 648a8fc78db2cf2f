// SPDX-License-Identifier: Apache-2.0
// Puts large memory blocks on huge pages if the system gives these on request ("madvise" in
// /sys/kernel/mm/transparent_hugepage/enabled): the kernel then maps 2 MiB per page fault instead
// of 4 KiB, and the processor translates addresses faster. Linked into the programs only, as it
// replaces operator new of the whole process; docs/performance.md states the gain.
#include <cstddef>
#include <cstdlib>
#include <new>

#include <sys/mman.h>

namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::size_t kLarge = 2 * kHugePage;  // smaller blocks would be rounded up by too much

// Null when there is no memory left.
void* block_of(std::size_t size) {
  if (size < kLarge) return std::malloc(size > 0 ? size : 1);
  const std::size_t whole_pages = (size + kHugePage - 1) & ~(kHugePage - 1);
  if (whole_pages < size) return nullptr;
  void* block = std::aligned_alloc(kHugePage, whole_pages);
  if (block != nullptr) madvise(block, whole_pages, MADV_HUGEPAGE);  // if refused: usual pages
  return block;
}

}  // namespace

void* operator new(std::size_t size) {
  for (;;) {
    if (void* block = block_of(size)) return block;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* block) noexcept { std::free(block); }

void operator delete(void* block, std::size_t) noexcept { std::free(block); }
