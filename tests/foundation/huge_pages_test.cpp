// SPDX-License-Identifier: Apache-2.0
// The programs' operator new, as the kernel sees what it gives.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <string>

#include <gtest/gtest.h>

namespace plotscan {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;

// Whether the mapping that holds the address was marked for huge pages ("hg", proc(5)).
bool is_marked(const void* address) {
  std::ifstream maps("/proc/self/smaps");
  const auto wanted = reinterpret_cast<std::uintptr_t>(address);  // NOLINT(*-reinterpret-cast)
  bool here = false;
  for (std::string line; std::getline(maps, line);) {
    std::size_t used = 0;
    const std::size_t dash = line.find('-');
    if (dash != std::string::npos && dash < 17 && line.find(':') > dash) {
      const std::uintptr_t begin = std::stoull(line, &used, 16);
      const std::uintptr_t end = std::stoull(line.substr(dash + 1), &used, 16);
      here = begin <= wanted && wanted < end;
    } else if (here && line.starts_with("VmFlags:")) {
      return line.find(" hg") != std::string::npos;
    }
  }
  return false;
}

TEST(HugePages, LargeBlocksAreMarkedAndAligned) {
  if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage"))
    GTEST_SKIP() << "a kernel without huge pages on request";
  for (const std::size_t size : {2 * kHugePage, 5 * kHugePage + 1, 40 * kHugePage}) {
    const std::unique_ptr<char[]> block(new char[size]);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block.get()) % kHugePage, 0u);  // NOLINT
    EXPECT_TRUE(is_marked(block.get())) << size;
    EXPECT_TRUE(is_marked(block.get() + size - 1)) << size;
    block[size - 1] = 1;
  }
}

TEST(HugePages, SmallBlocksAreNot) {
  const std::unique_ptr<char[]> block(new char[kHugePage]);
  EXPECT_FALSE(is_marked(block.get()));
  delete new char;
  ::operator delete(::operator new(0));
}

TEST(HugePages, TooMuchIsBadAlloc) {
  for (const std::size_t size : {std::numeric_limits<std::size_t>::max(),
                                 std::numeric_limits<std::size_t>::max() - kHugePage,
                                 std::numeric_limits<std::size_t>::max() / 4})
    EXPECT_THROW(::operator delete(::operator new(size)), std::bad_alloc) << size;
}

TEST(HugePages, ANewHandlerIsAskedFirst) {
  static int asked = 0;
  std::set_new_handler([] {
    if (++asked == 3) std::set_new_handler(nullptr);
  });
  EXPECT_THROW(::operator delete(::operator new(std::numeric_limits<std::size_t>::max() / 4)),
               std::bad_alloc);
  EXPECT_EQ(asked, 3);
}

}  // namespace
}  // namespace plotscan
