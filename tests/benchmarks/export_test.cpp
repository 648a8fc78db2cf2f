// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "benchmarks/blind_suite.h"
#include "core/error.h"
#include "farmbench/entry/sha256.h"
#include "farmbench/export/export_suite.h"
#include "scan/point_reader.h"
#include "temporary_folder.h"

namespace plotscan::farmbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using plotscan::testing::write_blind_suite;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) files.push_back(fs::relative(entry.path(), folder));
  std::ranges::sort(files);
  return files;
}

template <class Value>
Value at(const std::string& bytes, std::size_t place) {
  Value value{};
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

std::vector<scan::LabelledPoint> points_of(const fs::path& cloud) {
  std::vector<scan::LabelledPoint> points;
  scan::read_points(cloud, scan::read_cloud_info(cloud),
                    [&](auto part) { points.insert(points.end(), part.begin(), part.end()); });
  return points;
}

// The blind suite exported once, with all that an export may hold but the boxes.
class Export : public ::testing::Test {
 protected:
  void SetUp() override {
    suite_ = write_blind_suite(folder_);
    options_ = {.suite = {.file = suite_}, .output = folder_.path() / "task", .threads = 2};
    options_.parts.formats = {"pcd", "las", "pcap"};
  }

  json fields() const { return json::parse(read_text(options_.output / "task.json"))["fields"]; }

  TemporaryFolder folder_;
  fs::path suite_;
  ExportOptions options_;
};

TEST_F(Export, HoldsTheseFilesAndNoOthers) {
  const ExportSummary summary = export_suite(options_);
  EXPECT_EQ(summary.fields, 2U);
  std::vector<fs::path> expected = {"TASK.md", "manifest.json", "task.json"};
  for (const json& field : fields()) {
    const fs::path code = field["field"].get<std::string>();
    for (const char* file :
         {"cloud.las", "cloud.pcd", "flight.json", "flight.pcap", "poses.csv", "sensor.yaml"})
      expected.push_back(code / file);
  }
  std::ranges::sort(expected);
  EXPECT_EQ(files_below(options_.output), expected);
  for (const auto& entry : fs::directory_iterator(folder_.path()))  // no farm is left beside it
    EXPECT_THAT(entry.path().filename(), ::testing::AnyOf("task", "blind.yaml"));
}

TEST_F(Export, NoByteNamesCaseSeedFarmOrTruth) {
  export_suite(options_);
  const Suite suite = load_suite(suite_);
  std::vector<std::string> secrets = {"hidden", "918273646", "paper_flat", "paper_half",
                                      "random", "accession", "terrain"};
  for (const SuiteCase& suite_case : suite.cases) {
    const fs::path work = folder_.path() / "work" / suite_case.name;
    fs::create_directories(work);
    make_farm({suite_case, suite.seeds.front(), work, 1});
    for (const score::TruePlot& plot : score::read_truth(work / "farm"))
      for (const auto& [name, height_m] : plot.heights_m) secrets.push_back(json(height_m).dump());
  }
  const auto files = files_below(options_.output);
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) {
    const std::string bytes = read_text(options_.output / file);
    for (const std::string& secret : secrets)
      EXPECT_EQ(bytes.find(secret), std::string::npos) << file << " tells " << secret;
  }
}

TEST_F(Export, CloudsHaveNoLabels) {
  export_suite(options_);
  for (const json& field : fields()) {
    const fs::path folder = options_.output / field["field"].get<std::string>();
    EXPECT_THAT(read_text(folder / "cloud.pcd"),
                HasSubstr("\nFIELDS x y z intensity ring time return_number return_count\n"));
    const std::string las = read_text(folder / "cloud.las");
    // LAS 1.4 - R15, tables 3 and 16: point data offset and record length, then the classes.
    const auto offset = at<std::uint32_t>(las, 96);
    const auto record = at<std::uint16_t>(las, 105);
    ASSERT_EQ(record, 30 + 2);  // point format 6, and the ring
    ASSERT_EQ((las.size() - offset) / record, field["points"]);
    for (std::size_t place = offset; place < las.size(); place += record)
      ASSERT_EQ(las[place + 16], 0);
    const std::string header = las.substr(0, offset);
    EXPECT_NE(header.find("ring"), std::string::npos);
    for (const char* label : {"plot id", "plant", "weed"})
      EXPECT_EQ(header.find(label), std::string::npos) << label;
  }
}

TEST_F(Export, PointsAreTheScansInTheSensorsOrder) {
  export_suite(options_);
  const Suite suite = load_suite(suite_);
  for (const BlindField& field : blind_fields(suite, options_.suite)) {
    const fs::path work = folder_.path() / "work" / field.code;
    fs::create_directories(work);
    const FarmPlace place{field.suite_case, field.seed, work, 1};
    const ScannedFarm scanned = scan_farm(place, make_farm(place), {});
    std::vector<scan::LabelledPoint> points = points_of(scanned.cloud);
    ASSERT_TRUE(std::ranges::any_of(points, [](const auto& point) { return point.plant != 0; }));
    for (scan::LabelledPoint& point : points) {
      point.label = scan::PointClass::unlabelled;
      point.plot = point.plant = 0;
    }
    const fs::path folder = options_.output / field.code;
    EXPECT_EQ(points_of(folder / "cloud.pcd"), points);
    // Nothing but time orders them: no plot, plant or class does.
    EXPECT_TRUE(std::ranges::is_sorted(points, {}, &scan::LabelledPoint::time));
    // The drone's own word, which is off by centimetres, and not where it was.
    EXPECT_EQ(read_text(folder / "poses.csv"), read_text(work / "scan" / "poses.csv"));
    EXPECT_NE(read_text(folder / "poses.csv"), read_text(work / "scan" / "trajectory.csv"));
  }
}

TEST_F(Export, NeitherNamesNorTimesNorManifestTellTheOrder) {
  export_suite(options_);
  std::vector<std::string> codes;
  for (const json& field : fields()) codes.push_back(field["field"]);
  EXPECT_TRUE(std::ranges::is_sorted(codes));
  for (const std::string& code : codes) {
    EXPECT_EQ(code.size(), 10U);
    EXPECT_EQ(code.find_first_not_of("0123456789abcdef"), std::string::npos);
  }
  const auto time = fs::last_write_time(options_.output);
  for (const auto& entry : fs::recursive_directory_iterator(options_.output))
    EXPECT_EQ(fs::last_write_time(entry.path()), time) << entry.path();
  const json manifest = json::parse(read_text(options_.output / "manifest.json"));
  EXPECT_EQ(manifest["seed"], 0);
  EXPECT_EQ(manifest["inputs"], json::array());
  EXPECT_EQ(manifest["options"], json({{"suite", "blindsuite"}, {"boxes", false}, {"seeds", 1}}));
  EXPECT_EQ(manifest["results"], json::object());
}

TEST_F(Export, IsRepeatedBitByBit) {
  options_.parts.formats = {"pcd"};
  export_suite(options_);
  ExportOptions again = options_;
  again.output = folder_.path() / "again";
  again.threads = 1;
  export_suite(again);
  for (const fs::path& file : files_below(options_.output))
    EXPECT_EQ(read_text(options_.output / file), read_text(again.output / file)) << file;
  EXPECT_THAT(message_of<InputError>([&] { export_suite(again); }), HasSubstr("exists"));
}

TEST_F(Export, HashesAreThoseOfTheFiles) {
  options_.parts.formats = {"pcd"};
  options_.parts.boxes = true;
  export_suite(options_);
  EXPECT_EQ(sha256_of("abc"),  // FIPS 180-4's own example
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  for (const json& field : fields()) {
    const fs::path folder = options_.output / field["field"].get<std::string>();
    EXPECT_EQ(field["sha256"].size(), 6U);
    for (const auto& [file, hash] : field["sha256"].items())
      EXPECT_EQ(sha256_of(read_text(folder / file)), hash.get<std::string>()) << file;
  }
}

TEST_F(Export, GivenBoxesAreBoxesAlone) {
  options_.parts = {.formats = {"pcd"}, .boxes = true};
  export_suite(options_);
  for (const json& field : fields()) {
    const fs::path folder = options_.output / field["field"].get<std::string>();
    EXPECT_THAT(
        read_text(folder / "boxes.csv"),
        ::testing::StartsWith("plot_number,center_x_m,center_y_m,width_m,length_m,heading_deg\n"));
    const json boxes = json::parse(read_text(folder / "boxes.geojson"));
    ASSERT_EQ(boxes["features"].size(), 4U);
    for (const json& feature : boxes["features"]) {
      std::vector<std::string> keys;
      for (const auto& [key, value] : feature["properties"].items()) keys.push_back(key);
      EXPECT_THAT(keys, ElementsAre("center_x_m", "center_y_m", "heading_deg", "length_m",
                                    "plot_number", "width_m"));
    }
  }
}

TEST_F(Export, ASecretMakesOtherFarmsAndStaysOne) {
  options_.parts.formats = {"pcd"};
  options_.suite.secret = folder_.write("secret", "correct horse battery staple\n");
  const Suite drawn = chosen_suite(options_.suite);
  EXPECT_NE(drawn.seeds, load_suite(suite_).seeds);
  EXPECT_LT(drawn.seeds.front(), std::uint64_t{1} << 52);
  // What `printf 'plotscan seed\nblindsuite\n\n0\ncorrect horse battery staple' | sha256sum` begins
  // with.
  EXPECT_EQ(drawn.seeds.front(), 0x607025ea8553cULL);
  export_suite(options_);
  for (const fs::path& file : files_below(options_.output)) {
    const std::string bytes = read_text(options_.output / file);
    EXPECT_EQ(bytes.find("correct horse"), std::string::npos) << file;
    EXPECT_EQ(bytes.find(std::to_string(drawn.seeds.front())), std::string::npos) << file;
  }
  const auto open = blind_fields(load_suite(suite_), {.file = suite_});
  for (const json& field : fields())
    for (const BlindField& known : open) EXPECT_NE(field["field"], known.code);
  options_.suite.secret = folder_.write("short", "guess me\n");
  EXPECT_THAT(message_of<InputError>([&] { chosen_suite(options_.suite); }),
              HasSubstr("holds 8 bytes; a secret has 16"));
}

TEST_F(Export, ASurveysCloudEndsAtItsEdge) {
  const std::string suite = read_text(suite_);
  const std::size_t at = suite.find("set: &small");
  const fs::path partial = folder_.write(
      "partial.yaml", suite.substr(0, at) + "survey_m: [-3, -5, 8, 5], " + suite.substr(at));
  options_.suite.file = partial;
  options_.parts.formats = {"pcd"};
  export_suite(options_);
  const Suite loaded = load_suite(partial);
  for (const BlindField& field : blind_fields(loaded, options_.suite)) {
    if (!field.suite_case.survey) continue;
    for (const scan::LabelledPoint& point : points_of(options_.output / field.code / "cloud.pcd")) {
      ASSERT_GE(point.x, -3);
      ASSERT_LE(point.x, 8);
      ASSERT_GE(point.y, -5);
      ASSERT_LE(point.y, 5);
    }
  }
}

TEST_F(Export, RefusesWhatItCannotWrite) {
  const auto refused = [&](std::vector<std::string> formats) {
    options_.parts.formats = std::move(formats);
    return message_of<InputError>([&] { export_suite(options_); });
  };
  EXPECT_THAT(refused({"xyz"}), HasSubstr("there are pcd, las, pcap"));
  EXPECT_THAT(refused({"pcap"}), HasSubstr("an export has clouds"));
  EXPECT_THAT(refused({"pcd", "pcd"}), HasSubstr("named twice"));
  EXPECT_FALSE(fs::exists(options_.output));
}

}  // namespace
}  // namespace plotscan::farmbench
