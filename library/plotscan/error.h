// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

#include "plotscan/export.h"

namespace plotscan {

// What functions throw: BadInput and NothingMeasured as below. Whatever else goes wrong leaves as
// std::runtime_error, whose what() names the file where there is one (a disk that is full or cannot
// be written), or as std::bad_alloc.

// Bad input: a file, a line of it, a value, an option. what() says which one, what is wrong and
// what would be right, in the words in which the programs print it.
class PLOTSCAN_API BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Input that is sound and shows nothing of what is to be measured. what() says why, and what to do.
class PLOTSCAN_API NothingMeasured : public BadInput {
 public:
  using BadInput::BadInput;
};

}  // namespace plotscan
