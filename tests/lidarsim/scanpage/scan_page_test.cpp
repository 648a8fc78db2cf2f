// SPDX-License-Identifier: Apache-2.0
#include "scanpage/scan_page.h"

#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "scanpage/read_cloud.h"
#include "temporary_folder.h"

namespace plotscan::scanpage {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

// A level field of 6 x 6 m whose points are 5 cm apart, with a box of leaves in its middle.
std::string field_ply() {
  std::string body;
  int count = 0;
  for (int i = 0; i < 120; ++i) {
    for (int k = 0; k < 120; ++k) {
      const bool leaf = i > 40 && i < 80 && k > 40 && k < 80 && (i + k) % 2 == 0;
      body += std::to_string(0.05 * i) + " " + std::to_string(0.05 * k) + " " +
              (leaf ? "0.8" : "0.0") + " " + std::to_string(i) + (leaf ? " 2 17" : " 1 0") + "\n";
      ++count;
    }
  }
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float intensity\n"
         "property uchar class\nproperty uint plot\nend_header\n" +
         body;
}

nlohmann::json document_of(const fs::path& html) {
  const std::string page = read_text(html);
  const std::size_t begin = page.find('>', page.find("id=\"report\"")) + 1;
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

// A map of one plot on the cloud.
fs::path write_map(const TemporaryFolder& folder, const std::string& properties) {
  return folder.write(
      "plots.geojson",
      R"({"type":"FeatureCollection","coordinate_system":"local metres","features":[{"type":"Feature",
      "geometry":{"type":"Polygon","coordinates":[[[2,2],[4,2],[4,4.5],[2,4.5],[2,2]]]},"properties":)" +
          properties + "}]}");
}

TEST(ScanPage, HoldsPointsGroundAndPlots) {
  const TemporaryFolder folder;
  const fs::path cloud = folder.write("a \"><img src=x>.ply", field_ply());
  const fs::path plots = write_map(folder, R"({"plot_number":17,"height_max_m":0.8})");
  const fs::path html = folder.path() / "page.html";
  const report::PageSummary summary =
      write_scan_page({.scan = cloud, .html = html, .plots = plots, .points = 10'000});
  EXPECT_EQ(summary.read, 14'400U);
  EXPECT_EQ(summary.shown, 10'000U);
  const nlohmann::json document = document_of(html);
  EXPECT_EQ(document["kind"], "scan");
  const nlohmann::json& field = document["fields"][0];
  EXPECT_EQ(field["name"], cloud.filename().string());
  EXPECT_EQ(field["cloud"]["has"], nlohmann::json({"class", "plot", "intensity"}));
  EXPECT_EQ(field["plots"][0]["id"], "17");
  EXPECT_EQ(field["plots"][0]["truths"]["height_max_m"], 0.8);
  EXPECT_NEAR(field["ground"]["z"]["low"].get<double>(), 0, 0.01);
}

TEST(ScanPage, CallsNoEstimateTrue) {
  const TemporaryFolder folder;
  const fs::path cloud = folder.write("a.ply", field_ply());
  const fs::path plots = write_map(folder, R"({"trial_number":2,"points":900,"height_max_m":0.8})");
  const fs::path html = folder.path() / "page.html";
  write_scan_page({.scan = cloud, .html = html, .plots = plots});
  const nlohmann::json plot = document_of(html)["fields"][0]["plots"][0];
  EXPECT_EQ(plot["trial"], 2);
  EXPECT_FALSE(plot.contains("truths") && !plot["truths"].empty());
}

TEST(ScanPage, SaysWhenThePlotsLieElsewhere) {
  const TemporaryFolder folder;
  const fs::path cloud = folder.write("a.ply", field_ply());
  const fs::path html = folder.path() / "page.html";
  const auto notes_with_plot_at = [&](const std::string& x0, const std::string& x1) {
    const fs::path plots = folder.write(
        "plots.geojson", R"({"type":"FeatureCollection","features":[{"type":"Feature",
      "properties":{},"geometry":{"type":"Polygon","coordinates":[[[)" +
                             x0 + ",2],[" + x1 + ",2],[" + x1 + ",4.5],[" + x0 + ",4.5]]]}}]}");
    write_scan_page({.scan = cloud, .html = html, .plots = plots, .replace = true});
    return document_of(html)["fields"][0]["notes"];
  };
  EXPECT_EQ(notes_with_plot_at("2", "4"), nlohmann::json::array());
  EXPECT_THAT(notes_with_plot_at("-81", "-79").dump(), HasSubstr("a.ply lies among the plots"));
}

TEST(ScanPage, RefusesWithOneMessageAndLeavesNothing) {
  const TemporaryFolder folder;
  const fs::path cloud = folder.write("a.ply", field_ply());
  const fs::path html = folder.path() / "page.html";
  EXPECT_THAT(
      message_of<InputError>([&] { write_scan_page({.scan = cloud, .html = html, .points = 0}); }),
      HasSubstr("1 to 5000000 points"));
  EXPECT_THAT(message_of<InputError>(
                  [&] { write_scan_page({.scan = folder.path() / "none", .html = html}); }),
              HasSubstr("none"));
  EXPECT_FALSE(fs::exists(html));
  write_scan_page({.scan = cloud, .html = html});
  EXPECT_THAT(message_of<InputError>([&] { write_scan_page({.scan = cloud, .html = html}); }),
              HasSubstr("exists"));
}

// Seconds since 1970, which floats hold in steps of two minutes.
TEST(ScanPage, TellsTimesApartThatCountFromLongAgo) {
  const TemporaryFolder folder;
  const fs::path cloud = folder.write("a.ply",
                                      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                      "property float y\nproperty float z\nproperty double time\n"
                                      "end_header\n0 0 0 1700000001.5\n1 0 0 1700000002.5\n"
                                      "0 1 0 1700000005.25\n");
  const fs::path html = folder.path() / "page.html";
  write_scan_page({.scan = cloud, .html = html});
  EXPECT_EQ(document_of(html)["fields"][0]["cloud"]["time"],
            nlohmann::json({1700000001.5, 1700000005.25}));
  const ShownScan scan = read_shown_scan(cloud, {.most = 3});
  EXPECT_EQ(scan.cloud.points[1].time_s - scan.cloud.points[0].time_s, 1);
}

TEST(ReadShownScan, KeepsThePointsOfTheArea) {
  const TemporaryFolder folder;
  const fs::path cloud = folder.write("a.ply", field_ply());
  const ShownScan scan = read_shown_scan(
      cloud,
      {.most = 100'000,
       .area = Eigen::AlignedBox2d(Eigen::Vector2d(0.99, 1.99), Eigen::Vector2d(2.01, 3.01))});
  EXPECT_EQ(scan.cloud.read, 21U * 21U);
  for (const report::ShownPoint& point : scan.cloud.points) {
    EXPECT_NEAR(point.place.x(), 0.05 * point.intensity, 1e-5);
    EXPECT_EQ(point.plot, point.label == 2 ? 17U : 0U);
  }
}

}  // namespace
}  // namespace plotscan::scanpage
