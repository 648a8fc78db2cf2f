// SPDX-License-Identifier: Apache-2.0
#include "core/plot_features.h"
#include "core/program.h"
#include "farm/farm.h"
#include "view/picture.h"

namespace fs = std::filesystem;

namespace {

struct PictureArguments {
  fs::path farm;
  std::optional<fs::path> scan;
  std::optional<fs::path> plots;
  fs::path png;
  plotscan::view::PictureOptions options;
};

// A file, or a folder with that file in it.
fs::path file_or_inside(const fs::path& path, const char* name) {
  return fs::is_directory(path) ? path / name : path;
}

void draw(const plotscan::Program& program, const PictureArguments& arguments) {
  const plotscan::farm::Farm farm = plotscan::farm::read_farm(arguments.farm);
  std::vector<plotscan::PlotBox> boxes;
  if (arguments.plots) {
    for (const auto& plot :
         plotscan::read_plot_features(file_or_inside(*arguments.plots, "plots.geojson"))) {
      boxes.push_back(plot.box);
    }
  }
  std::optional<fs::path> cloud;
  if (arguments.scan) cloud = file_or_inside(*arguments.scan, "cloud.pcd");
  plotscan::view::draw_picture(farm, cloud, boxes, arguments.png, arguments.options);
  program.say("wrote " + arguments.png.string());
  program.result({{"picture", arguments.png.string()}});
}

}  // namespace

int main(int argc, char** argv) {
  plotscan::Program program(
      "plotview", "Draw virtual phenotyping farms, scans of them, and the plots found there.");
  PictureArguments arguments;
  CLI::App& picture =
      program.command("picture", "Draw a farm, and a scan with plot boxes beside it, into a PNG.",
                      [&] { draw(program, arguments); });
  picture.add_option("FARM", arguments.farm, "farm folder, from farmgen generate")->required();
  picture.add_option("-o,--output", arguments.png, "the PNG to write")->required();
  picture.add_option("--scan", arguments.scan,
                     "scan folder, PCD or PLY: drawn beside the farm, coloured by height");
  picture.add_option("--plots", arguments.plots,
                     "estimate folder or GeoJSON: its boxes are drawn on the scan");
  picture.add_option("--width", arguments.options.width_px, "width of the picture (pixels)");
  picture.add_option("--height", arguments.options.height_px, "height of the picture (pixels)");
  picture.add_option("--azimuth", arguments.options.azimuth_deg,
                     "where the camera stands, counter-clockwise from east (degrees)");
  picture.add_option("--elevation", arguments.options.elevation_deg,
                     "of the camera over the horizon (degrees)");
  picture.add_option("--margin", arguments.options.margin_m, "shown around the plots (metres)");
  return program.run(argc, argv);
}
