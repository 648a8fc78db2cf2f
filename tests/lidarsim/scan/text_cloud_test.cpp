// SPDX-License-Identifier: Apache-2.0
// Clouds as lines of text, as programs and people write them.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "scan/cloud_reader.h"
#include "scan/point_reader.h"
#include "temporary_folder.h"

namespace plotscan::scan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

using Positions = std::vector<Eigen::Vector3d>;

class TextCloud : public ::testing::Test {
 protected:
  Positions read(const std::string& text, const std::string& name = "cloud.txt") {
    Positions positions;
    summary_ = read_positions(folder_.write(name, text), [&](auto piece) {
      positions.insert(positions.end(), piece.begin(), piece.end());
    });
    return positions;
  }
  std::string refusal(const std::string& text) {
    return message_of<InputError>([&] { read(text); });
  }

  TemporaryFolder folder_;
  CloudSummary summary_;
};

const Positions kPoints = {{512345.6789, 4123456.7891, -1.5}, {1e-3, 20, 3}};

TEST_F(TextCloud, EverySeparatorIsRead) {
  EXPECT_EQ(read("512345.6789 4123456.7891 -1.5\n0.001 20 3\n"), kPoints);
  EXPECT_EQ(read("512345.6789|4123456.7891|-1.5\n0.001|20|3\n"), kPoints);  // GRASS
  EXPECT_EQ(read("  512345.6789\t4123456.7891  -1.5\r\n\r\n1e-3 +20 3"), kPoints);
  EXPECT_EQ(read("512345.6789,4123456.7891,-1.5\n0.001,20,3\n"), kPoints);
  EXPECT_EQ(read("512345.6789, 4123456.7891 , -1.5,\n0.001,20,3,\n"), kPoints);
  EXPECT_EQ(read("512345.6789;4123456.7891;-1.5;tree\n0.001;20;3;wheat, ripe\n"), kPoints);
  EXPECT_FALSE(summary_.system.zone);
}

TEST_F(TextCloud, DecimalCommasAreNamed) {
  for (const char* text : {"x;y;z\n512345,6789;4123456,7891;-1,5\n", "1,5 2,5 3\n1,5 2,5 3,25\n",
                           "1,5|2,5|3\n", "# a b c\n0,5\t2\t3\n"}) {
    EXPECT_THAT(refusal(text), HasSubstr("decimal commas")) << text;
  }
  EXPECT_THAT(refusal("x;y;z\n1,5;2,5;3\n"), HasSubstr("cloud.txt:2: "));
}

TEST_F(TextCloud, ThousandsThatAreSetOffAreNamed) {
  for (const char* text :
       {"1,234.5 2,345.6 12.5\n", "x;y;z\n1.234,5;2.345,6;12.5\n", "512.345,67 4.123.456,78 1,5\n",
        "512'345.6 4'123'456.7 -1.5\n", "x,y,z\n\"512,345.6\",\"4,123,456.7\",1.5\n"}) {
    EXPECT_THAT(refusal(text), HasSubstr("thousands are set off")) << text;
  }
  EXPECT_THAT(refusal("area 1,234 5,678\nno point\n"), HasSubstr("is neither a PCD"));
}

TEST_F(TextCloud, NumbersInQuotesAreNamed) {
  for (const char* text : {"\"x\",\"y\",\"z\"\n\"512345.678\",\"4123456.789\",\"99.746\"\n",
                           "\"1\" \"2\" \"3.5\"\n", "a,b\n\"1.5\",2,3\n"}) {
    EXPECT_THAT(refusal(text), HasSubstr("has numbers in quotes")) << text;
  }
}

TEST_F(TextCloud, HeadersNameTheColumns) {
  EXPECT_EQ(read("//X Y Z R G B\n512345.6789 4123456.7891 -1.5 1 2 3\n0.001 20 3 4 5 6\n"),
            kPoints);
  EXPECT_EQ(read("\xef\xbb\xbf\"id\",\"Z [m]\",\"Northing\",\"Easting\"\r\n"
                 "a,-1.5,4123456.7891,512345.6789\r\nb,3,20,0.001\r\n"),
            kPoints);
  EXPECT_EQ(read("time y height x\n0 4123456.7891 -1.5 512345.6789\n1 20 3 0.001\n"), kPoints);
  EXPECT_EQ(read("PointID,E,N,H\n1,512345.6789,4123456.7891,-1.5\n2,0.001,20,3\n"), kPoints);
  EXPECT_EQ(read("intensity,Points_m_XYZ:0,Points_m_XYZ:1,Points_m_XYZ:2\n"
                 "9,512345.6789,4123456.7891,-1.5\n9,0.001,20,3\n"),
            kPoints);
  EXPECT_EQ(read("# made by hand\n# in UTM 17\n512345.6789 4123456.7891 -1.5\n0.001 20 3\n"),
            kPoints);
  EXPECT_EQ(read("//X Y Z Original cloud index\n512345.6789 4123456.7891 -1.5 7\n0.001 20 3 7\n"),
            kPoints);
}

// Foot and US survey foot as NIST defines them.
TEST_F(TextCloud, UnitsInBracketsAreConverted) {
  EXPECT_EQ(read("X [ft],Y [ft],Z [ft]\n10,20,5\n"), (Positions{{3.048, 6.096, 1.524}}));
  EXPECT_THAT(summary_.system.notes, ElementsAre(HasSubstr("feet are converted to metres")));
  for (const char* unit : {"(US ft)", "[ftUS]", "(US survey feet, NAD83)"}) {
    const std::string names = std::string("easting ") + unit + ";northing;height\n";
    EXPECT_LT((read(names + "3937;3937;39.37\n").at(0) - Eigen::Vector3d(1200, 1200, 12)).norm(),
              1e-9)
        << unit;
  }
  EXPECT_EQ(read("x[cm] y[cm] z[mm]\n100 200 500\n"), (Positions{{1, 2, 0.5}}));
  EXPECT_EQ(read("X [ft] Y [ft] Z [ft]\n10 20 5\n"), (Positions{{3.048, 6.096, 1.524}}));
  EXPECT_EQ(read("# \"Z\" \"X [ft]\" \"Y [ft]\"\n5 10 20\n"), (Positions{{3.048, 6.096, 1.524}}));
  EXPECT_EQ(read("Z (m)\tX [US ft]\tY [US ft]\tnote\n5\t3937\t0\t1\n").at(0).z(), 5);
  EXPECT_NEAR(read("Z (m) X [US ft] Y [US ft]\n5 3937 0\n").at(0).x(), 1200, 1e-9);
  EXPECT_EQ(read("X (m),Y (m),Z (feet)\n1,2,10\n"), (Positions{{1, 2, 3.048}}));
  EXPECT_EQ(read("X (metres),Y,Z\n1,2,10\n"), (Positions{{1, 2, 10}}));
  EXPECT_EQ(read("X (UTM 15N),Y (UTM 15N),Z (NAVD88)\n1,2,10\n"), (Positions{{1, 2, 10}}));
  EXPECT_TRUE(summary_.system.notes.empty());
  EXPECT_THAT(refusal("x [m],y [ft],z\n1,2,3\n"),
              HasSubstr("cloud.txt:1: has x in metres and y in feet; both must be in one unit"));
}

TEST_F(TextCloud, DegreesAreKnownByTheirNames) {
  // The meridian of zone 32, where UTM's easting is 500 km and its northing the scaled arc.
  const Positions positions = read("lat,lon,alt\n45,9,70\n45,69,70\n");
  ASSERT_EQ(positions.size(), 1u);
  EXPECT_LT((positions[0] - Eigen::Vector3d(500000, 4982950.400, 70)).norm(), 1e-3);
  EXPECT_EQ(summary_.not_finite, 1u);  // a place far from the first
  EXPECT_LT(
      (read("x (deg),y (deg),z (ft)\n9,45,10\n")[0] - Eigen::Vector3d(500000, 4982950.400, 3.048))
          .norm(),
      1e-3);
  EXPECT_EQ(summary_.system.crs, "EPSG:32632");
  EXPECT_THAT(summary_.system.notes, ElementsAre(HasSubstr("UTM zone 32N")));
  EXPECT_THAT(refusal("lon lat z\n226 100 1\n"), HasSubstr("longitude 226, latitude 100"));
}

// .pts: each scan's count of points in front of it; CloudCompare's count behind its header.
TEST_F(TextCloud, CountsArePromises) {
  EXPECT_EQ(read("2\n512345.6789 4123456.7891 -1.5 -1200\n0.001 20 3 40\n", "a.pts"), kPoints);
  EXPECT_EQ(read("1\n512345.6789 4123456.7891 -1.5\n1\n0.001 20 3\n", "b.pts"), kPoints);
  EXPECT_EQ(read("//X Y Z\n2\n512345.6789 4123456.7891 -1.5\n0.001 20 3\n"), kPoints);
  EXPECT_EQ(read("\xef\xbb\xbf"
                 "2\n512345.6789 4123456.7891 -1.5\n0.001 20 3\n"),
            kPoints);
  EXPECT_EQ(read("2\nx y z\n512345.6789 4123456.7891 -1.5\n0.001 20 3\n"), kPoints);
  EXPECT_THAT(refusal("3\n1 2 3\n4 5 6\n"), HasSubstr("promises 3 points, the file holds 2"));
  EXPECT_THAT(refusal("3\n1 2 3\n2\n4 5 6\n7 8 9\n"),
              HasSubstr("cloud.txt:3: 3 points are promised before this line, 1 are there"));
}

TEST_F(TextCloud, WhatIsNotFiniteIsCounted) {
  EXPECT_EQ(read("nan nan nan 0\n0 1 2 5\n"), (Positions{{0, 1, 2}}));
  EXPECT_EQ(summary_.not_finite, 1u);
}

// R writes NA for what was not measured, pandas nothing.
TEST_F(TextCloud, MissingValuesAreCounted) {
  EXPECT_EQ(read("x,y,z\nNA,NA,NA\n0,1,2\n3,4,NA\n"), (Positions{{0, 1, 2}}));
  EXPECT_EQ(summary_.not_finite, 2u);
  EXPECT_EQ(read("x;y;z;plot\n0;1;;a\n0;1;2;b\n;;;\n"), (Positions{{0, 1, 2}}));
  EXPECT_EQ(summary_.not_finite, 2u);
}

TEST_F(TextCloud, BrokenLinesAreNamed) {
  EXPECT_THAT(refusal("x y z\n1 2 3\n4 5\n"),
              HasSubstr("cloud.txt:3: has 2 values; the first point has 3"));
  EXPECT_THAT(refusal("1 2 3\n\n# remark\n4 five 6\n"),
              HasSubstr("cloud.txt:4: \"five\" is not a number"));
  EXPECT_THAT(refusal("1 2 3\n4 5,5 6\n"), HasSubstr("decimals take a point"));
  EXPECT_THAT(refusal("1,2,3\n4,,6\n"), HasSubstr("cloud.txt:2: \"\" is not a number"));
  EXPECT_THAT(refusal("row,col,yield\n1,2,3\n"),
              HasSubstr("cloud.txt:1: names the columns row, col, yield; x, y and z"));
  EXPECT_THAT(refusal("id z x y\n1 2 3\n"), HasSubstr("names 4 columns; the first point has 3"));
  EXPECT_THAT(refusal("\"x\" \"y\" \"z\"\n\"1\" 1 2 3\n"),  // R's write.table with row names
              HasSubstr("cloud.txt:1: names 3 columns; the first point has 4"));
  EXPECT_THAT(refusal("x,y,z\n1,234.5,6,789.0,10\n"), HasSubstr("names 3 columns"));
  EXPECT_THAT(refusal("a story\nwithout any points\n"), HasSubstr("is a point, x y z"));
  EXPECT_THAT(refusal("x y z\n"), HasSubstr("is a point, x y z"));
  EXPECT_THAT(refusal("1 2 3\n" + std::string(3 << 20, '7')),
              HasSubstr(":2: the line is too long"));
}

// More than a block of text, cut at every place of a line.
TEST_F(TextCloud, LongFilesAreReadWhole) {
  std::string text;
  Positions expected;
  for (int i = 0; i < 200000; ++i) {
    text += std::to_string(i) + " " + std::to_string(i % 977) + " 0.5\n";
    expected.emplace_back(i, i % 977, 0.5);
  }
  EXPECT_EQ(read(text), expected);
}

// PDAL puts names in quotes.
TEST_F(TextCloud, NamedColumnsBecomeFieldsOfPoints) {
  const auto file =
      folder_.write("cloud.csv",
                    "\"X\",\"Y\",\"Z\",\"Intensity\",return_number,number_of_returns\n"
                    "500000.25,4000000.5,7,12.5,1,2\n");
  const CloudInfo info = read_cloud_info(file);
  EXPECT_THAT(info.fields, ElementsAre("intensity", "return_number", "return_count"));
  std::vector<LabelledPoint> points;
  read_points(file, info, [&](auto piece) { points.assign(piece.begin(), piece.end()); });
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(info.origin_m, Eigen::Vector3d(500000, 4000000, 0));
  EXPECT_EQ(points[0].x, 0.25f);
  EXPECT_EQ(points[0].intensity, 12.5f);
  EXPECT_EQ(points[0].return_count, 2);
}

}  // namespace
}  // namespace plotscan::scan
