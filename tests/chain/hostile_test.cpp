// SPDX-License-Identifier: Apache-2.0
// Files that are made to crash or exhaust what reads them, through every command that takes them.
#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>

#include <gmock/gmock.h>

#include "programs.h"
#include "sanitized.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

using testing::Finished;
using ::testing::HasSubstr;
using testing::run;
using testing::TemporaryFolder;

// Two nodes, each an instance of the other: Assimp follows them for ever.
constexpr const char* kCircle = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Z_UP</up_axis></asset>
<library_nodes><node id="a"><instance_node url="#b"/></node>
<node id="b"><instance_node url="#a"/></node></library_nodes>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_node url="#a"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

const std::string kPaperWorld = std::string("'") + PLOTSCAN_SOURCE_DIR "/worlds/paper_flat.yaml'";

struct Door {
  std::string name;
  std::string command;
};

void PrintTo(const Door& door, std::ostream* out) { *out << door.command; }

class HostileMeshFile : public ::testing::TestWithParam<Door> {};

TEST_P(HostileMeshFile, IsRefusedWhereverItComesIn) {
  if (testing::kSanitized) GTEST_SKIP() << "the sanitizer reports the child's crash as its own";
  const TemporaryFolder folder;
  folder.write("circle.dae", kCircle);
  folder.write("sound.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  folder.write("world.sdf",
               "<sdf version='1.9'><model name='m'><link name='l'><visual name='v'><geometry>"
               "<mesh><uri>circle.dae</uri></mesh></geometry></visual></link></model></sdf>");
  const Finished finished = run(GetParam().command, folder.path().string());
  EXPECT_EQ(finished.exit_code, 2) << finished.errors;
  EXPECT_THAT(finished.errors, HasSubstr("circle.dae: cannot be read as a mesh"));
  EXPECT_EQ(std::count(finished.errors.begin(), finished.errors.end(), '\n'), 1) << finished.errors;
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 3);
}

INSTANTIATE_TEST_SUITE_P(
    Doors, HostileMeshFile,
    ::testing::Values(Door{"Plant", "farmgen generate " + kPaperWorld +
                                        " -o out --set \"plants.models=[$PWD/circle.dae]\""},
                      Door{"Light",
                           "farmgen generate " + kPaperWorld +
                               " -o out --set \"plants.models=[{mesh: $PWD/sound.obj, light: "
                               "$PWD/circle.dae}]\""},
                      Door{"Terrain", "farmgen generate " + kPaperWorld +
                                          " -o out --set \"terrain={mesh: $PWD/circle.dae}\""},
                      Door{"Picture", "plotview plants circle.dae -o p.png"}),
    [](const auto& tested) { return tested.param.name; });

#ifdef PLOTSCAN_HAVE_SDFORMAT
INSTANTIATE_TEST_SUITE_P(Worlds, HostileMeshFile,
                         ::testing::Values(Door{"World", "lidarsim fly world.sdf -o out"}),
                         [](const auto& tested) { return tested.param.name; });
#endif

}  // namespace
}  // namespace plotscan
