// SPDX-License-Identifier: Apache-2.0
#include "cloud/internal/background_sink.h"

#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace plotscan::cloud {
namespace {

class WithThreads : public ::testing::TestWithParam<int> {};

// 500 pieces of 0 to 6 points, one point a number, into a sink that is slower than the caller.
TEST_P(WithThreads, TheSinkGetsAllPointsInTheirOrder) {
  std::vector<double> got;
  BackgroundSink sink(
      [&](std::span<const Eigen::Vector3d> points) {
        std::this_thread::yield();
        for (const Eigen::Vector3d& point : points) got.push_back(point.x());
      },
      GetParam());
  double number = 0;
  for (int piece = 0; piece < 500; ++piece) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < piece % 7; ++i) points.emplace_back(++number, 0, 0);
    sink.add(points);
  }
  sink.finish();
  ASSERT_EQ(got.size(), static_cast<std::size_t>(number));
  for (std::size_t i = 0; i < got.size(); ++i) ASSERT_EQ(got[i], static_cast<double>(i + 1));
}

// The caller goes on long after the sink has failed, which gets no more points.
TEST_P(WithThreads, TheSinksErrorReachesTheCaller) {
  int pieces = 0;
  const auto fail = [&](std::span<const Eigen::Vector3d>) {
    if (++pieces == 3) throw std::runtime_error("full");
  };
  const std::vector<Eigen::Vector3d> points(10, Eigen::Vector3d::Zero());
  BackgroundSink sink(fail, GetParam());
  const auto add_all = [&] {
    for (int i = 0; i < 1000; ++i) sink.add(points);
    sink.finish();
  };
  EXPECT_THROW(add_all(), std::runtime_error);
  EXPECT_EQ(pieces, 3);
}

// As when the file can't be read on: nobody calls finish, the sink fails or not.
TEST_P(WithThreads, ItEndsWithoutBeingFinished) {
  for (const bool fails : {false, true}) {
    int pieces = 0;
    {
      BackgroundSink sink(
          [&](std::span<const Eigen::Vector3d>) {
            ++pieces;
            if (fails) throw std::runtime_error("full");
          },
          GetParam());
      try {
        sink.add(std::vector<Eigen::Vector3d>(10, Eigen::Vector3d::Zero()));
      } catch (const std::runtime_error&) {
        EXPECT_EQ(GetParam(), 1);
      }
    }
    EXPECT_EQ(pieces, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(BackgroundSink, WithThreads, ::testing::Values(1, 2, 7));

}  // namespace
}  // namespace plotscan::cloud
