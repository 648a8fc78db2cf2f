// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/internal/layout_doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plotscan::methods::lattice {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

plots::FieldFit fit_of(double width_m, double length_m, double pitch_m) {
  plots::FieldFit fit;
  fit.layout.width_m = width_m;
  fit.layout.length_m = length_m;
  fit.layout.column_pitch_m = pitch_m;
  return fit;
}

TEST(LayoutDoubts, AreOfBlocksWhoseRowsRunAcross) {
  plots::FieldFit fit = fit_of(5.3, 9.1, 6.2);
  fit.sown_rows = {.rows = 12, .spacing_m = 0.76, .across = true};
  for (const bool told : {false, true})
    EXPECT_THAT(doubts_of(fit, told), ElementsAre(HasSubstr("12 rows of the crop run across")));
  fit.sown_rows->rows = 6;
  EXPECT_THAT(doubts_of(fit, false), IsEmpty());
}

TEST(LayoutDoubts, AreOfWhatMayBeRowsUnlessTheLayoutIsTold) {
  EXPECT_THAT(doubts_of(fit_of(0.7, 6.4, 0.75), false),
              ElementsAre(HasSubstr("one row of a plot")));
  EXPECT_THAT(doubts_of(fit_of(0.7, 6.4, 0.75), true), IsEmpty());
  EXPECT_THAT(doubts_of(fit_of(1.3, 4.2, 1.7), false), IsEmpty());
  EXPECT_THAT(doubts_of(fit_of(0.9, 1, 1.2), false), IsEmpty());  // hill plots
  EXPECT_THAT(doubts_of(fit_of(0.7, 6.4, 0), false), IsEmpty());  // one column
  plots::FieldFit sown = fit_of(0.9, 4, 1.1);
  sown.sown_rows = {.rows = 3, .spacing_m = 0.3};
  EXPECT_THAT(doubts_of(sown, false), IsEmpty());
}

}  // namespace
}  // namespace plotscan::methods::lattice
