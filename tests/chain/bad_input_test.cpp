// SPDX-License-Identifier: Apache-2.0
// Bad input gets one message and exit code 2, and leaves nothing behind.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <ostream>

#include "programs.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

using testing::Finished;
using testing::run;
using testing::TemporaryFolder;

const std::string kPaper = std::string("'") + PLOTSCAN_SOURCE_DIR "/worlds/paper_flat.yaml'";

// A LAS 1.2 header that promises ten points of 20 bytes, and no more.
std::string las_header(std::uint8_t point_format) {
  std::string bytes(227, '\0');
  const auto put = [&bytes](std::size_t offset, auto value) {
    std::memcpy(&bytes[offset], &value, sizeof value);
  };
  std::memcpy(bytes.data(), "LASF", 4);
  put(24, std::uint8_t{1});
  put(25, std::uint8_t{2});
  put(94, std::uint16_t{227});
  put(96, std::uint32_t{227});
  put(104, point_format);
  put(105, std::uint16_t{20});
  put(107, std::uint32_t{10});
  for (const std::size_t axis : {0, 1, 2}) put(131 + 8 * axis, 0.001);
  return bytes;
}

struct BadCommand {
  std::string command;
  std::string says;  // a part of the message
};

// GoogleTest prints it beside the test's name.
void PrintTo(const BadCommand& bad, std::ostream* out) { *out << bad.command; }

class BadInput : public ::testing::TestWithParam<BadCommand> {};

TEST_P(BadInput, GetsOneMessageAndLeavesNothing) {
  const TemporaryFolder folder;
  folder.write("broken.yaml", "name: x\nterrain: [1, 2\n");
  folder.write(
      "truncated.pcd",
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 100\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 100\nDATA binary\nabc");
  folder.write("nan.pcd",
               "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 2\nDATA ascii\nnan 0 0\n0 0 inf\n");
  const std::string floats = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
  folder.write("empty.pcd", floats + "WIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n");
  folder.write("one.pcd", floats + "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n0 0 0\n");
  folder.write("broken.csv", "x,y,z\n1,2,3\n4,five,6\n");
  folder.write("compressed.laz", las_header(1 | 0x80));
  folder.write("truncated.las", las_header(0) + std::string(190, 'x'));
  folder.write("not_a_farm/readme", "x");
  folder.write("web/manifest.json", "{}");
  folder.write("no_seeds.yaml",
               "name: x\ncases: [{name: a, farm: absent.yaml}]\nmethods: [dhami2020]\n");
  folder.write("index.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
               "y\nproperty float z\n"
               "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
               "0 0 0\n1 0 0\n0 0 1\n3 0 1 7\n");
  folder.write("map.gpkg", "x");
#ifdef PLOTSCAN_GDAL_LIBRARY
  folder.write("no_gdal/" PLOTSCAN_GDAL_LIBRARY, "x");
#endif
  folder.write("tall.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1000\nf 1 2 3\n");
  folder.write("latin.yaml", "name: M\xe4h\n");
  folder.write("latin.csv", "plot_id,name\n1,M\xe4h\n");
  folder.write("broken.sdf", "<sdf version='1.9'>\n<world name='w'>\n");
  folder.write("fuel.sdf",
               "<sdf version='1.9'><world name='w'><include>"
               "<uri>https://fuel.gazebosim.org/x/models/y</uri></include></world></sdf>");
  folder.write(
      "bare.sdf",
      "<sdf version='1.9'><model name='hut'><link name='l'><visual name='wall'><geometry>"
      "<mesh><uri>model://hut/wall.dae</uri></mesh></geometry></visual></link></model></sdf>");
  folder.write("box.sdf",
               "<sdf version='1.9'><model name='hut'><link name='l'><visual name='wall'><geometry>"
               "<box><size>4 4 1</size></box></geometry></visual></link></model></sdf>");
  folder.write("posed.sdf",
               "<sdf version='1.9'><model name='hut'><pose>1 2 nan 0 0 0</pose><link name='l'/>"
               "</model></sdf>");
  const std::string plots =
      R"({"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": {)"
      R"("type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 2], [0, 2], [0, 0]]]},)"
      R"("properties": {"plot_number": 1, "height_p95_m": 0.5}}]})";
  folder.write("groundless/plots.geojson", plots);
  folder.write("estimate/plots.geojson", plots);
  for (const char* grid : {"ground", "ground_se", "ground_seen"}) {
    folder.write(std::string("estimate/") + grid + ".asc",
                 "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 2\n0 0\n0 0\n");
  }
  std::filesystem::copy(folder.path() / "estimate", folder.path() / "measured");
  folder.write("measured/manifest.json", R"({"inputs": [{"file": "a.las", "hash": "0"}]})");
  const auto before = std::distance(std::filesystem::directory_iterator(folder.path()), {});
  const Finished finished = run(GetParam().command, folder.path().string());
  EXPECT_EQ(finished.exit_code, 2) << finished.output << finished.errors;
  EXPECT_NE(finished.errors.find(GetParam().says), std::string::npos) << finished.errors;
  EXPECT_LE(std::count(finished.errors.begin(), finished.errors.end(), '\n'), 2) << finished.errors;
  const auto left = std::distance(std::filesystem::directory_iterator(folder.path()), {});
  EXPECT_EQ(left, before) << "something was left behind";
}

INSTANTIATE_TEST_SUITE_P(
    Programs, BadInput,
    ::testing::Values(
        BadCommand{"farmgen", "subcommand"},
        BadCommand{"farmgen generate absent.yaml -o out", "absent.yaml"},
        BadCommand{"farmgen generate broken.yaml -o out", "broken.yaml:"},
        BadCommand{"farmgen generate " + kPaper + " -o out --set terrain.side_m=-3", "side_m"},
        BadCommand{"farmgen generate " + kPaper + " -o out --set terrain.side_m=8", "terrain"},
        BadCommand{"farmgen generate " + kPaper + " -o out --set plants.count=1e12", "count"},
        BadCommand{"farmgen generate " + kPaper + " -o out --set terrain.sides=3", "sides"},
        BadCommand{"farmgen generate " + kPaper + " -o not_a_farm", "not_a_farm"},
        BadCommand{"farmgen generate " + kPaper + " -o out --seed minus", "seed"},
        BadCommand{"lidarsim fly not_a_farm -o out", "not_a_farm"},
        BadCommand{"lidarsim fly absent -o out", "absent"},
        BadCommand{"lidarsim fly not_a_farm -o out --pattern single --spacing 5",
                   "--pattern single flies only one"},
        BadCommand{"lidarsim fly not_a_farm -o out --speed 3 --speed 4",
                   "--speed is given more than once"},
        BadCommand{"lidarsim fly not_a_farm -o out --altitude 8m",
                   "--altitude = 8m cannot be read as a number"},
        BadCommand{"lidarsim fly not_a_farm -o out --sway 3", "--sway"},
        BadCommand{"lidarsim fly not_a_farm -o out --wind 2 --wind-acts-on drone --sway 3",
                   "--sway is of plants, and --wind-acts-on drone leaves them at rest"},
        BadCommand{"lidarsim fly world.sdf -o out --wind 2 --sway 3",
                   "--sway is of a farm's plants; those of an SDF world stand still"},
        BadCommand{"lidarsim fly not_a_farm -o out --position-drift-time 5 --position-noise 1",
                   "--position-drift-time is of a drift, and none is given: --position-drift, "},
        BadCommand{"lidarsim fly not_a_farm -o out --attitude-drift-time 5 --height-drift 1",
                   "--attitude-drift-time is of a drift, and none is given: --tilt-drift, "},
        BadCommand{"lidarsim fly broken.yaml -o out", "broken.yaml"},
        BadCommand{"lidarsim convert truncated.pcd out.las", "truncated.pcd"},
        BadCommand{"lidarsim convert absent.las out.pcd", "absent.las"},
        BadCommand{"lidarsim convert index.ply out.xyz", ".las"},
        BadCommand{"lidarsim convert index.ply out.las --topic /points", "no topics"},
        BadCommand{"lidarsim convert index.ply out.las --crs utm", "anchor"},
        BadCommand{"lidarsim convert index.ply broken.yaml/out.las", "no such folder"},
        BadCommand{"farmgen generate " + kPaper + " -o web --force", "web"},
        BadCommand{"farmgen generate " + kPaper + " -o ''", "no name"},
        BadCommand{"farmgen generate " + kPaper + " -o out --seed -1", "seed"},
        BadCommand{
            "farmgen generate " + kPaper + " -o out --set \"plants.models=[$PWD/index.ply]\"",
            "vertex 7"},
        BadCommand{"farmgen generate " + kPaper + " -o out --set \"plants.models=[$PWD/tall.obj]\"",
                   "tall.obj: model tall is 1000 m tall; a plant has up to 120 m"},
        BadCommand{"farmgen generate latin.yaml -o out", "latin.yaml:1: is no UTF-8 text"},
        BadCommand{"estimator run index.ply -o out --plot-names latin.csv",
                   "latin.csv:2: is no UTF-8"},
        BadCommand{"farmbench run no_seeds.yaml -o out", "seeds"},
        BadCommand{"estimator run truncated.pcd -o out --method dhami2020 --plots 3",
                   "truncated.pcd"},
        BadCommand{"estimator run absent.pcd -o out", "absent.pcd"},
        BadCommand{"estimator run truncated.pcd -o out", "truncated.pcd"},
        BadCommand{"estimator run nan.pcd -o out", "no point of the cloud has finite"},
        BadCommand{"estimator info absent.las", "absent.las"},
        BadCommand{"estimator info broken.csv", "broken.csv:3: \"five\" is not a number"},
        BadCommand{"estimator run broken.csv -o out", "broken.csv:3:"},
        BadCommand{"estimator run nan.pcd -o out --units miles", "--units"},
        BadCommand{"estimator run compressed.laz -o out", "compressed.laz: "},
        BadCommand{"estimator run truncated.las -o out", "promises 10 points of 20"},
        BadCommand{"estimator run index.ply -o out --crop-box 50,50,60,60",
                   "none of its 3 points lies in"},
        BadCommand{"estimator run truncated.pcd -o out --heading 400",
                   "--heading 400 must be in [-360, 360]"},
        BadCommand{"estimator run truncated.pcd -o out --rows 2.5",
                   "--rows \"2.5\" is not a whole number"},
        BadCommand{"estimator run truncated.pcd -o out --ground-class 2,x",
                   "--ground-class \"x\" is not whole numbers"},
        BadCommand{"estimator run truncated.pcd -o out --voxel 0.1",
                   "belongs to --method dhami2020"},
        BadCommand{"estimator run truncated.pcd -o out --noise=-1", "noise"},
        BadCommand{"estimator run truncated.pcd -o out --method dhami2020 --plots=-3", "plots"},
        BadCommand{"estimator run index.ply -o out --boxes broken.yaml", "is no map of plots"},
        BadCommand{"estimator run index.ply -o out --boxes estimate/plots.geojson --id plot",
                   "no plot has an id in a property \"plot\""},
        BadCommand{"estimator run index.ply -o out --boxes estimate/plots.geojson --rows 3",
                   "--boxes excludes --rows"},
        BadCommand{"estimator run index.ply -o out --boxes estimate/plots.geojson --method "
                   "dhami2020 --no-level",
                   "--no-level"},
        BadCommand{"estimator run index.ply -o out --id plot", "give one of these"},
        BadCommand{"estimator run index.ply -o out --measured absent.csv", "absent.csv"},
        BadCommand{"estimator run index.ply -o out --measured latin.csv",
                   "latin.csv:2: is no UTF-8"},
        BadCommand{"estimator score estimate --truth absent.csv", "absent.csv"},
        BadCommand{"estimator score estimate --truth not_a_farm --id plot", "the truth is none"},
        BadCommand{"estimator score estimate --truth broken.csv", "--id names the column"},
        BadCommand{"estimator series estimate -o out", "a series needs two estimates and more"},
        BadCommand{"estimator series estimate absent -o out", "absent"},
        BadCommand{"estimator series estimate measured -o estimate", "is the input"},
        BadCommand{"estimator series estimate measured -o out --join neither", "--join"},
        BadCommand{"estimator run index.ply -o out --plot-names broken.yaml", "broken.yaml:2:"},
        BadCommand{"estimator run index.ply -o out --numbering rows", "zigzag"},
        BadCommand{"estimator report estimate -o out.html --points 100",
                   "--points requires --cloud"},
        BadCommand{"estimator report estimate -o out.html --units ft", "--units requires --cloud"},
        BadCommand{"estimator report estimate -o out.html --cloud index.ply --points -1",
                   "Value -1 not in range"},
        BadCommand{"estimator score absent --truth not_a_farm", "absent"},
        BadCommand{"farmbench run broken.yaml -o out", "broken.yaml"},
        BadCommand{"measure_plots run --secret s --strata wheat", "no stratum \"wheat\""},
        BadCommand{"measure_plots run --secret s --farms 0", "--farms"},
        BadCommand{"measure_plots run --secret s --strata maize --source absent", "plants.yaml"},
        BadCommand{"field_method empty.pcd absent.csv heights.csv", "empty.pcd: holds no points"},
        BadCommand{"field_method one.pcd absent.csv heights.csv", "absent.csv"},
        BadCommand{"plotview picture not_a_farm -o p.png", "not_a_farm"},
        BadCommand{"plotview picture not_a_farm -o p.png --plots estimate",
                   "--plots requires --scan"},
        BadCommand{"plotview field index.ply absent -o p.png", "absent: is no estimate folder"},
        BadCommand{"plotview field index.ply not_a_farm -o p.png", "plots.geojson"},
        BadCommand{"plotview field index.ply groundless -o p.png", "ground.asc"},
        BadCommand{"plotview field absent.las estimate -o p.png", "absent.las"},
        BadCommand{"plotview field index.ply measured --margin -1 -o p.png",
                   "note: The cloud index.ply is not the file that this estimate was made from"},
        BadCommand{"plotview field index.ply estimate -o index.ply", "index.ply: is the input"},
        BadCommand{"plotview plot index.ply estimate --plot 1 -o estimate/ground.asc",
                   "ground.asc: lies in the input"},
        BadCommand{"plotview plants tall.obj -o tall.obj", "tall.obj: is the input"},
        BadCommand{"plotview plants tall.obj -o p.jpg", "p.jpg: does not end in .png"},
        BadCommand{"plotview field index.ply estimate -o index.las", "does not end in .png"},
        BadCommand{"plotview picture not_a_farm --scan index.ply --plots estimate -o "
                   "estimate/plots.geojson",
                   "plots.geojson: lies in the input"},
        BadCommand{"plotview plot index.ply groundless --plot 1 -o p.png", "ground.asc"},
        BadCommand{"plotview plot index.ply estimate --plot 2 -o p.png", "no plot 2"},
        BadCommand{"plotview plot index.ply estimate -o p.png", "--plot"},
        BadCommand{"plotview plot index.ply estimate --plot 1 --heights p96 -o p.png", "p96"},
        BadCommand{
            "plotview plot index.ply estimate --plot 1 --heights max,max,max,max,max -o p.png",
            "5 heights are given; 4 are drawn at most"},
        BadCommand{"lidarsim view index.ply -o page.pcd", "page.pcd: does not end in .html"},
        BadCommand{"estimator report estimate -o page.txt", "page.txt: does not end in .html"}),
    [](const auto& tested) { return "Command" + std::to_string(tested.index + 1); });

#ifdef PLOTSCAN_GDAL_LIBRARY
INSTANTIATE_TEST_SUITE_P(
    Maps, BadInput,
    ::testing::Values(BadCommand{"estimator run index.ply --boxes map.gpkg -o out",
                                 "map.gpkg' not recognized as"},
                      BadCommand{
                          "LD_LIBRARY_PATH=no_gdal estimator run index.ply --boxes map.gpkg -o out",
                          "ogr2ogr -f GeoJSON map.geojson map.gpkg makes a map that can"}),
    [](const auto& tested) { return "Command" + std::to_string(tested.index + 1); });
#endif

#ifdef PLOTSCAN_HAVE_SDFORMAT
INSTANTIATE_TEST_SUITE_P(
    Worlds, BadInput,
    ::testing::Values(
        BadCommand{"lidarsim fly broken.sdf -o out", "broken.sdf:"},
        BadCommand{"lidarsim fly absent.sdf -o out", "absent.sdf"},
        BadCommand{"lidarsim fly fuel.sdf -o out", "network"},
        BadCommand{"lidarsim fly bare.sdf -o out", "hut/wall.dae"},
        BadCommand{"lidarsim fly posed.sdf -o out", "posed.sdf"},
        BadCommand{"lidarsim fly bare.sdf -o out --resource-path nowhere", "nowhere"},
        BadCommand{"lidarsim fly box.sdf -o out --format las,xyz", "must be one of pcd, ply, las"},
        BadCommand{"lidarsim fly box.sdf -o out --sensor os1_64 --format pcap", "--format"},
        BadCommand{"lidarsim fly box.sdf --sensor latin.yaml -o out", "latin.yaml:1: is no UTF-8"}),
    [](const auto& tested) { return "Command" + std::to_string(tested.index + 1); });
#else
INSTANTIATE_TEST_SUITE_P(WithoutLibsdformat, BadInput,
                         ::testing::Values(BadCommand{"lidarsim fly box.sdf -o out",
                                                      "box.sdf: no SDF world can be read"},
                                           BadCommand{"lidarsim fly box.sdf -o out",
                                                      "libsdformat-dev"}));
#endif

}  // namespace
}  // namespace plotscan
