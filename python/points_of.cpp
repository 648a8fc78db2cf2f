// SPDX-License-Identifier: Apache-2.0
#include "points_of.h"

#include <algorithm>
#include <cmath>
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

// Throws where most points are so far from the origin that float32 counts in steps that blur plots:
// in UTM northings in half a metre. A few may be strays.
void require_near(const PointsView& relative) {
  constexpr float kCoarse_m = 1 << 19;  // from here on the steps are 6 cm and more
  std::size_t far = 0;
  float farthest_m = 0;
  for (std::size_t i = 0; i < relative.size(); ++i) {
    const auto [x, y, z] = relative[i];
    const auto away_m = static_cast<float>(std::max(std::abs(x), std::abs(y)));
    if (!std::isfinite(away_m) || away_m < kCoarse_m) continue;
    farthest_m = std::max(farthest_m, away_m);
    ++far;
  }
  if (2 * far <= relative.size()) return;
  const float step_m = std::nextafter(farthest_m, INFINITY) - farthest_m;
  throw BadInput("the points lie up to " + std::to_string(std::llround(farthest_m)) +
                 " m from the origin, where float32 counts in steps of " +
                 std::to_string(std::lround(1000 * step_m)) +
                 " mm: give float64, or take an origin off in float64 and give it as origin_m");
}

PointsView floats(const void* x, std::size_t points, std::size_t step,
                  const std::array<double, 3>& origin_m) {
  const auto* first = static_cast<const float*>(x);
  require_near({first, points, step});
  return {first, points, step, origin_m};
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
    return floats(static_cast<const char*>(array.data()) + x, points, step, origin_m);
  }
  if (array.ndim() != 2 || array.shape(1) < 3) refuse(array);
  if (!empty && array.strides(1) != array.itemsize()) refuse(array);
  if (dtype.equal(py::dtype::of<float>())) return floats(array.data(), points, step, origin_m);
  if (!dtype.equal(py::dtype::of<double>())) refuse(array);
  if (origin_m != std::array<double, 3>{}) {
    throw BadInput(
        "origin_m is what positions in float32 count from; these are float64: add it to them");
  }
  return {static_cast<const double*>(array.data()), points, step};
}

}  // namespace plotscan::python
