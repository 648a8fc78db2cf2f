// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "plotscan/error.h"
#include "plotscan/export.h"

namespace plotscan {

// "major.minor.patch".
PLOTSCAN_API std::string library_version();

// The folder of the data that Plotscan ships: worlds/, models/, benchmarks/suites/; what the
// environment variable PLOTSCAN_DATA names, else share/plotscan of the folder that the library was
// installed to. Throws BadInput where there is none.
PLOTSCAN_API std::filesystem::path shipped_data();

}  // namespace plotscan
