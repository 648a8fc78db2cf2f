// SPDX-License-Identifier: Apache-2.0
// Exports as Gazebo itself reads them: libsdformat 12 and ign-common 4 are those of Fortress.
#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <sdf/sdf.hh>
#include <tinyxml2.h>

#include "core/error.h"
#include "farmgen/gazebo/export_example.h"
#include "gazebo/internal/naming.h"
#include "gazebo_vector.h"
#include "sdfxml/elements.h"

namespace plotscan::gazebo {
namespace {

namespace fs = std::filesystem;

struct Variant {
  std::string name;
  ExportOptions options;
};

// Every Gazebo and merge, with the other options taken in turns.
std::vector<Variant> variants() {
  std::vector<Variant> all;
  int number = 0;
  for (const Gazebo gazebo : {Gazebo::classic, Gazebo::sim}) {
    for (const Merge merge : {Merge::plot, Merge::row, Merge::none}) {
      for (const Collision collision : {Collision::none, Collision::box, Collision::mesh}) {
        all.push_back({"world" + std::to_string(number),
                       {.gazebo = gazebo,
                        .merge = merge,
                        .lod = number % 2 == 0 ? Detail::scan : Detail::light,
                        .collision = collision,
                        .drone = true}});
        ++number;
      }
    }
  }
  return all;
}

std::vector<fs::path> sdf_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".sdf") files.push_back(entry.path());
  }
  return files;
}

void load(const fs::path& folder, const fs::path& file, sdf::Root& root) {
  sdf::ParserConfig config;
  config.AddURIPath("model://", (folder / "models").string());
  config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::ERR);
  for (const sdf::Error& error : root.Load((folder / file).string(), config)) {
    ADD_FAILURE() << file << ": " << error.Message();
  }
}

Eigen::Vector3d position_of(const sdf::Model& model) { return eigen(model.RawPose().Pos()); }

double retro_of(const sdf::Visual& visual) { return visual.LaserRetro(); }

// The elements <plugin> of a world or model.
std::vector<sdf::ElementPtr> plugins_of(const sdf::ElementPtr& element) {
  std::vector<sdf::ElementPtr> plugins;
  if (!element->HasElement("plugin")) return plugins;
  for (auto each = element->GetElement("plugin"); each; each = each->GetNextElement("plugin"))
    plugins.push_back(each);
  return plugins;
}

std::string label_of(const sdf::Model& model) {
  for (const sdf::ElementPtr& plugin : plugins_of(model.Element())) {
    if (plugin->Get<std::string>("name").ends_with("::systems::Label"))
      return plugin->Get<std::string>("label");
  }
  return "";
}

TEST(ExportLoading, LibsdformatFindsEveryPlantWhereItStands) {
  const ExportExample example;
  const farm::Farm& farm = example.farm();
  for (const Gazebo gazebo : {Gazebo::classic, Gazebo::sim}) {
    const std::string name = gazebo == Gazebo::sim ? "sim" : "classic";
    example.write(name, {.gazebo = gazebo, .merge = Merge::none, .lod = Detail::scan});
    sdf::Root root;
    load(example.path() / name, "world.sdf", root);
    const sdf::World& world = *root.WorldByIndex(0);
    EXPECT_EQ(world.Name(), farm.name);
    ASSERT_EQ(world.ModelCount(), farm.plants.size() + 1);
    for (const farm::Plant& plant : farm.plants) {
      const sdf::Model* model = world.ModelByName(plant_model_name(plant.plot, plant.id));
      ASSERT_NE(model, nullptr) << plant.id;
      EXPECT_TRUE(model->Static());
      EXPECT_EQ(position_of(*model), plant.position);
      const auto& q = model->RawPose().Rot();
      EXPECT_LT(Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).angularDistance(plant.rotation),
                1e-6);
      const sdf::Visual& visual = *model->LinkByIndex(0)->VisualByIndex(0);
      const sdf::Mesh& mesh = *visual.Geom()->MeshShape();
      EXPECT_EQ(eigen(mesh.Scale()), plant.scale);
      EXPECT_EQ(mesh.Uri(), "model://" + farm.models[plant.model].name + "/meshes/" +
                                farm.models[plant.model].name + ".obj");
      const bool weed = plant.kind == farm::PlantKind::weed;
      EXPECT_EQ(retro_of(visual), weed ? 3 : 2);
      EXPECT_EQ(label_of(*model), gazebo == Gazebo::classic ? "" : (weed ? "3" : "2"));
    }
  }
}

TEST(ExportLoading, MergedModelsStandAtTheirPlotsWithTheirClass) {
  const ExportExample example;
  for (const Merge merge : {Merge::plot, Merge::row}) {
    const std::string name = merge == Merge::plot ? "plot" : "row";
    example.write(name, {.merge = merge, .drone = true});
    for (const char* file : {"world.sdf", "world_fortress.sdf"}) {
      sdf::Root root;
      load(example.path() / name, file, root);
      const sdf::World& world = *root.WorldByIndex(0);
      EXPECT_EQ(label_of(*world.ModelByName("terrain")), "1");
      EXPECT_EQ(retro_of(*world.ModelByName("terrain")->LinkByIndex(0)->VisualByIndex(0)), 1);
      EXPECT_EQ(label_of(*world.ModelByName("drone")), "4");
      for (const farm::Plot& plot : example.farm().plots) {
        const Eigen::Vector3d place(
            plot.box.center.x(), plot.box.center.y(),
            *example.farm().terrain.height(plot.box.center.x(), plot.box.center.y()));
        const std::string plot_name = sdfxml::plot_element_name(plot.id);
        for (const std::string& part : {plot_name, weeds_name(plot_name)}) {
          const bool weed = part != plot_name;
          const std::string row = row_model_name(plot.trial, plot.row);
          const sdf::Model* model =
              world.ModelByName(merge == Merge::plot ? part : (weed ? weeds_name(row) : row));
          ASSERT_NE(model, nullptr) << part;
          const sdf::Link* link = model->LinkByName(merge == Merge::plot ? "link" : part);
          ASSERT_NE(link, nullptr) << part;
          EXPECT_LT((position_of(*model) + eigen(link->RawPose().Pos()) - place).norm(), 1e-12);
          EXPECT_EQ(label_of(*model), weed ? "3" : "2");
          for (std::uint64_t i = 0; i < link->VisualCount(); ++i) {
            const sdf::Visual& visual = *link->VisualByIndex(i);
            EXPECT_EQ(retro_of(visual), weed ? 3 : 2);
            EXPECT_TRUE(visual.Material()->DoubleSided());
          }
        }
      }
    }
  }
}

TEST(ExportLoading, EachGazeboGetsThePluginsItKnows) {
  const ExportExample example;
  example.write("sim", {.drone = true});
  example.write("classic", {.gazebo = Gazebo::classic, .drone = true});
  const auto plugins = [&](const fs::path& folder, const char* file) {
    sdf::Root root;
    load(example.path() / folder, file, root);
    std::set<std::string> names;
    for (const sdf::ElementPtr& plugin : plugins_of(root.WorldByIndex(0)->Element()))
      names.insert(plugin->Get<std::string>("filename") + " " + plugin->Get<std::string>("name"));
    return names;
  };
  const std::vector<std::pair<std::string, std::string>> systems = {
      {"physics", "Physics"},
      {"user-commands", "UserCommands"},
      {"scene-broadcaster", "SceneBroadcaster"},
      {"sensors", "Sensors"},
      {"imu", "Imu"},
      {"navsat", "NavSat"}};
  const auto named = [&](const std::string& library, const std::string& space) {
    std::set<std::string> names;
    for (const auto& [file, name] : systems)
      names.insert(std::string(library).append(file).append("-system ").append(space).append(name));
    return names;
  };
  EXPECT_EQ(plugins("sim", "world.sdf"), named("gz-sim-", "gz::sim::systems::"));
  EXPECT_EQ(plugins("sim", "world_fortress.sdf"),
            named("ignition-gazebo-", "ignition::gazebo::systems::"));
  EXPECT_TRUE(plugins("classic", "world.sdf").empty());
}

TEST(ExportLoading, TheDroneCarriesOurLidar) {
  const ExportExample example;
  for (const Gazebo gazebo : {Gazebo::classic, Gazebo::sim}) {
    const std::string name = gazebo == Gazebo::sim ? "sim" : "classic";
    example.write(name, {.gazebo = gazebo, .drone = true});
    sdf::Root root;
    load(example.path() / name, "world.sdf", root);
    const sdf::World& world = *root.WorldByIndex(0);
    EXPECT_NEAR(world.SphericalCoordinates()->LatitudeReference().Degree(), 37.2, 1e-9);
    EXPECT_NEAR(world.SphericalCoordinates()->LongitudeReference().Degree(), -80.6, 1e-9);
    EXPECT_EQ(world.SphericalCoordinates()->ElevationReference(), 600);
    const sdf::Model& drone = *world.ModelByName("drone");
    EXPECT_EQ(drone.Static(), gazebo == Gazebo::sim);
    const sdf::Link& link = *drone.LinkByIndex(0);
    const sdf::Sensor& sensor = *link.SensorByName("vlp16");
    EXPECT_EQ(sensor.TypeStr(), "gpu_lidar");
    EXPECT_EQ(sensor.UpdateRate(), 10);
    EXPECT_EQ(eigen(sensor.RawPose().Pos()), Eigen::Vector3d::Zero()) << "trajectories are its own";
    // The spin axis lies along the flight, azimuth 0 points down.
    const auto& turn = sensor.RawPose().Rot();
    EXPECT_LT((eigen(turn * ignition::math::Vector3d::UnitZ) - Eigen::Vector3d::UnitX()).norm(),
              1e-12);
    EXPECT_LT((eigen(turn * ignition::math::Vector3d::UnitX) + Eigen::Vector3d::UnitZ()).norm(),
              1e-12);
    const sdf::Lidar& lidar = *sensor.LidarSensor();
    EXPECT_GE(lidar.HorizontalScanSamples(), 1800u);
    EXPECT_NEAR((lidar.HorizontalScanMaxAngle() - lidar.HorizontalScanMinAngle()).Radian(),
                2 * M_PI * (1 - 1.0 / lidar.HorizontalScanSamples()), 1e-9)
        << "no azimuth twice";
    EXPECT_EQ(lidar.VerticalScanSamples(), 16u);
    EXPECT_NEAR(lidar.VerticalScanMinAngle().Degree(), -15, 1e-9);
    EXPECT_NEAR(lidar.VerticalScanMaxAngle().Degree(), 15, 1e-9);
    EXPECT_EQ(lidar.RangeMax(), 100);
    EXPECT_NE(link.SensorByName("imu"), nullptr);
    ASSERT_NE(link.SensorByName("gps"), nullptr);
    EXPECT_EQ(link.SensorByName("gps")->TypeStr(), "navsat") << "gps is its old name";
  }
}

TEST(ExportLoading, BoxesHoldTheirPlants) {
  const ExportExample example;
  example.write("world", {.lod = Detail::scan, .collision = Collision::box});
  sdf::Root root;
  load(example.path() / "world", "world.sdf", root);
  for (const farm::Plant& plant : example.farm().plants) {
    const std::string name = plant.plot == 0 ? std::string(sdfxml::kPlantsOutsidePlots)
                                             : sdfxml::plot_element_name(plant.plot);
    const bool weed = plant.kind == farm::PlantKind::weed;
    const sdf::Model& model = *root.WorldByIndex(0)->ModelByName(weed ? weeds_name(name) : name);
    const sdf::Collision& collision = *model.LinkByIndex(0)->CollisionByIndex(0);
    const ignition::math::Vector3d half = collision.Geom()->BoxShape()->Size() / 2;
    const ignition::math::Pose3d world_from_box = model.RawPose() * collision.RawPose();
    for (const Eigen::Vector3f& vertex : example.farm().models[plant.model].mesh.vertices) {
      const Eigen::Vector3d v =
          plant.position + plant.rotation * plant.scale.cwiseProduct(vertex.cast<double>());
      const Eigen::Vector3d inside = eigen(world_from_box.Rot().RotateVectorReverse(
          ignition::math::Vector3d(v.x(), v.y(), v.z()) - world_from_box.Pos()));
      EXPECT_TRUE((inside.cwiseAbs().array() <= eigen(half).array() + 1e-9).all());
    }
  }
}

// What `ign sdf --check` looks for beside errors of reading; every start of it takes seconds.
void expect_checks_pass(const sdf::Root& root) {
  EXPECT_TRUE(sdf::checkCanonicalLinkNames(&root));
  EXPECT_TRUE(sdf::checkJointParentChildLinkNames(&root));
  EXPECT_TRUE(sdf::checkFrameAttachedToGraph(&root));
  EXPECT_TRUE(sdf::checkPoseRelativeToGraph(&root));
  EXPECT_TRUE(sdf::recursiveSiblingUniqueNames(root.Element()));
}

TEST(ExportLoading, LibsdformatFindsNothingToComplainAbout) {
  const ExportExample example;
  for (const Variant& variant : variants()) {
    example.write(variant.name, variant.options);
    const fs::path folder = example.path() / variant.name;
    for (const fs::path& file : sdf_files(folder)) {
      // A world's reading reads its models; one by one they are checked once for either Gazebo.
      if (file.parent_path() != folder && variant.options.collision != Collision::box) continue;
      SCOPED_TRACE(file.string());
      sdf::Root root;
      load(folder, fs::relative(file, folder), root);
      expect_checks_pass(root);
    }
  }
}

void expect_ignition_finds_it_valid(const fs::path& folder) {
  const std::string models = (folder / "models").string();
  const std::string output = (folder / "checked").string(), errors = output + ".err";
  const std::string check = "SDF_PATH=" + models + " IGN_FILE_PATH=" + models +
                            " ign sdf --check " + (folder / "world.sdf").string() + " >" + output +
                            " 2>" + errors;
  EXPECT_EQ(std::system(check.c_str()), 0) << folder;
  EXPECT_EQ(read_text(output), "Valid.\n") << folder << read_text(errors);
  EXPECT_EQ(read_text(errors).find("Warning"), std::string::npos) << folder << read_text(errors);
}

// One world for either Gazebo; a world's check reads its models.
TEST(ExportLoading, IgnitionFindsNothingToComplainAbout) {
  if (std::system("command -v ign >/dev/null 2>&1") != 0) GTEST_SKIP() << "ign is absent";
  const ExportExample example;
  for (const Gazebo gazebo : {Gazebo::classic, Gazebo::sim}) {
    const std::string name = gazebo == Gazebo::sim ? "sim" : "classic";
    example.write(name, {.gazebo = gazebo, .merge = Merge::plot, .drone = true});
    expect_ignition_finds_it_valid(example.path() / name);
  }
}

// Walks a document beside the specification that libsdformat ships for a version.
class Specification {
 public:
  explicit Specification(const std::string& version)
      : folder_(fs::path(PLOTSCAN_SDF_SPECIFICATIONS) / version) {}

  void expect_known(const tinyxml2::XMLElement& element, const tinyxml2::XMLElement& rule) {
    std::set<std::string> attributes;
    std::map<std::string, const tinyxml2::XMLElement*> children;
    for (auto* part = rule.FirstChildElement(); part; part = part->NextSiblingElement()) {
      const std::string kind = part->Name();
      if (kind == "attribute") attributes.insert(part->Attribute("name"));
      if (kind == "element" && part->Attribute("name")) children[part->Attribute("name")] = part;
      if (kind == "include") {
        const auto* included = rule_in(part->Attribute("filename"));
        children[included->Attribute("name")] = included;
      }
    }
    for (auto* a = element.FirstAttribute(); a; a = a->Next())
      EXPECT_TRUE(attributes.contains(a->Name())) << element.Name() << " " << a->Name();
    for (auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
      const auto known = children.find(child->Name());
      if (known == children.end()) {
        ADD_FAILURE() << "<" << child->Name() << "> is not in <" << element.Name() << ">, line "
                      << child->GetLineNum();
      } else {
        expect_known(*child, *known->second);
      }
    }
  }

  const tinyxml2::XMLElement* rule_in(const std::string& file) {
    auto& document = files_[file];
    if (!document) {
      document = std::make_unique<tinyxml2::XMLDocument>();
      EXPECT_EQ(document->LoadFile((folder_ / file).c_str()), tinyxml2::XML_SUCCESS) << file;
    }
    return document->RootElement();
  }

 private:
  fs::path folder_;
  std::map<std::string, std::unique_ptr<tinyxml2::XMLDocument>> files_;
};

TEST(ExportLoading, EveryElementIsOneOfTheVersionThatTheFileStates) {
  const ExportExample example;
  Specification classic("1.6");
  Specification sim("1.9");
  for (const Variant& variant : variants()) {
    // libsdformat knows Label's and Sensors' own elements as little as we may ask it to.
    if (variant.options.gazebo == Gazebo::sim) continue;
    example.write(variant.name, variant.options);
    for (const fs::path& file : sdf_files(example.path() / variant.name)) {
      tinyxml2::XMLDocument document;
      ASSERT_EQ(document.LoadFile(file.c_str()), tinyxml2::XML_SUCCESS);
      EXPECT_STREQ(document.RootElement()->Attribute("version"), "1.6");
      classic.expect_known(*document.RootElement(), *classic.rule_in("root.sdf"));
    }
  }
}

}  // namespace
}  // namespace plotscan::gazebo
