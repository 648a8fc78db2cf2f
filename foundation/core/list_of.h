// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <type_traits>
#include <vector>

namespace plotscan {

// What `of` gives for each of the items, in their order: list_of(plots, &Plot::box). `of` is a
// member or a function; the entries are of its type, or of the type that is named.
template <class Named = void, class Items, class Of>
auto list_of(Items&& items, const Of& of) {
  using Given = std::invoke_result_t<const Of&, decltype(*std::begin(items))>;
  std::vector<std::conditional_t<std::is_void_v<Named>, std::decay_t<Given>, Named>> list;
  list.reserve(std::size(items));
  for (auto&& item : items) list.emplace_back(std::invoke(of, item));
  return list;
}

// Those of the items of which `wanted`, a member or a function, is true, in their order.
template <class Items, class Wanted>
auto those_of(const Items& items, const Wanted& wanted) {
  std::vector<std::decay_t<decltype(*std::begin(items))>> those;
  std::ranges::copy_if(items, std::back_inserter(those), wanted);
  return those;
}

}  // namespace plotscan
