// SPDX-License-Identifier: Apache-2.0
#include "farmfolder/internal/ordered_texts.h"

#include <algorithm>

#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

namespace plotscan::farmfolder {
namespace {

struct NumberedText {
  std::size_t number = 0;
  std::string text;
};

}  // namespace

void make_in_order(std::size_t count, int threads,
                   const std::function<std::string(std::size_t number)>& make,
                   const std::function<void(std::size_t number, const std::string& text)>& take) {
  constexpr std::size_t kTextsOfThread = 4;
  std::size_t next = 0;
  const auto number = [&](tbb::flow_control& control) {
    if (next == count) control.stop();
    return next++;
  };
  const auto text_of = [&](std::size_t at) { return NumberedText{at, make(at)}; };
  const auto hand_on = [&](const NumberedText& made) { take(made.number, made.text); };
  // With more threads than processors oneTBB would print a warning.
  tbb::task_arena arena(std::min(threads, tbb::info::default_concurrency()));
  arena.execute([&] {
    using Mode = tbb::filter_mode;
    tbb::parallel_pipeline(
        kTextsOfThread * static_cast<std::size_t>(threads),
        tbb::make_filter<void, std::size_t>(Mode::serial_in_order, number) &
            tbb::make_filter<std::size_t, NumberedText>(Mode::parallel, text_of) &
            tbb::make_filter<NumberedText, void>(Mode::serial_in_order, hand_on));
  });
}

}  // namespace plotscan::farmfolder
