// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

namespace plotscan::python {

// Each adds its part of the module _plotscan.
void bind_clouds(pybind11::module_& module);
void bind_estimate(pybind11::module_& module);
void bind_simulate(pybind11::module_& module);

}  // namespace plotscan::python
