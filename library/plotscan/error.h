// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

#include "plotscan/export.h"

namespace plotscan {

// The functions throw BadInput and NothingMeasured, see below. Any other failure is a
// std::runtime_error, whose what() names the file if one is concerned (a disk that is full or
// cannot be written), or a std::bad_alloc.

// Bad input: a file, a line of it, a value, an option. what() says which one, what is wrong and
// what would be right, in the words in which the programs print it.
class PLOTSCAN_API BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The input is sound but shows nothing that can be measured. what() says why, and what to do.
class PLOTSCAN_API NothingMeasured : public BadInput {
 public:
  using BadInput::BadInput;
};

}  // namespace plotscan
