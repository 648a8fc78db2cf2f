// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

// "key", &Setting::key, "help", &Setting::help for PLOTSCAN_MEMBERS(Setting, key, help).
#define PLOTSCAN_MEMBER(Struct, member) #member, &Struct::member
#define PLOTSCAN_MEMBERS(Struct, ...) PYBIND11_MAP_LIST(PLOTSCAN_MEMBER, Struct, __VA_ARGS__)

namespace plotscan::python {

// Adds members of a struct as attributes to be read.
template <class Struct, class Member, class... More>
pybind11::class_<Struct> readable(pybind11::class_<Struct> bound, const char* name,
                                  Member Struct::*member, const More&... more) {
  bound.def_readonly(name, member);
  if constexpr (sizeof...(more) > 0) readable(bound, more...);
  return bound;
}

// The same, to be set as well.
template <class Struct, class Member, class... More>
pybind11::class_<Struct> settable(pybind11::class_<Struct> bound, const char* name,
                                  Member Struct::*member, const More&... more) {
  bound.def_readwrite(name, member);
  if constexpr (sizeof...(more) > 0) settable(bound, more...);
  return bound;
}

}  // namespace plotscan::python
