// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include "core/error.h"
#include "scan/cloud_reader.h"
#include "temporary_folder.h"

namespace plotscan::scan {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

std::string file_refusal(const std::filesystem::path& file) {
  return message_of<InputError>(
      [&] { read_positions(file, [](std::span<const Eigen::Vector3d>) {}); });
}

std::string refusal(const std::string& text) {
  const TemporaryFolder folder;
  return file_refusal(folder.write("cloud", text));
}

const std::string kFields = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";

TEST(BrokenCloud, MissingEmptyAndForeignFilesAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THAT(file_refusal(folder.path() / "none.pcd"), HasSubstr("no such file"));
  EXPECT_THAT(file_refusal(folder.path()), HasSubstr("not a regular file"));
  EXPECT_THAT(refusal(std::string()), HasSubstr("is empty"));
  EXPECT_THAT(refusal(std::string("PK\x03\x04 1 2 3\n")),
              HasSubstr("neither a PCD, nor a PLY, nor a LAS"));
  EXPECT_THAT(refusal(std::string("LASF and so on")), HasSubstr("is truncated"));
}

TEST(BrokenCloud, ForeignFilesAreNamed) {
  const auto bytes = [](std::string_view text) { return std::string(text); };
  using namespace std::string_view_literals;
  EXPECT_THAT(refusal("ASTM-E57" + std::string(40, '\1')),
              HasSubstr("but an E57 file: save it as"));
  EXPECT_THAT(refusal("PK\x03\x04 1 2 3\n"), HasSubstr("zip archive: unpack it"));
  EXPECT_THAT(refusal(bytes("\x1f\x8b\x08\0"sv)), HasSubstr("gzip archive"));
  EXPECT_THAT(refusal(bytes("II*\0\x08\0"sv)), HasSubstr("TIFF"));
  EXPECT_THAT(refusal(bytes("\xff\xfe"
                            "1\0 \0"sv)),
              HasSubstr("but UTF-16"));
  EXPECT_THAT(refusal("<!DOCTYPE html>\n"), HasSubstr("web page"));
  EXPECT_THAT(refusal("version https://git-lfs.github.com/spec/v1\n"), HasSubstr("git lfs pull"));
  EXPECT_THAT(refusal("ncols 2\nnrows 1\n1 2\n"), HasSubstr("raster of Esri"));
  EXPECT_THAT(refusal("# made by hand\no field\nv 1 2 3\n"), HasSubstr("OBJ mesh"));
  for (const char* start : {"OFF\n", "OFF\r\n", "COFF\n"})
    EXPECT_THAT(refusal(std::string(start) + "1 0 0\n1 2 3\n"), HasSubstr("but an OFF mesh"));
  EXPECT_THAT(refusal("# vtk DataFile Version 3.0\nx\nASCII\nPOINTS 1 float\n1 2 3\n"),
              HasSubstr("but a VTK file: save its points as PLY or text"));
  EXPECT_THAT(refusal("2\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n"), HasSubstr("but PTX"));
}

TEST(BrokenCloud, HeadersThatCannotBeAreRefused) {
  EXPECT_THAT(refusal(kFields + "WIDTH 1\n"), HasSubstr("ends inside its header"));
  EXPECT_THAT(refusal("FIELDS x y\nSIZE 4 4\nTYPE F F\nPOINTS 1\nDATA ascii\n1 2\n"),
              HasSubstr("no field \"z\""));
  EXPECT_THAT(refusal("FIELDS x y z\nSIZE 4 4\n"), HasSubstr(":2: SIZE has 2 values"));
  EXPECT_THAT(refusal("FIELDS x y z\nSIZE 4 4 3\n"), HasSubstr("SIZE must be"));
  EXPECT_THAT(refusal("FIELDS x y z\nTYPE F F Q\n"), HasSubstr("TYPE must be"));
  EXPECT_THAT(refusal("FIELDS x y z\nSIZE 4 4 4\nTYPE F F I\nPOINTS 1\nDATA binary\n"),
              HasSubstr("\"z\" must be one float"));
  EXPECT_THAT(refusal("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nDATA ascii\n"),
              HasSubstr("neither POINTS nor WIDTH"));
  EXPECT_THAT(refusal(kFields + "WIDTH -3\n"), HasSubstr("\"-3\" must be a whole number"));
  EXPECT_THAT(refusal(kFields + "POINTS 1\nDATA gzip\n"), HasSubstr("\"gzip\" must be"));
  EXPECT_THAT(refusal(kFields + "POINTS 0\nDATA ascii\n"), HasSubstr("0 points"));
  EXPECT_THAT(refusal(kFields + "COLOUR 3\n"), HasSubstr(":6: unknown PCD header entry"));
  EXPECT_THAT(refusal("# " + std::string(100000, 'x')), HasSubstr("too long"));
}

TEST(BrokenCloud, BrokenPlyHeadersAreRefused) {
  const std::string start = "ply\nformat ascii 1.0\n";
  EXPECT_THAT(refusal("ply\nformat text 1.0\n"), HasSubstr("format \"text\""));
  EXPECT_THAT(refusal(start + "element vertex 1\nproperty float x\nend_header\n1\n"),
              HasSubstr("no field \"y\""));
  EXPECT_THAT(refusal(start + "element face 1\n"), HasSubstr("vertex must come first"));
  EXPECT_THAT(refusal(start + "element vertex 1\nproperty list uchar int x\n"),
              HasSubstr("list property"));
  EXPECT_THAT(
      refusal(start + "element vertex 1\nproperty int x\nproperty float y\nproperty float z\n"
                      "end_header\n1 2 3\n"),
      HasSubstr("must be one float"));
  EXPECT_THAT(refusal(start + "element vertex 1\nproperty half x\n"), HasSubstr("\"half\""));
}

// Absurd promises are refused before any memory is asked for.
TEST(BrokenCloud, AbsurdCountsAreRefused) {
  EXPECT_THAT(refusal(kFields + "POINTS 1000000000000\nDATA binary\n0123456789ab"),
              HasSubstr("promises 1000000000000 points of 12 bytes, the file holds 12 bytes"));
  EXPECT_THAT(refusal(kFields + "POINTS 18446744073709551615\nDATA binary\n"),
              HasSubstr("must be a whole number in"));
  EXPECT_THAT(refusal(kFields + "WIDTH 1000000000000\nHEIGHT 1000000000000\nDATA binary\n"),
              HasSubstr("WIDTH x HEIGHT"));
  EXPECT_THAT(refusal("FIELDS x y z f\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 65000\n"
                      "POINTS 1\nDATA binary\n"),
              HasSubstr("more than 65536 bytes"));
  EXPECT_THAT(refusal("ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
                      "property float x\nproperty float y\nproperty float z\nend_header\nabc"),
              HasSubstr("is truncated"));
  const std::uint32_t sizes[2] = {4, 1200000000};
  EXPECT_THAT(refusal(kFields + "POINTS 100000000\nDATA binary_compressed\n" +
                      std::string(reinterpret_cast<const char*>(sizes), 8) + "abcd"),
              HasSubstr("does not fit the header"));
}

TEST(BrokenCloud, BrokenAsciiLinesAreNamed) {
  const std::string header = kFields + "POINTS 2\nDATA ascii\n";
  EXPECT_THAT(refusal(header + "1 2 3\n"), HasSubstr("promises 2 points, the file holds 1"));
  EXPECT_THAT(refusal(header + "1 2 3\n1 2\n"), HasSubstr("cloud:9: has 2 values"));
  EXPECT_THAT(refusal(header + "1 2 3\n1 2 tree\n"), HasSubstr("cloud:9: \"tree\" is not"));
  EXPECT_THAT(refusal(header + "nan 2 3\n1 nan 3\n"), HasSubstr("no point of the cloud"));
}

// Every prefix of a compressed and of a binary cloud is refused, never read past its end.
TEST(BrokenCloud, TruncatedFilesAreRefused) {
  const TemporaryFolder folder;
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (int i = 0; i < 50; ++i) cloud.push_back(pcl::PointXYZI(1.0f, 2.0f, 3.0f, 4.0f));
  const auto file = folder.path() / "cloud.pcd";
  for (const bool compressed : {false, true}) {
    if (compressed) {
      pcl::io::savePCDFileBinaryCompressed(file.string(), cloud);
    } else {
      pcl::io::savePCDFileBinary(file.string(), cloud);
    }
    for (auto size = std::filesystem::file_size(file); size-- > 0;) {
      std::filesystem::resize_file(file, size);
      EXPECT_NE(file_refusal(file), "");
    }
  }
}

TEST(BrokenCloud, BrokenCompressionIsRefused) {
  const TemporaryFolder folder;
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (int i = 0; i < 50; ++i) cloud.push_back(pcl::PointXYZ(1.0f, 2.0f, 3.0f));
  const auto file = folder.path() / "cloud.pcd";
  pcl::io::savePCDFileBinaryCompressed(file.string(), cloud);
  std::string text = read_text(file);
  const std::size_t body = text.find("binary_compressed\n") + 18 + 8;
  text[body] = '\xff';  // a back reference before anything was written
  EXPECT_THAT(file_refusal(folder.write("broken.pcd", text)),
              HasSubstr("compressed body is broken"));
}

}  // namespace
}  // namespace plotscan::scan
