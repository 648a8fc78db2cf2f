// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include <pybind11/pybind11.h>

#include "plotscan/progress.h"

namespace plotscan::python {

// Runs work in a thread of its own, without the interpreter's lock, while the calling thread, to
// which Python's signals come, waits: it calls `progress` (None, or a callable of one number) with
// the share done, and handles Ctrl-C. An exception of either ends the work at its next report,
// which leaves nothing half-written, and is raised when the work has ended. What the work throws is
// thrown.
void watch(const pybind11::object& progress, const std::function<void(const Progress&)>& work);

// The same for work that returns something.
template <class Work>
auto watched(const pybind11::object& progress, const Work& work) {
  std::optional<decltype(work(std::declval<const Progress&>()))> result;
  watch(progress, [&](const Progress& report) { result.emplace(work(report)); });
  return std::move(*result);
}

}  // namespace plotscan::python
