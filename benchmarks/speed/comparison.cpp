// SPDX-License-Identifier: Apache-2.0
#include "comparison.h"

#include <chrono>
#include <exception>
#include <iostream>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/statistics.h"

namespace plotscan::speed {

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

namespace {

void compare(benchmark::State& state, const Comparison& comparison) {
  std::vector<double> ours_s, reference_s, ratios;
  const auto seconds = [&](const std::function<void()>& action) {
    comparison.prepare();
    const double start_s = comparison.now_s();
    action();
    return comparison.now_s() - start_s;
  };
  for (auto _ : state) {  // NOLINT(clang-analyzer-deadcode.DeadStores): the library's idiom
    reference_s.push_back(seconds(comparison.reference));
    ours_s.push_back(seconds(comparison.ours));
    ratios.push_back(reference_s.back() / ours_s.back());
    state.SetIterationTime(ours_s.back());
  }
  state.SetLabel(comparison.reference_name);
  state.counters["ours_s"] = quantile(ours_s, 0.5);
  state.counters["reference_s"] = quantile(reference_s, 0.5);
  state.counters["ratio"] = quantile(ratios, 0.5);
  state.counters[comparison.items] = comparison.count;
  if (comparison.bytes > 0) state.counters["bytes"] = comparison.bytes;
}

}  // namespace

void add_benchmark(const std::string& name, const Comparison& comparison) {
  // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks): the library owns what it allocates
  benchmark::RegisterBenchmark(
      name.c_str(), [comparison](benchmark::State& state) { compare(state, comparison); })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

int run_program(const std::string& name, int (*run)(int argc, char** argv), int argc, char** argv) {
  try {
    benchmark::Initialize(&argc, argv);
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << '\n';
    return 1;
  }
}

}  // namespace plotscan::speed
