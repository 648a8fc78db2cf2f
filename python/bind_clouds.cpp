// SPDX-License-Identifier: Apache-2.0
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bind.h"
#include "plotscan/clouds.h"
#include "watched.h"

namespace plotscan::python {
namespace py = pybind11;
namespace fs = std::filesystem;
namespace {

using PointArray = py::array_t<Point, 0>;

// The cloud's points as an array that keeps the cloud alive.
PointArray points_array(const py::object& cloud) {
  auto& points = cloud.cast<Cloud&>().points;
  return PointArray(static_cast<py::ssize_t>(points.size()), points.data(), cloud);
}

void write(const fs::path& file, const py::array& points, const WriteCloudOptions& options,
           const py::object& progress) {
  const bool whole = points.ndim() == 1 && (points.flags() & py::array::c_style) != 0;
  if (!whole || !points.dtype().equal(py::dtype::of<Point>()))
    throw BadInput("points to write are a whole array of plotscan.point_dtype");
  const std::span<const Point> span(static_cast<const Point*>(points.data()),
                                    static_cast<std::size_t>(points.size()));
  watch(progress, [&](const Progress& report) { write_cloud(file, span, options, report); });
}

void bind_cloud(py::module_& module) {
  py::class_<Cloud>(module, "Cloud")
      .def_property_readonly("points", &points_array)
      .def_readonly("origin_m", &Cloud::origin_m)
      .def_readonly("fields", &Cloud::fields)
      .def_readonly("crs_wkt", &Cloud::crs_wkt)
      .def("__len__", [](const Cloud& cloud) { return cloud.points.size(); });
}

}  // namespace

void bind_clouds(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(Point, x, y, z, intensity, ring, time, return_number, return_count, label,
                       plot, plant);
  module.attr("point_dtype") = py::dtype::of<Point>();
  bind_cloud(module);
  module.def("read_cloud", [](const fs::path& file, const py::object& progress) {
    return watched(progress, [&](const Progress& report) { return read_cloud(file, report); });
  });
  module.def("write_cloud",
             [](const fs::path& file, const py::array& points,
                const std::array<double, 3>& origin_m, const std::string& crs_wkt,
                const std::string& encoding, bool replace, const py::object& progress) {
               write(file, points, {origin_m, crs_wkt, encoding, replace}, progress);
             });
  module.def("convert_cloud",
             [](const fs::path& in, const fs::path& out, const std::string& encoding,
                const std::string& crs, const std::string& topic, bool replace,
                const py::object& progress) {
               return watched(progress, [&](const Progress& report) {
                 return convert_cloud(in, out, {encoding, crs, topic, replace}, report);
               });
             });
}

}  // namespace plotscan::python
