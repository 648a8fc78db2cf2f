// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/axis_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <tbb/parallel_for.h>

#include "plots/layout/drill_rows.h"
#include "plots/layout/internal/plot_parts.h"
#include "plots/layout/internal/touching_plots.h"
#include "plots/layout/steps.h"

namespace plotscan::plots {
namespace {

constexpr double kLeastSide_m = 0.3, kMostSide_m = 100;  // of a plot; strips of farms
constexpr double kLeastGap_m = 0.15;                     // between plots
constexpr double kMostIrregular = 0.34;                  // of the steps from plot to plot,
constexpr double kAlleys = 1;                            // but one at least
constexpr std::size_t kMostPeriod = 4;                   // plots that one pass of a drill sows
constexpr double kMostTrack = 0.5;                       // of a plot's width, between two passes
constexpr double kSizeStep = 1.05;                       // from one size that is tried to the next
constexpr std::size_t kRefined = 4;    // best shapes of which others like them are tried
constexpr std::size_t kRowsTried = 3;  // in each of which all shapes are tried

int cells(double length_m, double cell_m) {
  return std::max(1, static_cast<int>(std::lround(length_m / cell_m)));
}

// How many steps are no whole multiple of the usual one; of two steps the narrower one is usual, as
// the other may be an alley.
double unusual_steps(const std::vector<double>& steps, double tolerance) {
  const double usual = steps.size() == 2 ? std::ranges::min(steps) : usual_step(steps);
  return static_cast<double>(std::ranges::count_if(steps, [&](double step) {
    return std::abs(step - usual * std::max(1.0, std::round(step / usual))) > tolerance;
  }));
}

// One step of each period, from the first one on.
std::vector<double> one_of_each(std::size_t period, std::size_t first,
                                const std::vector<double>& steps) {
  std::vector<double> some;
  for (std::size_t i = first; i < steps.size(); i += period) some.push_back(steps[i]);
  return some;
}

// The same where a wheel's track or the next pass of the drill follows every so many plots: of the
// usual step at the same place of the period, and one for each further place. Wider gaps than those
// may be between drill rows.
double irregular_steps(std::size_t period, const std::vector<double>& steps, double size,
                       double tolerance) {
  auto irregular = static_cast<double>(period - 1);
  for (std::size_t first = 0; first < period; ++first) {
    const std::vector<double> some = one_of_each(period, first, steps);
    if (usual_step(some) > (1 + kMostTrack) * size) return std::numeric_limits<double>::infinity();
    irregular += unusual_steps(some, tolerance);
  }
  return irregular;
}

// Number of steps that are no whole multiple of the usual one, of equal steps or of those that
// repeat. Each adds two parameters: its size and its place.
double irregular_steps(const std::vector<int>& begins, const BandShape& shape, double cell_m) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < begins.size(); ++i) steps.push_back(begins[i] - begins[i - 1]);
  if (steps.size() < 2) return 0;
  const double tolerance = std::max(0.05 / cell_m + 1, 0.05 * shape.size);
  double fewest = unusual_steps(steps, tolerance);
  for (std::size_t period = 2; period <= kMostPeriod && 2 * period <= steps.size(); ++period)
    fewest = std::min(fewest, irregular_steps(period, steps, shape.size, tolerance));
  return fewest;
}

// Fits bands of one shape; with `shared` the same on all profiles, else each profile's own.
AxisFit fit_shape(const Line& line, const BandShape& shape, bool shared) {
  const int gap = cells(kLeastGap_m, line.cell_m);
  AxisFit fit{.shape = shape};
  const auto add = [&](std::span<const ProfileSums> profiles) {
    Segmentation found = best_bands(profiles, shape, gap, line.price);
    if (found.begins.empty()) return false;
    fit.misfit += found.misfit;
    fit.parameters += found.parameters + 2 * irregular_steps(found.begins, shape, line.cell_m);
    fit.begins.push_back(std::move(found.begins));
    return true;
  };
  fit.misfit = 0;
  bool found = true;
  if (shared) {
    found = add(line.profiles);
  } else {
    for (const ProfileSums& profile : line.profiles) found = found && add({&profile, 1});
  }
  if (!found) fit.misfit = std::numeric_limits<double>::infinity();
  return fit;
}

// Whether a size agrees with the side that the user gave, if any.
bool may_be(int size, const Line& line) {
  const std::optional<double>& side_m = line.hint.side_m;
  return !side_m || std::abs(size * line.cell_m - *side_m) <= 0.5 * line.cell_m + 0.01 * *side_m;
}

std::vector<BandShape> coarse_shapes(const Line& line) {
  std::vector<BandShape> shapes;
  const double most =
      std::min<double>(kMostSide_m / line.cell_m, line.profiles.front().cells() - 4);
  std::vector<int> sizes;
  double size = line.hint.least_m / line.cell_m;
  while (size <= most) {
    sizes.push_back(static_cast<int>(size));
    size = std::max(size + 1, size * kSizeStep);
  }
  if (line.hint.side_m) sizes.push_back(cells(*line.hint.side_m, line.cell_m));
  for (const int cells : sizes)
    if (may_be(cells, line))
      shapes.push_back({.size = cells, .blur = std::min(2, (cells - 1) / 2)});
  return shapes;
}

std::vector<BandShape> shapes_like(const BandShape& shape) {
  std::vector<BandShape> shapes;
  for (const double wider : {0.98, 1.0, 1.02}) {
    for (const int blur : {1, 2, 4}) {
      const int size = static_cast<int>(std::lround(shape.size * wider));
      shapes.push_back({.size = std::max(3, size), .blur = blur});
    }
  }
  return shapes;
}

// Whether most steps equal one pitch; one alley may differ. Bands that come from a canopy's texture
// lie anywhere.
bool is_regular(const Line& line, const AxisFit& fit) {
  double irregular = 0, steps = 0;
  for (const std::vector<int>& begins : fit.begins) {
    irregular += irregular_steps(begins, fit.shape, line.cell_m);
    steps += static_cast<double>(begins.size()) - 1;
  }
  return irregular <= std::max(kAlleys, kMostIrregular * steps);
}

// Whether the number of bands is the user's number of plots along the axis. Rows with offsets of
// their own may lack some, so the longest counts.
bool has_told_count(const Line& line, const AxisFit& fit) {
  const auto most = std::ranges::max(fit.begins, {}, &std::vector<int>::size).size();
  return line.hint.count && most == static_cast<std::size_t>(*line.hint.count);
}

// The best of those that are plots, or drill rows of plots.
AxisFit best_of(const Line& line, std::vector<AxisFit> fits) {
  std::ranges::stable_sort(fits, {}, [&](const AxisFit& fit) { return fit.cost(line.price); });
  for (const AxisFit& fit : fits) {
    if (!std::isfinite(fit.misfit)) break;
    const AxisFit plots = put_together(line, fit);
    const bool is_one = plots.row_spacing > 0 || is_regular(line, fit);
    if (line.hint.count ? has_told_count(line, plots) : is_one) return fit;
  }
  return line.hint.count || fits.empty() ? AxisFit{} : fits.front();
}

// Bands that are too narrow for plots are drill rows of plots, or the canopy's texture.
void leave_out_texture(const Line& line, std::vector<AxisFit>& fits) {
  std::erase_if(fits, [&](const AxisFit& fit) {
    const bool narrow = !line.hint.side_m && fit.shape.size * line.cell_m < kLeastSide_m;
    return narrow && !(std::isfinite(fit.misfit) && put_together(line, fit).row_spacing > 0);
  });
}

std::vector<AxisFit> fit_shapes(const Line& line, const std::vector<BandShape>& shapes,
                                bool shared) {
  std::vector<AxisFit> fits(shapes.size());
  tbb::parallel_for(std::size_t{0}, shapes.size(),
                    [&](std::size_t i) { fits[i] = fit_shape(line, shapes[i], shared); });
  return fits;
}

std::vector<std::vector<double>> middles_of(const Line& line, const AxisFit& fit) {
  std::vector<std::vector<double>> middles;
  for (std::size_t i = 0; i < fit.begins.size(); ++i) {
    middles.emplace_back();
    for (const int begin : fit.begins[i])
      middles.back().push_back(line.profiles[i].centroid(begin, begin + fit.shape.size));
  }
  return middles;
}

std::vector<std::vector<int>> rounded(const std::vector<std::vector<double>>& lines) {
  std::vector<std::vector<int>> whole;
  for (const std::vector<double>& line : lines) {
    whole.emplace_back();
    for (const double place : line) whole.back().push_back(static_cast<int>(std::lround(place)));
  }
  return whole;
}

// With bands where plots may stand that showed none: low or lodged ones.
std::vector<std::vector<int>> filled_in(const std::vector<std::vector<int>>& lines) {
  std::vector<std::vector<double>> filled;
  for (const std::vector<int>& line : lines) {
    filled.emplace_back(line.begin(), line.end());
    fill_in(filled.back());
  }
  return rounded(filled);
}

}  // namespace

Line line_of(const RowView& view, const std::vector<std::vector<Band>>& strips,
             const AxisHint& hint) {
  Line line{.cell_m = view.cell_m(), .hint = hint};
  for (const std::vector<Band>& across : strips) {
    const CanopyProfile profile = profile_along_r(view, across);
    line.profiles.emplace_back(profile);
    line.independent += profile.independent;
  }
  line.price = std::log(std::max(2.0, line.independent));
  constexpr double kOfPiece = 2;  // parameters: its place and its level
  if (hint.model == LineModel::free_ends)
    for (ProfileSums& profile : line.profiles) profile.free_ends(kOfPiece * line.price);
  return line;
}

AxisFit put_together(const Line& line, AxisFit fit) {
  fit.band_size = fit.shape.size;
  if (line.hint.side_m || has_told_count(line, fit)) return fit;  // the bands are the plots
  if (const auto plots = drilled_plots(middles_of(line, fit), kMostSpacing_m / line.cell_m,
                                       kLeastGap_m / line.cell_m)) {
    fit.row_spacing = plots->spacing;
    fit.shape.size = static_cast<int>(std::lround(plots->width()));
    fit.begins = rounded(plots->begins);
  } else if (auto joined = joined_parts(line.profiles, fit.begins, fit.shape.size)) {
    fit.shape.size = joined->size;
    fit.begins = std::move(joined->begins);
  }
  fit.begins = filled_in(fit.begins);
  return fit;
}

AxisFit fit_axis(const Line& line, bool shared) {
  Line tried = line;
  if (!shared && tried.profiles.size() > kRowsTried)
    tried.profiles.erase(tried.profiles.begin() + kRowsTried, tried.profiles.end());
  std::vector<AxisFit> fits = fit_shapes(tried, coarse_shapes(line), shared);
  leave_out_texture(line, fits);
  if (fits.empty()) return {};
  std::ranges::stable_sort(fits, {}, [&](const AxisFit& fit) { return fit.cost(line.price); });
  std::vector<BandShape> shapes;
  for (std::size_t i = 0; i < std::min(fits.size(), kRefined); ++i) {
    for (const BandShape& shape : shapes_like(fits[i].shape))
      if (may_be(shape.size, line)) shapes.push_back(shape);
  }
  if (!shared) fits.clear();  // of fewer profiles
  for (AxisFit& fit : fit_shapes(line, shapes, shared)) fits.push_back(std::move(fit));
  leave_out_texture(line, fits);
  return best_of(line, std::move(fits));
}

std::optional<AxisFit> fit_touching(const Line& line) {
  const auto plots = touching_plots(line.profiles, line.cell_m, line.hint.side_m, line.hint.count);
  if (!plots) return std::nullopt;
  AxisFit fit{.shape = {.size = static_cast<int>(plots->side), .blur = 0}, .touching = plots->side};
  fit.begins = rounded(plots->begins);
  fit.band_size = fit.shape.size;
  return fit;
}

std::vector<Band> bands_of(const AxisFit& fit, std::size_t profile) {
  std::vector<Band> bands;
  for (const int begin : fit.begins[std::min(profile, fit.begins.size() - 1)])
    bands.push_back({begin, begin + fit.shape.size});
  return bands;
}

}  // namespace plotscan::plots
