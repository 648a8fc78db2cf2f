// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace plotscan::scan {

// What a file is that people take for a cloud but that is not read, by its first bytes, and what
// helps: "a zip archive: unpack it". "" for all others.
std::string_view foreign_file(std::string_view start);

}  // namespace plotscan::scan
