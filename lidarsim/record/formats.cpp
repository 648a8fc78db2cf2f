// SPDX-License-Identifier: Apache-2.0
#include "record/formats.h"

#include <algorithm>
#include <cctype>

#include "record/las_file.h"
#include "record/pcap_format.h"
#include "scan/cloud_writer.h"

namespace plotscan::record {
namespace {

using std::filesystem::path;

// PCD, PLY and LAS, by content.
Source open_cloud(const path& file, const std::optional<FlightRecord>& flight) {
  const scan::CloudInfo info = scan::read_cloud_info(file);
  return {.path = file, .info = info, .flight = flight, .stream = [=](const scan::PointSink& sink) {
            scan::read_points(file, info, sink);
          }};
}

scan::CloudWriteOptions cloud_options(const Source& source, const WriteOptions& options) {
  return {.ascii = options.encoding == "ascii", .origin_m = source.info.origin_m};
}

std::unique_ptr<scan::PointWriter> create_pcd(const path& file, const Source& source,
                                              const WriteOptions& options) {
  if (options.encoding == "compressed")
    return std::make_unique<scan::CompressedPcdWriter>(file, source.info.origin_m);
  return std::make_unique<scan::PcdWriter>(file, cloud_options(source, options));
}

std::unique_ptr<scan::PointWriter> create_ply(const path& file, const Source& source,
                                              const WriteOptions& options) {
  return std::make_unique<scan::PlyWriter>(file, cloud_options(source, options));
}

}  // namespace

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {
      {.name = "PCD cloud",
       .extensions = {".pcd"},
       .encodings = {"binary", "compressed", "ascii"},
       .open = open_cloud,
       .create = create_pcd},
      {.name = "PLY cloud",
       .extensions = {".ply"},
       .encodings = {"binary", "ascii"},
       .open = open_cloud,
       .create = create_ply},
      {.name = "LAS cloud",
       .extensions = {".las"},
       .has_crs = true,
       .open = open_cloud,
       .create = create_las},
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
