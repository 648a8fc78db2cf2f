// SPDX-License-Identifier: Apache-2.0
#include "farmbench/export/internal/task_sheet.h"

#include <string_view>

namespace plotscan::farmbench {
namespace {

using nlohmann::json;

constexpr std::string_view kFiles =
    "| file | holds |\n| --- | --- |\n"
    "| `cloud.pcd`, `cloud.las` | the points, whichever of the two were asked for |\n"
    "| `flight.pcap` | the sensor's packets, where they were asked for |\n"
    "| `poses.csv` | where the drone reported to be: `t_s,x_m,y_m,z_m,qx,qy,qz,qw` |\n"
    "| `sensor.yaml`, `flight.json` | the sensor and how it was mounted and set |\n"
    "| `boxes.csv`, `boxes.geojson` | the plots' boxes, where they are given |\n";

constexpr std::string_view kFrame =
    "Coordinates are metres in a local frame, x east, y north, z up; times are seconds from the "
    "flight's start. A box is its centre, width, length and heading: the direction of the length, "
    "counter-clockwise from x, degrees.\n";

constexpr std::string_view kHandIn =
    "Hand in a folder with\n\n"
    "- `submission.json`: `{\"method\": \"my-method\"}`, a name of letters, digits, `-` and `_`;\n"
    "- a copy of `task.json`, whose hashes say which farms and clouds these were;\n"
    "- of each field `FIELD.csv` or `FIELD.geojson`, one row or feature a plot: its box, heights "
    "(`height_p99_m`, ...), intervals (`low95_height_p99_m`, `high95_height_p99_m`), any of them. "
    "Without a box a row names one of the given boxes by its `plot_number`.\n\n"
    "A field without a file counts as one of which nothing was found. docs/submissions.md of "
    "Plotscan has the whole format and examples.\n";

}  // namespace

std::string task_sheet(const json& task) {
  std::string text = "# Task: " + task.at("suite").get<std::string>() + "\n\n" +
                     std::to_string(task.at("fields").size()) +
                     " fields were scanned from a drone. Say where their plots are, how high the "
                     "crop of each stands, and how sure that is; or any part of it.\n\n";
  text += task.at("boxes_given").get<bool>() ? "The plots' boxes are given: heights are asked.\n\n"
                                             : "Nothing is known of the plots but the clouds.\n\n";
  text += "## What you have\n\nEach field is a folder:\n\n" + std::string(kFiles) + "\n" +
          std::string(kFrame) +
          "\n## What is asked\n\nHeights are scored against\n\n| height | of "
          "the plot |\n| --- | --- |\n";
  for (const auto& [name, meaning] : task.at("heights").items())
    text += "| `" + name + "` | " + meaning.get<std::string>() + " |\n";
  text += "\n## How to hand it in\n\n" + std::string(kHandIn) +
          "\n## Fields\n\n| field | points |\n| --- | --- |\n";
  for (const json& field : task.at("fields")) {
    text += "| `" + field.at("field").get<std::string>() + "` | " +
            std::to_string(field.at("points").get<std::uint64_t>()) + " |\n";
  }
  return text;
}

}  // namespace plotscan::farmbench
