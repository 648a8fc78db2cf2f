// SPDX-License-Identifier: Apache-2.0
// An installed tree as its users have it: programs that find their data, examples built against it.
#include <cstdlib>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "chain/programs.h"
#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

namespace fs = std::filesystem;
using testing::Finished;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

const std::string kSmall =
    " terrain.side_m=30 plots.rows.0.plots=3 plots.rows.1.plots=3 plots.rows.2.plots=3"
    " plants.count=40";

class Installed : public ::testing::Test {
 protected:
  Finished succeed(const std::string& command) {
    Finished finished = testing::run(command, folder_.path().string());
    EXPECT_EQ(finished.exit_code, 0) << command << '\n' << finished.output << finished.errors;
    return finished;
  }
  std::string farm_name(const std::string& command) {
    const Finished checked = succeed(command + " check paper_flat --json");
    return nlohmann::json::parse(checked.output)["name"];
  }
  // A description of another name in data of its own.
  fs::path write_data(const fs::path& place, const std::string& name) {
    fs::create_directories(place.parent_path());
    fs::copy(PLOTSCAN_PREFIX "/share/plotscan", place, fs::copy_options::recursive);
    std::string text = read_text(place / "worlds/paper_flat.yaml");
    const std::string before = "name: paper_flat";
    text.replace(text.find(before), before.size(), "name: " + name);
    std::ofstream(place / "worlds/paper_flat.yaml") << text;
    return place;
  }

  TemporaryFolder folder_;
};

TEST_F(Installed, RunsFromAnEmptyFolder) {
  std::string sets;
  std::istringstream words(kSmall);
  for (std::string word; words >> word;) sets += " --set " + word;
  succeed("farmgen generate paper_flat -o farm --seed 101" + sets);
  succeed("farmgen check worlds/kentland.yaml");
  succeed("lidarsim fly farm -o scan");
  succeed("estimator run scan -o estimate");
  const Finished scored = succeed("estimator score estimate --truth farm --json");
  EXPECT_EQ(nlohmann::json::parse(scored.output)["boxes"]["found"], 9);
  succeed("lidarsim view scan -o scan.html");
  succeed("estimator report estimate --truth farm -o estimate.html");
#ifdef PLOTSCAN_HAVE_SDFORMAT
  succeed("lidarsim fly gazebo/classic/world.sdf -o world");
#endif
  succeed("farmbench run smoke -o results --methods one-number --seeds 1");
}

TEST_F(Installed, HasPagesWhereDebiansManAndShellsLook) {
  const fs::path share = PLOTSCAN_PREFIX "/share";
  for (const std::string program : {"farmgen", "lidarsim", "estimator", "farmbench", "plotview"}) {
    EXPECT_GT(fs::file_size(share / "man/man1" / (program + ".1.gz")), 500u);
    const auto completion = [&](const std::string& shell) {
      return succeed(program + " --print-" + shell + "-completion").output;
    };
    EXPECT_EQ(read_text(share / "bash-completion/completions" / program), completion("bash"));
    EXPECT_EQ(read_text(share / "zsh/vendor-completions" / ("_" + program)), completion("zsh"));
    EXPECT_EQ(read_text(share / "fish/vendor_completions.d" / (program + ".fish")),
              completion("fish"));
  }
}

TEST_F(Installed, FindsItsDataWhereverItIsMoved) {
  const fs::path moved = folder_.path() / "moved";
  fs::create_directories(moved / "bin");
  fs::copy(PLOTSCAN_PREFIX "/bin/farmgen", moved / "bin");
  write_data(moved / "share/plotscan", "moved");
  EXPECT_EQ(farm_name("moved/bin/farmgen"), "moved");
  EXPECT_EQ(farm_name("PATH=" + (moved / "bin").string() + ":$PATH farmgen"), "moved");
  fs::create_symlink(moved / "bin/farmgen", folder_.path() / "linked");
  EXPECT_EQ(farm_name("./linked"), "moved");
}

TEST_F(Installed, TakesDataFromTheEnvironment) {
  write_data(folder_.path() / "mine", "mine");
  EXPECT_EQ(farm_name("PLOTSCAN_DATA=mine farmgen"), "mine");
  EXPECT_EQ(farm_name("PLOTSCAN_DATA= farmgen"), "paper_flat");
  const Finished refused =
      testing::run("PLOTSCAN_DATA=/nowhere farmgen check paper_flat", folder_.path().string());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("/nowhere: named by PLOTSCAN_DATA"));
}

TEST_F(Installed, SaysThatThereIsNoSuchDescription) {
  const Finished refused = testing::run("farmgen check nothing_like_it", folder_.path().string());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("nothing_like_it"));
}

TEST_F(Installed, RunsTheExamples) {
  const std::string examples = PLOTSCAN_EXAMPLES_DIR "/";
  const Finished scored = succeed(examples + "farm_to_scores study" + kSmall);
  EXPECT_THAT(scored.output, HasSubstr("9 of 9 plots found, 0 invented"));
  EXPECT_THAT(succeed(examples + "sensor_study study/farm sensors puck_hires").output,
              HasSubstr("puck_hires: 9 of 9 plots"));
  EXPECT_THAT(succeed(examples + "crop_only study/scan crop.las").output, HasSubstr(" points"));
  EXPECT_THAT(succeed("estimator info crop.las").output, HasSubstr("LAS"));
  EXPECT_THAT(succeed(examples + "map_heights study/scan 0 0 1.5 4 90").output,
              HasSubstr("canopy_p95"));
  succeed("lidarsim convert study/scan cloud.pcd --encoding ascii");
  const Finished field =
      succeed("awk 'data { print $1, $2, $3 } /^DATA/ { data = 1 }' cloud.pcd | " + examples +
              "field_of_points");
  EXPECT_THAT(field.output, HasSubstr("plot 9 at"));
}

// What is installed for others names nothing of the machine that built it.
TEST_F(Installed, NamesNoFolderOfTheBuild) {
  const Finished found = testing::run("grep -rl '" PLOTSCAN_SOURCE_DIR "' '" PLOTSCAN_PREFIX
                                      "/lib/cmake' '" PLOTSCAN_PREFIX "/include'",
                                      folder_.path().string());
  EXPECT_EQ(found.output, "");
}

}  // namespace
}  // namespace plotscan
