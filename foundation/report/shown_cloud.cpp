// SPDX-License-Identifier: Apache-2.0
#include "report/shown_cloud.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "core/error.h"
#include "core/list_of.h"
#include "core/random.h"

namespace plotscan::report {

CloudSample::CloudSample(std::size_t most)
    : most_(most), highest_lot_(std::numeric_limits<std::uint64_t>::max()) {
  if (most < 1 || most > kMostPoints)
    throw InputError(fmt::format("a page shows 1 to {} points, not {}", kMostPoints, most));
}

void CloudSample::add(const ShownPoint& point) {
  const std::uint64_t lot =
      RandomStream(1, random_purpose("report/cloud-sample"), read_++).next_u64();
  if (lot > highest_lot_) return;
  drawn_.push_back({lot, point});
  if (drawn_.size() >= 2 * most_) keep_lowest();
}

void CloudSample::keep_lowest() {
  if (drawn_.size() <= most_) return;
  const auto last = drawn_.begin() + static_cast<std::ptrdiff_t>(most_ - 1);
  std::ranges::nth_element(drawn_, last, {}, &Drawn::lot);
  highest_lot_ = last->lot;
  drawn_.resize(most_, {0, {}});
}

std::vector<ShownPoint> CloudSample::take() {
  keep_lowest();
  return list_of(std::exchange(drawn_, {}), &Drawn::point);
}

}  // namespace plotscan::report
