// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/yaml_section.h"
#include "lidar/fly_settings.h"

// A suite's flights, with the options that lidarsim has. Internal to .cpp files, as YamlSection is.
namespace plotscan::farmbench {

// Sets one option of a flight to the section's value at its key. Throws InputError as the section's
// readers do.
void read_fly_setting(const YamlSection& section, const lidar::FlySetting& setting,
                      lidar::FlyOptions& flight);

// The flight with what the parent's section "flight" replaces in it. Throws as above.
lidar::FlyOptions read_flight(const YamlSection& parent, lidar::FlyOptions flight);

}  // namespace plotscan::farmbench
