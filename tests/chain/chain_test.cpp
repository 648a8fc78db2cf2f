// SPDX-License-Identifier: Apache-2.0
// The programs as a user runs them: farm, flight, scan, estimate, score.
#include <algorithm>
#include <map>
#include <regex>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/csv.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/text_file.h"
#include "programs.h"
#include "small_farm.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

using testing::Finished;
using testing::run;

class Chain : public testing::CommandsInAFolder {
 protected:
  bool exists(const std::string& name) const {
    return std::filesystem::exists(folder_.path() / name);
  }
  std::string hash(const std::string& name) const { return file_hash(folder_.path() / name); }
};

TEST_F(Chain, RunsFromDescriptionToScores) {
  succeed("farmgen generate " + testing::kSmallFarm + " -o farm --seed 101");
  succeed("lidarsim fly farm -o scan");
  succeed(
      "estimator run scan/cloud.pcd -o estimate --method dhami2020 --plots 9 --crop-box=-5,-9,5,9");
  const Finished scored = succeed("estimator score estimate --truth farm --json");
  const auto scores = nlohmann::json::parse(scored.output);
  EXPECT_EQ(scores["boxes"]["plots"], 9);
  EXPECT_GE(scores["boxes"]["found"], 8);
  succeed("estimator run scan -o from_cloud_alone");
  const Finished alone = succeed("estimator score from_cloud_alone --truth farm --json");
  EXPECT_EQ(nlohmann::json::parse(alone.output)["boxes"]["found"], 9);
  EXPECT_EQ(nlohmann::json::parse(alone.output)["boxes"]["extra"], 0);
  for (const char* file :
       {"farm/world.sdf", "farm/truth/plots.geojson", "scan/cloud.pcd", "scan/trajectory.csv",
        "estimate/plots.geojson", "estimate/heights.csv", "estimate/manifest.json"}) {
    EXPECT_TRUE(exists(file)) << file;
  }
}

TEST_F(Chain, JoinsTheFlightsOfASeason) {
  succeed("farmgen generate " + testing::kSmallFarm + " -o farm --seed 101");
  for (const std::string day : {"11", "01"}) {
    succeed("lidarsim fly farm -o scan --force --speed 6 --format las --start 2026-06-" + day +
            "T10:00:00Z");
    succeed("estimator run scan/cloud.las -o estimate" + day);
  }
  const auto joined = nlohmann::json::parse(
      succeed("estimator series estimate11 estimate01 -o series --json").output);
  EXPECT_EQ(joined["plots"], 9);
  EXPECT_EQ(joined["dates"][0]["date"], "2026-06-01");
  EXPECT_EQ(joined["dates"][1]["date"], "2026-06-11");
  EXPECT_EQ(joined["dates"][1]["grown"], 9);
  EXPECT_NEAR(joined["dates"][1]["median_growth_m"].get<double>(), 0, 0.02);
  for (const char* file : {"series.csv", "by_date.csv", "by_date.geojson", "growth.csv"})
    EXPECT_TRUE(exists(std::string("series/") + file)) << file;
}

// Two trials, each with plots and a crop of its own; one is four times as tall as the other.
TEST_F(Chain, TellsTrialsBesideEachOtherApart) {
  folder_.write(
      "station.yaml",
      "terrain: {side_m: 60, vertices: 100, relief_m: 0.2}\n"
      "trials:\n"
      "  - plots: {width_m: 1.5, length_m: 4, gap_width_m: 0.5, gap_length_m: 1, "
      "position_m: [-8, 0], rows: [{plots: 6}, {plots: 6}, {plots: 6}]}\n"
      "    plants: {density_m2: 20, pattern: drilled, drill_rows: 3, models: [{crop: soybean, "
      "stage: R2, variants: 3}]}\n"
      "  - plots: {width_m: 2, length_m: 6, gap_width_m: 0.6, gap_length_m: 1.5, "
      "position_m: [9, 0], rows: [{plots: 4}, {plots: 4}]}\n"
      "    plants: {density_m2: 8, pattern: drilled, drill_rows: 3, models: [{crop: maize, "
      "variants: 3}]}\n");
  succeed("farmgen generate station.yaml -o farm");
  succeed("lidarsim fly farm -o scan");
  succeed("estimator run scan -o estimate");
  const Finished scored = succeed("estimator score estimate --truth farm --json");
  const auto scores = nlohmann::json::parse(scored.output);
  EXPECT_EQ(scores["boxes"]["found"], 26);
  EXPECT_EQ(scores["boxes"]["extra"], 0);
  EXPECT_EQ(scores["trials"][0]["found"], 18);
  EXPECT_EQ(scores["trials"][1]["heights"][0]["plots"], 8);
  EXPECT_THAT(succeed("estimator score estimate --truth farm").output,
              ::testing::HasSubstr("\ntrial 2: 8 of 8 plots found\nheight "));
  const auto map = nlohmann::json::parse(read_text(folder_.path() / "estimate" / "plots.geojson"));
  std::map<int, int> plots_of_trial;
  for (const auto& plot : map["features"]) ++plots_of_trial[plot["properties"]["trial_number"]];
  EXPECT_EQ(plots_of_trial, (std::map<int, int>{{1, 18}, {2, 8}}));
}

// Plots without gaps: by their width they are found, without it the blocks between alleys are
// taken for plots, and are doubted.
TEST_F(Chain, FindsANurserysPlotsByTheirWidth) {
  succeed(std::string("farmgen generate '") + PLOTSCAN_SOURCE_DIR "/worlds/nursery.yaml'" +
          " -o farm --seed 102 --set terrain.side_m=40 --set plots.missing_rate=0" +
          " --set 'plots.rows=[{plots: 12}, {plots: 12}, {plots: 12}]'");
  succeed("lidarsim fly farm -o scan");
  succeed("estimator run scan -o estimate --plot-width 1.52");
  const Finished scored = succeed("estimator score estimate --truth farm --json");
  const auto scores = nlohmann::json::parse(scored.output)["boxes"];
  EXPECT_EQ(scores["found"], 36);
  EXPECT_EQ(scores["extra"], 0);
  EXPECT_GT(scores["iou_mean"], 0.95);
  const Finished blocks = succeed("estimator run scan -o blocks");
  EXPECT_THAT(blocks.output + blocks.errors,
              ::testing::HasSubstr("12 rows of the crop run across it, as of several plots"));
}

// LAS has steps of 0.1 mm: the plots are the same within them. Heights count from ground planes by
// RANSAC, which stops at the first good one: another point within the tolerance tilts them, and a
// height changes by millimetres.
TEST_F(Chain, EstimatesFromLasAsFromPcd) {
  succeed("farmgen generate " + testing::kSmallFarm + " -o farm --seed 101");
  succeed("lidarsim fly farm -o scan --format las");
  const std::string options = " --method dhami2020 --plots 9 --crop-box=-5,-9,5,9";
  succeed("estimator run scan/cloud.pcd -o from_pcd" + options);
  succeed("estimator run scan/cloud.las -o from_las" + options);
  const std::vector<std::string> columns = {
      "plot_number",        "center_x_m",       "center_y_m", "width_m",     "length_m",
      "height_voxel-max_m", "row_number",       "col_number", "heading_deg", "points",
      "height_raw-max_m",   "height_raw-p99_m", "flags"};
  const auto table = [&](const std::string& name) {
    std::vector<std::vector<double>> rows;
    read_csv(folder_.path() / name / "heights.csv", columns, {}, [&](const CsvRow& row) {
      rows.emplace_back();
      for (std::size_t column = 0; column < 6; ++column) rows.back().push_back(row.number(column));
    });
    return rows;
  };
  const auto pcd = table("from_pcd");
  const auto las = table("from_las");
  ASSERT_EQ(pcd.size(), 9u);
  ASSERT_EQ(las.size(), pcd.size());
  for (std::size_t row = 0; row < pcd.size(); ++row) {
    EXPECT_EQ(las[row][0], pcd[row][0]);
    for (std::size_t column = 1; column < 5; ++column)
      EXPECT_NEAR(las[row][column], pcd[row][column], 5e-4) << columns[column];
    // A point that rounding puts into the next voxel (of 5 cm) moves the mean of both.
    EXPECT_NEAR(las[row][5], pcd[row][5], 0.03);
  }
}

// The farm's own map in degrees, made through the Earth's centre, over the cloud in UTM: the same
// heights as in local metres, under the same numbers, and every attribute of the map.
TEST_F(Chain, MeasuresInAMapOfLongitudeAndLatitude) {
  succeed("farmgen generate " + testing::kSmallFarm +
          " -o farm --seed 101 --set anchor.latitude_deg=37.2 --set anchor.longitude_deg=-80.5" +
          " --set plots.first_number=301");
  succeed("lidarsim fly farm -o scan");
  succeed("lidarsim convert scan utm.las --crs utm");
  succeed("estimator run scan -o local --boxes farm/truth/plots.geojson");
  const Finished said =
      succeed("estimator run utm.las -o utm --boxes farm/truth/plots_wgs84.geojson");
  EXPECT_NE(said.output.find("converted to EPSG:32617 (UTM 17N)"), std::string::npos)
      << said.output;
  EXPECT_TRUE(exists("utm/plots.wgs84.geojson"));
  const auto features = [&](const std::string& name) {
    return nlohmann::json::parse(read_text(folder_.path() / name))["features"];
  };
  const auto local = features("local/plots.geojson");
  const auto utm = features("utm/plots.geojson");
  ASSERT_EQ(utm.size(), 9u);
  for (std::size_t i = 0; i < utm.size(); ++i) {
    const auto& plot = utm[i]["properties"];
    EXPECT_EQ(plot["plot_number"], 301 + i);
    EXPECT_EQ(plot["accession_name"], local[i]["properties"]["accession_name"]);
    for (const char* height : {"canopy_p95_m", "canopy_p99_m"}) {
      EXPECT_NEAR(plot[height].get<double>(), local[i]["properties"][height].get<double>(), 0.01)
          << height;
    }
  }
}

// The farm is numbered as its description says, the plots that are found as the same words say.
TEST_F(Chain, NumbersPlotsAsTheFieldBookDoes) {
  succeed("farmgen generate " + testing::kSmallFarm +
          " -o farm --seed 101 --set plots.numbering=serpentine --set plots.first_number=101");
  succeed("lidarsim fly farm -o scan");
  succeed("estimator run scan -o estimate --first-number 101 --numbering serpentine");
  const auto scores =
      nlohmann::json::parse(succeed("estimator score estimate --truth farm --json").output);
  ASSERT_EQ(scores["boxes"]["found"], 9);
  for (const auto& plot : scores["field"]["plots"]) {
    EXPECT_EQ(plot["found"]["estimate"], plot["plot_number"]);
    EXPECT_GT(plot["plot_number"], 100);
  }
}

// A bare slope: sound input without plots. The folder is there, with the ground.
TEST_F(Chain, SaysThatThereIsNothingToMeasure) {
  std::string points;
  std::size_t count = 0;
  for (int x = 0; x < 100; ++x) {
    for (int y = 0; y < 100; ++y, ++count) {
      points += std::to_string(0.1 * x) + " " + std::to_string(0.1 * y) + " " +
                std::to_string(0.01 * x) + "\n";
    }
  }
  folder_.write("bare.ply", "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
                                "\nproperty float x\nproperty float y\nproperty float z\n"
                                "end_header\n" +
                                points);
  const Finished finished = run("estimator run bare.ply -o estimate", folder_.path().string());
  EXPECT_EQ(finished.exit_code, 3) << finished.output << finished.errors;
  for (const char* word : {"no plots: ", "points/m2", "--crop-box", "--boxes", "--units"})
    EXPECT_NE(finished.errors.find(word), std::string::npos) << word << '\n' << finished.errors;
  EXPECT_TRUE(exists("estimate/ground.asc"));
  EXPECT_TRUE(exists("estimate/plots.geojson"));
}

TEST_F(Chain, GivesTheSameBytesForAnyNumberOfThreads) {
  for (const std::string threads : {"1", "7"}) {
    succeed("farmgen generate " + testing::kSmallFarm + " -o farm" + threads + " -j " + threads);
    succeed("lidarsim fly farm" + threads + " -o scan" + threads + " -j " + threads + " --speed 4");
    succeed("estimator run scan" + threads + "/cloud.pcd -o estimate" + threads +
            " --method dhami2020 --plots 9 --crop-box=-5,-9,5,9 -j " + threads);
    succeed("estimator run scan" + threads + "/cloud.pcd -o lattice" + threads + " -j " + threads);
  }
  for (const std::string file :
       {"farm#/manifest.json", "farm#/truth/plants.csv", "scan#/manifest.json", "scan#/cloud.pcd",
        "estimate#/manifest.json", "estimate#/heights.csv", "lattice#/manifest.json",
        "lattice#/heights.csv", "lattice#/ground.asc", "lattice#/ground_se.asc",
        "lattice#/chm.asc"}) {
    const auto with = [&file](const std::string& threads) {
      std::string name = file;
      return name.replace(name.find('#'), 1, threads);
    };
    EXPECT_EQ(hash(with("1")), hash(with("7"))) << file;
  }
}

TEST_F(Chain, AnotherSeedIsAnotherFarm) {
  succeed("farmgen generate " + testing::kSmallFarm + " -o a --seed 1");
  succeed("farmgen generate " + testing::kSmallFarm + " -o b --seed 2");
  EXPECT_NE(hash("a/truth/plants.csv"), hash("b/truth/plants.csv"));
}

TEST_F(Chain, AFarmKeepsTheDescriptionThatMakesItAgain) {
  const std::string farm =
      "terrain: {side_m: 20, vertices: 20}  # small\n"
      "plots: {width_m: 1.5, length_m: 4, gap_width_m: 0.5, gap_length_m: 1, rows: [{plots: 2}]}\n"
      "plants: {count: 9, models: [{crop: maize}]}\n";
  folder_.write("mine.yaml", farm);
  const std::string how = " --seed 7 --set plants.count=12 -q -o ";
  succeed("farmgen generate mine.yaml" + how + "farm");
  EXPECT_EQ(read_text(folder_.path() / "farm" / "description" / "mine.yaml"), farm);
  succeed("farmgen generate farm/description/mine.yaml" + how + "again");
  EXPECT_EQ(hash("farm/manifest.json"), hash("again/manifest.json"));  // with all files' hashes
}

TEST_F(Chain, LeavesNothingWhenInterrupted) {
  succeed("farmgen generate " + testing::kSmallFarm + " -o farm");
  const Finished interrupted =
      run("timeout -s INT 0.5 lidarsim fly farm -o scan --speed 0.05", folder_.path().string());
  EXPECT_NE(interrupted.exit_code, 0);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1)
      << "something was left behind";
}

TEST_F(Chain, NeverReplacesWhatItReads) {
  succeed("farmgen generate " + testing::kSmallFarm + " -o farm");
  succeed("lidarsim fly farm -o scan --speed 4");
  for (const std::string command :
       {"lidarsim fly farm -o farm --force", "lidarsim fly farm -o farm/scan",
        "farmgen export farm --gazebo sim -o farm/world", "estimator run scan -o scan/estimate",
        "lidarsim convert scan scan/cloud.pcd --force", "lidarsim convert scan scan/cloud.las"}) {
    EXPECT_EQ(run(command, folder_.path().string()).exit_code, 2) << command;
  }
  EXPECT_TRUE(exists("farm/truth/plants.csv"));
  EXPECT_FALSE(exists("farm/scan") || exists("farm/world") || exists("scan/estimate"));
}

TEST_F(Chain, NeverReplacesWhatItDidNotWrite) {
  const std::string generate = "farmgen generate " + testing::kSmallFarm + " -o farm";
  succeed(generate);
  const std::filesystem::path notes = folder_.write("farm/notes.txt", "precious");
  const Finished refused = run(generate + " --force", folder_.path().string());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("notes.txt"), std::string::npos) << refused.errors;
  EXPECT_EQ(read_text(notes), "precious");
  std::filesystem::remove(notes);
  succeed(generate + " --force");
}

TEST_F(Chain, EveryCommandExplainsTheCommonOptionsThatItUses) {
  const std::string seed = " --seed";
  const std::string threads = " --threads";
  for (const auto& [command, uses] :
       std::map<std::string, std::string>{{"farmgen generate", seed + threads},
                                          {"farmgen info", ""},
                                          {"farmgen check", seed},
                                          {"farmgen plant", seed},
                                          {"farmgen export", threads},
                                          {"lidarsim fly", seed + threads},
                                          {"lidarsim convert", ""},
                                          {"lidarsim sensors", ""},
                                          {"lidarsim view", threads},
                                          {"estimator run", seed + threads},
                                          {"estimator info", ""},
                                          {"estimator score", ""},
                                          {"estimator report", ""},
                                          {"estimator series", ""},
                                          {"farmbench run", seed + threads},
                                          {"farmbench report", seed},
                                          {"farmbench export", threads},
                                          {"farmbench score", seed + threads},
                                          {"measure_plots run", threads},
                                          {"plotview picture", ""},
                                          {"plotview field", ""},
                                          {"plotview plot", ""}}) {
    const std::string help = succeed(command + " --help").output;
    const std::string common = help.substr(std::min(help.size(), help.find("Common options:")));
    for (const char* option : {"--help", "--version", "--verbose", "--quiet", "--json"})
      EXPECT_NE(common.find(option), std::string::npos) << command << " --help lacks " << option;
    for (const std::string& option : {seed, threads}) {
      const bool used = uses.find(option) != std::string::npos;
      EXPECT_EQ(help.find(option.substr(1) + " ") != std::string::npos, used) << command << option;
    }
    EXPECT_NE(succeed(command + " --version").output.find(version()), std::string::npos);
  }
}

TEST_F(Chain, HelpTellsDefaultsRangesAndWhatIsExcluded) {
  const std::string pages = succeed("lidarsim fly --help").output +
                            succeed("estimator run --help").output +
                            succeed("estimator report --help").output;
  const std::string help = std::regex_replace(pages, std::regex("\\s+"), " ");
  for (const char* text :
       {"--altitude FLOAT metres above the mean ground of the plots, 0.5 to 120 "
        "[default: 8; not with --flight, --waypoints]",
        "--mount FLOAT x 3", "[default: 0,90,0]", "--returns {strongest,last,dual}", "[required]",
        "[0 to 255]", "[0 to 1024; default: 0, one for each processor]",
        "[1 to 5000000; default: 3000000; only with --cloud]"})
    EXPECT_NE(help.find(text), std::string::npos) << text;
}

}  // namespace
}  // namespace plotscan
