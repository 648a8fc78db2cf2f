// SPDX-License-Identifier: Apache-2.0
#include "sensors_command.h"

#include <memory>
#include <string>
#include <vector>

#include "sensor/sensor.h"
#include "sensor/summary.h"

namespace plotscan {
namespace {

void list_sensors(const Program& program) {
  std::vector<sensor::SensorSummary> summaries;
  nlohmann::json document = nlohmann::json::array();
  for (const std::string& name : sensor::sensor_names()) {
    summaries.push_back(summary_of(sensor::load_sensor(name)));
    document.push_back(summary_json(summaries.back()));
  }
  program.result(document);
  for (const std::string& line : summary_lines(summaries)) program.say(line);
}

void print_sensor(const Program& program, const std::string& name) {
  const sensor::Sensor sensor = sensor::load_sensor(name);
  nlohmann::json document = summary_json(summary_of(sensor));
  document["file"] = sensor.description;
  program.result(document);
  program.say(sensor.description.substr(0, sensor.description.find_last_not_of('\n') + 1));
}

}  // namespace

void declare_sensors(Program& program) {
  const auto name = std::make_shared<std::string>();
  CLI::App& sensors =
      program.command("sensors", "List the sensors, or print the file of one.", [&program, name] {
        if (name->empty())
          list_sensors(program);
        else
          print_sensor(program, *name);
      });
  sensors.add_option("NAME|FILE.yaml", *name,
                     "print this sensor's file, a start for your own; FILE.yaml: check your own");
}

}  // namespace plotscan
