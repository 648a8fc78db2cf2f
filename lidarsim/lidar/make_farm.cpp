// SPDX-License-Identifier: Apache-2.0
#include "lidar/make_farm.h"

#include "core/stage.h"
#include "description/load_description.h"
#include "farmfolder/write_farm.h"
#include "lidar/canopy_height.h"
#include "planting/generate.h"

namespace plotscan::lidar {
namespace {

planting::FarmDescription read_description(const std::filesystem::path& description,
                                           const std::vector<std::string>& overrides) {
  const Stage stage("description");
  return description::load_description(description, overrides);
}

}  // namespace

farm::Farm make_farm(const std::filesystem::path& description, const std::filesystem::path& folder,
                     const MakeFarmOptions& options, const ProgressReport& progress) {
  const planting::FarmDescription described = read_description(description, options.overrides);
  farm::Farm made =
      planting::generate(described, options.seed.value_or(described.seed.value_or(1)));
  measure_canopies(made, options.threads);
  farmfolder::write_farm(
      made, folder,
      {.command = options.command,
       .options = {{"description", description.filename().string()}, {"set", options.overrides}},
       .inputs = planting::input_files(described)},
      {.replace = options.replace, .threads = options.threads, .description = description},
      progress);
  return made;
}

}  // namespace plotscan::lidar
