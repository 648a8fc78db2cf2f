// SPDX-License-Identifier: Apache-2.0
#include "plotscan/flight.h"

#include "boundary/guarded.h"
#include "boundary/settings.h"
#include "boundary/values.h"
#include "core/data_folder.h"
#include "lidar/fly_place.h"
#include "lidar/fly_settings.h"

namespace plotscan {
namespace {

lidar::FlyPlaceOptions inner(const FlightOptions& options) {
  lidar::FlyPlaceOptions made{.resource_paths = options.resource_paths};
  boundary::take("the flight", options.settings, lidar::fly_settings(), made.flight);
  made.flight.flight = options.trajectory;
  made.flight.waypoints = options.waypoints;
  made.flight.formats = options.formats;
  made.flight.seed = options.seed;
  made.flight.threads = boundary::threads_of(options.threads);
  made.flight.replace = options.replace;
  return made;
}

}  // namespace

std::vector<Setting> flight_settings() {
  return boundary::outer(lidar::fly_settings(), lidar::FlyOptions{});
}

FlightSummary fly(const std::filesystem::path& place, const std::filesystem::path& folder,
                  const FlightOptions& options, const Progress& progress) {
  return boundary::guarded([&]() -> FlightSummary {
    lidar::PlaceScan scanned =
        lidar::fly_place(found_place(place, "worlds"), folder, inner(options), progress);
    return {.shots = scanned.summary.shots,
            .points = scanned.summary.points,
            .duration_s = scanned.summary.duration_s,
            .notes = std::move(scanned.notes)};
  });
}

}  // namespace plotscan
