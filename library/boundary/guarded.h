// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <utility>

#include "core/error.h"
#include "plotscan/error.h"

namespace plotscan::boundary {

// Returns what `work` returns. Errors for which a program ends with exit code 2 or 3 become the
// library's own errors, with the same text. Other failures, such as a disk that is full, read-only
// or broken, stay std::runtime_error.
template <class Work>
auto guarded(Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const NothingToMeasure& error) {
    throw NothingMeasured(error.what());
  } catch (const InputError& error) {
    throw BadInput(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    try {
      throw_as_ours(error);
    } catch (const InputError& ours) {
      throw BadInput(ours.what());
    }
  }
}

}  // namespace plotscan::boundary
