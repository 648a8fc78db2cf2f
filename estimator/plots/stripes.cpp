// SPDX-License-Identifier: Apache-2.0
#include "plots/stripes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "plots/statistics.h"

namespace plotscan::plots {
namespace {

constexpr double kStripe_m = 0.75;    // narrower ones may be rows of plants
constexpr double kLeastBreak = 1.25;  // times the usual step: between two plots
constexpr double kLeastAlike = 0.6;   // share of groups that hold the usual number of rows

// A plot's cells on the raster.
struct Cells {
  Band a, b;
};

std::vector<Cells> boxes_of(const Layout& layout) {
  std::vector<Cells> boxes;
  for (const Row& row : layout.rows) {
    for (const Band& plot : row.plots) {
      boxes.push_back(layout.view.swapped ? Cells{plot, row.band} : Cells{row.band, plot});
    }
  }
  return boxes;
}

// Whether the centre of the other lies within.
bool holds(const Cells& box, const Cells& other) {
  const auto within = [](const Band& band, const Band& inner) {
    const int middle = (inner.begin + inner.end) / 2;
    return middle >= band.begin && middle < band.end;
  };
  return within(box.a, other.a) && within(box.b, other.b);
}

int length_of(const Band& band) { return band.end - band.begin; }
int middle_of(const Band& band) { return (band.begin + band.end) / 2; }

// The stripes of each row of plots, side by side: `band` along the stripes, `plots` across them.
std::vector<Row> rows_of_stripes(const Layout& stripes, bool along_a) {
  struct Stripe {
    Band along, across;
  };
  std::vector<Stripe> all;
  for (const Cells& cells : boxes_of(stripes)) {
    all.push_back(along_a ? Stripe{cells.a, cells.b} : Stripe{cells.b, cells.a});
  }
  std::ranges::stable_sort(all, {}, [](const Stripe& s) { return middle_of(s.along); });
  std::vector<Row> rows;
  for (const Stripe& stripe : all) {
    const bool same_row = !rows.empty() && middle_of(stripe.along) - middle_of(rows.back().band) <
                                               length_of(stripe.along) / 2;
    if (!same_row) rows.push_back({.band = stripe.along});
    rows.back().plots.push_back(stripe.across);
  }
  for (Row& row : rows) std::ranges::stable_sort(row.plots, {}, &middle_of);
  return rows;
}

// The step from a drill row to the next: of the narrowest fifth of all steps and those like it.
double usual_small_step(const std::vector<Row>& rows) {
  std::vector<double> steps;
  for (const Row& row : rows) {
    for (std::size_t i = 1; i < row.plots.size(); ++i) {
      steps.push_back(middle_of(row.plots[i]) - middle_of(row.plots[i - 1]));
    }
  }
  if (steps.empty()) return 0;
  std::ranges::sort(steps);
  const double narrow = steps[steps.size() / 5];
  std::erase_if(steps, [&](double step) { return step > 1.15 * narrow; });
  return median(steps);
}

std::vector<std::vector<Band>> groups_of(const std::vector<Band>& stripes, double step) {
  std::vector<std::vector<Band>> groups;
  for (const Band& stripe : stripes) {
    const bool apart =
        groups.empty() || middle_of(stripe) - middle_of(groups.back().back()) > kLeastBreak * step;
    if (apart) groups.emplace_back();
    groups.back().push_back(stripe);
  }
  return groups;
}

// How many stripes most groups have; 0 where they are not alike, or where every row is one group.
std::size_t usual_count(const std::vector<std::vector<std::vector<Band>>>& groups_by_row) {
  std::map<std::size_t, std::size_t> groups_by_count;
  std::size_t groups = 0;
  for (const auto& row : groups_by_row) {
    for (const auto& group : row) ++groups_by_count[group.size()];
    groups += row.size();
  }
  if (groups < 2 * groups_by_row.size()) return 0;
  const auto usual =
      std::ranges::max_element(groups_by_count, {}, [](const auto& entry) { return entry.second; });
  const double alike = static_cast<double>(usual->second) / static_cast<double>(groups);
  return usual->first >= 2 && alike >= kLeastAlike ? usual->first : 0;
}

}  // namespace

bool has_stripes(const Layout& layout) {
  if (layout.rows.empty()) return false;
  const double cell_m = layout.view.cell_m();
  const int narrow = std::min(layout.r_size, layout.c_size);
  return narrow * cell_m < kStripe_m && std::max(layout.r_size, layout.c_size) > 4 * narrow;
}

bool are_stripes_of(const Layout& fine, const Layout& coarse) {
  if (!has_stripes(fine)) return false;
  const std::vector<Cells> stripes = boxes_of(fine);
  const std::vector<Cells> plots = boxes_of(coarse);
  if (plots.empty()) return false;
  const bool along_a = stripes.front().a.end - stripes.front().a.begin >
                       stripes.front().b.end - stripes.front().b.begin;
  const int length = std::max(fine.r_size, fine.c_size);
  const Band& side = along_a ? plots.front().a : plots.front().b;
  if (std::abs(side.end - side.begin - length) > 0.15 * length + 2) return false;
  std::vector<double> held;  // stripes in each plot
  for (const Cells& plot : plots) {
    held.push_back(static_cast<double>(
        std::ranges::count_if(stripes, [&](const Cells& stripe) { return holds(plot, stripe); })));
  }
  const double usual = median(held);
  const auto as_usual = std::ranges::count(held, usual);
  return usual >= 2 && static_cast<double>(as_usual) > 0.6 * static_cast<double>(held.size()) &&
         (coarse.quality > 0.5 * fine.quality || coarse.score > 0.25 * fine.score);
}

std::optional<DrilledLayout> plots_of_stripes(const Layout& stripes) {
  const std::vector<Cells> boxes = boxes_of(stripes);
  if (boxes.empty()) return std::nullopt;
  const bool along_a = length_of(boxes.front().a) > length_of(boxes.front().b);
  std::vector<Row> rows = rows_of_stripes(stripes, along_a);
  const double step = usual_small_step(rows);
  std::vector<std::vector<std::vector<Band>>> groups;
  for (const Row& row : rows) groups.push_back(groups_of(row.plots, step));
  const std::size_t count = step > 0 ? usual_count(groups) : 0;
  if (count == 0) return std::nullopt;
  const double cell_m = stripes.view.cell_m();
  DrilledLayout drilled{.layout = stripes, .row_m = step * cell_m};
  Layout& layout = drilled.layout;
  layout.view.swapped = !along_a;
  layout.rows.clear();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Row row{.band = rows[i].band};
    for (const auto& group : groups[i]) {
      if (group.size() != count) continue;
      row.plots.push_back({group.front().begin, group.back().end, group.front().contrast});
    }
    if (!row.plots.empty()) layout.rows.push_back(std::move(row));
  }
  const int stripe = std::min(stripes.r_size, stripes.c_size);
  layout.r_size = std::max(stripes.r_size, stripes.c_size);
  layout.c_size = static_cast<int>(std::lround(static_cast<double>(count - 1) * step)) + stripe;
  drilled.gap_m = (step - stripe) * cell_m;
  drilled.sown_width_m = static_cast<double>(count) * drilled.row_m;
  return drilled;
}

}  // namespace plotscan::plots
