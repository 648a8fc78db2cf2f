// SPDX-License-Identifier: Apache-2.0
#include <span>

#include <fmt/core.h>

#include "core/error.h"
#include "core/manifest.h"
#include "core/output_folder.h"
#include "core/plot_features.h"
#include "core/program.h"
#include "core/text.h"
#include "estimate/estimate.h"
#include "estimate/ground_grids.h"
#include "farm/farm.h"
#include "farmfolder/read_farm.h"
#include "mesh/mesh_import.h"
#include "view/field_picture.h"
#include "view/picture.h"
#include "view/plant_picture.h"
#include "view/plot_picture.h"

namespace {

using namespace plotscan;
namespace fs = std::filesystem;

struct PictureArguments {
  fs::path farm;
  std::optional<fs::path> scan;
  std::optional<fs::path> plots;
  fs::path png;
  view::PictureOptions options;
};

// A file, or a folder with that file in it.
fs::path file_or_inside(const fs::path& path, const char* name) {
  return fs::is_directory(path) ? path / name : path;
}

void require_picture(const fs::path& png, std::span<const fs::path> inputs) {
  require_apart(png, inputs);
  if (lower_extension(png) != ".png") throw InputError(png, "does not end in .png");
}

void say_written(const Program& program, const fs::path& png) {
  program.say("wrote " + png.string());
  program.result({{"picture", png.string()}});
}

void draw(const Program& program, const PictureArguments& arguments) {
  std::vector<fs::path> inputs = {arguments.farm};
  for (const auto& input : {arguments.scan, arguments.plots})
    if (input) inputs.push_back(*input);
  require_picture(arguments.png, inputs);
  const farm::Farm farm = farmfolder::read_farm(arguments.farm);
  std::vector<PlotBox> boxes;
  if (arguments.plots)
    for (const PlotFeature& plot : read_plot_features(plot_map_of(*arguments.plots)))
      boxes.push_back(plot.box);
  std::optional<fs::path> cloud;
  if (arguments.scan) cloud = file_or_inside(*arguments.scan, "cloud.pcd");
  view::draw_picture(farm, cloud, boxes, arguments.png, arguments.options);
  say_written(program, arguments.png);
}

struct PlantsArguments {
  std::vector<fs::path> meshes;
  std::vector<std::string> labels;
  std::string up;
  fs::path png;
  view::PlantPictureOptions options;
};

void draw_plants(const Program& program, const PlantsArguments& arguments) {
  require_picture(arguments.png, arguments.meshes);
  if (!arguments.labels.empty() && arguments.labels.size() != arguments.meshes.size()) {
    throw InputError(fmt::format("--labels names {} plants where there are {} meshes",
                                 arguments.labels.size(), arguments.meshes.size()));
  }
  mesh::MeshImportOptions import;
  if (!arguments.up.empty()) import.up = arguments.up == "y" ? mesh::UpAxis::y : mesh::UpAxis::z;
  std::vector<view::PicturedPlant> plants;
  for (std::size_t i = 0; i < arguments.meshes.size(); ++i) {
    const fs::path& path = arguments.meshes[i];
    plants.push_back(
        {.label = arguments.labels.empty() ? path.stem().string() : arguments.labels[i],
         .mesh = mesh::import_mesh(path, import)});
  }
  view::draw_plants(plants, arguments.png, arguments.options);
  say_written(program, arguments.png);
}

struct EstimateArguments {
  fs::path cloud;
  fs::path estimate;
  fs::path png;
  std::string plot;
  view::FieldPictureOptions field;
  view::PlotPictureOptions side;
};

estimate::Estimate estimate_with_ground(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw InputError(folder, "is no estimate folder, as estimator run writes it");
  estimate::Estimate estimate = estimate::read_estimate(folder);
  if (!fs::exists(folder / "ground.asc")) {
    throw InputError(folder,
                     "has no ground.asc: its method models no ground to draw "
                     "over; estimator run --method lattice does");
  }
  estimate.ground = estimate::read_ground(folder, estimate.units.value_or(CoordinateUnits{}));
  return estimate;
}

// The file of the estimate's cloud; a note tells if it is another one.
fs::path measured_cloud(const Program& program, const EstimateArguments& arguments) {
  fs::path cloud = file_or_inside(arguments.cloud, "cloud.pcd");
  if (const auto note = other_cloud_note(arguments.estimate, cloud))
    program.announce("note: " + *note);
  return cloud;
}

void draw_field(const Program& program, const EstimateArguments& arguments) {
  require_picture(arguments.png, {{arguments.cloud, arguments.estimate}});
  const estimate::Estimate estimate = estimate_with_ground(arguments.estimate);
  view::draw_field(measured_cloud(program, arguments), estimate, arguments.png, arguments.field);
  say_written(program, arguments.png);
}

void draw_plot(const Program& program, const EstimateArguments& arguments) {
  require_picture(arguments.png, {{arguments.cloud, arguments.estimate}});
  const estimate::Estimate estimate = estimate_with_ground(arguments.estimate);
  view::draw_plot(measured_cloud(program, arguments), estimate, PlotId(arguments.plot),
                  arguments.png, arguments.side);
  say_written(program, arguments.png);
}

void add_estimate_arguments(CLI::App& command, EstimateArguments& arguments) {
  command
      .add_option("CLOUD", arguments.cloud,
                  "the cloud, PCD, PLY, LAS or text, or the scan folder with it")
      ->required();
  command
      .add_option("EST", arguments.estimate,
                  "estimate folder of that cloud, from estimator run, with its ground")
      ->required();
  command.add_option("-o,--output", arguments.png, "the PNG to write")->required();
}

// Adds the options of both kinds of pictures.
template <class Options>
void add_view_options(CLI::App& command, Options& options) {
  command.add_option("--width", options.width_px, "width of the picture (pixels)")
      ->type_name("INT in " + Options::kWidth_px.text());
  command.add_option("--height", options.height_px, "height of the picture (pixels)")
      ->type_name("INT in " + Options::kHeight_px.text());
  command
      .add_option("--azimuth", options.azimuth_deg,
                  "where the camera stands, counter-clockwise from east (degrees)")
      ->type_name("FLOAT in " + Options::kAzimuth_deg.text());
  command
      .add_option("--elevation", options.elevation_deg, "of the camera over the horizon (degrees)")
      ->type_name("FLOAT in " + Options::kElevation_deg.text());
}

void declare_picture(Program& program, PictureArguments& arguments) {
  CLI::App& picture =
      program.command("picture", "Draw a farm, and a scan with plot boxes beside it, into a PNG.",
                      [&] { draw(program, arguments); });
  picture.add_option("FARM", arguments.farm, "farm folder, from farmgen generate")->required();
  picture.add_option("-o,--output", arguments.png, "the PNG to write")->required();
  CLI::Option* scan =
      picture.add_option("--scan", arguments.scan,
                         "scan folder, PCD or PLY: drawn beside the farm, coloured by height");
  picture
      .add_option("--plots", arguments.plots,
                  "estimate or farm folder, or GeoJSON: its boxes are drawn on the scan")
      ->needs(scan);
  add_view_options(picture, arguments.options);
  picture.add_option("--margin", arguments.options.margin_m, "shown around the plots (metres)")
      ->type_name("FLOAT in " + view::PictureOptions::kMargin_m.text());
}

void declare_plants(Program& program, PlantsArguments& arguments) {
  CLI::App& plants = program.command("plants", "Draw plant meshes side by side into a PNG.",
                                     [&] { draw_plants(program, arguments); });
  plants.add_option("MESH", arguments.meshes, "plant meshes: OBJ, DAE, glTF, PLY, STL")->required();
  plants.add_option("-o,--output", arguments.png, "the PNG to write")->required();
  plants
      .add_option("--labels", arguments.labels,
                  "names under the plants, separated by commas (default: the files' names)")
      ->delimiter(',')
      ->allow_extra_args(false);
  plants
      .add_option("--columns", arguments.options.columns,
                  "plants in a row (default: 0, as many as makes them largest)")
      ->type_name("INT in " + view::PlantPictureOptions::kColumns.text());
  plants.add_option("--up", arguments.up, "axis that points up in the meshes")
      ->check(CLI::IsMember({"z", "y"}));
  add_view_options(plants, arguments.options);
}

void declare_field(Program& program, EstimateArguments& arguments) {
  CLI::App& field = program.command(
      "field", "Draw an estimate's plots over its cloud, from straight above, into a PNG.",
      [&] { draw_field(program, arguments); });
  using Options = view::FieldPictureOptions;
  add_estimate_arguments(field, arguments);
  field.add_option("--width", arguments.field.width_px, "of the picture at most (pixels)")
      ->type_name("INT in " + Options::kSize_px.text());
  field.add_option("--height", arguments.field.height_px, "of the picture at most (pixels)")
      ->type_name("INT in " + Options::kSize_px.text());
  field.add_option("--margin", arguments.field.margin_m, "shown around the plots (metres)")
      ->type_name("FLOAT in " + Options::kMargin_m.text());
}

void declare_plot(Program& program, EstimateArguments& arguments) {
  CLI::App& plot =
      program.command("plot", "Draw a plot from the side, with its ground and heights, into a PNG.",
                      [&] { draw_plot(program, arguments); });
  using Options = view::PlotPictureOptions;
  add_estimate_arguments(plot, arguments);
  plot.add_option("--plot", arguments.plot, "id of the plot")->required();
  plot.add_option("--heights", arguments.side.heights,
                  "heights to draw, separated by commas (default: mean,p95,max)")
      ->delimiter(',')
      ->allow_extra_args(false);
  plot.add_option("--beyond", arguments.side.beyond_m, "shown before and behind the plot (metres)")
      ->type_name("FLOAT in " + Options::kBeyond_m.text());
  plot.add_option("--width", arguments.side.width_px, "of the picture (pixels)")
      ->type_name("INT in " + Options::kWidth_px.text());
  plot.add_option("--height", arguments.side.height_px, "of the picture at most (pixels)")
      ->type_name("INT in " + Options::kHeight_px.text());
}

}  // namespace

int main(int argc, char** argv) {
  Program program("plotview",
                  "Draw virtual phenotyping farms, scans of them, and the plots found there.");
  PictureArguments picture;
  PlantsArguments plants;
  EstimateArguments field, plot;
  declare_picture(program, picture);
  declare_plants(program, plants);
  declare_field(program, field);
  declare_plot(program, plot);
  return program.run(argc, argv);
}
