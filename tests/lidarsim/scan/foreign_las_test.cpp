// SPDX-License-Identifier: Apache-2.0
// LAS files of other programs: what our writer does not write.
#include "foreign_las.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace plotscan::scan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;

// With extra bytes that nothing describes and a record of a user we do not know; the waveform
// formats, 4, 5, 9 and 10, too.
TEST_F(ForeignLasFile, EveryVersionAndPointFormatIsRead) {
  for (const int minor : {0, 1, 2, 3, 4}) {
    for (int format = 0; format <= (minor >= 4 ? 10 : minor == 3 ? 5 : 3); ++format) {
      for (const std::size_t extra_bytes : {0u, 7u}) {
        const ForeignLas las{.minor = minor,
                             .format = format,
                             .extra_bytes = extra_bytes,
                             .offset_m = {10, 20, 30},
                             .records = record("someone", 7, "what nobody knows") + "\xdd\xcc",
                             .record_count = 1};
        const Read result = read(las, {{{1000, -2000, 3000}}, {{4, 5, 6}}});
        ASSERT_EQ(result.positions.size(), 2u) << minor << " " << format;
        EXPECT_EQ(result.positions[0], Eigen::Vector3d(11, 18, 33));
        EXPECT_LT((result.positions[1] - Eigen::Vector3d(10.004, 20.005, 30.006)).norm(), 1e-12);
        EXPECT_EQ(result.summary.system.crs, "");
      }
    }
  }
}

TEST_F(ForeignLasFile, CoordinatesOfUtmKeepATenthOfAMillimetre) {
  const ForeignLas las{
      .minor = 4, .format = 6, .scale_m = {1e-4, 1e-4, 1e-4}, .offset_m = {500000, 4100000, 200}};
  const Read result = read(las, {{{123456789, -98765432, 12345}}, {{123456790, -98765431, 12346}}});
  EXPECT_NEAR(result.positions[0].x(), 512345.6789, 1e-8);
  EXPECT_NEAR(result.positions[0].y(), 4090123.4568, 1e-8);
  EXPECT_NEAR(result.positions[0].z(), 201.2345, 1e-8);
  EXPECT_NEAR((result.positions[1] - result.positions[0]).cwiseAbs().minCoeff(), 1e-4, 1e-8);
}

TEST_F(ForeignLasFile, WithheldAndNoiseAreLeftOutOnRequest) {
  for (const int format : {1, 3, 6, 7}) {
    const std::vector<ForeignPoint> points = {{.xyz = {1, 0, 0}, .classification = 2},
                                              {.xyz = {2, 0, 0}, .classification = 7},
                                              {.xyz = {3, 0, 0}, .classification = 18},
                                              {.xyz = {4, 0, 0}, .withheld = true},
                                              {.xyz = {5, 0, 0}, .classification = 5}};
    const ForeignLas las{.minor = 4, .format = format, .scale_m = {1, 1, 1}};
    const Read all = read(las, points);
    EXPECT_EQ(all.summary.points, 5u);
    EXPECT_EQ(all.summary.marked, 0u);
    const Read some = read(las, points, true);
    EXPECT_EQ(some.summary.marked, 3u) << format;
    ASSERT_EQ(some.positions.size(), 2u);
    EXPECT_EQ(some.positions[0].x(), 1);
    EXPECT_EQ(some.positions[1].x(), 5);
  }
  EXPECT_THAT(message_of<InputError>([&] { read({}, {{.withheld = true}}, true); }),
              HasSubstr("all points of the cloud are marked"));
}

TEST_F(ForeignLasFile, ClassesAreLeftOutOnRequest) {
  const auto file =
      folder_.write("classes.las", bytes_of({.minor = 4, .format = 6, .scale_m = {1, 1, 1}},
                                            {{.xyz = {1, 0, 0}, .classification = 2},
                                             {.xyz = {2, 0, 0}, .classification = 5},
                                             {.xyz = {3, 0, 0}, .classification = 7},
                                             {.xyz = {4, 0, 0}, .classification = 200}}));
  CloudFiles cloud(file);
  cloud.leave_out_classes = {5, 200};
  std::vector<double> x;
  const auto collect = [&](std::span<const Eigen::Vector3d> piece) {
    for (const Eigen::Vector3d& position : piece) x.push_back(position.x());
  };
  const CloudSummary summary = read_positions(cloud, collect, {.leave_out_marked = true});
  EXPECT_THAT(x, ElementsAre(1));
  EXPECT_EQ(summary.left_out, 2u);
  EXPECT_EQ(summary.marked, 1u);
  x.clear();
  EXPECT_EQ(read_positions(cloud, collect).left_out, 2u);
  EXPECT_THAT(x, ElementsAre(1, 3));
  cloud.files = {folder_.write("bare.xyz", "1 2 3\n")};
  EXPECT_THAT(message_of<InputError>([&] { read_positions(cloud, collect); }),
              HasSubstr("has no field \"classification\""));
}

// Tiles of a survey, of different formats, are one cloud; of different systems they are not.
TEST_F(ForeignLasFile, SeveralFilesAreOneCloud) {
  const auto las = folder_.write("a.las", bytes_of({.scale_m = {1, 1, 1}}, {{{1, 2, 3}}}));
  const auto text = folder_.write("b.xyz", "4 5 6\n7 8 9\n");
  std::vector<Eigen::Vector3d> positions;
  const CloudSummary summary =
      read_positions(CloudFiles({las, text}), [&](std::span<const Eigen::Vector3d> piece) {
        positions.insert(positions.end(), piece.begin(), piece.end());
      });
  EXPECT_EQ(summary.points, 3u);
  EXPECT_EQ(positions, (std::vector<Eigen::Vector3d>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
  const std::string wkt = R"(PROJCS["x",UNIT["foot",0.3048],AUTHORITY["EPSG","2264"]])";
  const auto feet = folder_.write(
      "c.las", bytes_of({.records = record("LASF_Projection", 2112, wkt), .record_count = 1},
                        {{{1, 2, 3}}}));
  EXPECT_THAT(message_of<InputError>([&] {
                read_positions(CloudFiles({las, feet}), [](auto) {});
              }),
              HasSubstr("c.las: states another coordinate system or other units than"));
}

// Degrees are projected to the system that the other file states, but its numbers are no degrees.
TEST_F(ForeignLasFile, DegreesBesideMetresAreRefused) {
  const std::string wkt = R"(PROJCS["x",AUTHORITY["EPSG","32632"]])";
  const auto metres = folder_.write(
      "metres.las", bytes_of({.records = record("LASF_Projection", 2112, wkt), .record_count = 1},
                             {{{500000, 4982950, 70}}}));
  const auto degrees = folder_.write("degrees.csv", "lon,lat,z\n9,45,70\n");
  for (const CloudFiles& cloud : {CloudFiles({metres, degrees}), CloudFiles({degrees, metres})}) {
    EXPECT_THAT(message_of<InputError>([&] { read_positions(cloud, [](auto) {}); }),
                HasSubstr("states another coordinate system"))
        << cloud.files.front();
  }
}

// Fields of these names in other files are labels, and labels are the truth.
TEST_F(ForeignLasFile, MarksAreNotReadFromOtherFormats) {
  const Read result = read(
      "VERSION .7\nFIELDS x y z withheld classification\nSIZE 4 4 4 1 1\nTYPE F F F U U\n"
      "COUNT 1 1 1 1 1\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3 1 7\n",
      true);
  EXPECT_EQ(result.summary.points, 1u);
}

// What matters is where the points begin.
TEST_F(ForeignLasFile, AWrongCountOfRecordsIsNoted) {
  const std::string wkt = R"(PROJCS["x",AUTHORITY["EPSG","32617"]])";
  const std::string records = record("LASF_Projection", 2112, wkt);
  const std::string beyond = record("someone", 1, "12") + std::string(60, '\xff');
  const std::vector<ForeignLas> files = {
      {.records = records, .record_count = 3},
      {.records = records + "padding", .record_count = 4000000000},
      {.records = records + beyond, .record_count = 3},
      {.minor = 4, .records = records, .record_count = 1, .extended_record_count = 7}};
  const std::vector<std::string> notes = {"promises 3 variable length records, 1 are whole",
                                          "promises 4000000000 variable length records, 1 are",
                                          "promises 3 variable length records, 2 are whole",
                                          "promises 7 variable length records, 0 are whole"};
  for (std::size_t i = 0; i < files.size(); ++i) {
    const Read result = read(files[i], {{{1000, -2000, 3000}}});
    ASSERT_EQ(result.positions.size(), 1u);
    EXPECT_EQ(result.positions[0], Eigen::Vector3d(1, -2, 3));
    EXPECT_EQ(result.summary.system.crs, "EPSG:32617");
    EXPECT_THAT(result.summary.system.notes, ElementsAre(HasSubstr(notes[i])));
  }
  EXPECT_TRUE(read({.records = records, .record_count = 1}, {{}}).summary.system.notes.empty());
}

TEST_F(ForeignLasFile, BrokenOnesAreRefused) {
  const auto refusal = [&](const std::string& bytes) {
    return message_of<InputError>([&] { read(bytes); });
  };
  const std::vector<ForeignPoint> points(3);
  const std::string whole = bytes_of({.minor = 2, .format = 1}, points);
  EXPECT_EQ(read(whole).positions.size(), 3u);
  std::string broken = whole;
  put(broken, 104, static_cast<std::uint8_t>(1 | 0x80));
  EXPECT_THAT(refusal(broken), HasSubstr("LAZ"));
  broken = whole;
  put(broken, 105, std::uint16_t{27});
  EXPECT_THAT(refusal(broken), HasSubstr("points of format 1 have at least 28 bytes"));
  broken = whole;
  put(broken, 105, std::uint16_t{29});  // one too long for the file
  EXPECT_THAT(refusal(broken), HasSubstr("promises 3 points of 29 bytes, the file holds 84"));
  EXPECT_THAT(refusal(whole.substr(0, whole.size() - 1)), HasSubstr("is truncated"));
  EXPECT_THAT(refusal(whole.substr(0, 227)), HasSubstr("promises 3 points"));
  EXPECT_THAT(refusal(whole.substr(0, 200)), HasSubstr("its points begin at byte 227"));
  EXPECT_THAT(refusal(whole.substr(0, 90)), HasSubstr("is truncated"));
  broken = whole;
  put(broken, 94, std::uint16_t{226});
  EXPECT_THAT(refusal(broken), HasSubstr("226 bytes: too few"));
}

}  // namespace
}  // namespace plotscan::scan
