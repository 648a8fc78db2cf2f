// SPDX-License-Identifier: Apache-2.0
#include "bind.h"
#include "plotscan/clouds.h"
#include "plotscan/estimate.h"
#include "points_of.h"
#include "watched.h"
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

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
  py::class_<Box>(module, "Box")
      .def(py::init<double, double, double, double, double>(), py::arg("center_x_m"),
           py::arg("center_y_m"), py::arg("width_m"), py::arg("length_m"), py::arg("heading_deg"))
      .def_readwrite("center_x_m", &Box::center_x_m)
      .def_readwrite("center_y_m", &Box::center_y_m)
      .def_readwrite("width_m", &Box::width_m)
      .def_readwrite("length_m", &Box::length_m)
      .def_readwrite("heading_deg", &Box::heading_deg);
  py::class_<BoxError>(module, "BoxError")
      .def_readonly("along_m", &BoxError::along_m)
      .def_readonly("across_m", &BoxError::across_m)
      .def_readonly("width_m", &BoxError::width_m)
      .def_readonly("length_m", &BoxError::length_m)
      .def_readonly("heading_deg", &BoxError::heading_deg);
  py::class_<Height>(module, "Height")
      .def_readonly("value_m", &Height::value_m)
      .def_readonly("standard_error_m", &Height::standard_error_m)
      .def_readonly("low95_m", &Height::low95_m)
      .def_readonly("high95_m", &Height::high95_m);
  py::class_<Plot>(module, "Plot")
      .def_readonly("id", &Plot::id)
      .def_readonly("trial", &Plot::trial)
      .def_readonly("row", &Plot::row)
      .def_readonly("column", &Plot::column)
      .def_readonly("box", &Plot::box)
      .def_readonly("box_error", &Plot::box_error)
      .def_readonly("points", &Plot::points)
      .def_readonly("heights", &Plot::heights)
      .def_readonly("confidence", &Plot::confidence)
      .def_readonly("flags", &Plot::flags);
}

void bind_results(py::module_& module) {
  py::class_<GroundGrid>(module, "GroundGrid")
      .def_readonly("x_m", &GroundGrid::x_m)
      .def_readonly("y_m", &GroundGrid::y_m)
      .def_readonly("cell_m", &GroundGrid::cell_m)
      .def_property_readonly("z_m",
                             [](const py::object& grid) {
                               return grid_array(grid, grid.cast<const GroundGrid&>().z_m);
                             })
      .def_property_readonly("sd_m", [](const py::object& grid) {
        return grid_array(grid, grid.cast<const GroundGrid&>().sd_m);
      });
  py::class_<FieldEstimate>(module, "FieldEstimate")
      .def_readonly("method", &FieldEstimate::method)
      .def_readonly("plots", &FieldEstimate::plots)
      .def_readonly("why_no_plots", &FieldEstimate::why_no_plots)
      .def_readonly("ground", &FieldEstimate::ground)
      .def_readonly("crs", &FieldEstimate::crs)
      .def_property_readonly("geojson",
                             [](const FieldEstimate& estimate) { return parsed(estimate.geojson); })
      .def_property_readonly("diagnostics", [](const FieldEstimate& estimate) {
        return parsed(estimate.diagnostics);
      });
}

void bind_options(py::module_& module) {
  py::class_<Setting>(module, "Setting")
      .def_readonly("key", &Setting::key)
      .def_readonly("help", &Setting::help)
      .def_readonly("usual", &Setting::usual)
      .def_readonly("choices", &Setting::choices);
  py::class_<EstimateOptions>(module, "EstimateOptions")
      .def(py::init<>())
      .def_readwrite("crop_box", &EstimateOptions::crop_box)
      .def_readwrite("boxes", &EstimateOptions::boxes)
      .def_readwrite("settings", &EstimateOptions::settings)
      .def_readwrite("threads", &EstimateOptions::threads);
  py::class_<EstimateFilesOptions>(module, "EstimateFilesOptions")
      .def(py::init<>())
      .def_readwrite("field", &EstimateFilesOptions::field)
      .def_readwrite("method", &EstimateFilesOptions::method)
      .def_readwrite("boxes", &EstimateFilesOptions::boxes)
      .def_readwrite("id", &EstimateFilesOptions::id)
      .def_readwrite("units", &EstimateFilesOptions::units)
      .def_readwrite("crs", &EstimateFilesOptions::crs)
      .def_readwrite("trajectory", &EstimateFilesOptions::trajectory)
      .def_readwrite("sensor", &EstimateFilesOptions::sensor)
      .def_readwrite("mount_rpy_deg", &EstimateFilesOptions::mount_rpy_deg)
      .def_readwrite("topic", &EstimateFilesOptions::topic)
      .def_readwrite("leave_out_classes", &EstimateFilesOptions::leave_out_classes)
      .def_readwrite("first_number", &EstimateFilesOptions::first_number)
      .def_readwrite("numbering", &EstimateFilesOptions::numbering)
      .def_readwrite("first_corner", &EstimateFilesOptions::first_corner)
      .def_readwrite("plot_names", &EstimateFilesOptions::plot_names)
      .def_readwrite("measured", &EstimateFilesOptions::measured)
      .def_readwrite("csv", &EstimateFilesOptions::csv)
      .def_readwrite("seed", &EstimateFilesOptions::seed)
      .def_readwrite("replace", &EstimateFilesOptions::replace);
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
