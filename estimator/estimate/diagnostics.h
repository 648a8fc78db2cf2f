// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/plot_id.h"

namespace plotscan::estimate {

// Why a point of a cloud was not used.
enum class Unused {
  not_finite,
  marked,    // withheld or noise
  left_out,  // of a class that was to be left out
  outside,
  repeated,
  thinned,
  outliers,       // neither ground nor crop
  without_ground  // of those in the area
};

// What became of a cloud's points.
struct PointAccount {
  std::uint64_t read = 0;
  std::uint64_t in_area = 0;
  std::map<Unused, std::uint64_t> unused = {};  // by the reasons that the method tells apart
  std::array<double, 4> area_m = {};            // x0, y0, x1, y1, in the cloud's frame
};

// "25408 read = 25131 used + 25 withheld or noise + 252 outside the field". What is 0 is not named.
std::string text_of(const PointAccount& points);

// How well a cloud shows its ground.
struct GroundFacts {
  double cell_m = 0;         // of its grid
  std::size_t nodes = 0;     // of the grid, with ground within reach
  double seen_share = 0;     // of these nodes
  double unknown_share = 0;  // of the grid, without ground
  double noise_m = 0;        // sigma of the points' heights
};

// A map of plots that was given (--boxes).
struct GivenBoxes {
  std::size_t plots = 0;
  std::string id_property;
  bool from_degrees = false;  // converted to the cloud's coordinates
};

// A table of names that was given (--plot-names).
struct GivenNames {
  std::size_t plots = 0;
  std::string id_property;
  std::vector<PlotId> not_found = {};
};

// Heights of a trial that were scaled to agree with measured ones.
struct Agreed {
  std::string height;     // "mean"
  int trial = 0;          // from 1; 0 where the field is one
  std::size_t plots = 0;  // that were measured
  double factor = 1;      // by which the heights were multiplied
  double factor_sd = 0;
  double residual_m = 0;  // standard deviation of a plot about that
};

// A table of heights measured by hand that was given (--measured).
struct GivenMeasured {
  std::string id_column;
  std::vector<PlotId> not_found = {};
  std::vector<Agreed> heights = {};
};

// Facts found while an estimate was made. Those that another part of the program uses have a member
// of their own; files and the library get all of them from to_json.
struct Diagnostics {
  std::optional<std::vector<std::string>> notes = {};  // how the input was read, a sentence each
  std::optional<PointAccount> points = {};
  std::optional<double> density_per_m2 = {};  // in the median square of the field
  std::optional<GroundFacts> ground = {};
  std::vector<std::map<std::string, double>> crops = {};  // how likely each trial is of each
  std::string why_no_plots = {};                          // "" where there are plots
  std::optional<GivenBoxes> boxes = {};
  std::optional<GivenNames> names = {};
  std::optional<GivenMeasured> measured = {};
  // What only this method reports: as JSON for the manifest, and as lines for people.
  nlohmann::json of_method = nlohmann::json::object();
  std::vector<std::string> lines = {};
};

// The member of the manifest's diagnostics that read_estimate reads again.
inline constexpr const char* kWhyNoPlots = "why_no_plots";

// As the manifest has them (docs/estimate-format.md).
nlohmann::json to_json(const Diagnostics& diagnostics);

}  // namespace plotscan::estimate
