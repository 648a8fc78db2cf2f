// SPDX-License-Identifier: Apache-2.0
#include "points_of.h"

#include <string>

#include "plotscan/error.h"

namespace plotscan::python {
namespace py = pybind11;
namespace {

[[noreturn]] void refuse(const py::array& array) {
  std::string shape;
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis)
    shape += (axis > 0 ? ", " : "") + std::to_string(array.shape(axis));
  throw BadInput(
      "points are an array of shape (N, 3), float32 or float64, each row whole in memory "
      "(numpy.ascontiguousarray makes one), or a cloud's points; not one of shape (" +
      shape + "), dtype " + py::str(array.dtype()).cast<std::string>());
}

// Where the field lies in a record, in bytes; -1 where there is none of float32.
py::ssize_t place_of(const py::dtype& record, const char* field) {
  const py::object fields = record.attr("fields");
  if (fields.is_none() || !fields.contains(field)) return -1;
  const py::tuple found = fields[field];
  if (!found[0].cast<py::dtype>().equal(py::dtype::of<float>())) return -1;
  return found[1].cast<py::ssize_t>();
}

}  // namespace

PointsView points_of(const py::array& array, const std::array<double, 3>& origin_m) {
  const py::dtype dtype = array.dtype();
  const auto points = static_cast<std::size_t>(array.ndim() > 0 ? array.shape(0) : 0);
  // NumPy gives an array without points any strides.
  const bool empty = array.size() == 0;
  const py::ssize_t stride = array.ndim() > 0 && !empty ? array.strides(0) : 0;
  if (stride < 0) refuse(array);
  const auto step = static_cast<std::size_t>(stride);
  if (array.ndim() == 1) {
    const py::ssize_t x = place_of(dtype, "x");
    const auto four = static_cast<py::ssize_t>(sizeof(float));
    if (x < 0 || place_of(dtype, "y") != x + four || place_of(dtype, "z") != x + 2 * four)
      refuse(array);
    const auto* first = static_cast<const char*>(array.data()) + x;
    return {reinterpret_cast<const float*>(first), points, step, origin_m};
  }
  if (array.ndim() != 2 || array.shape(1) < 3) refuse(array);
  if (!empty && array.strides(1) != array.itemsize()) refuse(array);
  if (dtype.equal(py::dtype::of<float>()))
    return {static_cast<const float*>(array.data()), points, step, origin_m};
  if (!dtype.equal(py::dtype::of<double>())) refuse(array);
  if (origin_m != std::array<double, 3>{}) {
    throw BadInput(
        "origin_m is what positions in float32 count from; these are float64: add it to them");
  }
  return {static_cast<const double*>(array.data()), points, step};
}

}  // namespace plotscan::python
