// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "core/processor_time.h"

namespace plotscan::speed {

double wall_s();  // since some moment

// The same work done by us and by a reference.
struct Comparison {
  std::function<void()> ours, reference;
  std::function<void()> prepare = [] {};  // before each of them, not timed
  std::string reference_name;             // "PCL's VoxelGrid"
  std::string items;                      // what `count` counts: "points", "rays"
  double count = 0;                       // of items that each goes through
  double bytes = 0;  // of the file that each reads or writes; 0 where there is none
  double (*now_s)() = processor_time_s;  // the clock
};

// Adds a benchmark that runs both alternately, so that other load on the machine slows both. Its
// counters: the median seconds of each, the median over the turns of (reference seconds / our
// seconds), and the work.
void add_benchmark(const std::string& name, const Comparison& comparison);

// A program's main: takes Google Benchmark's arguments, calls `run` with the others, and prints
// what it throws.
int run_program(const std::string& name, int (*run)(int argc, char** argv), int argc, char** argv);

}  // namespace plotscan::speed
