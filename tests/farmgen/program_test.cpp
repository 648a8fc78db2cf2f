// SPDX-License-Identifier: Apache-2.0
// farmgen as its users run it: exit codes, messages, outputs.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "core/error.h"
#include "farmgen/example_farm.h"

namespace plotscan::farm {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Outcome {
  int exit_code;
  std::string out;
  std::string err;
};

class Farmgen : public ::testing::Test {
 protected:
  Farmgen() { write_example(folder_); }

  // Runs in the temporary folder.
  Outcome run(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.path().string() + "' && '" PLOTSCAN_FARMGEN "' " +
                                arguments + " >out.txt 2>err.txt </dev/null";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), read_text(folder_.path() / "out.txt"),
            read_text(folder_.path() / "err.txt")};
  }

  nlohmann::json json_of(const std::string& arguments) const {
    const Outcome outcome = run(arguments + " --json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }

  // Every file and folder below the temporary folder but those that a run leaves anyhow.
  std::vector<std::string> left_behind() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      if (name != "out.txt" && name != "err.txt" && name != "example.yaml") names.push_back(name);
    }
    return names;
  }

  TemporaryFolder folder_;
};

TEST_F(Farmgen, GeneratesWhatCheckForetellsAndInfoTells) {
  const auto checked = json_of("check example.yaml --seed 3");
  EXPECT_THAT(left_behind(), IsEmpty()) << "check writes nothing";
  auto generated = json_of("generate example.yaml -o farm --seed 3");
  EXPECT_EQ(generated["folder"], "farm");
  generated.erase("folder");
  generated.erase("seconds");
  EXPECT_EQ(generated, checked);
  // Plot headings pass through degrees: compare all but the field's size exactly.
  auto read = json_of("info farm");
  EXPECT_NEAR(read["field_size_m"][0].get<double>(), checked["field_size_m"][0].get<double>(),
              1e-9);
  EXPECT_NEAR(read["leaf_area_index"].get<double>(), checked["leaf_area_index"].get<double>(),
              1e-6);
  for (const char* key : {"name", "seed", "plots", "plants", "plant_triangles", "plant_height_m",
                          "plot_height_max_m", "terrain"}) {
    EXPECT_EQ(read[key], checked[key]) << key;
  }
  EXPECT_THAT(run("info farm").out, HasSubstr("leaf area index"));
}

TEST_F(Farmgen, TellsTheAnchor) {
  EXPECT_FALSE(json_of("check example.yaml").contains("anchor"));
  const auto made = json_of(
      "generate example.yaml -o farm --set 'anchor={latitude_deg: 37.2, longitude_deg: -80}'");
  EXPECT_EQ(made["anchor"]["latitude_deg"], 37.2);
  EXPECT_EQ(made["anchor"]["longitude_deg"], -80);
  EXPECT_EQ(json_of("info farm")["anchor"], made["anchor"]);
  EXPECT_THAT(run("info farm").out, HasSubstr("latitude 37.20000000, longitude -80.0"));
}

TEST_F(Farmgen, TheSeedIsTheUsersElseTheDescriptionsElseOne) {
  EXPECT_EQ(json_of("check example.yaml")["seed"], 1);
  EXPECT_EQ(json_of("check example.yaml --set seed=7")["seed"], 7);
  EXPECT_EQ(json_of("check example.yaml --set seed=7 --seed 9")["seed"], 9);
  EXPECT_EQ(json_of("check example.yaml --set seed=7 --seed 1")["seed"], 1);
}

TEST_F(Farmgen, BadInputEndsWithCodeTwoOneMessageAndNothingWritten) {
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {"generate none.yaml -o farm", "farmgen: none.yaml: no such file\n"},
      {"generate example.yaml -o farm --set terrain.side_m=12",
       "farmgen: example.yaml: plots: a corner of plot"},
      {"generate example.yaml -o farm --set terrain.sid=12",
       "farmgen: --set terrain.sid=12: terrain.sid is not a known key"},
      {"check example.yaml --set plants.count=-1",
       "farmgen: --set plants.count=-1: plants.count -1 is not in [0, 1000000]\n"},
      {"generate example.yaml -o farm --set 'terrain.clods={height_m: 0.03, size_m: 0.01}'",
       "farmgen: example.yaml: terrain: vertices 0.00314 m apart over"},
      {"generate example.yaml -o farm --set 'terrain={xyz: none.xyz}'",
       "terrain.xyz \"none.xyz\" is no file"},
      {"generate example.yaml -o farm --set 'terrain={heightmap: example.yaml, side_m: 20, "
       "height_m: [0, 1]}'",
       "farmgen: example.yaml: is not a sound PNG: "},
      {"info nowhere", "farmgen: nowhere: no such farm folder\n"},
      {"info .", "not a folder written by plotscan"},
      {"plant soybean -o s.ply", "farmgen: s.ply: does not end in .obj\n"},
      {"plant soybean -o s.obj --set nodes=0", "nodes is to be a whole number in [1, 30]\n"},
      {"plant soybean -o s.obj --stage R9", "stage R9 is not one of soybean's, which are V2, V4"},
      {"plant soybean -o s.obj --cultivar none.yaml", "farmgen: none.yaml: no such file\n"},
      {"plant soybean -o s.obj --detail fine", "--detail"},
      {"plant triffid -o s.obj", "triffid"},
      {"plant soybean -o none/s.obj", "none"},
      {"generate example.yaml", "--output is required"},
      {"sow", ""}};
  for (const auto& [arguments, message] : mistakes) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << arguments;
    EXPECT_THAT(outcome.out, IsEmpty()) << arguments;
    EXPECT_THAT(left_behind(), IsEmpty()) << arguments;
  }
}

TEST_F(Farmgen, ReplacesOnlyWithForce) {
  EXPECT_EQ(run("generate example.yaml -o farm -q").exit_code, 0);
  const Outcome refused = run("generate example.yaml -o farm --seed 2");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(json_of("info farm")["seed"], 1);
  EXPECT_EQ(run("generate example.yaml -o farm --seed 2 --force").exit_code, 0);
  EXPECT_EQ(json_of("info farm")["seed"], 2);
  EXPECT_THAT(left_behind(), ::testing::ElementsAre("farm"));
}

TEST_F(Farmgen, MakesPlants) {
  const auto made = json_of("plant soybean --seed 4 --stage R2 --set nodes=10 -o s.obj");
  EXPECT_GT(made["height_m"], 0.3);
  EXPECT_EQ(made["stage"], "R2");
  EXPECT_EQ(run("plant soybean -o s.obj").exit_code, 2) << "it exists";
  EXPECT_EQ(run("plant soybean -o s.obj --force").exit_code, 0);
  EXPECT_THAT(left_behind(), ::testing::UnorderedElementsAre("s.obj", "s.mtl"));
  const auto light = json_of("plant soybean --detail light -o s.obj --force");
  EXPECT_LT(light["triangles"], 300);
  folder_.write("mine.yaml", "crop: soybean\nparameters: {leaflet_length_m: {value: 0.05}}\n");
  const auto mine = json_of("plant soybean --cultivar mine.yaml -o s.obj --force");
  EXPECT_LT(mine["leaf_area_m2"], 0.4 * light["leaf_area_m2"].get<double>());
}

TEST_F(Farmgen, SaysOfACultivarWhatItsFileStates) {
  folder_.write("mine.yaml",
                "crop: soybean\ndefault_stage: V2\nplot: {plants_per_m2: 25}\n"
                "parameters: {branch_angle_deg: {value: 51}}\n");
  EXPECT_EQ(json_of("plant soybean --cultivar mine.yaml -o s.obj")["stage"], "V2");
  const std::string grown = run("plant soybean --cultivar mine.yaml -o s.obj --force").out;
  EXPECT_THAT(grown, HasSubstr("s.obj: soybean at V2"));
  EXPECT_THAT(grown, HasSubstr("a plot of 25 plants per m2 at V2"));
  const std::string listed = run("plant soybean --cultivar mine.yaml --list").out;
  EXPECT_THAT(listed, HasSubstr("first trifoliolate leaf full grown (default)"));
  EXPECT_THAT(listed, ::testing::ContainsRegex("branch_angle_deg +51 "));
}

TEST_F(Farmgen, PlantListsStagesAndKeysOfACropOrOfAll) {
  const std::string soybean = run("plant soybean --list").out;
  for (const char* text :
       {"soybean (Glycine max", "R3", "(default)", "leaflet_length_m", "by stage", "[0.01, 0.3]"}) {
    EXPECT_THAT(soybean, HasSubstr(text));
  }
  EXPECT_THAT(soybean, ::testing::Not(HasSubstr("maize")));
  const std::string all = run("plant --list").out;
  EXPECT_THAT(all, HasSubstr(soybean));
  EXPECT_THAT(all, HasSubstr("maize (Zea mays"));
  const auto maize = json_of("plant maize --list");
  ASSERT_EQ(maize.size(), 1U);
  EXPECT_EQ(maize[0]["default_stage"], "R1");
  EXPECT_EQ(maize[0]["stages"][0]["stage"], "V3");
  EXPECT_EQ(maize[0]["parameters"][0]["key"], "leaves");
  EXPECT_EQ(maize[0]["parameters"][0]["range"][1], 26);
  EXPECT_EQ(run("plant oat --list").exit_code, 2);
  const std::string help = run("plant --help").out;
  EXPECT_LT(std::ranges::count(help, '\n'), 40);
}

TEST_F(Farmgen, ExportsWorlds) {
  ASSERT_EQ(run("generate example.yaml -o farm -q").exit_code, 0);
  for (const char* gazebo : {"classic", "sim"}) {
    const std::string folder = gazebo;
    const auto made = json_of("export farm --gazebo " + folder + " -o " + folder);
    EXPECT_EQ(made["models"], 5 + 1) << "plots and terrain";
    EXPECT_EQ(made["plants"], 100);
    EXPECT_TRUE(fs::exists(folder_.path() / folder / "world.sdf"));
    const Outcome refused = run("export farm --gazebo " + folder + " -o " + folder);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("--force"));
    EXPECT_EQ(run("export farm --force --gazebo " + folder + " -o " + folder).exit_code, 0);
  }
}

TEST_F(Farmgen, ExportsNothingOfBadInput) {
  ASSERT_EQ(run("generate example.yaml -o farm -q").exit_code, 0);
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"export nowhere --gazebo sim -o w", "nowhere: no such farm folder"},
           {"export farm -o w", "--gazebo is required"},
           {"export farm --gazebo sim", "--output is required"},
           {"export farm --gazebo gz -o w", "--gazebo"},
           {"export farm --gazebo sim --merge all -o w", "--merge"},
           {"export farm --gazebo sim --lod fine -o w", "--lod"},
           {"export farm --gazebo sim --collision sphere -o w", "--collision"},
           {"export farm --gazebo classic --drone --lidar sonar -o w", "--lidar"},
           {"export farm --gazebo classic --drone --lidar cpu -o w",
            "--lidar cpu needs --collision mesh"},
           {"export farm --gazebo sim -o farm --force", "is the input"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << arguments;
    EXPECT_THAT(left_behind(), ::testing::ElementsAre("farm")) << arguments;
  }
}

// Every file by its path, but the manifest, which tells the version; without the version that the
// page tells, and canopy heights to the micrometre: Embree's rays differ between processors.
std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (!entry.is_regular_file() || name == "manifest.json") continue;
    const std::string text =
        std::regex_replace(read_text(entry.path()), std::regex(R"(Plotscan \d+\.\d+\.\d+)"), "");
    files[name] = std::regex_replace(text, std::regex(R"(("canopy_p\d+_m": \d+\.\d{6})\d*)"), "$1");
  }
  return files;
}

TEST_F(Farmgen, TheShippedGazeboWorldsAreThoseOfTheirDescription) {
  const fs::path worlds = fs::path(PLOTSCAN_SOURCE_DIR) / "worlds";
  ASSERT_EQ(run("generate '" + (worlds / "demo.yaml").string() + "' -o demo -q").exit_code, 0);
  for (const std::string gazebo : {"classic", "sim"}) {
    ASSERT_EQ(run("export demo --drone --gazebo " + gazebo + " -o " + gazebo).exit_code, 0);
    const auto made = files_in(folder_.path() / gazebo);
    const auto shipped = files_in(worlds / "gazebo" / gazebo);
    ASSERT_FALSE(made.empty());
    std::size_t bytes = 0;
    for (const auto& [name, text] : made) {
      const auto same = shipped.find(name);
      EXPECT_TRUE(same != shipped.end() && same->second == text)
          << gazebo << "/" << name << " differs; scripts/demo_worlds makes it again";
      bytes += text.size();
    }
    EXPECT_EQ(made.size(), shipped.size());
    EXPECT_LT(bytes, 1'000'000u);
  }
}

}  // namespace
}  // namespace plotscan::farm
