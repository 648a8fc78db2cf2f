// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cloud/area.h"
#include "farmbench/command_method.h"
#include "farmbench/sweep.h"
#include "lidar/fly.h"

namespace plotscan::farmbench {

inline constexpr int kMostSeeds = 10'000;  // of a case

// One kind of farm and flight: a description, with some of its keys replaced. Flights' seeds and
// threads are set farm by farm.
struct SuiteCase {
  std::string name;
  std::filesystem::path farm;
  std::vector<std::string> overrides = {};  // "terrain.side_m=20"
  lidar::FlyOptions flight = {};            // the suite's, with what the case replaces in it
  std::optional<double> published_rmse_cm = std::nullopt;  // somebody's figure for such a farm
  // The surveyed part of the field, if not all: only it is flown over and kept in the cloud.
  std::optional<cloud::Area> survey = std::nullopt;
  // The things in the farm's boxes are no plots but, for example, trees: every plot found is extra.
  bool without_plots = false;
};

// Published figures, shown beside the measured ones.
struct Published {
  std::string source;                // "Dhami et al., IROS 2020"
  std::vector<std::string> methods;  // the rows that it belongs beside, "dhami2020/raw-p99"
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Published, source, methods)

// A benchmark: every method on every seed of every case.
struct Suite {
  std::filesystem::path file;
  std::string name;
  std::vector<SuiteCase> cases;
  std::vector<std::uint64_t> seeds;  // of farm, flight and method alike
  double crop_margin_m = 1;          // bare ground around the plots that methods are given
  std::vector<std::string> methods;  // names of known_methods() and of `commands`
  std::vector<CommandMethod> commands = {};
  std::vector<std::string> truths = {};  // that the reports show; none: tallest and mean plant
  std::optional<Published> published = std::nullopt;
  std::optional<std::string> baseline = std::nullopt;  // the case that the others are compared with
  std::optional<Sweep> sweep = std::nullopt;           // what the cases are combinations of
};

// Reads a suite (docs/benchmark.md) or a sweep (docs/sweep.md). Paths of farms are relative to the
// suite's file. Throws InputError (file:line, key, what is allowed) on an unknown key, a wrong
// type, an unknown method, an impossible value, or a case whose farm description does not hold.
Suite load_suite(const std::filesystem::path& file);

}  // namespace plotscan::farmbench
