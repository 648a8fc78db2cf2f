// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/internal/layout_doubts.h"

#include <fmt/core.h>

namespace plotscan::methods::lattice {
namespace {

// Blocks of plots that touch look like plots whose rows run across them: those of a plot run along
// its length, and are few.
bool are_blocks(const plots::FieldFit& fit) {
  constexpr int kMostOfPlot = 6;  // the most rows that plots are usually sown in; chosen
  return fit.sown_rows && fit.sown_rows->across && fit.sown_rows->rows > kMostOfPlot;
}

// Plots may be sown in one row each. As narrow and as near to each other are the rows of larger
// plots.
bool may_be_rows(const plots::FieldFit& fit) {
  constexpr double kMostSpacing_m = 1.2, kLeastAspect = 3;  // of crop rows, as in plots/layout
  const TrialLayout& layout = fit.layout;
  return !fit.sown_rows && layout.column_pitch_m > 0 && layout.column_pitch_m <= kMostSpacing_m &&
         layout.length_m > kLeastAspect * layout.width_m;
}

}  // namespace

std::vector<std::string> doubts_of(const plots::FieldFit& fit, bool stated) {
  std::vector<std::string> doubts;
  if (are_blocks(fit))
    doubts.push_back(
        fmt::format("{} rows of the crop run across it, as of several plots side by side",
                    fit.sown_rows->rows));
  if (!stated && may_be_rows(fit))
    doubts.emplace_back("may be one row of a plot: rows of crops lie as near to each other");
  return doubts;
}

}  // namespace plotscan::methods::lattice
