// SPDX-License-Identifier: Apache-2.0
// LAS files as other programs write them, byte by byte after the tables of "LAS Specification 1.4 -
// R15" (ASPRS, 2019): what our writer does not write.
#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "temporary_folder.h"
#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "scan/cloud_reader.h"
#include "scan/las_crs.h"

namespace plotscan::scan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

template <class T>
void put(std::string& bytes, std::size_t offset, T value) {
  std::memcpy(&bytes[offset], &value, sizeof value);
}

struct ForeignPoint {
  std::array<std::int32_t, 3> xyz{};
  std::uint8_t classification = 0;
  bool withheld = false;
};

struct ForeignLas {
  int minor = 2;
  int format = 0;
  std::size_t extra_bytes = 0;  // behind each point, that no record describes
  std::array<double, 3> scale_m = {0.001, 0.001, 0.001};
  std::array<double, 3> offset_m = {};
  std::string records = {};  // variable length, in front of the points
  std::uint32_t record_count = 0;
  std::string extended_records = {};  // behind them
  std::uint32_t extended_record_count = 0;
};

// Tables 7 to 17: the sizes of the point formats.
constexpr std::array<std::size_t, 11> kSizes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

std::string bytes_of(const ForeignLas& las, const std::vector<ForeignPoint>& points) {
  const std::size_t header_size = las.minor >= 4 ? 375 : las.minor == 3 ? 235 : 227;
  const std::size_t points_at = header_size + las.records.size();
  const std::size_t format = static_cast<std::size_t>(las.format);
  const std::size_t point_size = kSizes[format] + las.extra_bytes;
  std::string bytes(header_size, '\0');
  std::memcpy(bytes.data(), "LASF", 4);
  put(bytes, 24, std::uint8_t{1});
  put(bytes, 25, static_cast<std::uint8_t>(las.minor));
  put(bytes, 94, static_cast<std::uint16_t>(header_size));
  put(bytes, 96, static_cast<std::uint32_t>(points_at));
  put(bytes, 100, las.record_count);
  put(bytes, 104, static_cast<std::uint8_t>(las.format));
  put(bytes, 105, static_cast<std::uint16_t>(point_size));
  // Formats 6 to 10 leave the old count 0.
  if (las.format < 6) put(bytes, 107, static_cast<std::uint32_t>(points.size()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(bytes, 131 + 8 * axis, las.scale_m[axis]);
    put(bytes, 155 + 8 * axis, las.offset_m[axis]);
  }
  if (las.minor >= 4) {
    put(bytes, 235, static_cast<std::uint64_t>(points_at + points.size() * point_size));
    put(bytes, 243, las.extended_record_count);
    put(bytes, 247, static_cast<std::uint64_t>(points.size()));
  }
  bytes += las.records;
  for (const ForeignPoint& point : points) {
    std::string record(point_size, '\x5a');  // fields that nobody should look at
    for (std::size_t axis = 0; axis < 3; ++axis) put(record, 4 * axis, point.xyz[axis]);
    const bool is_new = las.format >= 6;
    record[15] =
        static_cast<char>(is_new ? (point.withheld ? 0x0f : 0x0b)
                                 : point.classification | 0x60 | (point.withheld ? 0x80 : 0));
    if (is_new) record[16] = static_cast<char>(point.classification);
    bytes += record;
  }
  return bytes + las.extended_records;
}

std::string record(const std::string& user, std::uint16_t id, const std::string& data,
                   bool extended = false) {
  std::string bytes(extended ? 60 : 54, '\0');
  std::memcpy(&bytes[2], user.data(), user.size());
  put(bytes, 18, id);
  if (extended) {
    put(bytes, 20, static_cast<std::uint64_t>(data.size()));
  } else {
    put(bytes, 20, static_cast<std::uint16_t>(data.size()));
  }
  return bytes + data;
}

struct Read {
  CloudSummary summary;
  std::vector<Eigen::Vector3d> positions;
};

class ForeignLasFile : public ::testing::Test {
 protected:
  Read read(const std::string& bytes, bool leave_out_marked = false) const {
    Read result;
    result.summary = read_positions(folder_.write("cloud.las", bytes),
                                    [&](std::span<const Eigen::Vector3d> piece) {
                                      result.positions.insert(result.positions.end(), piece.begin(),
                                                              piece.end());
                                    },
                                    {.leave_out_marked = leave_out_marked});
    return result;
  }
  Read read(const ForeignLas& las, const std::vector<ForeignPoint>& points,
            bool leave_out_marked = false) const {
    return read(bytes_of(las, points), leave_out_marked);
  }

  TemporaryFolder folder_;
};

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

// Fields of these names in other files are labels, and labels are the truth.
TEST_F(ForeignLasFile, MarksAreNotReadFromOtherFormats) {
  const Read result = read(
      "VERSION .7\nFIELDS x y z withheld classification\nSIZE 4 4 4 1 1\nTYPE F F F U U\n"
      "COUNT 1 1 1 1 1\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3 1 7\n",
      true);
  EXPECT_EQ(result.summary.points, 1u);
}

TEST_F(ForeignLasFile, TheCoordinateSystemIsFoundWhereverItStands) {
  const std::string wkt = R"(PROJCS["WGS 84 / UTM zone 17N",GEOGCS["WGS 84"]])";  // as ESRI's
  EXPECT_EQ(read({.minor = 4,
                  .format = 6,
                  .records = record("LASF_Projection", 2112, wkt + '\0'),
                  .record_count = 1},
                 {{}})
                .summary.system.crs,
            wkt);
  EXPECT_EQ(read({.minor = 4,
                  .format = 6,
                  .extended_records = record("LASF_Projection", 2112, wkt, true),
                  .extended_record_count = 1},
                 {{}})
                .summary.system.crs,
            wkt);
  // GeoTIFF keys: a projected system, 32617, of EPSG.
  const auto keys = [](std::uint16_t model, std::uint16_t projected) {
    const std::array<std::uint16_t, 16> numbers = {1,    1, 0, 3,    1024, 0, 1, model,
                                                   2048, 0, 1, 4326, 3072, 0, 1, projected};
    return record("LASF_Projection", 34735,
                  {reinterpret_cast<const char*>(numbers.data()), sizeof numbers});
  };
  const Read utm = read({.records = keys(1, 32617), .record_count = 1}, {{}});
  EXPECT_EQ(utm.summary.system.crs, "EPSG:32617");
  EXPECT_FALSE(utm.summary.system.zone.has_value());
  EXPECT_EQ(read({.records = keys(1, 32767), .record_count = 1}, {{}}).summary.system.crs, "");
  EXPECT_TRUE(
      read({.records = keys(2, 32767), .record_count = 1}, {{}}).summary.system.zone.has_value());
  const std::string degrees = R"(GEOGCS["WGS 84",DATUM["WGS_1984"]])";
  EXPECT_TRUE(read({.records = record("LASF_Projection", 2112, degrees), .record_count = 1}, {{}})
                  .summary.system.zone.has_value());
}

constexpr double kUsFoot = 1200.0 / 3937.0;

std::string wkt_record(const std::string& wkt) { return record("LASF_Projection", 2112, wkt); }

std::string key_record(const std::vector<std::array<std::uint16_t, 2>>& keys) {
  std::vector<std::uint16_t> numbers = {1, 1, 0, static_cast<std::uint16_t>(keys.size())};
  for (const auto& [key, value] : keys) numbers.insert(numbers.end(), {key, 0, 1, value});
  return record("LASF_Projection", 34735,
                {reinterpret_cast<const char*>(numbers.data()), 2 * numbers.size()});
}

// Feet of x and y and of z, wherever they are stated, are metres when they leave the reader.
TEST_F(ForeignLasFile, StatedUnitsBecomeMetres) {
  struct Case {
    std::string records;
    double horizontal_m, vertical_m;
  };
  const std::string us_foot = R"(UNIT["Foot_US",0.3048006096012192])";
  const std::vector<Case> cases = {
      {wkt_record(R"(PROJCS["a",GEOGCS["b",UNIT["Degree",0.0174]],PARAMETER["p",1],)" + us_foot +
                  "]"),
       kUsFoot, kUsFoot},
      {wkt_record(R"(COMPD_CS["c",PROJCS["a",UNIT["foot",0.3048]],)"
                  R"(VERT_CS["v",UNIT["metre",1]]])"),
       0.3048, 1},
      {wkt_record(R"(COMPOUNDCRS["c",PROJCRS["a",BASEGEOGCRS["g"],CONVERSION["u",PARAMETER["e",5,)"
                  R"(LENGTHUNIT["metre",1]]],CS[Cartesian,2],AXIS["e",east,LENGTHUNIT["US survey )"
                  R"(foot",0.304800609601219]],AXIS["n",north]],VERTCRS["v",CS[vertical,1],)"
                  R"(AXIS["h",up],LENGTHUNIT["foot",0.3048]]])"),
       kUsFoot, 0.3048},
      {key_record({{1024, 1}, {3072, 2264}, {3076, 9003}}), kUsFoot, kUsFoot},
      {key_record({{1024, 1}, {3076, 9002}, {4099, 9001}}), 0.3048, 1},
      {key_record({{1024, 1}, {3076, 9001}, {4099, 9003}}), 1, kUsFoot}};
  for (const Case& stated : cases) {
    const ForeignLas las{
        .offset_m = {2e6, 6e5, 1000}, .records = stated.records, .record_count = 1};
    const Read result = read(las, {{{1000, 2000, 3000}}});
    const Eigen::Vector3d expected(2000001 * stated.horizontal_m, 600002 * stated.horizontal_m,
                                   1003 * stated.vertical_m);
    EXPECT_LT((result.positions.at(0) - expected).norm(), 1e-6) << stated.records;
    EXPECT_THAT(result.summary.system.notes, ElementsAre(HasSubstr("are read as metres")));
  }
  const std::string odd = key_record({{1024, 1}, {3076, 9005}});
  const Read unknown = read({.records = odd, .record_count = 1}, {{{1000, 0, 0}}});
  EXPECT_EQ(unknown.positions.at(0).x(), 1);
  EXPECT_THAT(unknown.summary.system.notes, ElementsAre(HasSubstr("code 9005")));
}

TEST_F(ForeignLasFile, GivenUnitsAreBelieved) {
  const auto file = folder_.write(
      "a.las", bytes_of({.records = key_record({{1024, 2}}), .record_count = 1}, {{{1000, 0, 0}}}));
  double x = 0;
  CloudFiles cloud(file);
  cloud.units = {0.3048, 0.3048};
  const CloudSummary summary = read_positions(cloud, [&](auto piece) { x = piece[0].x(); });
  EXPECT_EQ(x, 0.3048);
  EXPECT_FALSE(summary.system.zone);
  EXPECT_THAT(summary.system.notes, ElementsAre(HasSubstr("as --units says")));
}

// A survey of Nebraska in US survey feet, of others: the bounds that its header states.
TEST(RealLas, UsFeetBecomeMetres) {
  const std::filesystem::path file = PLOTSCAN_SHARED_DATA_DIR "/real/nebraska_us_feet.las";
  if (!exists(file)) GTEST_SKIP() << file << " is not at hand";
  Eigen::AlignedBox3d bounds;
  read_positions(file, [&](auto piece) {
    for (const Eigen::Vector3d& position : piece) bounds.extend(position);
  });
  EXPECT_LT((bounds.min() - kUsFoot * Eigen::Vector3d(2445180, 604300, 1352.7)).norm(), 1e-4);
  EXPECT_LT((bounds.max() - kUsFoot * Eigen::Vector3d(2445239.99, 604339.98, 1403.96)).norm(),
            1e-4);
}

TEST(ShortCrs, IsTheCodeOfTheProjectedSystem) {
  EXPECT_EQ(short_crs(utm_crs_wkt(UtmZone{.number = 17, .north = true})), "EPSG:32617");
  EXPECT_EQ(short_crs(utm_crs_wkt(UtmZone{.number = 33, .north = false})), "EPSG:32733");
  EXPECT_EQ(short_crs(R"(PROJCRS["ETRS89 / UTM zone 32N [x]",BASEGEOGCRS["E",ID["EPSG",4258]],)"
                      R"(CONVERSION["U",ID["EPSG",16032]],ID["EPSG",25832]])"),
            "EPSG:25832");
  for (const std::string& none :
       {std::string(), local_crs_wkt(),
        std::string(R"(PROJCS["x",GEOGCS["y",AUTHORITY["EPSG","4326"]]])"),
        std::string(R"(PROJCS["broken)")})
    EXPECT_EQ(short_crs(none), none);
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
