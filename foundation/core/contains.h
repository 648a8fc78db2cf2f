// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>

namespace plotscan {

// Whether one of the items is `value`, or has it as what `of`, a member or a function, gives:
// contains(methods, "lattice", &Method::name).
template <class Items, class Value, class Of = std::identity>
bool contains(const Items& items, const Value& value, const Of& of = {}) {
  return std::ranges::find(items, value, of) != std::ranges::end(items);
}

}  // namespace plotscan
