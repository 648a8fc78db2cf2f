// SPDX-License-Identifier: Apache-2.0
// LAZ and COPC: by LASzip, where Plotscan is built with it, and by scripts/unlaz, whose decoder is
// not LASzip's.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "scan/cloud_reader.h"
#include "scan/point_reader.h"
#include "temporary_folder.h"
#ifdef PLOTSCAN_HAVE_LASZIP
#include "scan/laz_writer.h"
#endif

#include "numbered_point.h"

namespace plotscan::scan {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

struct Read {
  CloudInfo info;
  std::vector<LabelledPoint> points;
};

Read read_points(const std::filesystem::path& file) {
  Read result{.info = read_cloud_info(file), .points = {}};
  read_points(file, result.info, [&](auto piece) {
    result.points.insert(result.points.end(), piece.begin(), piece.end());
  });
  return result;
}

class Laz : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!exists(real_)) GTEST_SKIP() << real_ << " is not at hand";
    if (!exists(readers_ / "node_modules")) GTEST_SKIP() << "scripts/setup installs " << readers_;
  }
  // What scripts/unlaz makes of a LAZ file; nothing where it fails.
  std::filesystem::path unpacked(const std::filesystem::path& laz) const {
    const auto las = folder_.path() / (laz.filename().string() + ".las");
    const std::string command = "node '" + (readers_ / "unlaz.cjs").string() + "' '" +
                                laz.string() + "' '" + las.string() + "' > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return las;
  }

  std::filesystem::path real_ = PLOTSCAN_SHARED_DATA_DIR "/real";
  std::filesystem::path readers_ = PLOTSCAN_SOURCE_DIR "/tests/readers";
  TemporaryFolder folder_;
};

// Every point of a square that somebody else cut out of the cloud is there.
TEST_F(Laz, UnlazGivesThePointsOfTheFile) {
  using Place = std::tuple<double, double, double>;
  std::multiset<Place> places;
  std::size_t missing = 0;
  read_positions(unpacked(real_ / "iowa_farmland.laz"), [&](auto piece) {
    for (const Eigen::Vector3d& p : piece) places.emplace(p.x(), p.y(), p.z());
  });
  EXPECT_EQ(places.size(), 376483u);
  read_positions(real_ / "iowa_farmland_80m.las", [&](auto piece) {
    for (const Eigen::Vector3d& p : piece) missing += !places.contains({p.x(), p.y(), p.z()});
  });
  EXPECT_EQ(missing, 0u);
}

TEST_F(Laz, UnlazRefusesWhatIsNoLaz) {
  const std::string command = "node '" + (readers_ / "unlaz.cjs").string() + "' '" +
                              (real_ / "iowa_farmland_80m.las").string() + "' '" +
                              (folder_.path() / "out.las").string() + "' 2> /dev/null";
  EXPECT_NE(std::system(command.c_str()), 0);
  EXPECT_FALSE(exists(folder_.path() / "out.las"));
}

#ifdef PLOTSCAN_HAVE_LASZIP

TEST_F(Laz, LaszipReadsWhatUnlazReads) {
  for (const char* name :
       {"simple.laz", "simple.copc.laz", "iowa_farmland.laz", "lone-star.copc.laz"}) {
    const Read laz = read_points(real_ / name);
    const Read las = read_points(unpacked(real_ / name));
    EXPECT_EQ(laz.info.fields, las.info.fields) << name;
    EXPECT_EQ(laz.info.crs_wkt, las.info.crs_wkt) << name;
    EXPECT_EQ(laz.points.size(), las.info.points) << name;
    EXPECT_TRUE(laz.points == las.points) << name;
  }
}

TEST_F(Laz, TruncatedFilesAreRefused) {
  const std::string bytes = read_text(real_ / "iowa_farmland.laz");
  for (const std::size_t size : {std::size_t{400}, bytes.size() / 2, bytes.size() - 100}) {
    const auto file = folder_.write("cut.laz", bytes.substr(0, size));
    EXPECT_NE(message_of<InputError>([&] { read_points(file); }), "") << size;
  }
}

TEST_F(Laz, WrittenFilesAreRead) {
  const std::vector<LabelledPoint> points = numbered_points(120000);
  const LasOptions options{.crs_wkt = "none", .offset_m = {500000, 4000000, 0}};
  LasWriter las(folder_.path() / "cloud.las", options);
  LazWriter laz(folder_.path() / "cloud.laz", options);
  for (PointWriter* writer : std::array<PointWriter*, 2>{&las, &laz}) {
    writer->write(points);
    writer->close();
  }
  const Read plain = read_points(folder_.path() / "cloud.las");
  const Read packed = read_points(folder_.path() / "cloud.laz");
  EXPECT_EQ(packed.info.fields, plain.info.fields);
  EXPECT_EQ(packed.info.crs_wkt, "none");
  EXPECT_TRUE(packed.points == plain.points);
  EXPECT_TRUE(read_points(unpacked(folder_.path() / "cloud.laz")).points == plain.points);
  EXPECT_LT(file_size(folder_.path() / "cloud.laz") * 2, file_size(folder_.path() / "cloud.las"));
}

#else

TEST_F(Laz, IsRefusedWithWhatHelps) {
  const std::string message = message_of<InputError>([&] { read_points(real_ / "simple.laz"); });
  EXPECT_THAT(message, HasSubstr("is compressed (LAZ), which this build does not read"));
  EXPECT_THAT(message, HasSubstr("scripts/unlaz"));
}

#endif

}  // namespace
}  // namespace plotscan::scan
