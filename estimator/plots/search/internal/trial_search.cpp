// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/trial_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <tbb/task_arena.h>

#include "plots/canopy/canopy_raster.h"
#include "plots/lattice/lattice.h"
#include "plots/layout/layout.h"
#include "plots/search/internal/heading.h"
#include "plots/search/internal/told_layout.h"
#include "plots/search/internal/trial_area.h"
#include "plots/signs/field_signs.h"

namespace plotscan::plots {
namespace {

constexpr double kAxisCell_m = 0.1;  // of the raster on which the heading is sought
constexpr double kCell_m = 0.05;
constexpr double kLeastLeaves_m = 0.12;  // lower are clods and the lowest weeds,
constexpr double kMostOfTop = 0.5;       // but in a crop lower than twice this, leaves too
constexpr double kLeavesFrom = 0.25;     // of the crop's height: lower may be weeds

constexpr const char* kNoCanopy = "no canopy stands out from the ground here";

constexpr int kSizeRounds = 2;  // of size and centres in turn

PlotField no_plots(std::string why) { return {.why_none = std::move(why)}; }

// The same plots, each with half of the gaps beside it.
Lattice with_gaps(Lattice lattice) {
  for (Side* side : {&lattice.r, &lattice.c})
    side->size_m += gap_of_trial_m(side->pitch_m, side->size_m);
  return lattice;
}

FieldFit fit_of(const Lattice& lattice, const std::optional<SownRows>& sown_rows) {
  const bool by_c = lattice.c.size_m > lattice.r.size_m;
  const Side &length = by_c ? lattice.c : lattice.r, &width = by_c ? lattice.r : lattice.c;
  return {.layout = layout_of(lattice),
          .columns_aligned = lattice.aligned,
          .rms_along_length_m = length.rms_m,
          .rms_along_width_m = width.rms_m,
          .leaf_spread_m = std::max(lattice.r.blur_m, lattice.c.blur_m),
          .sown_rows = sown_rows,
          .side_contrast = lattice.contrast};
}

Frame frame_of(const FieldAxes& axes) {
  return {.a_axis = {std::cos(axes.first_rad), std::sin(axes.first_rad)},
          .b_axis = {std::cos(axes.second_rad), std::sin(axes.second_rad)}};
}

// Sizes that the user gave are the sizes; the length is the longer one.
void take_given_sides(Lattice& lattice, const Hints& hints) {
  const bool along_r = lattice.r.size_m >= lattice.c.size_m;
  Side &length = along_r ? lattice.r : lattice.c, &width = along_r ? lattice.c : lattice.r;
  length.size_m = hints.length_m.value_or(length.size_m);
  width.size_m = hints.width_m.value_or(width.size_m);
}

// The rows that the plots are sown in. For plots of few rows leaves say little of the sown width:
// the number of rows times their spacing is used instead.
std::optional<SownRows> take_sown_rows(Lattice& lattice) {
  std::optional<SownRows> rows = sown_rows_along(lattice);
  if (rows) {
    lattice.r.size_m = rows->extent_m();
    return rows;
  }
  rows = sown_rows_along(lattice.turned());
  if (rows) lattice.c.size_m = rows->extent_m();
  return rows;
}

// Sizes and places in turn.
std::optional<SownRows> refine(Lattice& lattice, const Hints& hints) {
  for (int round = 0; round < kSizeRounds; ++round) {
    fit_edges(lattice);
    straighten(lattice);
  }
  fit_edges(lattice);
  std::optional<SownRows> rows = take_sown_rows(lattice);
  if (rows) rows->across = rows->extent_m() >= std::max(lattice.r.size_m, lattice.c.size_m);
  take_given_sides(lattice, hints);
  return rows;
}

std::vector<FoundPlot> plots_on(const Lattice& lattice, const TrialLayout& layout,
                                double field_confidence, const Hints& hints) {
  std::vector<FoundPlot> plots;
  const PlotBoxError error = box_error(lattice, hints);
  const std::vector<bool> edgeless = without_edge(lattice);
  for (std::size_t i = 0; i < lattice.places.size(); ++i) {
    const Place& place = lattice.places[i];
    const double clearness = std::clamp(0.5 * (place.share + place.contrast), 0.0, 1.0);
    plots.push_back({.row = layout.places[i].row,
                     .column = layout.places[i].column,
                     .box = layout.box(layout.places[i]),
                     .box_error = error,
                     .confidence = field_confidence * clearness,
                     .without_edge = edgeless[i]});
  }
  // Whichever axis the search took for that of the rows.
  std::ranges::sort(plots, {},
                    [](const FoundPlot& plot) { return std::pair(plot.row, plot.column); });
  return plots;
}

// A layout, and another that the canopy shows more clearly than the user's, if there is one.
struct Choice {
  Layout layout;
  std::optional<Layout> rival = std::nullopt;
};

Choice choose_layout(const CanopyRaster& canopy, Hints hints, LineModel model) {
  constexpr double kMoreClearly = 1.1;
  if (!hints.tell_layout()) return {best_layout(canopy, hints, model)};
  Layout shown = best_layout(canopy);
  if (model != LineModel::touching && is_as_told(shown, hints)) return {std::move(shown)};
  // Where plots touch, their length lies along the rows of the crop.
  if (model == LineModel::touching && !hints.heading_rad)
    hints.heading_rad = heading_of_rows(shown);
  Choice choice{best_layout(canopy, hints, model)};
  const bool clearer = shown.evidence > kMoreClearly * choice.layout.evidence;
  if (!shown.rows.empty() && clearer) choice.rival = std::move(shown);
  return choice;
}

// Why there is no layout.
std::string no_layout(const Hints& hints, const std::optional<Layout>& rival) {
  if (!hints.tell_layout()) return "no plots of one size lie in rows here";
  return "no plots of the size and number told lie in rows here" +
         (rival ? "; the canopy shows " + text_of(*rival) : "");
}

// Whether the layout's plots are single rows that others are sown in.
bool are_rows(const Layout& layout, const std::optional<SownRows>& rows) {
  const int width = std::min(layout.r_shape.size, layout.c_shape.size);
  return rows && width * layout.view.cell_m() < rows->spacing_m;
}

// Why what looks like plots is none; "" where it may be plots. What the user told is taken as true,
// but that plots touch is not told.
std::string refused_because(const TrialLayout& layout, const FieldSigns& signs, double in_gaps,
                            const Hints& hints, LineModel model) {
  if (!hints.tell_layout()) return no_plots_because(signs);
  std::string why = not_told_because(layout, signs, hints);
  if (why.empty() && model == LineModel::touching) return no_touching_plots_because(signs, in_gaps);
  return why;
}

// Counts what is higher, tall plots and those beside another crop too.
CanopyScale leaves_above(double height_m) {
  constexpr double kStep_m = 1e-3;  // from no leaves to leaves
  return {.low_m = height_m, .high_m = height_m + kStep_m, .with_others = true};
}

// How many plots of a trial beside others these may be.
std::size_t plots_beside_others(const FieldSigns& signs, double explained) {
  constexpr double kLeastOfAll = 0.15;  // six trials of one size hold 0.17 each
  return explained > kLeastOfAll && may_be_beside_others(signs) ? signs.plots : 0;
}

// By height; leaves from a quarter of the crop's height on; every leaf.
std::array<CanopyScale, 3> scales_of(const FieldCanopy& field, double noise_m) {
  const double low_m =
      std::max(std::min(kLeastLeaves_m, kMostOfTop * field.scale().high_m), 4 * noise_m);
  const double leaves_m = std::max(low_m, kLeavesFrom * field.scale().high_m);
  return {field.scale(), leaves_above(leaves_m), leaves_above(low_m)};
}

Look look_along(const FieldAxes& axes, const FieldCanopy& field, double noise_m, const Hints& hints,
                LineModel model, int threads) {
  const Frame frame = frame_of(axes);
  const std::array scales = scales_of(field, noise_m);
  const std::vector<CanopyRaster> rasters = rasterise(field, frame, kCell_m, scales, threads);
  const CanopyRaster &canopy = rasters[0], &low_leaves = rasters[2];
  // Beside a giant a dwarf that touches it is as good as bare, unless every leaf counts.
  const bool touching = model == LineModel::touching;
  const CanopyRaster& cover = touching ? low_leaves : rasters[1];
  tbb::task_arena arena(threads);
  Choice choice;
  arena.execute([&] { choice = choose_layout(touching ? low_leaves : canopy, hints, model); });
  auto& [layout, rival] = choice;
  if (layout.rows.empty()) return {no_plots(no_layout(hints, rival))};

  layout.view.raster = &cover;
  Lattice lattice = fit_lattice(layout, hints, &low_leaves, &canopy);
  if (lattice.places.empty()) return {no_plots("no plots of one size lie in rows here")};
  const std::optional<SownRows> rows = refine(lattice, hints);
  lattice.view.raster = &canopy;
  const FieldSigns signs = signs_of(lattice, field, noise_m, layout.evidence_in_outline);
  const double in_gaps = held_share(with_gaps(lattice)) - signs.held_share;
  lattice.view.raster = &cover;
  FieldFit fit = fit_of(lattice, rows);
  Look look{no_plots(refused_because(fit.layout, signs, in_gaps, hints, model))};
  look.field.fit = std::move(fit);
  look.field.signs = signs;
  if (hints.tell_layout() && !touching) look.field.doubt = no_plots_because(signs);
  if (rival && !are_rows(*rival, rows)) look.field.rival = text_of(*rival);
  look.explained = held_share(with_gaps(lattice));
  if (!look.field.why_none.empty()) {
    look.may_be = plots_beside_others(signs, look.explained);
    return look;
  }
  look.field.plots = plots_on(lattice, look.field.fit->layout, field_confidence(signs), hints);
  look.edgeless = count_edgeless(lattice);
  look.may_be = look.field.plots.size();
  look.evidence = layout.evidence;
  return look;
}

// Of looks at the same canopy.
Look clearest(const std::vector<Look>& looks) {
  if (looks.empty()) return {no_plots(kNoCanopy)};
  return *std::ranges::max_element(
      looks, {}, [](const Look& look) { return std::pair(look.evidence, look.may_be); });
}

// Where a part of what stands on a field is taken for something else, what is left may be few
// pieces of anything: they must be so many.
bool is_field(const Look& look) {
  constexpr std::size_t kLeastPlots = 4;
  return look.evidence > 0 && look.field.plots.size() >= kLeastPlots;
}

// Whether a look shows more plots than the one before, as far as they are plots. The evidence of
// the two is not that of the same canopy.
bool shows_more(const Look& look, const Look& before) {
  if (look.evidence == 0 && before.evidence == 0) return look.may_be > before.may_be;
  return is_field(look) && (before.evidence == 0 || expected_plots(look) > expected_plots(before));
}

// Whether there are plots, and nothing speaks against them.
bool is_sure(const Look& look) { return look.evidence > 0 && look.field.doubt.empty(); }

// Whether the plots hold nearly all of the canopy that was looked at.
bool holds_most(const Look& look) {
  constexpr double kMost = 0.9;
  return is_sure(look) && look.field.signs->held_share > kMost;
}

// Whether many plots show with gaps between them: they do not touch.
bool shows_gaps(const Look& look) {
  constexpr std::size_t kMany = 9;
  constexpr double kMostInGaps = 0.8, kLeastSeen_m = 0.1;
  if (look.evidence == 0 || look.field.plots.size() < kMany) return false;
  const FieldSigns& signs = *look.field.signs;
  return signs.gap_cover < kMostInGaps && signs.least_gap_m > kLeastSeen_m &&
         no_plots_because(signs).empty();
}

// Whether the plots and their gaps are all that stands there, and nothing was left out.
bool explains_all(const Look& look) {
  return is_sure(look) && look.explained > kNearlyAll && look.field.others_m2 == 0;
}

// Looks at a field in several ways, and keeps the best.
class TrialSearch {
 public:
  explicit TrialSearch(const ScannedField& scanned)
      : scanned_(scanned), tops_m_(scanned.blocks.crop_tops_m()) {}

  void look_in_every_canopy(LineModel model, const std::vector<bool>& others = {}) {
    for (const double top_m : tops_m_) look({.top_m = top_m, .others = others}, model);
  }

  // Another crop may stand beside the plots.
  void look_beside_closed_canopy() {
    for (const std::vector<bool>& others : scanned_.blocks.closed()) {
      look_in_every_canopy(LineModel::free_ends, others);
      if (holds_most(best())) return;
    }
  }

  bool found_canopy() const { return best_.has_value(); }
  const std::vector<Look>& looks() const { return looks_; }
  Look best() const { return best_.value_or(Look{no_plots(kNoCanopy)}); }

 private:
  void look(const Crop& crop, LineModel model) {
    const auto& [points, blocks, noise_m, hints, threads, ground_error] = scanned_;
    const FieldCanopy field(points, blocks, crop, threads, ground_error);
    std::vector<Look> looks;
    for (const FieldAxes& axes : axes_in(field, crop))
      looks.push_back(look_along(axes, field, noise_m, hints, model, threads));
    looks_.insert(looks_.end(), looks.begin(), looks.end());
    Look look = clearest(looks);
    look.field.others_m2 = blocks.covered_m2(crop.others);
    if (!best_ || shows_more(look, *best_)) best_ = std::move(look);
  }

  // A canopy's axes, the same whatever is assumed of what stands beside the plots.
  const std::vector<FieldAxes>& axes_in(const FieldCanopy& field, const Crop& crop) {
    const auto [known, is_new] = axes_.try_emplace({crop.top_m, crop.others});
    if (is_new) {
      const int threads = scanned_.threads;
      const CanopyRaster coarse =
          rasterise(field, {}, kAxisCell_m, {&field.scale(), 1}, threads).front();
      known->second = find_axes(coarse, scanned_.hints.heading_rad, threads);
    }
    return known->second;
  }

  const ScannedField& scanned_;
  std::vector<double> tops_m_;
  std::map<std::pair<double, std::vector<bool>>, std::vector<FieldAxes>> axes_;  // by crop
  std::vector<Look> looks_;
  std::optional<Look> best_;
};

}  // namespace

double expected_plots(const Look& look) {
  if (look.evidence == 0) return 0;
  return static_cast<double>(look.field.plots.size() - look.edgeless) *
         field_confidence(*look.field.signs);
}

Look look_once(const ScannedField& scanned) {
  TrialSearch search(scanned);
  search.look_in_every_canopy(LineModel::free_ends);
  return search.best();
}

Look look_twice(const ScannedField& scanned) {
  TrialSearch search(scanned);
  search.look_in_every_canopy(LineModel::free_ends);
  Look first = search.best();
  if (first.explained > kNearlyAll) return first;
  search.look_in_every_canopy(LineModel::even_ends);
  Look best = search.best();
  return first.evidence == 0 || best.explained > kNearlyAll ? best : first;
}

Looks look_in_all_ways(const ScannedField& scanned) {
  TrialSearch search(scanned);
  search.look_in_every_canopy(LineModel::free_ends);
  const std::vector<Look> at_all = search.looks();
  if (!search.found_canopy() || holds_most(search.best())) return {at_all, search.best()};
  search.look_beside_closed_canopy();
  if (search.best().evidence == 0) search.look_in_every_canopy(LineModel::even_ends);
  // Plots of the sides told may touch. Or there are gaps in them too, as of wheels: pieces of
  // plots look like many things beside the field then.
  if (scanned.hints.tell_sides() && !explains_all(search.best()))
    search.look_in_every_canopy(shows_gaps(search.best()) ? LineModel::even_ends
                                                          : LineModel::touching);
  return {at_all, search.best()};
}

}  // namespace plotscan::plots
