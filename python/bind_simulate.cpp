// SPDX-License-Identifier: Apache-2.0
#include "bind.h"
#include "plotscan/farm.h"
#include "plotscan/flight.h"
#include "plotscan/score.h"
#include "watched.h"
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace plotscan::python {
namespace py = pybind11;
namespace fs = std::filesystem;
namespace {

void bind_farm(py::module_& module) {
  py::class_<FarmSummary>(module, "FarmSummary")
      .def_readonly("name", &FarmSummary::name)
      .def_readonly("seed", &FarmSummary::seed)
      .def_readonly("plots", &FarmSummary::plots)
      .def_readonly("plants", &FarmSummary::plants)
      .def_readonly("weeds", &FarmSummary::weeds)
      .def_readonly("field_size_m", &FarmSummary::field_size_m)
      .def_readonly("plant_height_mean_m", &FarmSummary::plant_height_mean_m)
      .def_readonly("plant_height_max_m", &FarmSummary::plant_height_max_m)
      .def_readonly("leaf_area_index", &FarmSummary::leaf_area_index);
  py::class_<TruePlot>(module, "TruePlot")
      .def_readonly("id", &TruePlot::id)
      .def_readonly("trial", &TruePlot::trial)
      .def_readonly("row", &TruePlot::row)
      .def_readonly("column", &TruePlot::column)
      .def_readonly("box", &TruePlot::box)
      .def_readonly("heights_m", &TruePlot::heights_m);
  module.def(
      "generate_farm",
      [](const fs::path& description, const fs::path& folder, const std::vector<std::string>& set,
         std::optional<std::uint64_t> seed, int threads, bool replace, const py::object& progress) {
        return watched(progress, [&](const Progress& report) {
          return generate_farm(description, folder, {set, seed, threads, replace}, report);
        });
      });
  module.def("read_truth", &read_truth);
}

void bind_flight(py::module_& module) {
  py::class_<FlightSummary>(module, "FlightSummary")
      .def_readonly("shots", &FlightSummary::shots)
      .def_readonly("points", &FlightSummary::points)
      .def_readonly("duration_s", &FlightSummary::duration_s)
      .def_readonly("notes", &FlightSummary::notes);
  py::class_<FlightOptions>(module, "FlightOptions")
      .def(py::init<>())
      .def_readwrite("settings", &FlightOptions::settings)
      .def_readwrite("trajectory", &FlightOptions::trajectory)
      .def_readwrite("waypoints", &FlightOptions::waypoints)
      .def_readwrite("formats", &FlightOptions::formats)
      .def_readwrite("resource_paths", &FlightOptions::resource_paths)
      .def_readwrite("seed", &FlightOptions::seed)
      .def_readwrite("threads", &FlightOptions::threads)
      .def_readwrite("replace", &FlightOptions::replace);
  module.def("flight_settings", &flight_settings);
  module.def("fly", [](const fs::path& place, const fs::path& folder, const FlightOptions& options,
                       const py::object& progress) {
    return watched(progress,
                   [&](const Progress& report) { return fly(place, folder, options, report); });
  });
}

void bind_score(py::module_& module) {
  py::class_<HeightScore>(module, "HeightScore")
      .def_readonly("height", &HeightScore::height)
      .def_readonly("truth", &HeightScore::truth)
      .def_readonly("plots", &HeightScore::plots)
      .def_readonly("rmse_m", &HeightScore::rmse_m)
      .def_readonly("bias_m", &HeightScore::bias_m)
      .def_readonly("mae_m", &HeightScore::mae_m)
      .def_readonly("r2", &HeightScore::r2)
      .def_readonly("coverage95", &HeightScore::coverage95);
  py::class_<Scores>(module, "Scores")
      .def_readonly("plots", &Scores::plots)
      .def_readonly("found", &Scores::found)
      .def_readonly("missed", &Scores::missed)
      .def_readonly("extra", &Scores::extra)
      .def_readonly("iou_mean", &Scores::iou_mean)
      .def_readonly("center_rmse_m", &Scores::center_rmse_m)
      .def_readonly("heading_rmse_deg", &Scores::heading_rmse_deg)
      .def_readonly("heights", &Scores::heights)
      .def_readonly("notes", &Scores::notes);
  module.def("score_estimate",
             [](const FieldEstimate& estimate, const fs::path& truth, double min_iou,
                const std::string& id) { return score_estimate(estimate, truth, min_iou, id); });
  module.def("score_estimate",
             [](const fs::path& estimate, const fs::path& truth, double min_iou,
                const std::string& id) { return score_estimate(estimate, truth, min_iou, id); });
}

}  // namespace

void bind_simulate(py::module_& module) {
  bind_farm(module);
  bind_flight(module);
  bind_score(module);
}

}  // namespace plotscan::python
