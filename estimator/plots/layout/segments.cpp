// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/segments.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plotscan::plots {
namespace {

constexpr double kLeastLevel = 0.15;  // of the line's highest: less is no plot
constexpr double kMostGap = 0.92;     // of the lower band beside it: a gap is lower than its bands
constexpr double kNever = std::numeric_limits<double>::infinity();

// One band on one profile.
struct Level {
  double canopy = 0;
  double misfit = kNever;
};

Level level_of(const ProfileSums& sums, const BandShape& shape, int begin) {
  const int low = begin + shape.blur, high = begin + shape.size - shape.blur;
  const double canopy = sums.mean(low, high);
  return {canopy, sums.squares(low, high, canopy)};
}

// The gap from the end of one band, at its level, to the beginning of the next; -1 in place of a
// band stands for the line's begin or end.
ProfileSums::Stretch gap_between(const ProfileSums& sums, int blur, int end, double from, int begin,
                                 double to) {
  const int low = end + blur, high = begin < 0 ? sums.cells() : begin - blur;
  ProfileSums::Stretch gap = end < 0     ? sums.until(high)
                             : begin < 0 ? sums.from(low)
                                         : sums.even(low, high);
  if (end >= 0) gap.misfit += sums.squares(end - blur, low, from, gap.level);
  if (begin >= 0) gap.misfit += sums.squares(high, begin + blur, gap.level, to);
  return gap;
}

// A place where a band may begin, with its level on every profile.
struct Start {
  int begin = 0;
  std::span<const Level> levels = {};
  double canopy = 0, misfit = 0;  // sums of the levels'
  double cost = 0;                // of the best bands up to this one
  double least = 0;               // cost of the cheapest start up to this one
  int before = -1;                // the start before it
};

// The levels of starts, one after the other. They stay where they are.
class Levels {
 public:
  Levels(std::span<const ProfileSums> profiles, std::size_t starts) : profiles_(profiles) {
    levels_.reserve(starts * profiles.size());
  }

  Start start_at(int begin, const BandShape& shape) {
    Start start{.begin = begin};
    for (const ProfileSums& sums : profiles_) {
      const Level& level = levels_.emplace_back(level_of(sums, shape, begin));
      start.canopy += level.canopy;
      start.misfit += level.misfit;
    }
    start.levels = std::span(levels_).last(profiles_.size());
    return start;
  }

 private:
  std::span<const ProfileSums> profiles_;
  std::vector<Level> levels_;
};

// A band that rises at its begin and falls at its end, on the profiles together.
bool stands_out(std::span<const ProfileSums> profiles, const BandShape& shape, const Start& start) {
  const int end = start.begin + shape.size;
  double before = 0, after = 0;
  for (const ProfileSums& sums : profiles) {
    before += sums.mean(std::max(0, start.begin - shape.blur - 2), start.begin - shape.blur);
    after += sums.mean(end + shape.blur, std::min(sums.cells(), end + shape.blur + 2));
  }
  return std::max(before, after) < kMostGap * start.canopy;
}

std::vector<Start> starts_on(std::span<const ProfileSums> profiles, const BandShape& shape,
                             Levels& levels) {
  const int cells = profiles.front().cells();
  double least = 0;
  for (const ProfileSums& sums : profiles)
    least += kLeastLevel * sums.highest_mean(std::min(shape.size, cells));
  std::vector<Start> starts;
  for (int begin = shape.blur + 1; begin + shape.size + shape.blur < cells; ++begin) {
    const Start start = levels.start_at(begin, shape);
    if (start.canopy < least || start.misfit == kNever) continue;
    if (stands_out(profiles, shape, start)) starts.push_back(start);
  }
  return starts;
}

// The gap on all profiles together; a null pointer stands for the line's begin or end.
ProfileSums::Stretch gap_between(std::span<const ProfileSums> profiles, const BandShape& shape,
                                 const Start* from, const Start* to) {
  const int end = from != nullptr ? from->begin + shape.size : -1;
  const int begin = to != nullptr ? to->begin : -1;
  ProfileSums::Stretch sum;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const ProfileSums::Stretch gap =
        gap_between(profiles[i], shape.blur, end, from != nullptr ? from->levels[i].canopy : 0,
                    begin, to != nullptr ? to->levels[i].canopy : 0);
    sum.level += gap.level;
    sum.misfit += gap.misfit;
  }
  return sum;
}

// Whether a gap is not lower than both bands beside it.
bool is_filled(double level, const Start* from, const Start* to) {
  const double lower =
      std::min(from != nullptr ? from->canopy : kNever, to != nullptr ? to->canopy : kNever);
  return level > kMostGap * lower;
}

// The cost of a gap; infinite where it is filled.
double gap_cost(std::span<const ProfileSums> profiles, const BandShape& shape, const Start* from,
                const Start* to) {
  const ProfileSums::Stretch gap = gap_between(profiles, shape, from, to);
  return is_filled(gap.level, from, to) ? kNever : gap.misfit;
}

// A gap without its edges. Those only add to what it costs, as does all that lies before it: the
// squares about the mean of more cells are no fewer.
ProfileSums::Stretch within_gap(std::span<const ProfileSums> profiles, const BandShape& shape,
                                const Start& from, const Start& to) {
  ProfileSums::Stretch sum;
  for (const ProfileSums& sums : profiles) {
    const ProfileSums::Stretch gap =
        sums.even(from.begin + shape.size + shape.blur, to.begin - shape.blur);
    sum.level += gap.level;
    sum.misfit += gap.misfit;
  }
  return sum;
}

// Lets a start follow the one of `others`, which all end before it, with which the bands up to it
// cost least, or none. The gap before it, and so the search, is rarely longer than a band.
void follow_cheapest(std::span<const ProfileSums> profiles, const BandShape& shape,
                     std::span<const Start> others, Start& start) {
  start.cost = gap_cost(profiles, shape, nullptr, &start);
  for (std::size_t k = others.size(); k-- > 0;) {
    const Start& other = others[k];
    const ProfileSums::Stretch within = within_gap(profiles, shape, other, start);
    if (other.least + within.misfit > start.cost) return;
    if (other.cost + within.misfit > start.cost || is_filled(within.level, &other, &start))
      continue;
    const double cost = other.cost + gap_cost(profiles, shape, &other, &start);
    if (cost > start.cost) continue;
    start.cost = cost;
    start.before = static_cast<int>(k);
  }
}

// A begin, and on every profile the band's level and that of the gap before it.
double parameters_of_band(std::size_t profiles) { return 1 + 2 * static_cast<double>(profiles); }

}  // namespace

Segmentation best_bands(std::span<const ProfileSums> profiles, const BandShape& shape,
                        int least_gap, double price) {
  Segmentation none{.shape = shape, .begins = {}, .misfit = kNever, .parameters = 0};
  if (shape.size < 2 * shape.blur + 1) return none;
  Levels levels(profiles, static_cast<std::size_t>(profiles.front().cells()));
  std::vector<Start> starts = starts_on(profiles, shape, levels);
  const double band_price = price * parameters_of_band(profiles.size());
  const int least_step = shape.size + std::max(least_gap, 2 * shape.blur + 1);
  std::size_t others = 0;  // that end before the start
  for (std::size_t i = 0; i < starts.size(); ++i) {
    Start& start = starts[i];
    while (starts[others].begin + least_step <= start.begin) ++others;
    follow_cheapest(profiles, shape, std::span(starts).first(others), start);
    start.cost += start.misfit + band_price;
    start.least = i > 0 ? std::min(starts[i - 1].least, start.cost) : start.cost;
  }
  double best = kNever;
  int last = -1;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double cost = starts[i].cost + gap_cost(profiles, shape, &starts[i], nullptr);
    if (cost >= best) continue;
    best = cost;
    last = static_cast<int>(i);
  }
  if (last < 0) return none;
  Segmentation found = none;
  for (; last >= 0; last = starts[static_cast<std::size_t>(last)].before)
    found.begins.push_back(starts[static_cast<std::size_t>(last)].begin);
  std::ranges::reverse(found.begins);
  found.parameters = static_cast<double>(found.begins.size()) * parameters_of_band(profiles.size());
  found.misfit = best - price * found.parameters;
  return found;
}

}  // namespace plotscan::plots
