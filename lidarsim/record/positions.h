// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/cloud_files.h"
#include "scan/cloud_facts.h"
#include "scan/cloud_reader.h"

namespace plotscan::record {

// What scan/cloud_reader.h and scan/cloud_facts.h read of clouds, of recordings as well: pcap of
// Velodyne sensors, bags and MCAP files, each point placed where the sensor was at its instant, by
// CloudFiles::recording (docs/formats.md). Nothing but positions is handed on, so that an estimator
// cannot see labels. All files of a cloud are recordings, or none.

// Throws InputError as scan::read_positions does, on a broken recording, one whose poses are not
// known, recordings beside clouds, and RecordingOptions that mean nothing for the files.
scan::CloudSummary read_positions(const CloudFiles& cloud, const scan::PositionSink& sink,
                                  const scan::PositionOptions& options = {});

// The same of scan::expected_points; of recordings, from their length.
double expected_points(const CloudFiles& cloud);

// The same of scan::read_cloud_system. A recording has metres and names no system.
scan::CloudSystem read_cloud_system(const CloudFiles& cloud);

// The same of scan::read_cloud_facts.
scan::CloudFacts read_cloud_facts(const CloudFiles& cloud, const scan::PositionSink& sink);

}  // namespace plotscan::record
