// SPDX-License-Identifier: Apache-2.0
// Large blocks lie on huge pages where the system gives them on request ("madvise" in
// /sys/kernel/mm/transparent_hugepage/enabled): the kernel then maps 2 MiB at a fault in place of
// 4 KiB, and the processor finds addresses faster. Part of the programs alone, as it replaces
// operator new of the whole process; docs/performance.md says what it is worth.
#include <cstddef>
#include <cstdlib>
#include <new>

#include <sys/mman.h>

namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::size_t kLarge = 2 * kHugePage;  // less would be rounded up by too much

// Null where there is no memory.
void* block_of(std::size_t size) {
  if (size < kLarge) return std::malloc(size > 0 ? size : 1);
  const std::size_t whole_pages = (size + kHugePage - 1) & ~(kHugePage - 1);
  if (whole_pages < size) return nullptr;
  void* block = std::aligned_alloc(kHugePage, whole_pages);
  if (block != nullptr) madvise(block, whole_pages, MADV_HUGEPAGE);  // refused: usual pages
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
