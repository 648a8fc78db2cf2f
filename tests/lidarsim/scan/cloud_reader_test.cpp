// SPDX-License-Identifier: Apache-2.0
#include "scan/cloud_reader.h"

#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include "core/csv.h"
#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan::scan {
namespace {

using testing::TemporaryFolder;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct ReadCloud {
  CloudSummary summary;
  std::vector<Eigen::Vector3d> positions;
};

ReadCloud read(const std::filesystem::path& file) {
  ReadCloud result;
  result.summary = read_positions(file, [&](std::span<const Eigen::Vector3d> piece) {
    result.positions.insert(result.positions.end(), piece.begin(), piece.end());
  });
  return result;
}

// More points than one chunk holds, of a type with fields around x y z.
template <class Point>
pcl::PointCloud<Point> pcl_cloud(std::size_t size = 20001) {
  pcl::PointCloud<Point> cloud;
  for (std::size_t i = 0; i < size; ++i) {
    Point point;
    point.x = 0.25f * static_cast<float>(i);
    point.y = -1.0f / static_cast<float>(i + 1);
    point.z = static_cast<float>(i % 7);
    cloud.push_back(point);
  }
  return cloud;
}

template <class Point>
void expect_same(const ReadCloud& read, const pcl::PointCloud<Point>& cloud, double tolerance = 0) {
  ASSERT_EQ(read.positions.size(), cloud.size());
  EXPECT_EQ(read.summary.points, cloud.size());
  EXPECT_EQ(read.summary.not_finite, 0u);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d expected = cloud[i].getVector3fMap().template cast<double>();
    ASSERT_LE((read.positions[i] - expected).norm(), tolerance) << "point " << i;
  }
}

// Three thousand points in the byte order that the header does not say.
TEST(CloudReader, RefusesTheOtherByteOrder) {
  const testing::TemporaryFolder folder;
  std::string body;
  for (int i = 0; i < 9000; ++i) {
    const float number = 0.37F * static_cast<float>(i % 97) - 11.1F;
    std::array<char, sizeof number> bytes{};
    std::memcpy(bytes.data(), &number, sizeof number);
    body.append(bytes.rbegin(), bytes.rend());
  }
  const std::string properties = "property float x\nproperty float y\nproperty float z\n";
  const std::string element = "element vertex 3000\n" + properties + "end_header\n";
  const auto wrong =
      folder.write("w.ply", "ply\nformat binary_little_endian 1.0\n" + element + body);
  const auto right = folder.write("r.ply", "ply\nformat binary_big_endian 1.0\n" + element + body);
  const auto pcd = folder.write(
      "w.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 3000\nDATA binary\n" + body);
  EXPECT_EQ(read(right).summary.points, 3000u);
  for (const auto& file : {wrong, pcd}) {
    EXPECT_THAT(testing::message_of<InputError>([&] { read(file); }),
                ::testing::HasSubstr("is their byte order another than the header says?"));
  }
}

TEST(CloudReader, ReadsPclsBinaryPcd) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cloud.pcd";
  const auto cloud = pcl_cloud<pcl::PointXYZINormal>();
  pcl::io::savePCDFileBinary(file.string(), cloud);
  expect_same(read(file), cloud);
}

TEST(CloudReader, ReadsPclsAsciiPcd) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cloud.pcd";
  const auto cloud = pcl_cloud<pcl::PointXYZI>();
  pcl::PCDWriter().writeASCII(file.string(), cloud, 9);
  expect_same(read(file), cloud, 1e-5);  // nine digits of up to 5000
}

TEST(CloudReader, ReadsPclsCompressedPcd) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cloud.pcd";
  const auto cloud = pcl_cloud<pcl::PointXYZRGBNormal>();
  pcl::io::savePCDFileBinaryCompressed(file.string(), cloud);
  expect_same(read(file), cloud);
}

TEST(CloudReader, ReadsPclsBinaryPly) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cloud.ply";
  const auto cloud = pcl_cloud<pcl::PointXYZINormal>();
  pcl::PLYWriter().write(file.string(), cloud, true);
  expect_same(read(file), cloud);
}

TEST(CloudReader, ReadsPclsAsciiPly) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cloud.ply";
  const auto cloud = pcl_cloud<pcl::PointXYZI>();
  pcl::PLYWriter().write(file.string(), cloud, false);
  expect_same(read(file), cloud, 1e-3);  // PCL writes six digits
}

TEST(CloudReader, GoesByContentNotByName) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cloud.pcd";
  const auto cloud = pcl_cloud<pcl::PointXYZ>(10);
  pcl::PLYWriter().write(file.string(), cloud, true);
  expect_same(read(file), cloud);
}

// Doubles at odd offsets, behind a field of three elements and before a byte.
TEST(CloudReader, ReadsDoublesAtAnyOffset) {
  const TemporaryFolder folder;
  std::string body;
  const std::vector<Eigen::Vector3d> expected = {{1e6 + 1e-7, -2, 3}, {4, 5e-300, 6}};
  for (const Eigen::Vector3d& p : expected) {
    body += "abc";
    for (const int axis : {2, 0, 1}) {
      const double value = p[axis];
      body.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    body += 'd';
  }
  const auto file =
      folder.write("cloud.pcd",
                   "VERSION .7\nFIELDS tag z x y end\nSIZE 1 8 8 8 1\nTYPE U F F F U\n"
                   "COUNT 3 1 1 1 1\nWIDTH 1\nHEIGHT 2\nDATA binary\n" +
                       body);
  EXPECT_EQ(read(file).positions, expected);
}

TEST(CloudReader, ReadsBigEndianPly) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "cloud.ply",
      std::string("ply\r\nformat binary_big_endian 1.0\r\ncomment one\r\nelement vertex 1\r\n"
                  "property uchar r\r\nproperty float x\r\nproperty float y\r\n"
                  "property double z\r\nelement face 0\r\n"
                  "property list uchar int vertex_indices\r\nend_header\r\n") +
          std::string("\x07\x3f\xc0\0\0\xc0\0\0\0\x40\x09\0\0\0\0\0\0", 17));
  const ReadCloud result = read(file);
  ASSERT_EQ(result.positions.size(), 1u);
  EXPECT_EQ(result.positions[0], Eigen::Vector3d(1.5, -2.0, 3.125));
}

// PDAL names PCD's fields in capitals; some programs leave a blank behind "ply".
TEST(CloudReader, ReadsCapitalsAndBlanks) {
  const TemporaryFolder folder;
  const std::vector<Eigen::Vector3d> expected = {{1.5, -2, 3}};
  EXPECT_EQ(read(folder.write("a.pcd",
                              "VERSION 0.7\nFIELDS Intensity X Y Z\nSIZE 2 8 8 8\nTYPE U F F F\n"
                              "COUNT 1 1 1 1\nPOINTS 1\nDATA ascii\n7 1.5 -2 3\n"))
                .positions,
            expected);
  for (const std::string& first : {std::string("ply \n"), std::string("ply\t \r\n")}) {
    EXPECT_EQ(read(folder.write("a.ply", first + "format ascii 1.0\nelement vertex 1\n"
                                                 "property float x\nproperty float y\n"
                                                 "property float z\nend_header\n1.5 -2 3\n"))
                  .positions,
              expected);
  }
}

// PDAL's test files, where they are at hand: one survey as LAS and as PCD.
TEST(CloudReader, ReadsPdalsPcdAsItsLas) {
  const std::filesystem::path real = PLOTSCAN_SHARED_DATA_DIR "/real";
  if (!exists(real)) GTEST_SKIP() << real << " is not at hand";
  const ReadCloud pcd = read(real / "autzen-utm.pcd");
  const ReadCloud las = read(real / "autzen-utm-chipped-25.las");
  ASSERT_EQ(pcd.positions.size(), 1065u);
  ASSERT_EQ(las.positions.size(), 1065u);
  const auto mean = [](const ReadCloud& read) -> Eigen::Vector3d {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& position : read.positions) sum += position;
    return sum / static_cast<double>(read.positions.size());
  };
  EXPECT_LT((mean(pcd) - mean(las)).norm(), 0.1);
}

// As an organised cloud, of a depth camera or of a driver, whose misses are NaN.
TEST(CloudReader, ReadsPclsOrganisedClouds) {
  const TemporaryFolder folder;
  auto cloud = pcl_cloud<pcl::PointXYZI>(640 * 48);
  cloud.width = 640;
  cloud.height = 48;
  for (std::size_t i = 0; i < cloud.size(); i += 3) cloud[i].x = cloud[i].y = cloud[i].z = kNan;
  cloud.is_dense = false;
  const auto file = folder.path() / "cloud.pcd";
  for (const bool compressed : {false, true}) {
    if (compressed) {
      pcl::io::savePCDFileBinaryCompressed(file.string(), cloud);
    } else {
      pcl::io::savePCDFileBinary(file.string(), cloud);
    }
    const ReadCloud result = read(file);
    EXPECT_EQ(result.summary.not_finite, 640u * 48 / 3);
    ASSERT_EQ(result.positions.size(), 640u * 48 * 2 / 3);
    EXPECT_EQ(result.positions.back().x(), cloud.back().x);
  }
}

// A mesh, as MeshLab and CloudCompare write them: doubles, a list of faces behind the vertices.
TEST(CloudReader, ReadsTheVerticesOfAMesh) {
  const TemporaryFolder folder;
  const std::string header =
      "element vertex 3\nproperty double z\nproperty uchar red\nproperty double x\n"
      "property double y\nelement face 1\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nend_header\n";
  const std::vector<Eigen::Vector3d> expected = {
      {512345.6789, 4123456.7891, 234.5678}, {1, 2, 3}, {-4, 5e-7, 6}};
  std::string binary = "ply\nformat binary_little_endian 1.0\n" + header;
  std::string ascii = "ply\nformat ascii 1.0\n" + header;
  for (const Eigen::Vector3d& p : expected) {
    for (const double value : {p.z(), p.x(), p.y()}) {
      binary.append(reinterpret_cast<const char*>(&value), sizeof value);
      if (value == p.z()) binary += '\xff';
    }
    ascii +=
        format_number(p.z()) + " 255 " + format_number(p.x()) + " " + format_number(p.y()) + "\r\n";
  }
  binary += std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0\0", 14);
  ascii += "3 0 1 2 0\n";
  EXPECT_EQ(read(folder.write("binary.ply", binary)).positions, expected);
  EXPECT_EQ(read(folder.write("ascii.ply", ascii)).positions, expected);
}

TEST(CloudReader, ReadsAsciiWithNanAndFieldsOfManyColumns) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "cloud.pcd",
      "VERSION .7\nFIELDS normal z rgb x y\nSIZE 4 8 4 8 8\nTYPE F F U F F\nCOUNT 3 1 1 1 1\n"
      "WIDTH 2\nHEIGHT 2\nDATA ascii\n"
      "0 0 1 234.5678 4294967295 512345.6789 4123456.7891\n"
      "nan nan nan nan 0 1 2\n"
      "0 0 1 3 0 -inf 2\n"
      "0 0 1 3e0 0 +1.0 2\n");
  const ReadCloud result = read(file);
  EXPECT_EQ(result.summary.not_finite, 2u);
  EXPECT_EQ(result.positions,
            (std::vector<Eigen::Vector3d>{{512345.6789, 4123456.7891, 234.5678}, {1, 2, 3}}));
}

TEST(CloudReader, CountsPointsThatAreNotFinite) {
  const TemporaryFolder folder;
  auto cloud = pcl_cloud<pcl::PointXYZ>(5);
  cloud[1].y = kNan;
  cloud[3].z = std::numeric_limits<float>::infinity();
  for (const bool binary : {true, false}) {
    const auto file = folder.path() / "cloud.pcd";
    pcl::io::savePCDFile(file.string(), cloud, binary);
    const ReadCloud result = read(file);
    EXPECT_EQ(result.summary.points, 3u);
    EXPECT_EQ(result.summary.not_finite, 2u);
    ASSERT_EQ(result.positions.size(), 3u);
    EXPECT_EQ(result.positions[1].x(), cloud[2].x);
  }
}

}  // namespace
}  // namespace plotscan::scan
