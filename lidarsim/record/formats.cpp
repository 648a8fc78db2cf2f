// SPDX-License-Identifier: Apache-2.0
#include "record/formats.h"

#include <algorithm>
#include <cctype>

#include "record/pcap_format.h"
#include "scan/pcd_writer.h"

namespace plotscan::record {
namespace {

using std::filesystem::path;

// PCD and PLY, by content.
Source open_cloud(const path& file, const std::optional<FlightRecord>& flight) {
  const scan::CloudInfo info = scan::read_cloud_info(file);
  return {.path = file, .info = info, .flight = flight, .stream = [=](const scan::PointSink& sink) {
            scan::read_points(file, info, sink);
          }};
}

}  // namespace

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {
      {.name = "PCD cloud",
       .extensions = {".pcd"},
       .open = open_cloud,
       .create = [](const path& file, const Source&,
                    const WriteOptions&) { return std::make_unique<scan::PcdWriter>(file); }},
      {.name = "PLY cloud", .extensions = {".ply"}, .open = open_cloud},
#ifdef PLOTSCAN_HAVE_PCAP
      pcap_format(),
      pcapng_format(),
#endif
  };
  return all;
}

const Format* find_format(const path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : formats())
    if (std::ranges::count(format.extensions, extension) > 0) return &format;
  return nullptr;
}

}  // namespace plotscan::record
