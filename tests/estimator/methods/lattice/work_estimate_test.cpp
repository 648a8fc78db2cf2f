// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/work_estimate.h"

#include <gtest/gtest.h>

namespace plotscan::methods::lattice {
namespace {

struct Measured {
  const char* cloud;
  FieldSize field;
  double seconds;  // of the processor
  double gigabytes;
};

// Runs of docs/real-clouds-tests.md, one thread.
TEST(EstimateWork, IsWithinAFactorOfTwoOfWhatWasMeasured) {
  const Measured runs[] = {{"a flight of the paper's", {7700000, 2300, 3040}, 2.95, 0.32},
                           {"114 ha", {684374, 1183744, 0.594}, 2.7, 0.23},
                           {"1 ha of a trial", {3000000, 10404, 300}, 6.5, 0.34},
                           {"10 ha of a trial", {9985600, 101124, 100}, 57, 1.08}};
  for (const Measured& run : runs) {
    const WorkEstimate work = estimate_work(run.field, 1);
    EXPECT_LT(work.seconds, 2 * run.seconds) << run.cloud;
    EXPECT_GT(work.seconds, 0.5 * run.seconds) << run.cloud;
    EXPECT_LT(work.gigabytes, 1.5 * run.gigabytes) << run.cloud;
    EXPECT_GT(work.gigabytes, 0.67 * run.gigabytes) << run.cloud;
  }
}

TEST(EstimateWork, OfMoreThreadsIsShorter) {
  const FieldSize field{7700000, 2300, 3040};
  EXPECT_LT(estimate_work(field, 2).seconds, estimate_work(field, 1).seconds);
  EXPECT_EQ(estimate_work(field, 2).gigabytes, estimate_work(field, 1).gigabytes);
}

}  // namespace
}  // namespace plotscan::methods::lattice
