// SPDX-License-Identifier: Apache-2.0
#include "crop/cultivar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan::crop {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

const char* const kReed = R"(crop: reed
species: Phragmites example
default_stage: tall
sources: {book: A book. A publisher., chosen: Chosen.}
plot: {plants_per_m2: 50, row_spacing_m: 0.2, source: "book, p. 3"}
colours: {leaf: [0.1, 0.5, 0.2], stem: [0.3, 0.4, 0.1]}
parameters:
  angle_deg: {value: 40, range: [0, 90], unit: deg, meaning: of the leaves, source: book}
  nodes: {range: [1, 20], unit: count, meaning: nodes of the stem, source: chosen}
stages:
  - {name: short, meaning: young, values: {nodes: 4}, height_m: [0.1, 0.3],
     leaf_area_index: [0.1, 0.6], leaf_inclination_deg: [30, 60], source: book}
  - {name: tall, meaning: old, values: {nodes: 12}, height_m: [1, 2],
     leaf_area_index: [2, 4], leaf_inclination_deg: [30, 60], source: book}
)";

Cultivar reed() { return parse_cultivar(kReed, "reed.yaml"); }

Cultivar with(const std::string& user_file) {
  const TemporaryFolder folder;
  return override_cultivar(reed(), folder.write("mine.yaml", user_file));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(Cultivar, ReadsParametersStagesAndPlot) {
  const Cultivar cultivar = reed();
  EXPECT_EQ(cultivar.crop, "reed");
  EXPECT_EQ(cultivar.plants_per_m2, 50);
  EXPECT_EQ(cultivar.stage("").name, "tall");
  EXPECT_EQ(cultivar.stage("short").height_m.high, 0.3);
  EXPECT_EQ(Traits(cultivar, cultivar.stage("short"), {}).count("nodes"), 4);
  const Traits traits(cultivar, cultivar.stage("tall"), {"angle_deg=60"});
  EXPECT_EQ(traits.count("nodes"), 12);
  EXPECT_EQ(traits["angle_deg"], 60);
  EXPECT_NEAR(traits.radians("angle_deg"), 1.0472, 1e-4);
}

TEST(Cultivar, AUsersFileChangesWhatItNames) {
  const Cultivar mine = with(
      "crop: reed\nparameters: {angle_deg: {value: 20}}\n"
      "stages: [{name: tall, values: {nodes: 15}}]\nplot: {plants_per_m2: 30}\n");
  EXPECT_EQ(Traits(mine, mine.stage("tall"), {})["angle_deg"], 20);
  EXPECT_EQ(Traits(mine, mine.stage("tall"), {}).count("nodes"), 15);
  EXPECT_EQ(Traits(mine, mine.stage("short"), {}).count("nodes"), 4);
  EXPECT_EQ(mine.plants_per_m2, 30);
  EXPECT_EQ(mine.row_spacing_m, 0.2);
  const Cultivar copy = with(kReed);
  EXPECT_EQ(copy.stages.size(), 2u) << "a whole copy is a user's file as well";
  EXPECT_EQ(copy.parameters.size(), 2u);
}

TEST(Cultivar, RefusesAUsersFileThatDoesNotFit) {
  const auto message = [](const std::string& text) {
    return message_of<InputError>([&] { with(text); });
  };
  EXPECT_THAT(message("crop: wheat\n"), HasSubstr("mine.yaml:1: crop is wheat, but the plant is"));
  EXPECT_THAT(message("species: x\n"), HasSubstr("crop is missing"));
  EXPECT_THAT(message("crop: reed\nparameters: {petal: {value: 1}}\n"),
              HasSubstr("mine.yaml:2: parameters.petal is not a known key; known here are angle"));
  EXPECT_THAT(message("crop: reed\nparameters: {angle_deg: {value: 100}}\n"),
              HasSubstr("parameters.angle_deg.value 100 is not in [0, 90]"));
  EXPECT_THAT(message("crop: reed\nparameters: {angle_deg: {range: [0, 100]}}\n"),
              HasSubstr("is not a pair of numbers in [0, 90]"));
  EXPECT_THAT(message("crop: reed\nparameters: {angle_deg: {range: [50, 60]}}\n"),
              HasSubstr("mine.yaml:2: parameters.angle_deg.range leaves out the crop's value 40"));
  EXPECT_THAT(message("crop: reed\nparameters: {nodes: {range: [5, 20]}}\n"),
              HasSubstr("parameters.nodes.range leaves out the crop's value 4"));
  EXPECT_NO_THROW(
      with("crop: reed\nparameters: {nodes: {range: [5, 20]}}\n"
           "stages: [{name: short, values: {nodes: 6}}]\n"));
  EXPECT_THAT(message("crop: reed\nparameters: {nodes: {value: 5}}\n"),
              HasSubstr("parameters.nodes.value is given by each stage: set it under stages"));
  EXPECT_THAT(message("crop: reed\nparameters: {angle_deg: {unit: rad}}\n"),
              HasSubstr("is deg, not rad"));
  EXPECT_THAT(message("crop: reed\nstages: [{name: R9}]\n"),
              HasSubstr("\"R9\" is not a stage of reed, which has short, tall"));
  EXPECT_THAT(message("crop: reed\nstages: [{name: tall, values: {nodes: 4.5}}]\n"),
              HasSubstr("nodes is to be a whole number in [1, 20]"));
  EXPECT_THAT(message("crop: reed\ncolours: {petal: [1, 0, 0]}\n"),
              HasSubstr("petal is not a material of reed, which has leaf, stem"));
  EXPECT_THAT(message("crop: reed\ncolours: {leaf: [1, 0, 2]}\n"),
              HasSubstr("[1, 0, 2] is not 3 numbers in [0, 1]"));
}

TEST(Cultivar, ACropsOwnFileIsWholeAndNamesItsSources) {
  const auto message = [](const std::string& from, const std::string& to) {
    return message_of<InputError>([&] { parse_cultivar(replaced(kReed, from, to), "reed.yaml"); });
  };
  EXPECT_THAT(message("crop: reed", "crop: wheat"),
              HasSubstr("reed.yaml:1: crop is wheat, but the plant is a reed"));
  EXPECT_THAT(message("source: chosen", "source: rumour"),
              HasSubstr("\"rumour\" is not one of the file's sources, which are book, chosen"));
  EXPECT_THAT(message("values: {nodes: 4}, ", ""), HasSubstr("values is missing"));
  EXPECT_THAT(message("{nodes: 4}", "{}"), HasSubstr("nodes is missing"));
  EXPECT_THAT(message("default_stage: tall", "default_stage: old"), HasSubstr("\"old\""));
  EXPECT_THAT(message("[0.1, 0.3]", "[0.3, 0.1]"), HasSubstr("larger end first"));
}

TEST(Cultivar, RefusesAssignmentsOutOfRange) {
  const Cultivar cultivar = reed();
  const auto message = [&](const std::string& assignment) {
    return message_of<InputError>([&] { Traits(cultivar, cultivar.stage(""), {assignment}); });
  };
  EXPECT_THAT(message("nodes=1e9"),
              HasSubstr("--set nodes=1e9: nodes is to be a whole number in [1, 20]"));
  EXPECT_THAT(message("nodes=4.5"), HasSubstr("whole number"));
  EXPECT_THAT(message("angle_deg=nan"), HasSubstr("angle_deg is to be a number in [0, 90]"));
  EXPECT_THAT(message("angle_deg="), HasSubstr("angle_deg is to be a number"));
  EXPECT_THAT(message("angle_deg"), HasSubstr("angle_deg is to be a number"));
  EXPECT_THAT(message("petal=1"),
              HasSubstr("petal is not a known key; known are angle_deg, nodes"));
  EXPECT_THAT(message_of<InputError>([&] { cultivar.stage("R2"); }),
              HasSubstr("stage R2 is not one of reed's, which are short, tall"));
}

TEST(Cultivar, AUsersFileStatesReflectancesOfTheCropsMaterials) {
  EXPECT_TRUE(reed().reflectance.empty());
  const Cultivar mine = with("crop: reed\nreflectance: {leaf: 0.5}\n");
  EXPECT_EQ(mine.reflectance, (std::map<std::string, float>{{"leaf", 0.5F}}));
  const auto refusal = [](const std::string& reflectance) {
    return message_of<InputError>([&] { with("crop: reed\nreflectance: " + reflectance + "\n"); });
  };
  EXPECT_THAT(refusal("{ear: 0.5}"), HasSubstr("mine.yaml:2: reflectance.ear"));
  EXPECT_THAT(refusal("{leaf: 1.01}"), HasSubstr("mine.yaml:2: reflectance.leaf"));
}

}  // namespace
}  // namespace plotscan::crop
