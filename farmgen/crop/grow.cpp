// SPDX-License-Identifier: Apache-2.0
#include "crop/grow.h"

#include "crop/soybean.h"

#include "core/error.h"

namespace plotscan::crop {

std::vector<std::string> crops() { return {"soybean"}; }

std::vector<std::string> stages(const std::string&) { return {"R2"}; }

mesh::Mesh grow(const GrowOptions& options, std::uint64_t seed) {
  if (options.crop != "soybean") throw InputError("crop " + options.crop + " is not known");
  const mesh::Mesh mesh = soybean(soybean_options(options.assignments), seed);
  return options.detail == Detail::scan ? mesh : mesh::simplified(mesh, 300);
}

}  // namespace plotscan::crop
