// SPDX-License-Identifier: Apache-2.0
#include "estimate/internal/gdal.h"

#include <stdexcept>

#include <dlfcn.h>

namespace plotscan::estimate {
namespace {

struct Gdal {
  void* library;
  std::string why_not;
};

// Never unloaded: it keeps threads and memory of its own until the end.
const Gdal& gdal() {
  static const Gdal gdal = [] {
    void* const library = dlopen(PLOTSCAN_GDAL_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
    return Gdal{library, library == nullptr ? dlerror() : ""};
  }();
  return gdal;
}

}  // namespace

std::string gdal_missing() { return gdal().why_not; }

void* gdal_function(const char* name) {
  if (void* const function = dlsym(gdal().library, name)) return function;
  throw std::logic_error(std::string("GDAL has no function ") + name);
}

}  // namespace plotscan::estimate
