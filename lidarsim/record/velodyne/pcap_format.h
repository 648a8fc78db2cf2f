// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "record/recording/format.h"

namespace plotscan::record {

// The format of pcap recordings of Velodyne sensors, for formats(). Only in builds with libpcap.
Format pcap_format();
// The same for pcapng, which newer recorders write. It is only read.
Format pcapng_format();

}  // namespace plotscan::record
