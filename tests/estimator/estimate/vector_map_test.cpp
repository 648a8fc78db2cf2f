// SPDX-License-Identifier: Apache-2.0
#include "estimate/internal/vector_map.h"

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gdal.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include "core/error.h"
#include "core/geodesy.h"
#include "core/plot_features.h"
#include "estimate/ground_grids.h"
#include "estimator/methods/run_on_farm.h"

namespace plotscan::estimate {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;
using testing::kFarm;
using testing::write_cloud;

// A map written by GDAL, as QGIS writes it.
class Map {
 public:
  Map(const fs::path& file, const char* driver) {
    GDALAllRegister();
    data_.reset(GetGDALDriverManager()->GetDriverByName(driver)->Create(file.c_str(), 0, 0, 0,
                                                                        GDT_Unknown, nullptr));
  }
  OGRLayer& layer(const char* name, int epsg, OGRwkbGeometryType type = wkbPolygon) {
    OGRSpatialReference system;
    if (epsg > 0) system.importFromEPSG(epsg);
    system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return *data_->CreateLayer(name, epsg > 0 ? &system : nullptr, type, nullptr);
  }

 private:
  std::unique_ptr<GDALDataset> data_;
};

OGRPolygon polygon_of(const std::vector<Eigen::Vector2d>& corners) {
  OGRLinearRing ring;
  for (const Eigen::Vector2d& corner : corners) ring.addPoint(corner.x(), corner.y());
  ring.closeRings();
  OGRPolygon polygon;
  polygon.addRing(&ring);
  return polygon;
}

std::vector<Eigen::Vector2d> corners_of(const PlotBox& box, const Eigen::Vector2d& moved) {
  std::vector<Eigen::Vector2d> corners;
  for (const Eigen::Vector2d& corner : box.corners()) corners.push_back(corner + moved);
  return corners;
}

struct Field {
  const char* name;
  OGRFieldType type;
};

void add_fields(OGRLayer& layer, const std::vector<Field>& fields) {
  for (const Field& field : fields) {
    OGRFieldDefn definition(field.name, field.type);
    ASSERT_EQ(layer.CreateField(&definition), OGRERR_NONE);
  }
}

void add(OGRLayer& layer, OGRFeature& feature, const OGRPolygon& polygon) {
  feature.SetGeometry(&polygon);
  ASSERT_EQ(layer.CreateFeature(&feature), OGRERR_NONE);
}

const Eigen::Vector2d kUtm(512'000, 4'123'000);

// The farm in zone 17, a cloud whose file is silent.
methods::RunOptions run_over_utm(const TemporaryFolder& folder) {
  std::string text;
  for (Eigen::Vector3d point : kFarm.points()) {
    point.head<2>() += kUtm;
    for (int axis = 0; axis < 3; ++axis) text += std::to_string(point[axis]) + ' ';
    text += '\n';
  }
  methods::RunOptions options{.cloud = folder.write("utm.xyz", text),
                              .output = folder.path() / "estimate"};
  options.cloud.crs = "EPSG:32617";
  options.method = "dhami2020";
  return options;
}

nlohmann::json properties_of(const methods::RunOptions& options, std::size_t feature) {
  const auto written = nlohmann::json::parse(read_text(options.output / "plots.geojson"));
  return written["features"][feature]["properties"];
}

// Ids and attributes of every type come back, the plots lie where the map has them.
TEST(VectorMap, AGeoPackageComesBackWithHeights) {
  const TemporaryFolder folder;
  methods::RunOptions options = run_over_utm(folder);
  options.boxes = folder.path() / "plots.gpkg";
  {
    Map map(*options.boxes, "GPKG");
    OGRLayer& layer = map.layer("trial", 32617);
    add_fields(layer, {{"plot_id", OFTString},
                       {"cultivar", OFTString},
                       {"barcode", OFTInteger64},
                       {"density", OFTReal},
                       {"sown", OFTDate}});
    OGRFeature first(layer.GetLayerDefn());
    first.SetField("plot_id", "A-12");
    first.SetField("cultivar", "Gr\u00fcner");
    first.SetField("barcode", GIntBig{8000000000123});
    first.SetField("density", 30.5);
    first.SetField("sown", 2026, 5, 3);
    add(layer, first, polygon_of(corners_of(kFarm.box(1, 2), kUtm)));
    OGRFeature second(layer.GetLayerDefn());
    second.SetField("plot_id", "0101");
    add(layer, second, polygon_of(corners_of(kFarm.box(0, 0), kUtm)));
  }
  const Estimate estimate = methods::run(options);
  ASSERT_EQ(estimate.plots.size(), 2u);
  EXPECT_EQ(estimate.plots[0].id, PlotId("A-12"));
  EXPECT_EQ(estimate.plots[1].id, PlotId("0101"));
  EXPECT_EQ(estimate.id_property, "plot_id");
  EXPECT_NEAR(estimate.plots[0].heights_m.at("raw-max"), kFarm.height_m(1, 2), 1e-3);
  EXPECT_NEAR(estimate.plots[1].heights_m.at("raw-max"), kFarm.height_m(0, 0), 1e-3);
  const auto properties = properties_of(options, 0);
  EXPECT_EQ(properties["cultivar"], "Gr\u00fcner");
  EXPECT_EQ(properties["barcode"], 8000000000123);
  EXPECT_EQ(properties["density"], 30.5);
  EXPECT_EQ(properties["sown"], "2026-05-03");
  EXPECT_EQ(properties["fid"], 1);
  EXPECT_EQ(properties_of(options, 1)["cultivar"], nullptr);
}

// A shapefile knows its system by the .prj alone, and numbers by their digits.
TEST(VectorMap, AShapefileIsRead) {
  const TemporaryFolder folder;
  methods::RunOptions options = run_over_utm(folder);
  options.boxes = folder.path() / "plots.shp";
  const auto write = [&](int epsg) {
    Map map(*options.boxes, "ESRI Shapefile");
    OGRLayer& layer = map.layer("plots", epsg);
    add_fields(layer, {{"plot_id", OFTInteger}, {"entry", OFTString}});
    OGRFeature feature(layer.GetLayerDefn());
    feature.SetField("plot_id", 207);
    feature.SetField("entry", "Rock");
    add(layer, feature, polygon_of(corners_of(kFarm.box(1, 3), kUtm)));
  };
  write(32617);
  const Estimate estimate = methods::run(options);
  ASSERT_EQ(estimate.plots.size(), 1u);
  EXPECT_EQ(estimate.plots[0].id, 207u);
  EXPECT_NEAR(estimate.plots[0].heights_m.at("raw-max"), kFarm.height_m(1, 3), 1e-3);
  EXPECT_EQ(properties_of(options, 0)["entry"], "Rock");
  fs::remove(*options.boxes);
  write(32618);
  options.replace = true;
  EXPECT_THAT(message_of<InputError>([&] { methods::run(options); }),
              HasSubstr("is in the coordinate system EPSG:32618, and the cloud is in EPSG:32617"));
}

// Longitude comes first in the files, whatever EPSG's axes say.
TEST(VectorMap, DegreesAreConverted) {
  const TemporaryFolder folder;
  methods::RunOptions options = run_over_utm(folder);
  options.boxes = folder.path() / "degrees.gpkg";
  {
    Map map(*options.boxes, "GPKG");
    OGRLayer& layer = map.layer("trial", 4326);
    std::vector<Eigen::Vector2d> lonlat;
    for (const Eigen::Vector2d& corner : corners_of(kFarm.box(1, 2), kUtm)) {
      const GeodeticPoint place =
          geodetic_from_utm({.number = 17, .north = true}, {corner.x(), corner.y(), 0});
      lonlat.emplace_back(place.longitude_deg, place.latitude_deg);
    }
    OGRFeature feature(layer.GetLayerDefn());
    add(layer, feature, polygon_of(lonlat));
  }
  const Estimate estimate = methods::run(options);
  EXPECT_TRUE(estimate.diagnostics.boxes.value().from_degrees);
  ASSERT_EQ(estimate.plots.size(), 1u);
  EXPECT_LT((estimate.plots[0].box.center - kFarm.box(1, 2).center - kUtm).norm(), 1e-3);
}

TEST(VectorMap, WhatIsNoMapOfPlotsIsRefused) {
  const TemporaryFolder folder;
  const auto refusal = [&](const fs::path& file) {
    return message_of<InputError>([&] { read_vector_map(file); });
  };
  EXPECT_THAT(refusal(folder.path() / "none.gpkg"), HasSubstr("none.gpkg: no such file"));
  EXPECT_THAT(refusal(folder.write("text.gpkg", "hello")), HasSubstr("text.gpkg: cannot be read"));
  {
    Map map(folder.path() / "points.gpkg", "GPKG");
    map.layer("points", 32617, wkbPoint);
    Map two(folder.path() / "two.gpkg", "GPKG");
    two.layer("north", 32617);
    two.layer("south", 32617);
    Map old(folder.path() / "old.gpkg", "GPKG");
    old.layer("nad27", 4267);
  }
  EXPECT_THAT(refusal(folder.path() / "points.gpkg"), HasSubstr("no layer of polygons"));
  EXPECT_THAT(refusal(folder.path() / "two.gpkg"),
              HasSubstr("several layers of polygons: north, south"));
  EXPECT_THAT(refusal(folder.path() / "old.gpkg"),
              HasSubstr("NAD27\" (EPSG:4267), which is not known"));
  // Bytes of ISO 8859-1 in a file that says UTF-8.
  const fs::path shp = folder.path() / "latin.shp";
  {
    Map map(shp, "ESRI Shapefile");
    OGRLayer& layer = map.layer("latin", 32617);
    add_fields(layer, {{"entry", OFTString}});
    OGRFeature feature(layer.GetLayerDefn());
    feature.SetField("entry", "Grxner");
    add(layer, feature, polygon_of(corners_of(kFarm.box(0, 0), kUtm)));
  }
  std::string table = read_text(folder.path() / "latin.dbf");
  table.at(table.find("Grxner") + 2) = '\xFC';
  folder.write("latin.dbf", table);
  folder.write("latin.cpg", "UTF-8");
  EXPECT_THAT(refusal(shp), HasSubstr("latin.shp: its attribute \"entry\" has letters"));
  EXPECT_TRUE(is_vector_map("a/B.SHP"));
  EXPECT_FALSE(is_vector_map("plots.geojson"));
}

// As GDAL, and with it QGIS and R, opens the grids.
TEST(GroundGrids, StateTheirSystemWhereItIsKnown) {
  const TemporaryFolder folder;
  ground::Surface surface{{.origin = {500000, 40}, .cell_m = 0.2, .columns = 2, .rows = 2}};
  surface.z_m = {1, 2, 3, 4};
  surface.sd_m = {0.01F, 0.02F, 0.03F, 0.04F};
  surface.seen = {1, 0, 1, 0};
  const auto name_in_gis = [&](const std::string& crs, const CoordinateUnits& units = {}) {
    for (const char* grid : {"ground.prj", "ground_se.prj", "ground_seen.prj"})
      fs::remove(folder.path() / grid);
    write_ground(folder.path(), surface, units, crs);
    GDALAllRegister();
    const std::unique_ptr<GDALDataset> grid(
        GDALDataset::Open((folder.path() / "ground.asc").c_str(), GDAL_OF_RASTER));
    const OGRSpatialReference* system = grid->GetSpatialRef();
    return std::string(system == nullptr ? "none" : system->GetName());
  };
  EXPECT_EQ(name_in_gis("EPSG:32632"), "WGS 84 / UTM zone 32N");
  EXPECT_EQ(name_in_gis("EPSG:25832"), "ETRS89 / UTM zone 32N");
  EXPECT_TRUE(fs::exists(folder.path() / "ground_se.prj"));
  EXPECT_EQ(name_in_gis(""), "none");
  EXPECT_EQ(name_in_gis("EPSG:32632", {kFoot_m, kFoot_m}), "none") << "UTM's, but in feet";
  EXPECT_EQ(name_in_gis("EPSG:99999"), "none");
}

TEST(GroundGrids, GdalReadsTheCanopyHeightModel) {
  const TemporaryFolder folder;
  const ground::Grid grid{.origin = {500000, 40}, .cell_m = 0.2, .columns = 3, .rows = 2};
  const float none = std::numeric_limits<float>::quiet_NaN();
  write_canopy(folder.path(), grid, {0.1F, 0.2F, 0.3F, 0.4F, none, 0.6F}, {}, "EPSG:32632");
  GDALAllRegister();
  const std::unique_ptr<GDALDataset> chm(
      GDALDataset::Open((folder.path() / "chm.asc").c_str(), GDAL_OF_RASTER));
  ASSERT_NE(chm, nullptr);
  EXPECT_STREQ(chm->GetSpatialRef()->GetName(), "WGS 84 / UTM zone 32N");
  std::array<double, 6> place = {};
  chm->GetGeoTransform(place.data());
  EXPECT_NEAR(place[0], 499999.9, 1e-6);  // the north-western corner
  EXPECT_NEAR(place[3], 40.3, 1e-6);
  std::array<float, 6> values = {};
  GDALRasterBand* const band = chm->GetRasterBand(1);
  ASSERT_EQ(band->RasterIO(GF_Read, 0, 0, 3, 2, values.data(), 3, 2, GDT_Float32, 0, 0), CE_None);
  EXPECT_EQ(values, (std::array<float, 6>{0.4F, -9999, 0.6F, 0.1F, 0.2F, 0.3F}));
  EXPECT_EQ(band->GetNoDataValue(), -9999);
}

// As R's sf, geopandas and QGIS open what is written: without a member crs it would be degrees.
TEST(PlotFeatures, OfNoKnownSystemAreMetresInGisPrograms) {
  const TemporaryFolder folder;
  const std::vector<PlotFeature> plots = {
      {.box = {.center = {10, 20}, .width_m = 1.5, .length_m = 4}}};
  const auto unit_in_gis = [&](const std::optional<CoordinateUnits>& units) {
    const auto file = folder.path() / "plots.geojson";
    write_plot_features(file, plots, "", units);
    EXPECT_NEAR(read_plot_features(file, "EPSG:32617").plots.at(0).box.center.y(), 20, 1e-9);
    GDALAllRegister();
    const std::unique_ptr<GDALDataset> data(
        GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
    const OGRSpatialReference* system = data->GetLayer(0)->GetSpatialRef();
    return system != nullptr && system->IsLocal() ? system->GetLinearUnits() : 0;
  };
  EXPECT_DOUBLE_EQ(unit_in_gis({}), 1);
  EXPECT_DOUBLE_EQ(unit_in_gis(CoordinateUnits{kFoot_m, kFoot_m}), kFoot_m);
}

}  // namespace
}  // namespace plotscan::estimate
