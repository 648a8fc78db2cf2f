// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/cloud_files.h"
#include "core/progress.h"
#include "estimate/plot_numbers.h"
#include "methods/dhami2020/settings.h"
#include "methods/lattice/settings.h"

namespace plotscan::methods {

// One run of a method, from files to an estimate folder.
struct RunOptions {
  CloudFiles cloud;  // files and folders, as cloud_files_of takes them
  std::filesystem::path output;
  std::string method = "lattice";  // one of method_names()
  // A map of plots (estimate::read_plot_map): heights only, in its boxes.
  std::optional<std::filesystem::path> boxes = {};
  estimate::NumberingOptions numbering = {};  // of the plots that are found, without boxes
  // Property of the boxes, or column of the names and of the measured heights, with the ids.
  std::optional<std::string> id = {};
  // A table of heights measured by hand in some plots: the field's are scaled to agree with them.
  std::optional<std::filesystem::path> measured = {};
  std::optional<std::filesystem::path> csv = {};  // a table for breeding databases as well
  bool replace = false;                           // an estimate folder, a table that exists
  // Use only the points in here. In the cloud's own coordinates, as are the given boxes and
  // dhami2020's learn box; metres of UTM where the cloud is in degrees.
  std::optional<cloud::Area> crop_box = {};
  lattice::Options lattice = {};      // crop box, boxes, threads are taken from here
  dhami2020::Options dhami2020 = {};  // as above, and the seed
  std::uint64_t seed = 1;
  int threads = 1;
};

// Calls `use` with each method's name, its settings and its own options in `run`, the default
// method first. `run` finds a method's estimate_plots by the type of these options.
template <class Run, class Use>
void for_each_method(Run& run, Use&& use) {
  use("lattice", lattice::settings(), run.lattice);
  use("dhami2020", dhami2020::settings(), run.dhami2020);
}

// The methods that `run` knows, the default first.
const std::vector<std::string>& method_names();

// Throws InputError, which lists them, on any other.
void require_known(const std::string& method);

// Runs the method and writes the estimate folder (docs/estimate-format.md). Methods count in
// metres: the cloud's own coordinates become metres here and at reading, and become its own again
// in write_estimate. With given boxes, plots keep the map's ids and attributes (plot_map.h). Throws
// InputError on bad input; nothing is left behind then.
estimate::Estimate run(const RunOptions& options, const ProgressReport& progress = {});

// Throws NothingToMeasure where an estimate has no plots, or no height of any: the message says
// why, how dense the cloud is, and what to do next that the options have not done yet.
void require_measured(const RunOptions& options, const estimate::Estimate& estimate);

// How many plots have each height, and its median, least and greatest value, metres.
nlohmann::json height_summary(const estimate::Estimate& estimate);

}  // namespace plotscan::methods
