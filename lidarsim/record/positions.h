// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/cloud_files.h"
#include "scan/cloud_facts.h"
#include "scan/cloud_reader.h"

namespace plotscan::record {

// The functions of scan/cloud_reader.h and scan/cloud_facts.h, extended to recordings: pcap files
// of Velodyne sensors, bags and MCAP files. Each point is placed from where the sensor was at that
// instant; CloudFiles::recording adds what a file does not say (docs/formats.md). Only positions
// are passed on, so that an estimator cannot see labels. Either all files of a cloud are
// recordings, or none.

// Throws InputError as scan::read_positions does, on a broken recording, one whose poses are
// unknown, recordings mixed with clouds, and RecordingOptions that do not apply to the files.
scan::CloudSummary read_positions(const CloudFiles& cloud, const scan::PositionSink& sink,
                                  const scan::PositionOptions& options = {});

// As scan::expected_points; for recordings, estimated from the file's size.
double expected_points(const CloudFiles& cloud);

// As scan::read_cloud_system. A recording is in metres and names no coordinate system.
scan::CloudSystem read_cloud_system(const CloudFiles& cloud);

// As scan::read_cloud_facts.
scan::CloudFacts read_cloud_facts(const CloudFiles& cloud, const scan::PositionSink& sink);

}  // namespace plotscan::record
