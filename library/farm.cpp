// SPDX-License-Identifier: Apache-2.0
#include "plotscan/farm.h"

#include "boundary/guarded.h"
#include "boundary/values.h"
#include "core/data_folder.h"
#include "core/list_of.h"
#include "farm/summary.h"
#include "lidar/make_farm.h"
#include "score/score.h"

namespace plotscan {
namespace {

FarmSummary outer(const farm::Farm& made) {
  const farm::FarmSummary summary = farm::summarise(made);
  return {.name = made.name,
          .seed = made.seed,
          .plots = summary.plots,
          .plants = summary.plants,
          .weeds = summary.weeds,
          .field_size_m = {summary.field_size_m.x(), summary.field_size_m.y()},
          .plant_height_mean_m = summary.plant_height_m.mean,
          .plant_height_max_m = summary.plant_height_m.max,
          .leaf_area_index = summary.leaf_area_index};
}

}  // namespace

FarmSummary generate_farm(const std::filesystem::path& description,
                          const std::filesystem::path& folder, const FarmOptions& options,
                          const Progress& progress) {
  return boundary::guarded([&] {
    return outer(lidar::make_farm(found_or_shipped(description, "worlds"), folder,
                                  {.overrides = options.set,
                                   .seed = options.seed,
                                   .threads = boundary::threads_of(options.threads),
                                   .replace = options.replace},
                                  progress));
  });
}

std::vector<TruePlot> read_truth(const std::filesystem::path& farm) {
  return boundary::guarded([&] {
    return list_of(score::read_truth(farm), [](const score::TruePlot& plot) {
      return TruePlot{.id = plot.id.text(),
                      .trial = plot.trial,
                      .row = plot.row,
                      .column = plot.column,
                      .box = boundary::outer(plot.box),
                      .heights_m = plot.heights_m};
    });
  });
}

}  // namespace plotscan
