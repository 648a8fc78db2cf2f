// SPDX-License-Identifier: Apache-2.0
// libFuzzer's entry points, for the target that the environment variable FUZZ_TARGET names.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>

#include <unistd.h>

#include "fuzz/mutate.h"
#include "fuzz/targets.h"

namespace {

using plotscan::fuzz::Target;
namespace fs = std::filesystem;

const Target& target() {
  static const Target& chosen = []() -> const Target& {
    const char* name = std::getenv("FUZZ_TARGET");
    const auto& all = plotscan::fuzz::targets();
    const auto found = std::ranges::find(all, name == nullptr ? "" : name, &Target::name);
    if (found == all.end()) {
      std::cerr << "FUZZ_TARGET is one of";
      for (const Target& one : all) std::cerr << ' ' << one.name;
      std::cerr << '\n';
      std::exit(2);
    }
    return *found;
  }();
  return chosen;
}

// In memory; gone with the process.
struct Folder {
  fs::path path = fs::path("/dev/shm") / ("plotscan-fuzz-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  target();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  plotscan::fuzz::is_read(target(), std::string(reinterpret_cast<const char*>(data), size),
                          folder.path);
  return 0;
}

// Three of four mutants of a tree are trees; the others are for its parser.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned int seed) {
  if (seed % 4 != 0) {
    const auto changed = plotscan::fuzz::mutated(
        target().structure, std::string(reinterpret_cast<const char*>(data), size), seed / 4);
    if (changed && changed->size() <= most && !changed->empty()) {
      std::memcpy(data, changed->data(), changed->size());
      return changed->size();
    }
  }
  return LLVMFuzzerMutate(data, size, most);
}
