// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "plotscan/error.h"
#include "plotscan/export.h"

namespace plotscan {

// "major.minor.patch".
PLOTSCAN_API std::string library_version();

// The folder of the data that Plotscan ships: worlds/, models/, benchmarks/suites/. It is the
// folder that the environment variable PLOTSCAN_DATA names, else share/plotscan under the library's
// install folder. Throws BadInput where neither exists.
PLOTSCAN_API std::filesystem::path shipped_data();

}  // namespace plotscan
