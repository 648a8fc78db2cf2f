// SPDX-License-Identifier: Apache-2.0
// The coordinate systems and units that LAS files of other programs state.
#include <array>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "foreign_las.h"
#include "scan/cloud_system.h"
#include "scan/las_crs.h"
#include "scan/point_reader.h"

namespace plotscan::scan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

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

// "Réseau" in Latin-1, as older programs write it; estimates and reports are UTF-8.
TEST_F(ForeignLasFile, TextInLatin1BecomesUtf8) {
  const auto crs_of = [&](const std::string& wkt) {
    return read({.records = record("LASF_Projection", 2112, wkt), .record_count = 1}, {{}})
        .summary.system.crs;
  };
  EXPECT_EQ(crs_of("PROJCS[\"R\xe9seau\",GEOGCS[\"b\"]]"), "PROJCS[\"Réseau\",GEOGCS[\"b\"]]");
  EXPECT_EQ(crs_of("PROJCS[\"Réseau\",GEOGCS[\"b\"]]"), "PROJCS[\"Réseau\",GEOGCS[\"b\"]]");
}

// Keys of a geographic system beside well-known text of a projected one, in either order.
TEST_F(ForeignLasFile, WellKnownTextTakesPrecedenceOverKeys) {
  const std::array<std::uint16_t, 8> numbers = {1, 1, 0, 1, 1024, 0, 1, 2};
  const std::string keys = record("LASF_Projection", 34735,
                                  {reinterpret_cast<const char*>(numbers.data()), sizeof numbers});
  const std::string text =
      record("LASF_Projection", 2112,
             R"(PROJCS["WGS 84 / UTM zone 32N",GEOGCS["WGS 84"],AUTHORITY["EPSG","32632"]])");
  for (const std::string& records : {text + keys, keys + text}) {
    const Read utm = read({.records = records, .record_count = 2}, {{}});
    EXPECT_EQ(utm.summary.system.crs, "EPSG:32632");
    EXPECT_FALSE(utm.summary.system.zone.has_value());
  }
}

// New York Long Island in US survey feet (EPSG:2263): the file need not say so.
TEST_F(ForeignLasFile, ASystemOfUnknownUnitIsNoted) {
  const auto notes_of = [&](std::uint16_t code) {
    const std::array<std::uint16_t, 8> numbers = {1, 1, 0, 1, 3072, 0, 1, code};
    return read({.records = record("LASF_Projection", 34735,
                                   {reinterpret_cast<const char*>(numbers.data()), sizeof numbers}),
                 .record_count = 1},
                {{}})
        .summary.system.notes;
  };
  EXPECT_THAT(notes_of(2263), ElementsAre(HasSubstr("EPSG:2263, is not known here")));
  EXPECT_TRUE(notes_of(32617).empty());
  EXPECT_TRUE(notes_of(26917).empty());
  const auto notes_of_text = [&](const std::string& wkt) {
    return read({.records = record("LASF_Projection", 2112, wkt), .record_count = 1}, {{}})
        .summary.system.notes;
  };
  EXPECT_THAT(notes_of_text(R"(PROJCS["NAD83 / New York Long Island",GEOGCS["NAD83"]])"),
              ElementsAre(HasSubstr("NAD83 / New York Long Island, is not known here")));
  EXPECT_THAT(notes_of_text(R"(PROJCS["a",GEOGCS["b"],AUTHORITY["EPSG","2263"]])"),
              ElementsAre(HasSubstr("EPSG:2263, is not known here")));
  EXPECT_TRUE(notes_of_text(R"(PROJCS["a",GEOGCS["b"],AUTHORITY["EPSG","32617"]])").empty());
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
      {key_record({{1024, 1}, {3076, 9001}, {4099, 9003}}), 1, kUsFoot},
      // NAVD88 in US survey feet, feet and metres, NGVD29 in US survey feet (EPSG).
      {key_record({{1024, 1}, {3072, 32617}, {4096, 6360}}), 1, kUsFoot},
      {key_record({{1024, 1}, {3072, 32617}, {4096, 8228}}), 1, 0.3048},
      {key_record({{1024, 1}, {3076, 9003}, {4096, 5703}}), kUsFoot, 1},
      {key_record({{1024, 1}, {3072, 32617}, {4096, 5702}}), 1, kUsFoot},
      {key_record({{1024, 1}, {3072, 32617}, {4096, 6360}, {4099, 9002}}), 1, 0.3048}};
  for (const Case& stated : cases) {
    const ForeignLas las{
        .offset_m = {2e6, 6e5, 1000}, .records = stated.records, .record_count = 1};
    const Read result = read(las, {{{1000, 2000, 3000}}});
    const Eigen::Vector3d expected(2000001 * stated.horizontal_m, 600002 * stated.horizontal_m,
                                   1003 * stated.vertical_m);
    EXPECT_LT((result.positions.at(0) - expected).norm(), 1e-6) << stated.records;
    EXPECT_THAT(result.summary.system.notes, ElementsAre(HasSubstr("are converted to metres")));
  }
  const std::string odd = key_record({{1024, 1}, {3076, 9005}});
  const Read unknown = read({.records = odd, .record_count = 1}, {{{1000, 0, 0}}});
  EXPECT_EQ(unknown.positions.at(0).x(), 1);
  EXPECT_THAT(unknown.summary.system.notes, ElementsAre(HasSubstr("code 9005")));
}

// At latitude 60 degrees 1/cos(latitude) is 2; its northing in EPSG:3857 is R ln(tan 75 degrees).
TEST_F(ForeignLasFile, WebMercatorIsNoted) {
  const auto notes_of = [&](std::uint16_t code, double northing_m) {
    return read({.offset_m = {0, northing_m, 0},
                 .records = key_record({{1024, 1}, {3072, code}, {3076, 9001}}),
                 .record_count = 1},
                {{}})
        .summary.system.notes;
  };
  EXPECT_THAT(notes_of(3857, 8399737.89), ElementsAre(HasSubstr("x and y, here 2.00 times")));
  EXPECT_THAT(notes_of(3857, -8399737.89), ElementsAre(HasSubstr("x and y, here 2.00 times")));
  EXPECT_TRUE(notes_of(32617, 8399737.89).empty());
}

// PDAL's lone-star.copc.laz states such a system, and metres.
TEST_F(ForeignLasFile, GeocentricCoordinatesAreNoted) {
  for (const std::string& records :
       {wkt_record(R"(GEOCCS["unnamed",DATUM["WGS_1984"],PRIMEM["Greenwich",0],UNIT["metre",1],)"
                   R"(AXIS["Geocentric X",OTHER]])"),
        key_record({{1024, 3}, {2048, 4978}})}) {
    EXPECT_THAT(read({.records = records, .record_count = 1}, {{}}).summary.system.notes,
                ElementsAre(HasSubstr("it states geocentric coordinates")));
  }
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

// What GeoTIFF keys say goes on as well-known text, which alone LAS 1.4 writes.
TEST_F(ForeignLasFile, KeysBecomeText) {
  const auto info_of = [&](const std::vector<std::array<std::uint16_t, 2>>& keys) {
    return read_cloud_info(folder_.write(
        "a.las", bytes_of({.records = key_record(keys), .record_count = 1}, {{{1000, 0, 0}}})));
  };
  const std::string utm = info_of({{1024, 1}, {3072, 32617}, {3076, 9001}}).crs_wkt;
  EXPECT_EQ(short_crs(utm), "EPSG:32617");
  EXPECT_EQ(units_of_wkt(utm).horizontal_m, 1);
  const std::string us_feet = info_of({{1024, 1}, {3072, 2264}, {3076, 9003}}).crs_wkt;
  EXPECT_EQ(crs_name(us_feet), "EPSG:2264");
  EXPECT_EQ(units_of_wkt(us_feet).horizontal_m, kUsFoot);
  const std::string mixed = info_of({{1024, 1}, {3072, 32617}, {4099, 9002}}).crs_wkt;
  EXPECT_EQ(short_crs(mixed), "EPSG:32617");
  EXPECT_EQ(units_of_wkt(mixed).vertical_m, 0.3048);
  EXPECT_EQ(units_of_wkt(info_of({{1024, 1}, {3076, 9002}}).crs_wkt).horizontal_m, 0.3048);
  EXPECT_EQ(info_of({{1024, 1}, {3076, 9001}}).crs_wkt, "");
}

// Floats about whole kilometres would round them to a metre.
TEST_F(ForeignLasFile, DegreesAreNoPoints) {
  const auto file = folder_.write(
      "a.las", bytes_of({.records = key_record({{1024, 2}}), .record_count = 1}, {{{1000, 0, 0}}}));
  EXPECT_THAT(testing::message_of<InputError>([&] { read_cloud_info(file); }),
              HasSubstr("a.las: has longitudes and latitudes"));
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

}  // namespace
}  // namespace plotscan::scan
