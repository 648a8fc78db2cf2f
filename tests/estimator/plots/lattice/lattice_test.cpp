// SPDX-License-Identifier: Apache-2.0
#include "plots/lattice/lattice.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "estimator/plots/known_trial.h"

namespace plotscan::plots {
namespace {

// The bands that the trial's plots are, but for those in the `unseen` rows and columns.
Layout bands_of(const TrialLayout& trial, const CanopyRaster& raster,
                const std::set<std::pair<int, int>>& unseen = {}) {
  Layout layout{.view = {.raster = &raster}, .r_shape = {.size = 60}, .c_shape = {.size = 30}};
  layout.rows.resize(static_cast<std::size_t>(trial.rows()));
  for (const TrialPlace& place : trial.places) {
    const Eigen::Vector2d center = trial.box(place).center;
    const int r = static_cast<int>(std::lround((center.x() - 1.5) / 0.05));
    const int c = static_cast<int>(std::lround((center.y() - 0.75) / 0.05));
    Row& row = layout.rows[static_cast<std::size_t>(place.row - 1)];
    row.band = {r, r + 60};
    if (!unseen.contains({place.row, place.column})) row.plots.push_back({c, c + 30});
  }
  return layout;
}

void expect_places(const TrialLayout& found, const TrialLayout& truth) {
  ASSERT_EQ(found.places.size(), truth.places.size());
  for (std::size_t i = 0; i < truth.places.size(); ++i) {
    EXPECT_EQ(found.places[i].row, truth.places[i].row);
    EXPECT_EQ(found.places[i].column, truth.places[i].column);
    EXPECT_GT(intersection_over_union(found.box(found.places[i]), truth.box(truth.places[i])),
              0.97);
  }
}

TEST(Lattice, IsTheTrialThatTheBandsShow) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = canopy_of(trial);
  const TrialLayout found = layout_of(fit_lattice(bands_of(trial, raster), {}));
  expect_places(found, trial);
  EXPECT_NEAR(found.column_pitch_m, 1.9, 0.01);
  EXPECT_NEAR(found.row_pitch_m, 3.8, 0.01);
  EXPECT_NEAR(found.skew_rad(), 0, 0.001);
}

// The raster's cells are 5 cm, bands begin at whole ones.
TEST(Lattice, HasPitchesBetweenTheCells) {
  TrialLayout trial = known_trial({0, 0, 0});
  for (TrialPlace& place : trial.places)
    place.position_m += Eigen::Vector2d(0.022 * place.column, 0.018 * place.row);
  const CanopyRaster raster = canopy_of(trial);
  const TrialLayout found = layout_of(fit_lattice(bands_of(trial, raster), {}));
  EXPECT_NEAR(found.column_pitch_m, 1.922, 0.004);
  EXPECT_NEAR(found.row_pitch_m, 3.818, 0.004);
}

// Nothing stands in the alley, and what lies beyond it stays in its place.
TEST(Lattice, KeepsAnAlleyBetweenColumns) {
  TrialLayout trial = known_trial({0, 0, 0, 0}, 9);
  for (TrialPlace& place : trial.places)
    if (place.column > 7) place.position_m.x() += 1.2;
  trial.places.erase(trial.places.begin() + 7);
  const CanopyRaster raster = canopy_of(trial);
  expect_places(layout_of(fit_lattice(bands_of(trial, raster), {})), trial);
}

// Of a row whose gap is closed no band may show a plot; nothing stands at another crossing.
TEST(Lattice, HasPlotsThatNoBandShows) {
  for (const double offset_m : {0.0, 0.9}) {
    TrialLayout trial = known_trial({0, offset_m, 0});
    trial.places.erase(trial.places.begin() + 12);
    const CanopyRaster raster = canopy_of(trial);
    Layout layout = bands_of(trial, raster, {{1, 3}, {2, 2}});
    layout.aligned = offset_m == 0;
    expect_places(layout_of(fit_lattice(layout, {})), trial);
  }
}

TEST(Lattice, LeavesOutBandsWithoutCanopy) {
  const TrialLayout bands = known_trial({0, 0, 0});
  TrialLayout trial = bands;
  trial.places.erase(trial.places.begin() + 8);
  const CanopyRaster raster = canopy_of(trial);
  expect_places(layout_of(fit_lattice(bands_of(bands, raster), {})), trial);
}

// A lodged plot is seen 0.85 m beside the other two of its column, where no column has room.
TEST(Lattice, HasNoColumnOfAPlotThatLeansOver) {
  TrialLayout trial = known_trial({0, 0, 0}, 6);
  trial.places.erase(trial.places.begin() + 10);  // its neighbour is missing
  trial.places[9].position_m.x() += 0.85;
  const CanopyRaster raster = canopy_of(trial);
  const Lattice lattice = fit_lattice(bands_of(trial, raster), {});
  EXPECT_EQ(lattice.columns, 6);
  for (std::size_t i = 0; i < lattice.places.size(); ++i)
    EXPECT_EQ(lattice.places[i].column + 1, trial.places[i].column) << i;
}

// Of two plots hardly a leaf is as high as those of the usual plot; a third is missing.
TEST(Lattice, HasPlotsThatAreMuchLower) {
  const TrialLayout bands = known_trial({0, 0, 0});
  TrialLayout trial = bands;
  trial.places.erase(trial.places.begin() + 11);
  const auto leaves = [&](double of_low_plots) {
    return raster_of(14, 12, [&](double x, double y) {
      for (const TrialPlace& place : trial.places) {
        const bool low = place.column == place.row;  // the first one at a corner
        if (trial.box(place).contains({x, y})) return low && place.row < 3 ? of_low_plots : 0.8;
      }
      return 0.0;
    });
  };
  const CanopyRaster high = leaves(0.08), all = leaves(0.2);
  const Layout layout = bands_of(trial, high, {{1, 1}, {2, 2}});
  EXPECT_EQ(fit_lattice(layout, {}).places.size(), trial.places.size() - 2);
  expect_places(layout_of(fit_lattice(layout, {}, &all)), trial);
}

// Tall plots, whose leaves hang 0.3 m over what they touch: a low plot, and a place without one.
TEST(Lattice, HasLowPlotsThatTouchTallOnes) {
  TrialLayout bands = known_trial({0, 0, 0}, 6);
  bands.column_pitch_m = bands.width_m;
  for (TrialPlace& place : bands.places)
    place.position_m.x() = 2 + (place.column - 1) * bands.width_m;
  TrialLayout trial = bands;
  const TrialPlace low = trial.places[8], none = trial.places[10];
  trial.places.erase(trial.places.begin() + 10);
  const CanopyRaster leaves = raster_of(14, 13, [&](double x, double y) {
    for (const TrialPlace& place : trial.places) {
      PlotBox box = trial.box(place);
      box.width_m += 0.6;
      if (place.position_m != low.position_m && box.contains({x, y})) return 0.8;
    }
    return trial.box(low).contains({x, y}) ? 0.12 : 0.0;
  });
  Layout layout = bands_of(bands, leaves, {{low.row, low.column}, {none.row, none.column}});
  layout.c_touching = 30;
  expect_places(layout_of(fit_lattice(layout, {}, &leaves)), trial);
}

// Leaves are everywhere, so plots rise above nothing: a missing plot stays missing.
TEST(Lattice, HasNoLowPlotsWhereLeavesCloseTheGaps) {
  const TrialLayout bands = known_trial({0, 0, 0});
  TrialLayout trial = bands;
  trial.places.erase(trial.places.begin() + 7);
  const CanopyRaster high = canopy_of(trial),
                     all = raster_of(16, 14, [](double, double) { return 0.5; });
  expect_places(layout_of(fit_lattice(bands_of(bands, high), {}, &all)), trial);
}

// A patch as large as a plot, ten columns beyond the second row.
TEST(Lattice, LeavesOutAPatchFarBesideTheTrial) {
  const TrialLayout trial = known_trial({0, 0, 0});
  TrialLayout with_patch = trial;
  with_patch.places.push_back(trial.places[9]);
  with_patch.places.back().column = 15;
  with_patch.places.back().position_m.x() += 10 * trial.column_pitch_m;
  const CanopyRaster raster = canopy_of(with_patch);
  expect_places(layout_of(fit_lattice(bands_of(with_patch, raster), {})), trial);
}

// Two cars parked one behind the other, five columns beyond.
TEST(Lattice, LeavesOutTwoPatchesBesideEachOther) {
  const TrialLayout trial = known_trial({0, 0, 0});
  TrialLayout with_patches = trial;
  for (const std::size_t last_of_row : {9U, 14U}) {
    with_patches.places.push_back(trial.places[last_of_row]);
    with_patches.places.back().column = 10;
    with_patches.places.back().position_m.x() += 5 * trial.column_pitch_m;
  }
  const CanopyRaster raster = canopy_of(with_patches);
  expect_places(layout_of(fit_lattice(bands_of(with_patches, raster), {})), trial);
}

// The trial's canopy, and all that lies beyond `from_m` along y: a hedge or weeds.
CanopyRaster with_canopy_beyond(const TrialLayout& trial, double from_m) {
  return raster_of(14, from_m + 4, [&](double x, double y) {
    return y > from_m || std::ranges::any_of(trial.places, [&](const TrialPlace& place) {
             return trial.box(place).contains({x, y});
           });
  });
}

// Bands show a column where the canopy beyond the trial begins; it has no plots' edges.
TEST(Lattice, LeavesOutAColumnOfWhatLiesBesideTheTrial) {
  const TrialLayout trial = known_trial({0, 0, 0}), with_more = known_trial({0, 0, 0}, 6);
  const CanopyRaster raster = with_canopy_beyond(trial, 11.1);
  expect_places(layout_of(fit_lattice(bands_of(with_more, raster), {})), trial);
}

// Beside the trial stand wider plots of another crop, in the same rows.
TEST(Lattice, LeavesOutBandsAcrossPlotsOfAnotherCrop) {
  const TrialLayout trial = known_trial({0, 0, 0}), bands = known_trial({0, 0, 0}, 9);
  const double nothing_seen = 1.0 * kUnseen / kFullCover;
  const auto canopy_with = [&](double of_other) {
    return raster_of(14, 21, [&](double x, double y) {
      const bool in_row = std::abs(std::remainder(x - 3, trial.row_pitch_m)) < 1.5;
      if (y > 11) return in_row && std::fmod(y - 11, 2.9) < 2.4 ? of_other : 0.0;
      return std::ranges::any_of(trial.places,
                                 [&](const TrialPlace& place) {
                                   return trial.box(place).contains({x, y});
                                 })
                 ? 1.0
                 : 0.0;
    });
  };
  const CanopyRaster all = canopy_with(1), own = canopy_with(nothing_seen);
  const Layout layout = bands_of(bands, all);
  EXPECT_GT(fit_lattice(layout, {}).places.size(), trial.places.size());
  expect_places(layout_of(fit_lattice(layout, {}, nullptr, &own)), trial);
}

// The first plot leans 0.5 m over the field's border.
TEST(Lattice, KeepsALodgedPlotAtTheBorder) {
  const TrialLayout bands = known_trial({0, 0, 0});
  TrialLayout trial = bands;
  trial.places.front().position_m.x() -= 0.5;
  const CanopyRaster raster = with_canopy_beyond(trial, 14);
  EXPECT_EQ(fit_lattice(bands_of(bands, raster), {}).places.size(), trial.places.size());
}

// Two plots side by side in the outer row lean away from each other, as far as a plot is half
// beside its place: over their neighbours, and over the field's border. Bands do not show them.
TEST(Lattice, KeepsLodgedPlotsSideBySideAtTheBorder) {
  const TrialLayout bands = known_trial({0, 0, 0, 0}, 6);
  TrialLayout trial = bands;
  trial.places[19].position_m += Eigen::Vector2d(-0.7, 0.2);
  trial.places[20].position_m += Eigen::Vector2d(0.7, 0.2);
  const CanopyRaster raster = canopy_of(trial);
  expect_places(layout_of(fit_lattice(bands_of(bands, raster, {{4, 2}, {4, 3}}), {})), bands);
}

// Three plots half beside the places of a fourth row are another trial's: lodged ones are a tenth
// of a trial at most.
TEST(Lattice, LeavesOutARowWhosePlotsAllLieBesideTheirPlaces) {
  const TrialLayout bands = known_trial({0, 0, 0, 0}, 6);
  TrialLayout trial = bands;
  std::erase_if(trial.places,
                [](const TrialPlace& place) { return place.row == 4 && place.column % 2 == 0; });
  for (TrialPlace& place : trial.places)
    if (place.row == 4) place.position_m += Eigen::Vector2d(0.65, 0.3);
  const CanopyRaster raster = canopy_of(trial);
  const Layout layout = bands_of(bands, raster, {{4, 2}, {4, 3}, {4, 4}, {4, 5}, {4, 6}});
  EXPECT_EQ(fit_lattice(layout, {}).places.size(), 18U);
}

// The plots on either side of a missing one lean over its place, in the outer row.
TEST(Lattice, LeavesOutAPlaceThatOthersLeanOver) {
  const TrialLayout bands = known_trial({0, 0, 0, 0}, 8);
  TrialLayout trial = bands;
  trial.places[25].position_m += Eigen::Vector2d(0.7, 0.2);
  trial.places[27].position_m += Eigen::Vector2d(-0.7, 0.2);
  trial.places.erase(trial.places.begin() + 26);
  const CanopyRaster raster = canopy_of(trial);
  const Lattice lattice = fit_lattice(bands_of(bands, raster), {});
  EXPECT_EQ(lattice.places.size(), trial.places.size());
  for (const Place& place : lattice.places)
    EXPECT_FALSE(place.row == 3 && place.column == 2) << place.share << " " << place.contrast;
}

TEST(Lattice, HoldsTheNumberOfPlotsThatWasTold) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = canopy_of(trial);
  EXPECT_EQ(fit_lattice(bands_of(trial, raster), {.plots = 13}).places.size(), 13U);
}

// Rows that start elsewhere have no columns in common; numbers count pitches along each row.
TEST(Lattice, NumbersEachRowBySteps) {
  TrialLayout trial = known_trial({0, 0.9, 0});
  trial.places.erase(trial.places.begin() + 2);
  const CanopyRaster raster = canopy_of(trial);
  Layout layout = bands_of(trial, raster);
  layout.aligned = false;
  const Lattice lattice = fit_lattice(layout, {});
  EXPECT_FALSE(lattice.aligned);
  std::vector<int> first_row;
  for (const Place& place : lattice.places)
    if (place.row == 0) first_row.push_back(place.column);
  EXPECT_THAT(first_row, testing::ElementsAre(0, 1, 3, 4));
}

// The same field, whichever axis is called r; its length stays the longer side.
TEST(Lattice, TurnedIsTheSameTrial) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = canopy_of(trial);
  Lattice lattice = lattice_of(trial, raster);
  lattice.r_per_c = 0.02;
  const TrialLayout one = layout_of(lattice), other = layout_of(lattice.turned());
  EXPECT_EQ(one.length_m, 3);
  EXPECT_EQ(one.row_axis, other.row_axis);
  EXPECT_EQ(one.column_axis, other.column_axis);
  EXPECT_NEAR(one.skew_rad(), -0.02, 1e-4);
  for (std::size_t i = 0; i < one.places.size(); ++i) {
    EXPECT_EQ(one.places[i].row, other.places[i].row);
    EXPECT_EQ(one.places[i].position_m, other.places[i].position_m);
  }
}

TEST(CellsAbout, AreThoseOfThePlotAndWhatIsAroundIt) {
  const TrialLayout trial = known_trial({0}, 1);
  const CanopyRaster raster = canopy_of(trial);
  const Lattice lattice = lattice_of(trial, raster);
  const CellBox box = cells_about(lattice, lattice.places.front(), 0.1);
  EXPECT_EQ(box.r0, 28);  // (3 - 1.5 - 0.1) / 0.05
  EXPECT_EQ(box.r1, 92);
  EXPECT_EQ(box.c0, 23);  // (2 - 0.75 - 0.1) / 0.05
  EXPECT_EQ(box.c1, 57);
}

}  // namespace
}  // namespace plotscan::plots
