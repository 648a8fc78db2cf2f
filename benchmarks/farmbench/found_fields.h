// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "methods/lattice/lattice.h"

namespace plotscan::farmbench {

// The plots of one cloud as lattice methods find them. Methods that differ only in how they measure
// heights share one search.
class FoundFields {
 public:
  explicit FoundFields(std::filesystem::path cloud) : cloud_(std::move(cloud)) {}

  // The field as these options find it. Throws what lattice::find_field does.
  const methods::lattice::FoundField& with(const methods::lattice::Options& options);

  // Seconds of the searches that methods were given without making them. A method on its own would
  // take as much longer as this grew while it ran.
  double spared_s() const { return spared_s_; }

 private:
  struct Search {
    methods::lattice::FoundField field;
    double seconds = 0;
  };
  std::filesystem::path cloud_;
  std::map<std::string, Search> searches_;  // by what they depend on
  double spared_s_ = 0;
};

}  // namespace plotscan::farmbench
