// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "core/trial_layout.h"
#include "core/yaml_section.h"
#include "description/internal/sections.h"

namespace plotscan::description {
namespace {

constexpr std::size_t kMostTrials = 1000;

// The number after the highest of the trials' plots.
std::uint32_t next_number(const std::vector<planting::TrialDescription>& trials) {
  std::uint32_t last = 0;
  for (const planting::TrialDescription& trial : trials)
    last = std::max(last, planting::last_number(trial.plots));
  return last + 1;
}

void require_new_numbers(const YamlSection& plots, const planting::PlotGridDescription& grid,
                         const std::vector<planting::TrialDescription>& trials) {
  for (std::size_t place = 0; place < trials.size(); ++place) {
    const planting::PlotGridDescription& other = trials[place].plots;
    const std::uint32_t first = std::max(grid.first_number, other.first_number);
    if (first > std::min(planting::last_number(grid), planting::last_number(other))) continue;
    plots.fail("first_number", "gives a plot the number {}, which trial {} has too", first,
               place + 1);
  }
}

void require_few_enough(const YamlSection& farm,
                        const std::vector<planting::TrialDescription>& trials) {
  std::uint64_t plots = 0;
  std::uint64_t seeds = 0;
  for (const planting::TrialDescription& trial : trials) {
    plots += planting::plots_of(trial.plots);
    if (trial.plants) seeds += planting::most_seeds(trial.plots, *trial.plants);
  }
  if (plots > kMostPlots)
    farm.fail("trials", "hold {} plots; at most {} are allowed", plots, kMostPlots);
  if (seeds > kMostSeedsOfFarm)
    farm.fail("trials", "make {} plants; at most {} are allowed", seeds, kMostSeedsOfFarm);
}

// A section with a trial's `plots` and, where it is sown, `plants`.
planting::TrialDescription read_trial(const YamlSection& section, bool sown,
                                      std::uint32_t first_number,
                                      std::vector<planting::ModelDescription>& models) {
  planting::TrialDescription trial{.plots = read_plot_grid(section.section("plots"), first_number)};
  if (sown) trial.plants = read_plants(section.section("plants"), trial.plots, models);
  return trial;
}

std::vector<planting::TrialDescription> read_list(const YamlSection& farm, bool sown,
                                                  std::vector<planting::ModelDescription>& models) {
  std::vector<planting::TrialDescription> trials;
  for (const YamlSection& section : farm.list("trials", kMostTrials)) {
    if (!sown && section.has("plants"))
      section.fail("plants", "are placed by layout; give one of the two");
    planting::TrialDescription trial = read_trial(section, sown, next_number(trials), models);
    require_new_numbers(section.section("plots"), trial.plots, trials);
    trials.push_back(std::move(trial));
  }
  require_few_enough(farm, trials);
  return trials;
}

}  // namespace

std::vector<planting::TrialDescription> read_trials(
    const YamlSection& farm, bool sown, std::vector<planting::ModelDescription>& models) {
  if (!farm.has("trials")) {
    if (!sown && !farm.has("plots")) return {};
    return {read_trial(farm, sown, 1, models)};
  }
  for (const char* key : {"plots", "plants"})
    if (farm.has(key)) farm.fail("trials", "takes the place of {}; give one of the two", key);
  return read_list(farm, sown, models);
}

}  // namespace plotscan::description
