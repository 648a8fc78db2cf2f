// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <utility>

#include "plotscan/error.h"

#include "core/error.h"

namespace plotscan::boundary {

// What `work` returns; the errors that a program prints and ends with exit code 2 or 3 leave the
// library as its own, with the same text. A disk that is full, read only or broken stays a
// std::runtime_error, as every other failure does.
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
