// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/settings.h"

#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "methods/lattice/settings.h"
#include "temporary_folder.h"

namespace plotscan::methods {
namespace {

using plotscan::testing::message_of;

template <class Options>
void set(const std::vector<MethodSetting<Options>>& settings, const std::string& key,
         const std::string& text, Options& options) {
  const auto found = std::ranges::find(settings, key, &MethodSetting<Options>::key);
  ASSERT_NE(found, settings.end()) << key;
  assign(*found, key, text, options);
}

TEST(MethodSettings, SetWhatTheyAreNamedAfter) {
  lattice::Options options;
  const auto& settings = lattice::settings();
  set(settings, "heading_deg", "-30.5", options);
  set(settings, "plot_width_m", "1.5", options);
  set(settings, "plot_length_m", "4", options);
  set(settings, "rows", "3", options);
  set(settings, "columns", "5", options);
  set(settings, "plots", "14", options);
  set(settings, "crop", "wheat", options);
  set(settings, "noise_m", "0.02", options);
  set(settings, "ground_classes", "2,9", options);
  set(settings, "calibrated", "false", options);
  EXPECT_EQ(options.heading_deg, -30.5);
  EXPECT_EQ(options.plot_width_m, 1.5);
  EXPECT_EQ(options.plot_length_m, 4);
  EXPECT_EQ(options.rows, 3);
  EXPECT_EQ(options.columns, 5);
  EXPECT_EQ(options.plots, 14);
  EXPECT_EQ(options.crop, "wheat");
  EXPECT_EQ(options.noise_m, 0.02);
  EXPECT_EQ(options.ground_classes, (std::vector<int>{2, 9}));
  EXPECT_FALSE(options.calibrated);
  EXPECT_EQ(settings_json(settings, options).dump(),
            R"({"calibrated":false,"columns":5,"crop":"wheat","ground_classes":[2,9],)"
            R"("heading_deg":-30.5,"noise_m":0.02,"plot_length_m":4.0,"plot_width_m":1.5,)"
            R"("plots":14,"rows":3})");
}

TEST(MethodSettings, OfAnAreaAndAFlag) {
  dhami2020::Options options;
  set(dhami2020::settings(), "learn_box", "-1,-2.5,3,4", options);
  set(dhami2020::settings(), "level", "false", options);
  EXPECT_EQ(options.learn_box, (cloud::Area{-1, -2.5, 3, 4}));
  EXPECT_FALSE(options.level);
}

TEST(MethodSettings, RefuseWhatTheyCannotHold) {
  const auto message = [](const std::string& key, const std::string& text) {
    return message_of<InputError>([&] {
      lattice::Options options;
      set(lattice::settings(), key, text, options);
    });
  };
  EXPECT_EQ(message("heading_deg", "361"), "heading_deg 361 must be in [-360, 360]");
  EXPECT_EQ(message("heading_deg", "nan"), "heading_deg nan must be in [-360, 360]");
  EXPECT_EQ(message("heading_deg", "north"), "heading_deg \"north\" is not a number");
  EXPECT_EQ(message("rows", "0"), "rows 0 must be in [1, 100000]");
  EXPECT_EQ(message("rows", "1.5"), "rows \"1.5\" is not a whole number");
  EXPECT_EQ(message("ground_classes", "2,256"), "ground_classes 256 must be in [0, 255]");
  EXPECT_EQ(message("crop", "tulip"), "crop \"tulip\" must be one of maize, soybean, wheat");
  EXPECT_EQ(message("calibrated", "no"), "calibrated \"no\" must be one of true, false");
}

// The usual options are sound, and no two settings are called the same.
template <class Options>
void expect_consistent(const std::vector<MethodSetting<Options>>& settings) {
  EXPECT_NO_THROW(require_settings(settings, Options{}));
  std::set<std::string> names;
  for (const MethodSetting<Options>& setting : settings) {
    EXPECT_TRUE(names.insert(setting.key).second) << setting.key;
    EXPECT_TRUE(setting.flag.empty() || names.insert(setting.flag).second) << setting.flag;
  }
}

TEST(MethodSettings, AreSoundAndCalledDifferently) {
  expect_consistent(lattice::settings());
  expect_consistent(dhami2020::settings());
}

}  // namespace
}  // namespace plotscan::methods
