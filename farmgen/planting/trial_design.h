// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "farm/farm.h"

namespace plotscan::planting {

enum class TrialDesign {
  rcbd,    // randomised complete blocks: every cultivar once in every block
  random,  // completely randomised: every cultivar equally often
  cycle,   // one after the other, again and again
  list,    // plot by plot as given
};

// What plots a block is made of.
enum class BlockBy { plots, rows, columns };

// Which cultivar grows in which plot.
struct DesignDescription {
  TrialDesign design = TrialDesign::rcbd;
  BlockBy block_by = BlockBy::plots;
  std::vector<std::size_t> list = {};  // list: the cultivar of each plot, in the order of numbers
};

// Gives every plot of a trial's whole grid, in the order of their numbers, its block, its cultivar
// (one of `accessions`) and its replicate; returns the cultivar's index of each. Drawn by the seed
// and the trial's place among the farm's (from 0) alone. Throws InputError when the plots do not
// make whole blocks, or the list is of another length.
std::vector<std::size_t> assign_cultivars(const DesignDescription& design,
                                          const std::vector<std::string>& accessions,
                                          std::uint64_t seed, std::vector<farm::Plot>& plots,
                                          std::uint32_t trial = 0);

}  // namespace plotscan::planting
