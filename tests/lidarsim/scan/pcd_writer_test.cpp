// SPDX-License-Identifier: Apache-2.0
#include "scan/pcd_writer.h"

#include <array>
#include <vector>

#include "temporary_folder.h"
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>

#include "core/error.h"
#include "scan/cloud_reader.h"

namespace plotscan::scan {
namespace {

using testing::TemporaryFolder;

LabelledPoint numbered_point(std::uint32_t i) {
  const auto f = static_cast<float>(i);
  return {.x = f,
          .y = -f,
          .z = 0.125f * f,
          .intensity = static_cast<float>(i % 256),
          .ring = static_cast<std::uint16_t>(i % 16),
          .time = 1e-6 * i,
          .return_number = static_cast<std::uint8_t>(1 + i % 2),
          .return_count = static_cast<std::uint8_t>(1 + i % 3),
          .label = static_cast<PointClass>(i % 5),
          .plot = i / 2,
          .plant = 4000000000u + i};
}

void write_cloud(const std::filesystem::path& file, std::uint32_t points) {
  PcdWriter writer(file);
  for (std::uint32_t i = 0; i < points; i += 2) {
    const std::array<LabelledPoint, 2> pair = {numbered_point(i), numbered_point(i + 1)};
    writer.write(std::span(pair).first(std::min(points - i, 2u)));
  }
  EXPECT_EQ(writer.points(), points);
  writer.close();
}

// One field of one point as PCL sees it.
template <class T>
T value(const pcl::PCLPointCloud2& cloud, const std::string& name, std::uint8_t type,
        std::size_t point) {
  for (const pcl::PCLPointField& field : cloud.fields) {
    if (field.name != name) continue;
    EXPECT_EQ(field.datatype, type) << name;
    EXPECT_EQ(field.count, 1u) << name;
    T result;
    std::memcpy(&result, &cloud.data[point * cloud.point_step + field.offset], sizeof result);
    return result;
  }
  ADD_FAILURE() << "no field " << name;
  return {};
}

TEST(PcdWriter, PclReadsEveryField) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cloud.pcd";
  write_cloud(file, 1001);
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::PCDReader().read(file.string(), cloud), 0);
  ASSERT_EQ(cloud.width * cloud.height, 1001u);
  ASSERT_EQ(cloud.fields.size(), 11u);
  using Field = pcl::PCLPointField;
  for (std::uint32_t i = 0; i < 1001; ++i) {
    const LabelledPoint point = numbered_point(i);
    EXPECT_EQ(value<float>(cloud, "x", Field::FLOAT32, i), point.x);
    EXPECT_EQ(value<float>(cloud, "y", Field::FLOAT32, i), point.y);
    EXPECT_EQ(value<float>(cloud, "z", Field::FLOAT32, i), point.z);
    EXPECT_EQ(value<float>(cloud, "intensity", Field::FLOAT32, i), point.intensity);
    EXPECT_EQ(value<std::uint16_t>(cloud, "ring", Field::UINT16, i), point.ring);
    EXPECT_EQ(value<double>(cloud, "time", Field::FLOAT64, i), point.time);
    EXPECT_EQ(value<std::uint8_t>(cloud, "return_number", Field::UINT8, i), point.return_number);
    EXPECT_EQ(value<std::uint8_t>(cloud, "return_count", Field::UINT8, i), point.return_count);
    EXPECT_EQ(value<PointClass>(cloud, "class", Field::UINT8, i), point.label);
    EXPECT_EQ(value<std::uint32_t>(cloud, "plot", Field::UINT32, i), point.plot);
    EXPECT_EQ(value<std::uint32_t>(cloud, "plant", Field::UINT32, i), point.plant);
  }
}

TEST(PcdWriter, OurReaderReadsIt) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cloud.pcd";
  write_cloud(file, 7);
  std::vector<Eigen::Vector3d> positions;
  read_positions(file, [&](std::span<const Eigen::Vector3d> piece) {
    positions.insert(positions.end(), piece.begin(), piece.end());
  });
  ASSERT_EQ(positions.size(), 7u);
  EXPECT_EQ(positions[6], Eigen::Vector3d(6, -6, 0.75));
}

TEST(PcdWriter, UnclosedFileHoldsNoPoints) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cloud.pcd";
  {
    PcdWriter writer(file);
    writer.write(std::vector<LabelledPoint>(1));
  }
  EXPECT_THROW(read_positions(file, [](auto) {}), InputError);
}

TEST(PcdWriter, FullDiskAndMissingFolderAreErrors) {
  const TemporaryFolder folder;
  EXPECT_THROW(PcdWriter(folder.path() / "none" / "cloud.pcd"), std::runtime_error);
  EXPECT_THROW(PcdWriter("/dev/full"), std::runtime_error);
}

}  // namespace
}  // namespace plotscan::scan
