// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "sensor/sensor.h"
#include "sensor/summary.h"

namespace plotscan {
namespace {

void list_sensors(const Program& program) {
  std::vector<sensor::Sensor> sensors;
  nlohmann::json document = nlohmann::json::array();
  for (const std::string& name : sensor::sensor_names()) {
    sensors.push_back(sensor::load_sensor(name));
    document.push_back(summary_json(sensors.back()));
  }
  program.result(document);
  for (const std::string& line : summary_lines(sensors)) program.say(line);
}

void print_sensor(const Program& program, const std::string& name) {
  const sensor::Sensor sensor = sensor::load_sensor(name);
  nlohmann::json document = summary_json(sensor);
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
