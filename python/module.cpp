// SPDX-License-Identifier: Apache-2.0
// The compiled part of the Python package plotscan, which plotscan/__init__.py documents.
#include <pybind11/stl/filesystem.h>

#include "bind.h"
#include "plotscan/data.h"
#include "plotscan/error.h"

PYBIND11_MODULE(_plotscan, module) {
  namespace py = pybind11;
  using namespace plotscan;
  // The later one is asked first: NothingMeasured is a BadInput.
  const auto& bad_input = py::register_exception<BadInput>(module, "BadInput", PyExc_ValueError);
  py::register_exception<NothingMeasured>(module, "NothingMeasured", bad_input);
  module.def("version", &library_version);
  module.def("data_folder", &shipped_data);
  python::bind_clouds(module);
  python::bind_estimate(module);
  python::bind_simulate(module);
}
