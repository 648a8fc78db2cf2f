// SPDX-License-Identifier: Apache-2.0
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bind.h"
#include "members.h"
#include "plotscan/clouds.h"
#include "plotscan/estimate.h"
#include "points_of.h"
#include "watched.h"

namespace plotscan::python {
namespace py = pybind11;
namespace fs = std::filesystem;
namespace {

// A grid's values as an array (rows, columns) that keeps the estimate alive.
py::array_t<float> grid_array(const py::object& grid, const std::vector<float>& values) {
  const auto& shape = grid.cast<const GroundGrid&>();
  return py::array_t<float>({shape.rows, shape.columns}, values.data(), grid);
}

py::object parsed(const std::string& json) {
  return py::module_::import("json").attr("loads")(json);
}

void bind_plots(py::module_& module) {
  settable(py::class_<Box>(module, "Box")
               .def(py::init<double, double, double, double, double>(), py::arg("center_x_m"),
                    py::arg("center_y_m"), py::arg("width_m"), py::arg("length_m"),
                    py::arg("heading_deg")),
           PLOTSCAN_MEMBERS(Box, center_x_m, center_y_m, width_m, length_m, heading_deg));
  readable(py::class_<BoxError>(module, "BoxError"),
           PLOTSCAN_MEMBERS(BoxError, along_m, across_m, width_m, length_m, heading_deg));
  readable(py::class_<Height>(module, "Height"),
           PLOTSCAN_MEMBERS(Height, value_m, standard_error_m, low95_m, high95_m));
  readable(py::class_<Plot>(module, "Plot"),
           PLOTSCAN_MEMBERS(Plot, id, trial, row, column, box, box_error, points, heights,
                            confidence, flags));
}

void bind_results(py::module_& module) {
  readable(py::class_<GroundGrid>(module, "GroundGrid"),
           PLOTSCAN_MEMBERS(GroundGrid, x_m, y_m, cell_m))
      .def_property_readonly("z_m",
                             [](const py::object& grid) {
                               return grid_array(grid, grid.cast<const GroundGrid&>().z_m);
                             })
      .def_property_readonly("sd_m", [](const py::object& grid) {
        return grid_array(grid, grid.cast<const GroundGrid&>().sd_m);
      });
  readable(py::class_<FieldEstimate>(module, "FieldEstimate"),
           PLOTSCAN_MEMBERS(FieldEstimate, method, plots, why_no_plots, ground, crs))
      .def_property_readonly("geojson",
                             [](const FieldEstimate& estimate) { return parsed(estimate.geojson); })
      .def_property_readonly("diagnostics", [](const FieldEstimate& estimate) {
        return parsed(estimate.diagnostics);
      });
}

void bind_options(py::module_& module) {
  readable(py::class_<Setting>(module, "Setting"),
           PLOTSCAN_MEMBERS(Setting, key, help, usual, choices));
  settable(py::class_<EstimateOptions>(module, "EstimateOptions").def(py::init<>()),
           PLOTSCAN_MEMBERS(EstimateOptions, crop_box, boxes, settings, threads));
  settable(py::class_<EstimateFilesOptions>(module, "EstimateFilesOptions").def(py::init<>()),
           PLOTSCAN_MEMBERS(EstimateFilesOptions, field, method, boxes, id, units, crs, trajectory,
                            sensor, mount_rpy_deg, topic, leave_out_classes, first_number,
                            numbering, first_corner, plot_names, measured, csv, seed, replace));
}

}  // namespace

void bind_estimate(py::module_& module) {
  bind_plots(module);
  bind_results(module);
  bind_options(module);
  module.def("estimate_settings", &estimate_settings);
  module.def("estimate_field", [](const Cloud& cloud, const EstimateOptions& options,
                                  const std::array<double, 3>&, const py::object& progress) {
    return watched(progress, [&](const Progress& report) {
      return estimate_field(cloud.positions(), options, report);
    });
  });
  module.def("estimate_field", [](const py::array& points, const EstimateOptions& options,
                                  const std::array<double, 3>& origin_m,
                                  const py::object& progress) {
    const PointsView view = points_of(points, origin_m);
    return watched(progress,
                   [&](const Progress& report) { return estimate_field(view, options, report); });
  });
  module.def("estimate_files", [](const std::vector<fs::path>& clouds, const fs::path& folder,
                                  const EstimateFilesOptions& options, const py::object& progress) {
    return watched(progress, [&](const Progress& report) {
      return estimate_files(clouds, folder, options, report);
    });
  });
}

}  // namespace plotscan::python
