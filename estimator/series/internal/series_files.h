// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "series/series.h"

namespace plotscan::series {

// Writes series.csv, by_date.csv, by_date.geojson and growth.csv (docs/series.md) into an existing
// folder; all but the first are of one height. Throws WriteError where they cannot be written.
void write_series(const std::filesystem::path& folder, const Series& series,
                  const std::string& height);

}  // namespace plotscan::series
