// SPDX-License-Identifier: Apache-2.0
#include "planting/trial_design.h"

#include <algorithm>
#include <numeric>

#include <fmt/core.h>

#include "core/error.h"
#include "core/list_of.h"
#include "core/random.h"

namespace plotscan::planting {
namespace {

// Of a trial's random numbers: no two trials share one.
std::uint64_t first_index(std::uint32_t trial) { return std::uint64_t{trial} << 32; }

// Every order as likely as another (Fisher and Yates).
void shuffle(std::vector<std::size_t>& values, RandomStream random) {
  for (std::size_t left = values.size(); left > 1; --left)
    std::swap(values[left - 1], values[random.below(left)]);
}

// Blocks of one plot a cultivar, each of plots that follow each other in the order given.
void number_blocks(const std::vector<farm::Plot*>& plots, std::size_t cultivars) {
  if (plots.size() % cultivars != 0) {
    throw InputError(
        fmt::format("makes no whole blocks: {} plots are not a multiple of {} cultivars; random "
                    "and cycle need no blocks",
                    plots.size(), cultivars));
  }
  for (std::size_t i = 0; i < plots.size(); ++i)
    plots[i]->block = static_cast<int>(i / cultivars) + 1;
}

// Blocks of whole rows or columns: of a `line` of that name.
void number_blocks_by_lines(std::vector<farm::Plot*> plots, int farm::Plot::*line, const char* name,
                            std::size_t cultivars) {
  std::stable_sort(plots.begin(), plots.end(),
                   [&](const farm::Plot* a, const farm::Plot* b) { return a->*line < b->*line; });
  number_blocks(plots, cultivars);
  for (std::size_t i = cultivars; i < plots.size(); i += cultivars) {
    const farm::Plot& before = *plots[i - 1];
    if (before.*line != plots[i]->*line) continue;
    throw InputError(fmt::format("makes no blocks of whole {0}s: {1} cultivars end within {0} {2}",
                                 name, cultivars, before.*line));
  }
}

void make_blocks(BlockBy by, std::size_t cultivars, std::vector<farm::Plot>& plots) {
  const auto all = list_of(plots, [](farm::Plot& plot) { return &plot; });
  if (by == BlockBy::plots) return number_blocks(all, cultivars);
  if (by == BlockBy::rows) return number_blocks_by_lines(all, &farm::Plot::row, "row", cultivars);
  number_blocks_by_lines(all, &farm::Plot::column, "column", cultivars);
}

// The cultivars of each block in an order of the block's own.
std::vector<std::size_t> randomised_blocks(const std::vector<farm::Plot>& plots,
                                           std::size_t cultivars, std::uint64_t seed,
                                           std::uint32_t trial) {
  std::vector<std::vector<std::size_t>> orders(plots.size() / cultivars);
  for (std::size_t block = 0; block < orders.size(); ++block) {
    orders[block].resize(cultivars);
    std::iota(orders[block].begin(), orders[block].end(), 0);
    shuffle(orders[block], {seed, random_purpose("trial/block"), first_index(trial) + block + 1});
  }
  std::vector<std::size_t> assigned;
  for (const farm::Plot& plot : plots) {
    std::vector<std::size_t>& order = orders[static_cast<std::size_t>(plot.block - 1)];
    assigned.push_back(order.back());
    order.pop_back();
  }
  return assigned;
}

std::vector<std::size_t> listed(const DesignDescription& design, std::size_t plots) {
  if (design.list.size() == plots) return design.list;
  throw InputError(fmt::format("list names the cultivars of {} plots; the grid has {}",
                               design.list.size(), plots));
}

std::vector<std::size_t> drawn(const DesignDescription& design, std::size_t cultivars,
                               std::uint64_t seed, std::vector<farm::Plot>& plots,
                               std::uint32_t trial) {
  if (design.design == TrialDesign::list) return listed(design, plots.size());
  if (design.design == TrialDesign::rcbd) {
    make_blocks(design.block_by, cultivars, plots);
    return randomised_blocks(plots, cultivars, seed, trial);
  }
  std::vector<std::size_t> assigned(plots.size());
  for (std::size_t i = 0; i < assigned.size(); ++i) assigned[i] = i % cultivars;
  if (design.design == TrialDesign::random)
    shuffle(assigned, {seed, random_purpose("trial/random"), first_index(trial)});
  return assigned;
}

}  // namespace

std::vector<std::size_t> assign_cultivars(const DesignDescription& design,
                                          const std::vector<std::string>& accessions,
                                          std::uint64_t seed, std::vector<farm::Plot>& plots,
                                          std::uint32_t trial) {
  std::vector<std::size_t> assigned = drawn(design, accessions.size(), seed, plots, trial);
  std::vector<int> replicates(accessions.size(), 0);
  for (std::size_t i = 0; i < plots.size(); ++i) {
    plots[i].accession = accessions[assigned[i]];
    const int replicate = ++replicates[assigned[i]];
    plots[i].rep = design.design == TrialDesign::rcbd ? plots[i].block : replicate;
  }
  return assigned;
}

}  // namespace plotscan::planting
