// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <pybind11/numpy.h>

#include "plotscan/points.h"

namespace plotscan::python {

// The positions in an array of shape (N, 3) or more columns, float32 or float64, each row whole in
// memory; or in a structured array (N,) with float32 fields x, y and z behind each other, as a
// cloud's points have them. Nothing is copied. float32 positions are relative to the origin. Throws
// BadInput on any other array, on an origin beside float64, and on float32 positions most of
// which are so far from the origin that they count in steps of more than 5 cm.
PointsView points_of(const pybind11::array& array, const std::array<double, 3>& origin_m);

}  // namespace plotscan::python
