// SPDX-License-Identifier: Apache-2.0
#include "record/scan_formats.h"

#include "core/contains.h"
#include "core/error.h"
#include "core/text.h"
#include "record/convert.h"
#include "record/formats.h"

namespace plotscan::record {
namespace {

const Format& format_of(const std::string& name) {
  for (const Format& format : formats()) {
    if (format.create && contains(format.extensions, "." + name)) return format;
  }
  throw InputError("--format \"" + name + "\" must be one of pcd, " +
                   joined(further_formats(), ", "));
}

}  // namespace

std::vector<std::string> further_formats() {
  std::vector<std::string> names;
  for (const std::string& extension :
       extensions_of([](const Format& format) { return format.create != nullptr; })) {
    if (extension != ".pcd") names.push_back(extension.substr(1));
  }
  return names;
}

void require_formats(const std::vector<std::string>& formats, const sensor::Sensor& sensor) {
  for (const std::string& name : formats) {
    if (format_of(name).needs_packets && !sensor.packets) {
      throw InputError("--format " + name + ": sensor " + sensor.name +
                       " sends no Velodyne packets (its description has no `packets`)");
    }
  }
}

void finish_scan(const std::filesystem::path& scan_folder, const Manifest& manifest,
                 const std::vector<std::string>& formats) {
  write_manifest(scan_folder, manifest);
  if (formats.empty()) return;
  for (const std::string& name : formats) {
    const std::string stem = format_of(name).needs_flight ? "flight." : "cloud.";
    if (name != "pcd") convert_within(scan_folder, scan_folder / (stem + name), {.replace = true});
  }
  write_manifest(scan_folder, manifest);
}

}  // namespace plotscan::record
