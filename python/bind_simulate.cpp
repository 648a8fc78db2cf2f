// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bind.h"
#include "members.h"
#include "plotscan/farm.h"
#include "plotscan/flight.h"
#include "plotscan/score.h"
#include "watched.h"

namespace plotscan::python {
namespace py = pybind11;
namespace fs = std::filesystem;
namespace {

void bind_farm(py::module_& module) {
  readable(py::class_<FarmSummary>(module, "FarmSummary"),
           PLOTSCAN_MEMBERS(FarmSummary, name, seed, plots, plants, weeds, field_size_m,
                            plant_height_mean_m, plant_height_max_m, leaf_area_index));
  readable(py::class_<TruePlot>(module, "TruePlot"),
           PLOTSCAN_MEMBERS(TruePlot, id, trial, row, column, box, heights_m));
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
  readable(py::class_<FlightSummary>(module, "FlightSummary"),
           PLOTSCAN_MEMBERS(FlightSummary, shots, points, duration_s, notes));
  settable(py::class_<FlightOptions>(module, "FlightOptions").def(py::init<>()),
           PLOTSCAN_MEMBERS(FlightOptions, settings, trajectory, waypoints, formats, resource_paths,
                            seed, threads, replace));
  module.def("flight_settings", &flight_settings);
  module.def("fly", [](const fs::path& place, const fs::path& folder, const FlightOptions& options,
                       const py::object& progress) {
    return watched(progress,
                   [&](const Progress& report) { return fly(place, folder, options, report); });
  });
}

void bind_score(py::module_& module) {
  readable(
      py::class_<HeightScore>(module, "HeightScore"),
      PLOTSCAN_MEMBERS(HeightScore, height, truth, plots, rmse_m, bias_m, mae_m, r2, coverage95));
  readable(py::class_<Scores>(module, "Scores"),
           PLOTSCAN_MEMBERS(Scores, plots, found, missed, extra, iou_mean, center_rmse_m,
                            heading_rmse_deg, heights, notes));
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
