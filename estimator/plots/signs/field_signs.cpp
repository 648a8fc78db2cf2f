// SPDX-License-Identifier: Apache-2.0
#include "plots/signs/field_signs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/statistics.h"
#include "plots/lattice/row_ends.h"
#include "plots/signs/internal/plot_shape.h"

namespace plotscan::plots {
namespace {

constexpr double kCanopyPiece_m = 1;      // of a plot, in which canopy is taken
constexpr double kNear_m = 1.5;           // of a plot, where surfaces are looked for
constexpr double kMostSurface = 0.1;      // walls and roofs: 0.14 and more; crops up to 0.02
constexpr double kLeastRoughness = 0.08;  // tables: up to 0.02; cars: from 0.03
// In sigmas of the noise. Cars and furniture: 0.8 to 1.0; maize: 1.6 and more, other crops 2.4 (13
// fields).
constexpr double kLeastPatchScatter = 1.25;
constexpr double kRoughnessOfCrops = 0.115;  // and more; a torn sheet: 0.09
// Length of a plot over its width: longer ones may be rows. Plots of drawn trials: up to 9.0; vine
// rows, whole or in equal parts: 10.7 and more. But rows of a crop are not wider than this from one
// to the next, and rows of vines and trees leave room to pass, at least this of their own width.
constexpr double kMostAspect = 10;
constexpr double kMostPitchOfRows_m = 1.2, kLeastPassage = 0.5;
constexpr double kLeastGapSeen_m = 0.05;  // a cell of the raster: no less is seen
// Plots whose leaves close their gaps: up to 0.94, most 0.6; pieces of vine rows: 0.965 and more.
constexpr double kMostGapCover = 0.95;
constexpr double kLeastSquareness = 0.9;  // round crowns: 0.6 to 0.8; plots: 0.97 and more,
constexpr double kStraight = 2;           // or this of the canopy: crowns and mounds up to 1.2
// This few plots may lie at equal steps by chance: they must be rectangles rather than ellipses.
constexpr std::size_t kFewPlots = 4;
constexpr double kLeastSquarenessOfFew = 1.05;
// Closed plots reach 0.3. Plots of few single plants reach 0.5, as these stand at random; but the
// mean of all plots does not, and little canopy stands beside the plots. Trees two by two: 0.7, in
// the mean too. Bushes: 0.5 to 1.5, and they hold up to 0.7 of the canopy, or by chance more.
constexpr double kMostUneven = 0.45;
constexpr double kMostUnevenAtRandom = 0.9;
constexpr double kLeastHeldOfUneven = 0.85;
constexpr double kLeastHeld = 0.6;  // of the canopy; the rest may be weeds, or another trial
constexpr double kLeastHeldOfTouching = 0.85;  // of what does not hang into other gaps; chosen
constexpr double kLeastFilled = 0.6;           // of the places
// Nats a plot, in the layout's outline. One canopy cut into cells, mounds: up to 4; plots, also
// those of clouds cut to the field: 6.5 and more (57 fields of two words).
constexpr double kLeastEvidence = 3;
// Several signs that are each just good enough are no plots: trees in thin clouds reach 0.01, wrong
// plots on fields of plots 0.08, right ones 0.14 and more (304 fields of ten words).
constexpr double kLeastConfidence = 0.1;

// So many rectangles of this squareness and evidence, and more, are plots whatever else stands
// there: a trial in another crop, or in a survey of a whole farm, holds little of the canopy, and
// photogrammetry smooths it. Trials so: squareness 1.9 to 3.4, 30 nats and more (7 clouds of
// another generator); what is no field of plots: up to 1.2, fewer pieces of sheets 1.45. Such plots
// are half as sure.
constexpr std::size_t kClearPlots = 9;
constexpr double kSquare = 1.3, kClearlySquare = 1.7;
constexpr double kClearEvidence = 12, kVeryClearEvidence = 24;
constexpr double kSureOfClear = 0.5;

double share(double value, double none, double all) {
  return std::clamp((value - none) / (all - none), 0.0, 1.0);
}

// 0 to 1, for each of the signs that are weighed against each other.
struct Clearness {
  double held = 0, squareness = 0, roughness = 0, evidence = 0;

  double product() const { return held * squareness * roughness * evidence; }
};

Clearness clearness_of(const FieldSigns& signs) {
  const double clear = signs.plots < kClearPlots
                           ? 0
                           : kSureOfClear * share(signs.squareness, kSquare, kClearlySquare) *
                                 share(signs.evidence, kClearEvidence, kVeryClearEvidence);
  // Not known of plots with few returns.
  const double roughness = std::isnan(signs.roughness) ? kRoughnessOfCrops : signs.roughness;
  return {.held = std::max(clear, share(signs.held_share, kLeastHeld, 1)),
          .squareness = std::max(
              share(signs.squareness, kLeastSquareness, kSquare),
              share(std::log(signs.straightness), std::log(kStraight), std::log(2 * kStraight))),
          .roughness = std::max(clear, share(roughness, kLeastRoughness, kRoughnessOfCrops)),
          .evidence = share(std::log(std::max(kLeastEvidence, signs.evidence)),
                            std::log(kLeastEvidence), std::log(4 * kLeastEvidence))};
}

// Why several signs together are not clear enough: the weakest of them.
std::string unclear_because(const FieldSigns& signs, const Clearness& clearness) {
  const double others = std::min(clearness.squareness, clearness.evidence);
  if (clearness.held < std::min(others, clearness.roughness))
    return fmt::format("what may be plots holds {:.0f} % of the canopy here",
                       100 * signs.held_share);
  if (clearness.roughness < others)
    return "what may be plots is nearly as smooth as roofs are (photogrammetry smooths a canopy)";
  return "canopy lies here, but not in plots of one size at equal steps";
}

double canopy_in(const RowView& view, const CellBox& box) {
  return view.cover(box.r0, box.r1, box.c0, box.c1) *
         view.seen_cells(box.r0, box.r1, box.c0, box.c1);
}

double least_gap_m(const Lattice& lattice) {
  const auto gap = [](double pitch_m, double size_m) {
    return pitch_m > 0 ? pitch_m - size_m : std::numeric_limits<double>::infinity();
  };
  return std::min(gap(lattice.r.pitch_m, lattice.r.size_m),
                  gap(lattice.c.pitch_m, lattice.c.size_m));
}

// Length over width of plots that are wider by a standard error: two drill rows hide part of the
// sown width.
double least_aspect(const Lattice& lattice) {
  const auto [width_m, length_m] = std::minmax(lattice.r.size_m, lattice.c.size_m);
  return length_m / (width_m + box_error(lattice, {}).width_m);
}

const Side& across(const Lattice& lattice) {
  return lattice.r.size_m < lattice.c.size_m ? lattice.r : lattice.c;
}

double filled_share(const Lattice& lattice) {
  double places = 0;
  for (const auto& [row, end] : row_ends(lattice.places)) places += end.second - end.first + 1;
  return static_cast<double>(lattice.places.size()) / std::max(1.0, places);
}

// Canopy of the square metres of a plot, or of the mean plot; one after the other along its sides.
class Pieces {
 public:
  explicit Pieces(const Lattice& lattice)
      : lattice_(lattice),
        r_parts_(parts_of(lattice.r.size_m)),
        c_parts_(parts_of(lattice.c.size_m)) {}

  std::vector<double> of(const Place& place) const {
    const CellBox box = cells_about(lattice_, place, 0);
    std::vector<double> canopy;
    for (const Band& r : equal_parts({box.r0, box.r1}, r_parts_))
      for (const Band& c : equal_parts({box.c0, box.c1}, c_parts_))
        canopy.push_back(lattice_.view.cover(r.begin, r.end, c.begin, c.end));
    return canopy;
  }

  std::vector<double> of_mean_plot() const {
    std::vector<double> sum(static_cast<std::size_t>(r_parts_ * c_parts_));
    for (const Place& place : lattice_.places) {
      const std::vector<double> canopy = of(place);
      std::ranges::transform(sum, canopy, sum.begin(), std::plus());
    }
    return sum;
  }

 private:
  static int parts_of(double size_m) {
    return std::max(1, static_cast<int>(std::lround(size_m / kCanopyPiece_m)));
  }

  const Lattice& lattice_;
  int r_parts_, c_parts_;
};

double spread_over_mean(const std::vector<double>& canopy) {
  const double middle = mean(canopy);
  double squares = 0;
  for (const double value : canopy) squares += value * value;
  const double variance = squares / static_cast<double>(canopy.size()) - middle * middle;
  return std::sqrt(std::max(0.0, variance)) / std::max(1e-9, middle);
}

// Unevenness, median over the plots.
double unevenness_of(const Lattice& lattice, const Pieces& pieces) {
  std::vector<double> spreads;
  for (const Place& place : lattice.places) spreads.push_back(spread_over_mean(pieces.of(place)));
  return quantile(std::move(spreads), 0.5);
}

std::vector<Eigen::Vector2d> centres_of(const Lattice& lattice) {
  std::vector<Eigen::Vector2d> centres;
  for (const Place& place : lattice.places)
    centres.push_back(lattice.view.to_world(place.r_m, place.c_m));
  return centres;
}

// Whether plots so long are rows of a crop, of vines or of trees.
bool are_rows(const FieldSigns& signs) {
  const bool sown_beside = signs.pitch_m > kMostPitchOfRows_m && signs.passage < kLeastPassage;
  return signs.aspect > kMostAspect && !sown_beside;
}

}  // namespace

double held_share(const Lattice& lattice) {
  const RowView& view = lattice.view;
  double held = 0;
  for (const Place& place : lattice.places) held += canopy_in(view, cells_about(lattice, place, 0));
  return held / std::max(1e-9, canopy_in(view, {0, view.r_cells(), 0, view.c_cells()}));
}

FieldSigns signs_of(const Lattice& lattice, const FieldCanopy& field, double noise_m,
                    double evidence) {
  const Pieces pieces(lattice);
  const Squareness squareness = squareness_of(lattice);
  const Roughness tops = roughness(lattice, field.points(), noise_m);
  const double sides = std::hypot(lattice.r.size_m, lattice.c.size_m);
  return {.plots = lattice.places.size(),
          .held_share = held_share(lattice),
          .filled_share = filled_share(lattice),
          .surface_share = field.surface_share(centres_of(lattice), sides / 2 + kNear_m),
          .squareness = squareness.of_outline,
          .straightness = squareness.of_canopy,
          .roughness = tops.of_height,
          .patch_scatter = tops.in_patches,
          .unevenness = unevenness_of(lattice, pieces),
          .mean_unevenness = spread_over_mean(pieces.of_mean_plot()),
          .aspect = least_aspect(lattice),
          .pitch_m = across(lattice).pitch_m,
          .passage = across(lattice).pitch_m / across(lattice).size_m - 1,
          .least_gap_m = least_gap_m(lattice),
          .gap_cover = gap_cover(lattice),
          .evidence = evidence / static_cast<double>(lattice.places.size())};
}

std::string no_plots_because(const FieldSigns& signs) {
  if (signs.surface_share > kMostSurface || signs.roughness < kLeastRoughness ||
      signs.patch_scatter < kLeastPatchScatter)
    return "what stands here has smooth surfaces, as walls, roofs or cars do; a crop from photos "
           "has "
           "them too, and is measured where --boxes say that plots are";
  if (are_rows(signs) || signs.least_gap_m < kLeastGapSeen_m || signs.gap_cover > kMostGapCover)
    return "rows of a crop or a vineyard lie here, not plots";
  const bool few = signs.plots < kFewPlots;
  const bool square = signs.squareness >= (few ? kLeastSquarenessOfFew : kLeastSquareness);
  if (!square && (few || signs.straightness < kStraight))
    return "the canopy lies here in round crowns or bushes, not in plots with straight sides";
  if (signs.mean_unevenness > kMostUneven || signs.unevenness > kMostUnevenAtRandom ||
      (signs.unevenness > kMostUneven && signs.held_share < kLeastHeldOfUneven))
    return "single bushes or trees stand here, not plots that are covered by a crop";
  if (signs.filled_share < kLeastFilled)
    return "canopy lies here, but not in plots of one size at equal steps";
  const Clearness clearness = clearness_of(signs);
  return clearness.product() < kLeastConfidence ? unclear_because(signs, clearness) : "";
}

std::string no_touching_plots_because(FieldSigns signs, double in_gaps) {
  if (signs.held_share < kLeastHeldOfTouching * (1 - in_gaps))
    return "canopy lies here, but not in plots without gaps";
  signs.least_gap_m = std::numeric_limits<double>::infinity();
  signs.gap_cover = 0;
  return no_plots_because(signs);
}

bool may_be_beside_others(FieldSigns signs) {
  signs.held_share = 1;
  signs.gap_cover = 0;
  return no_plots_because(signs).empty();
}

double field_confidence(const FieldSigns& signs) { return clearness_of(signs).product(); }

double confidence_beside_others(FieldSigns signs) {
  signs.held_share = 1;
  return field_confidence(signs);
}

}  // namespace plotscan::plots
