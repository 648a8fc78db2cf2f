// SPDX-License-Identifier: Apache-2.0
#include "farmbench/found_fields.h"

#include <gtest/gtest.h>

#include "blind_suite.h"
#include "farmbench/farm_scan.h"
#include "farmbench/suite.h"
#include "methods/lattice/lattice.h"

namespace plotscan::farmbench {
namespace {

using methods::lattice::Options;
using plotscan::testing::TemporaryFolder;

// The scan of a small farm.
class SharedSearch : public ::testing::Test {
 protected:
  void SetUp() override {
    const Suite suite = load_suite(testing::write_blind_suite(folder_));
    const FarmPlace place{suite.cases.front(), 7, folder_.path(), 2};
    cloud_ = scan_farm(place, make_farm(place), {}).cloud;
    for (const score::TruePlot& plot : standing_plots(place)) boxes_.push_back(plot.box);
  }

  TemporaryFolder folder_;
  std::filesystem::path cloud_;
  std::vector<PlotBox> boxes_;
};

TEST_F(SharedSearch, GivesEveryMethodWhatItFindsAndMeasuresAlone) {
  FoundFields found(cloud_);
  const std::vector<Options> methods = {{},
                                        {.calibrated = false},
                                        {.crop = "wheat"},
                                        {.plot_width_m = 1.3},
                                        {.boxes = boxes_},
                                        {.boxes = {boxes_.front()}},
                                        {}};
  for (const Options& options : methods) {
    const estimate::Estimate shared = measure_field(found.with(options), options);
    const estimate::Estimate alone = methods::lattice::estimate_plots(cloud_, options);
    ASSERT_EQ(shared.plots.size(), alone.plots.size());
    ASSERT_FALSE(shared.plots.empty());
    for (std::size_t i = 0; i < alone.plots.size(); ++i) {
      EXPECT_EQ(shared.plots[i].box.center, alone.plots[i].box.center);
      EXPECT_EQ(shared.plots[i].box.width_m, alone.plots[i].box.width_m);
      EXPECT_EQ(shared.plots[i].heights_m, alone.plots[i].heights_m);
      EXPECT_EQ(shared.plots[i].flags, alone.plots[i].flags);
    }
    EXPECT_EQ(shared.ground->z_m, alone.ground->z_m);
    EXPECT_EQ(to_json(shared.diagnostics), to_json(alone.diagnostics));
  }
}

TEST_F(SharedSearch, IsMadeOnceForMethodsThatOnlyMeasureOtherwise) {
  FoundFields found(cloud_);
  const auto* first = &found.with({});
  EXPECT_EQ(found.spared_s(), 0);
  EXPECT_EQ(&found.with({.calibrated = false}), first);
  const double spared_s = found.spared_s();
  EXPECT_GT(spared_s, 0);
  EXPECT_NE(&found.with({.noise_m = 0.02}), first);
  EXPECT_NE(&found.with({.boxes = boxes_}), first);
  EXPECT_NE(&found.with({.crop_box = cloud::Area{-5, -5, 5, 5}}), first);
  EXPECT_EQ(found.spared_s(), spared_s);
  EXPECT_EQ(&found.with({.crop = "maize"}), first);
  EXPECT_EQ(found.spared_s(), 2 * spared_s);
}

}  // namespace
}  // namespace plotscan::farmbench
