// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/internal/voting.h"

#include <cmath>
#include <map>
#include <vector>

#include "core/angle.h"
#include "core/plot_box.h"
#include "core/statistics.h"

namespace plotscan::methods::dhami2020 {
namespace {

using Bins = std::map<long, std::vector<double>>;

const std::vector<double>& fullest(const Bins& bins) {
  auto best = bins.begin();
  for (auto bin = bins.begin(); bin != bins.end(); ++bin) {
    if (bin->second.size() > best->second.size()) best = bin;
  }
  return best->second;
}

}  // namespace

Vote vote(std::span<const double> values, double bin) {
  if (values.empty()) return {};
  Bins bins;
  for (const double value : values) bins[std::lround(std::floor(value / bin))].push_back(value);
  const std::vector<double>& winner = fullest(bins);
  return {.value = mean(winner), .votes = winner.size()};
}

Vote vote_heading(std::span<const double> headings_rad, double bin_rad) {
  if (headings_rad.empty()) return {};
  Bins bins;
  for (const double heading : headings_rad) {
    const double wrapped = wrap_heading(heading);
    const bool in_first_bin = wrapped >= kPi - bin_rad / 2;
    bins[in_first_bin ? 0 : std::lround(std::floor(wrapped / bin_rad + 0.5))].push_back(heading);
  }
  const std::vector<double>& winner = fullest(bins);
  double sine = 0;
  double cosine = 0;
  for (const double heading : winner) {
    sine += std::sin(2 * heading);
    cosine += std::cos(2 * heading);
  }
  return {.value = wrap_heading(std::atan2(sine, cosine) / 2), .votes = winner.size()};
}

}  // namespace plotscan::methods::dhami2020
