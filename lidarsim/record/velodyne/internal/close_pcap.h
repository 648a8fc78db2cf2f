// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pcap/pcap.h>

namespace plotscan::record {

// Deleter of libpcap's handles, for std::unique_ptr.
struct ClosePcap {
  void operator()(pcap_t* pcap) const { pcap_close(pcap); }
  void operator()(pcap_dumper_t* file) const { pcap_dump_close(file); }
};

}  // namespace plotscan::record
