// SPDX-License-Identifier: Apache-2.0
#include "scan/cloud_writer.h"

#include <cstring>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include "core/error.h"
#include "lidarsim/scan/numbered_point.h"
#include "scan/cloud_reader.h"
#include "scan/point_reader.h"
#include "temporary_folder.h"

namespace plotscan::scan {
namespace {

using testing::TemporaryFolder;

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

void write_cloud(PointWriter& writer, std::uint32_t points) {
  for (const LabelledPoint& point : numbered_points(points)) writer.write({&point, 1});
  writer.close();
}

void expect_every_field(const pcl::PCLPointCloud2& cloud, std::uint32_t points) {
  ASSERT_EQ(cloud.width * cloud.height, points);
  ASSERT_EQ(cloud.fields.size(), 11u);
  using Field = pcl::PCLPointField;
  for (std::uint32_t i = 0; i < points; ++i) {
    const LabelledPoint point = numbered_point(i);
    ASSERT_EQ(value<float>(cloud, "x", Field::FLOAT32, i), point.x);
    ASSERT_EQ(value<float>(cloud, "y", Field::FLOAT32, i), point.y);
    ASSERT_EQ(value<float>(cloud, "z", Field::FLOAT32, i), point.z);
    ASSERT_EQ(value<float>(cloud, "intensity", Field::FLOAT32, i), point.intensity);
    ASSERT_EQ(value<std::uint16_t>(cloud, "ring", Field::UINT16, i), point.ring);
    ASSERT_EQ(value<double>(cloud, "time", Field::FLOAT64, i), point.time);
    ASSERT_EQ(value<std::uint8_t>(cloud, "return_number", Field::UINT8, i), point.return_number);
    ASSERT_EQ(value<std::uint8_t>(cloud, "return_count", Field::UINT8, i), point.return_count);
    ASSERT_EQ(value<PointClass>(cloud, "class", Field::UINT8, i), point.label);
    ASSERT_EQ(value<std::uint32_t>(cloud, "plot", Field::UINT32, i), point.plot);
    ASSERT_EQ(value<std::uint32_t>(cloud, "plant", Field::UINT32, i), point.plant);
  }
}

std::vector<LabelledPoint> read_back(const std::filesystem::path& file) {
  std::vector<LabelledPoint> points;
  read_points(file, read_cloud_info(file), [&](std::span<const LabelledPoint> piece) {
    points.insert(points.end(), piece.begin(), piece.end());
  });
  return points;
}

// Every kind of cloud file, by what makes its writer.
struct Kind {
  std::string name;
  std::unique_ptr<PointWriter> (*create)(const std::filesystem::path&, const Eigen::Vector3d&);
};

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

class CloudFormats : public ::testing::TestWithParam<Kind> {
 protected:
  TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / ("cloud." + GetParam().name.substr(0, 3));
};

TEST_P(CloudFormats, PclReadsEveryField) {
  write_cloud(*GetParam().create(file_, Eigen::Vector3d::Zero()), 1001);
  pcl::PCLPointCloud2 cloud;
  if (file_.extension() == ".ply") {
    ASSERT_EQ(pcl::PLYReader().read(file_.string(), cloud), 0);
  } else {
    ASSERT_EQ(pcl::PCDReader().read(file_.string(), cloud), 0);
  }
  expect_every_field(cloud, 1001);
}

TEST_P(CloudFormats, OurReaderReadsEveryField) {
  write_cloud(*GetParam().create(file_, Eigen::Vector3d::Zero()), 1001);
  EXPECT_EQ(read_back(file_), numbered_points(1001));
}

TEST_P(CloudFormats, AnOriginMakesDoubles) {
  const Eigen::Vector3d origin(553000, 4123000, -1000);
  write_cloud(*GetParam().create(file_, origin), 101);
  pcl::PCLPointCloud2 cloud;
  const int read = file_.extension() == ".ply" ? pcl::PLYReader().read(file_.string(), cloud)
                                               : pcl::PCDReader().read(file_.string(), cloud);
  ASSERT_EQ(read, 0);
  EXPECT_EQ(value<double>(cloud, "y", pcl::PCLPointField::FLOAT64, 7), 4123000 - 7);
  EXPECT_EQ(value<std::uint32_t>(cloud, "plant", pcl::PCLPointField::UINT32, 7), 4000000007u);
  EXPECT_EQ(read_cloud_info(file_).origin_m, origin);
  EXPECT_EQ(read_back(file_), numbered_points(101));
}

const Kind kKinds[] = {
    {"pcd_binary",
     [](auto& file, auto& origin) -> std::unique_ptr<PointWriter> {
       return std::make_unique<PcdWriter>(file, CloudWriteOptions{.origin_m = origin});
     }},
    {"pcd_ascii",
     [](auto& file, auto& origin) -> std::unique_ptr<PointWriter> {
       return std::make_unique<PcdWriter>(file,
                                          CloudWriteOptions{.ascii = true, .origin_m = origin});
     }},
    {"pcd_compressed",
     [](auto& file, auto& origin) -> std::unique_ptr<PointWriter> {
       return std::make_unique<CompressedPcdWriter>(file, origin);
     }},
    {"ply_binary",
     [](auto& file, auto& origin) -> std::unique_ptr<PointWriter> {
       return std::make_unique<PlyWriter>(file, CloudWriteOptions{.origin_m = origin});
     }},
    {"ply_ascii", [](auto& file, auto& origin) -> std::unique_ptr<PointWriter> {
       return std::make_unique<PlyWriter>(file,
                                          CloudWriteOptions{.ascii = true, .origin_m = origin});
     }}};

INSTANTIATE_TEST_SUITE_P(All, CloudFormats, ::testing::ValuesIn(kKinds),
                         [](const auto& tested) { return tested.param.name; });

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
