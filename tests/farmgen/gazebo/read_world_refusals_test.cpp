// SPDX-License-Identifier: Apache-2.0
// Worlds that cannot be read, and what is said of them.

#include <gmock/gmock.h>

#include "read_world_fixture.h"
#include "temporary_folder.h"
#include "world_text.h"

namespace plotscan::gazebo {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::message_of;
using testing::model_text;
using testing::TemporaryFolder;
using testing::visual_text;
using testing::world_text;

TEST_F(ReadWorld, BrokenFilesAreRefused) {
  const auto refused = [&](const std::string& text) {
    const fs::path file = folder_.write("broken.sdf", text);
    return message_of<InputError>([&] { read_world(file); });
  };
  EXPECT_THAT(refused("<sdf version='1.9'>\n<world name='x'>\n<model\n"),
              AllOf(HasSubstr("broken.sdf:"), HasSubstr("cannot be parsed as XML")));
  EXPECT_THAT(refused(""), HasSubstr("broken.sdf"));
  EXPECT_THAT(refused("<!-- nothing else -->"), HasSubstr("broken.sdf: holds no XML element"));
  EXPECT_THAT(refused("<html/>"), HasSubstr("broken.sdf: is not an SDF file"));
  EXPECT_THAT(refused("<sdf/>"), HasSubstr("broken.sdf: <sdf> has no version"));
  for (const std::string version : {"abc", "", "1.", "1.x", "1.9 ", "-1", "99999999999"}) {
    EXPECT_THAT(refused("<sdf version='" + version + "'><world name='x'/></sdf>"),
                HasSubstr("which is no number such as 1.9"));
  }
  EXPECT_THAT(refused("<sdf version='1.9'/>"), HasSubstr("no world and no model"));
  EXPECT_THAT(refused("<sdf version='99'><world name='x'/></sdf>"), HasSubstr("is SDF 99; up to"));
  EXPECT_THAT(refused("<sdf version='1.9'><world name='x'><model name='m'/></world></sdf>"),
              HasSubstr("broken.sdf"));
  EXPECT_THAT(refused(world_text("")), HasSubstr("nothing that a laser could meet"));
  EXPECT_THAT(message_of<InputError>([&] { read_world(folder_.path()); }),
              HasSubstr("not a regular file"));
  EXPECT_THAT(message_of<InputError>([&] { read_world(folder_.path() / "none.sdf"); }),
              HasSubstr("no such file"));
  EXPECT_THAT(
      message_of<InputError>([&] { read("", {.resource_paths = {folder_.path() / "absent"}}); }),
      HasSubstr("no such folder"));
}

TEST_F(ReadWorld, IncludesThatLeadNowhereAreRefused) {
  EXPECT_THAT(
      refusal("<include><uri>model://absent</uri></include>"),
      AllOf(HasSubstr("by_hand.sdf:4: <include> model://absent is found nowhere"),
            HasSubstr((folder_.path() / "models/absent").string()), HasSubstr("--resource-path")));
  EXPECT_THAT(
      refusal("<include><uri>https://fuel.gazebosim.org/1.0/a/models/Sun</uri></include>"),
      AllOf(HasSubstr("https://fuel.gazebosim.org/1.0/a/models/Sun"), HasSubstr("on the network")));
  EXPECT_THAT(refusal("<include/>"), HasSubstr("no <uri>"));
  EXPECT_THAT(refusal("<include><uri>gopher://x</uri></include>"), HasSubstr("scheme"));
  folder_.write("models/empty/readme", "");
  EXPECT_THAT(refusal("<include><uri>model://empty</uri></include>"), HasSubstr("model.config"));
}

TEST_F(ReadWorld, BrokenDescriptionsOfModelsAreRefused) {
  for (const std::string config :
       {"", "<!-- -->", "<model", "<model/>", "<other/>", "<model><sdf/></model>",
        "<model><sdf>model.sdf</sdf></model>", "<model><sdf version='7'>model.sdf</sdf></model>",
        "<model><sdf version='x'>model.sdf</sdf></model>"}) {
    folder_.write("models/broken/model.config", config);
    EXPECT_THAT(refusal("<include><uri>model://broken</uri></include>"),
                HasSubstr("broken/model.config"))
        << config;
  }
}

TEST_F(ReadWorld, NamesOfModelsStayInTheirFolders) {
  folder_.write("mesh.obj", kTriangle);
  const std::string up = "model://../" + folder_.path().filename().string();
  EXPECT_THAT(refusal("<include><uri>" + up + "</uri></include>"),
              AllOf(HasSubstr(up), HasSubstr("leads out of the folders of models")));
  const std::string mesh = "<mesh><uri>" + up + "/mesh.obj</uri></mesh>";
  EXPECT_THAT(refusal(model_text("m", "0 0 0 0 0 0", visual_text(mesh))),
              HasSubstr("leads out of the folders of models"));
}

// What libsdformat has to say comes in the exception alone.
TEST_F(ReadWorld, NothingIsPrinted) {
  folder_.write("models/bare/readme", "");
  folder_.write("models/wrong/model.config", "<model><sdf version='1.9'>none.sdf</sdf></model>");
  const std::string box = visual_text("<box><size>1 1 1</size><odd/></box>");
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  refusal("<include><uri>model://bare</uri></include>");
  refusal("<include><uri>model://wrong</uri></include>");
  refusal(model_text("m", "1 2 three", box));
  read("<odd/>" + model_text("m", "0 0 0 0 0 0", box));
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

// Each file includes the next twice: 2^20 models from a few lines.
TEST_F(ReadWorld, TooManyModelsAreRefusedBeforeTheyAreLoaded) {
  for (int i = 0; i < 20; ++i) {
    const std::string next = "<include><uri>part_" + std::to_string(i + 1) + ".sdf</uri><name>";
    folder_.write("part_" + std::to_string(i) + ".sdf", "<sdf version='1.9'><model name='m'>" +
                                                            next + "a</name></include>" + next +
                                                            "b</name></include></model></sdf>");
  }
  folder_.write("part_20.sdf", "<sdf version='1.9'><model name='m'><link name='l'/></model></sdf>");
  EXPECT_THAT(refusal("<include><uri>part_0.sdf</uri></include>"),
              AllOf(HasSubstr(".sdf:1: more than 10000 models"), HasSubstr("--merge plot")));
}

TEST_F(ReadWorld, ErrorsDeepInIncludesAreRefused) {
  write_model("models/outer",
              "<model name='o'><include><uri>model://inner</uri></include></model>");
  write_model("models/inner", "<model name='i'><link name='same'/><link name='same'/></model>");
  EXPECT_THAT(refusal("<include><uri>model://outer</uri></include>"),
              AllOf(HasSubstr("inner/model.sdf"), HasSubstr("same")));
  // Of this one libsdformat 12 tells on stderr alone.
  write_model("models/inner",
              "<model name='i'><link name='l'/></model><model name='k'><link name='l'/></model>");
  EXPECT_THAT(refusal("<include><uri>model://outer</uri></include>"),
              AllOf(HasSubstr("inner/model.sdf"), HasSubstr("one model")));
}

TEST_F(ReadWorld, IncludesInACircleAreRefused) {
  write_model("models/hen", "<model name='hen'><include><uri>model://egg</uri></include></model>");
  write_model("models/egg", "<model name='egg'><include><uri>model://hen</uri></include></model>");
  EXPECT_THAT(refusal("<include><uri>model://hen</uri></include>"),
              AllOf(HasSubstr("egg/model.sdf"), HasSubstr("circle")));
}

// libsdformat is told of an include by its URI alone.
TEST_F(ReadWorld, OneRelativeNameForTwoThingsIsRefused) {
  const std::string box = visual_text("<box><size>1 1 1</size></box>");
  write_model("a/part", model_text("part", "0 0 0 0 0 0", box));
  write_model("b/part", model_text("part", "0 0 0 0 0 0", box));
  for (const std::string name : {"a", "b"}) {
    write_model(name + "/whole", "<model name='w'><include><uri>../part</uri></include></model>");
  }
  EXPECT_THAT(refusal("<include><uri>a/whole</uri></include>"
                      "<include><uri>b/whole</uri><name>other</name></include>"),
              AllOf(HasSubstr("a/part"), HasSubstr("b/part"), HasSubstr("model://")));
}

TEST_F(ReadWorld, MissingMeshesNameModelVisualAndPlaces) {
  EXPECT_THAT(refusal(model_text("hut", "0 0 0 0 0 0",
                                 visual_text("<mesh><uri>model://hut/wall.dae</uri></mesh>"))),
              AllOf(HasSubstr("model \"hut\""), HasSubstr("visual \"v\""),
                    HasSubstr("model://hut/wall.dae"),
                    HasSubstr((folder_.path() / "models/hut/wall.dae").string())));
  folder_.write("wall.obj", "v 0 0 0\n");
  EXPECT_THAT(
      refusal(model_text("hut", "0 0 0 0 0 0", visual_text("<mesh><uri>wall.obj</uri></mesh>"))),
      AllOf(HasSubstr("by_hand.sdf: model \"hut\""), HasSubstr("wall.obj")));
  EXPECT_THAT(refusal(model_text("hut", "0 0 0 0 0 0", visual_text("<mesh/>"))),
              AllOf(HasSubstr("model \"hut\""), HasSubstr("<mesh> has no <uri>")));
}

// One model in a file, but thousands of files that wait for it.
TEST_F(ReadWorld, IncludesAreNotDeep) {
  for (int i = 0; i < 100; ++i) {
    folder_.write("part_" + std::to_string(i) + ".sdf",
                  "<sdf version='1.9'><model name='m'><include><uri>part_" + std::to_string(i + 1) +
                      ".sdf</uri></include></model></sdf>");
  }
  EXPECT_THAT(refusal("<include><uri>part_0.sdf</uri></include>"),
              HasSubstr("is included by 64 files in a row"));
}

TEST_F(ReadWorld, PolylinesOfThousandsOfPointsAreRefused) {
  std::string points;
  for (int i = 0; i < 2001; ++i)
    points += "<point>" + std::to_string(i) + " " + std::to_string(i % 2) + "</point>";
  EXPECT_THAT(
      refusal(model_text("m", "0 0 0 0 0 0",
                         visual_text("<polyline>" + points + "<height>1</height></polyline>"))),
      HasSubstr("has 2001 points; at most 2000"));
}

TEST_F(ReadWorld, NumbersThatAreNoneAreRefused) {
  folder_.write("mesh.obj", kTriangle);
  const auto shaped = [&](const std::string& shape) {
    return refusal(model_text("m", "0 0 0 0 0 0", visual_text(shape)));
  };
  EXPECT_THAT(refusal(model_text("m", "0 nan 0 0 0 0", visual_text(kMesh))),
              HasSubstr("by_hand.sdf"));
  EXPECT_THAT(refusal(model_text("m", "0 inf 0 0 0 0", visual_text(kMesh))),
              HasSubstr("by_hand.sdf"));
  EXPECT_THAT(refusal(model_text("m", "1 2 three", visual_text(kMesh))), HasSubstr("by_hand.sdf"));
  EXPECT_THAT(shaped("<mesh><uri>mesh.obj</uri><scale>1 0 1</scale></mesh>"), HasSubstr("scale"));
  EXPECT_THAT(shaped("<sphere><radius>-1</radius></sphere>"), HasSubstr("size"));
  EXPECT_THAT(shaped("<box><size>1 1 0</size></box>"), HasSubstr("size"));
  EXPECT_THAT(shaped("<polyline><point>0 0</point><point>1 1</point><height>1</height></polyline>"),
              HasSubstr("no area"));
}

TEST_F(ReadWorld, PlacesBeyondAnyFarmAreRefused) {
  folder_.write("mesh.obj", kTriangle);
  const auto refused = [&](const std::string& pose, const std::string& shape) {
    EXPECT_THAT(refusal(model_text("m", pose, visual_text(shape))),
                AllOf(HasSubstr("by_hand.sdf: model \"m\""), HasSubstr("further than 10000000 m")))
        << pose << shape;
  };
  refused("1e8 0 0 0 0 0", kMesh);
  refused("1e200 0 0 0 0 0", kMesh);
  refused("0 0 0 0 0 0", "<box><size>1 1e39 1</size></box>");
  refused("0 0 0 0 0 0", "<mesh><uri>mesh.obj</uri><scale>1 1 1e30</scale></mesh>");
  EXPECT_NO_THROW(read(model_text("m", "1e6 0 0 0 0 0", visual_text(kMesh))));
}

TEST_F(ReadWorld, AFileOfAMillionBoxesIsRefusedBeforeItIsParsed) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("w.sdf", "<sdf version='1.9'/>");
  fs::resize_file(file, 32'000'001);
  EXPECT_THAT(message_of<InputError>([&] { read_world(file); }),
              HasSubstr("has 32000001 bytes; SDF is read up to 32000000"));
}

}  // namespace
}  // namespace plotscan::gazebo
