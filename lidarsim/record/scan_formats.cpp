// SPDX-License-Identifier: Apache-2.0
#include "record/scan_formats.h"

#include "core/error.h"
#include "core/text.h"
#include "record/convert.h"
#include "record/formats.h"

namespace plotscan::record {
namespace {

const Format& format_of(const std::string& name) {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (!format.create) continue;
    if (format.extensions.front() == "." + name) return format;
    names.push_back(format.extensions.front().substr(1));
  }
  throw InputError("--format \"" + name + "\" must be one of " + joined(names, ", "));
}

}  // namespace

void require_formats(const std::vector<std::string>& formats, const sensor::Sensor& sensor) {
  for (const std::string& name : formats) {
    if (format_of(name).needs_packets && !sensor.packets) {
      throw InputError("--format " + name + ": sensor " + sensor.name +
                       " sends no Velodyne packets (its description has no `packets`)");
    }
  }
}

void write_formats(const std::vector<std::string>& formats,
                   const std::filesystem::path& scan_folder) {
  for (const std::string& name : formats) {
    const std::string stem = format_of(name).needs_flight ? "flight." : "cloud.";
    if (name != "pcd") convert_within(scan_folder, scan_folder / (stem + name), {.replace = true});
  }
}

}  // namespace plotscan::record
