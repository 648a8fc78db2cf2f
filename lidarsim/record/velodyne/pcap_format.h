// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "record/recording/format.h"

namespace plotscan::record {

// Recordings of Velodyne sensors, for formats(); only where libpcap was there to build with.
Format pcap_format();
// The same as newer recorders write them; only read.
Format pcapng_format();

}  // namespace plotscan::record
