// SPDX-License-Identifier: Apache-2.0
#include "lidar/make_farm.h"

#include "farm/description.h"
#include "farm/generate.h"
#include "farm/write_farm.h"
#include "lidar/canopy_height.h"

namespace plotscan::lidar {

farm::Farm make_farm(const std::filesystem::path& description, const std::filesystem::path& folder,
                     const MakeFarmOptions& options, const ProgressReport& progress) {
  const farm::FarmDescription described = farm::load_description(description, options.overrides);
  farm::Farm made = farm::generate(described, options.seed.value_or(described.seed.value_or(1)));
  measure_canopies(made, options.threads);
  farm::write_farm(
      made, folder, options.replace,
      {.command = "farmgen generate",
       .options = {{"description", description.filename().string()}, {"set", options.overrides}},
       .inputs = farm::input_files(described)},
      progress);
  return made;
}

}  // namespace plotscan::lidar
