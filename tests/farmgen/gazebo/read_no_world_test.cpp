// SPDX-License-Identifier: Apache-2.0
// Without libsdformat worlds are refused: the message says which package is missing.
#include <gmock/gmock.h>

#include "read_world_fixture.h"

namespace plotscan::gazebo {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(ReadWorld, IsRefusedWithoutItsLibrary) {
  EXPECT_THAT(
      refusal(testing::model_text("m", "0 0 0 0 0 0", "")),
      AllOf(HasSubstr("by_hand.sdf: no SDF world can be read"), HasSubstr("libsdformat-dev")));
}

}  // namespace
}  // namespace plotscan::gazebo
