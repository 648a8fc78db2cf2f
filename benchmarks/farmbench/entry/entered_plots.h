// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "estimate/estimate.h"
#include "farmbench/entry/problems.h"
#include "score/score.h"

namespace plotscan::farmbench {

// A field's plots as an entrant's file states them.
struct EnteredPlots {
  std::vector<estimate::PlotEstimate> plots = {};  // without boxes where these are not stated
  std::vector<std::string> places = {};            // of each, for messages: "3fa2.csv:4"
  bool boxes_stated = true;                        // else each plot's id names a given box
};

// Reads a CSV table or GeoJSON (docs/submissions.md); the file's first character decides which.
// Whatever is wrong with the file goes to `problems`; what remains is returned.
EnteredPlots read_entered_plots(const std::filesystem::path& file, Problems& problems);

// Gives plots without boxes the boxes of the scored true plots with the same ids; unknown ids are
// problems.
void take_boxes(EnteredPlots& entered, const std::vector<score::TruePlot>& truth,
                Problems& problems);

// Whether it is 1 to 40 letters, digits, '-' and '_', so that tables can hold it.
bool is_table_name(const std::string& name);

}  // namespace plotscan::farmbench
