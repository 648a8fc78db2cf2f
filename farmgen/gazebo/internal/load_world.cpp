// SPDX-License-Identifier: Apache-2.0
#include "gazebo/internal/load_world.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <sstream>

#include <sdf/Geometry.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/Root.hh>
#include <sdf/Sensor.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>

#include "core/error.h"
#include "gazebo/internal/naming.h"
#include "gazebo/internal/quiet.h"
#include "gazebo/internal/shape_spec.h"

namespace plotscan::gazebo {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse(const fs::path& file, const sdf::Errors& errors) {
  const sdf::Error& first = errors.front();
  // The first says what, those behind it often why.
  constexpr std::size_t kShown = 3;
  std::string message = first.Message();
  for (std::size_t i = 1; i < std::min(kShown, errors.size()); ++i)
    message += "; " + errors[i].Message();
  const fs::path where = first.FilePath() ? fs::path(*first.FilePath()) : file;
  if (first.LineNumber())
    throw InputError(where, static_cast<std::size_t>(*first.LineNumber()), message);
  throw InputError(where, message);
}

// Tells libsdformat where each include lies: a prefix of its URI, and the folder that stands for
// it.
sdf::ParserConfig parser_config(const Includes& includes, const ResourceFinder& finder) {
  sdf::ParserConfig config;
  for (const fs::path& folder : finder.folders())
    for (const char* scheme : {"model://", "package://"})
      config.AddURIPath(scheme, folder.string());
  for (const auto& [uri, path] : includes.by_uri) {
    const std::string name = uri.substr(0, uri.find_last_not_of('/') + 1);
    const std::string prefix = name.substr(0, name.rfind('/') + 1);  // empty: no slash
    config.AddURIPath(prefix, path.parent_path().string());
  }
  return config;
}

// To the files that it includes libsdformat gives the global configuration, whatever it was called
// with.
class Loading {
 public:
  explicit Loading(const sdf::ParserConfig& config) : before_(sdf::ParserConfig::GlobalConfig()) {
    sdf::ParserConfig::GlobalConfig() = config;
  }
  ~Loading() { sdf::ParserConfig::GlobalConfig() = before_; }
  Loading(const Loading&) = delete;
  Loading& operator=(const Loading&) = delete;

 private:
  sdf::ParserConfig before_;
};

// Keeps what is printed on stderr.
class CaughtStderr {
 public:
  CaughtStderr() : before_(std::cerr.rdbuf(text_.rdbuf())) {}
  ~CaughtStderr() { std::cerr.rdbuf(before_); }
  CaughtStderr(const CaughtStderr&) = delete;
  CaughtStderr& operator=(const CaughtStderr&) = delete;

  bool is_empty() const { return text_.view().empty(); }

 private:
  std::ostringstream text_;
  std::streambuf* before_;
};

// The file, unless something is wrong in it or in what it includes: of an included file libsdformat
// 12 prints the errors and goes on.
std::optional<sdf::Root> faultless(const fs::path& file, const sdf::ParserConfig& config) {
  const CaughtStderr printed;
  sdf::Root root;
  if (!root.Load(file.string(), config).empty() || !printed.is_empty()) return std::nullopt;
  return root;
}

// The last of the files, which includes the others. Where something is wrong, loads them one by
// one, each behind those that it includes, to say what: that takes three times as long.
sdf::Root loaded(const std::vector<fs::path>& files, const sdf::ParserConfig& config) {
  const Loading loading(config);
  if (std::optional<sdf::Root> root = faultless(files.back(), config)) return std::move(*root);
  sdf::Root root;
  for (const fs::path& file : files) {
    root = sdf::Root();
    const sdf::Errors errors = root.Load(file.string(), config);
    if (!errors.empty()) refuse(file, errors);
  }
  return root;
}

template <class Element>
Eigen::Affine3d parent_from(const Element& element, const std::string& what, const fs::path& file) {
  ignition::math::Pose3d pose;
  const sdf::Errors errors = element.SemanticPose().Resolve(pose);
  if (!errors.empty()) refuse(file, errors);
  const auto& p = pose.Pos();
  const auto& q = pose.Rot();
  Eigen::Affine3d transform = Eigen::Translation3d(p.X(), p.Y(), p.Z()) *
                              Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).normalized();
  if (!transform.matrix().allFinite())
    throw InputError(file, "{} has a pose that is not finite", what);
  return transform;
}

// What the names of the models and the link around a visual say of it.
struct Place {
  std::string names;  // model "a", link "b"
  std::uint32_t plot = 0;
  std::uint32_t plant = 0;
  bool ground = false;
  bool crop = false;
  bool weed = false;

  Place inside(const std::string& kind, const std::string& name) const {
    Place place = *this;
    place.names += (names.empty() ? "" : ", ") + kind + " \"" + name + '"';
    place.plot = plot_in_name(name).value_or(plot);
    place.plant = plant_in_name(name).value_or(plant);
    place.ground = ground || name.starts_with("ground_plane") || name.starts_with("terrain") ||
                   name.starts_with("heightmap");
    place.crop = crop || place.plot != 0 || place.plant != 0 || name.starts_with("plants_outside");
    place.weed = weed || name.ends_with("_weeds");
    return place;
  }
};

farm::SurfaceClass kind_of(const sdf::Visual& visual, const Place& place) {
  if (visual.HasLaserRetro()) {
    for (const farm::SurfaceClass kind : {farm::SurfaceClass::ground, farm::SurfaceClass::crop,
                                          farm::SurfaceClass::weed, farm::SurfaceClass::other})
      if (visual.LaserRetro() == static_cast<double>(kind)) return kind;
  }
  const sdf::GeometryType type = visual.Geom()->Type();
  const bool flat = type == sdf::GeometryType::PLANE || type == sdf::GeometryType::HEIGHTMAP;
  if (place.ground || flat) return farm::SurfaceClass::ground;
  if (place.crop) return place.weed ? farm::SurfaceClass::weed : farm::SurfaceClass::crop;
  return farm::SurfaceClass::other;
}

bool carries_lidar(const sdf::Model& model) {
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link& link = *model.LinkByIndex(i);
    for (std::uint64_t k = 0; k < link.SensorCount(); ++k) {
      const sdf::SensorType type = link.SensorByIndex(k)->Type();
      if (type == sdf::SensorType::LIDAR || type == sdf::SensorType::GPU_LIDAR) return true;
    }
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i)
    if (carries_lidar(*model.ModelByIndex(i))) return true;
  return false;
}

class WorldWalker {
 public:
  explicit WorldWalker(const fs::path& file) : file_(file) {}

  WorldVisuals walk(const sdf::Root& root) {
    if (root.WorldCount() > 0) {
      add_world(root);
    } else if (root.Model() != nullptr) {
      world_.name = root.Model()->Name();
      add_model(*root.Model(), Eigen::Affine3d::Identity(), {});
    } else {
      throw InputError(file_, "holds no world and no model");
    }
    if (world_.visuals.empty()) throw InputError(file_, "has nothing that a laser could meet");
    note(moving_, "model(s) that may move taken as they stand at the start");
    note(invisible_, "visual(s) with visibility_flags 0 left out");
    note(empty_, "visual(s) without a shape left out");
    return std::move(world_);
  }

 private:
  void add_world(const sdf::Root& root) {
    const sdf::World& world = *root.WorldByIndex(0);
    world_.name = world.Name();
    note(root.WorldCount() - 1, "world(s) behind the file's first one left out");
    std::uint64_t scanners = 0;
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      const sdf::Model& model = *world.ModelByIndex(i);
      // It would scan itself, or stand in the way of what flies in its place.
      if (carries_lidar(model))
        ++scanners;
      else
        add_model(model, Eigen::Affine3d::Identity(), {});
    }
    note(scanners, "model(s) with a lidar left out");
    note(world.ActorCount(), "actor(s) left out");
    note(world.LightCount(), "light(s) left out");
  }

  void add_model(const sdf::Model& model, const Eigen::Affine3d& world_from_parent,
                 const Place& around) {
    const Place place = around.inside("model", model.Name());
    const Eigen::Affine3d world_from_model =
        world_from_parent * parent_from(model, place.names, file_);
    if (!model.Static() && around.names.empty()) ++moving_;
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const sdf::Link& link = *model.LinkByIndex(i);
      const Place in_link = place.inside("link", link.Name());
      const Eigen::Affine3d world_from_link =
          world_from_model * parent_from(link, in_link.names, file_);
      for (std::uint64_t k = 0; k < link.VisualCount(); ++k)
        add_visual(*link.VisualByIndex(k), world_from_link, in_link);
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i)
      add_model(*model.ModelByIndex(i), world_from_model, place);
  }

  void add_visual(const sdf::Visual& visual, const Eigen::Affine3d& world_from_link,
                  const Place& in_link) {
    if (visual.VisibilityFlags() == 0) {
      ++invisible_;
      return;
    }
    const Place place = in_link.inside("visual", visual.Name());
    std::optional<ShapeSpec> shape = shape_spec(visual, place.names, file_);
    if (!shape) {
      ++empty_;
      return;
    }
    world_.visuals.push_back(
        {.shape = std::move(*shape),
         .world_from_visual = world_from_link * parent_from(visual, place.names, file_),
         .kind = kind_of(visual, place),
         .plot = place.plot,
         .plant = place.plant,
         .what = place.names});
  }

  void note(std::uint64_t count, const std::string& what) {
    if (count > 0) world_.notes.push_back(std::to_string(count) + " " + what);
  }

  fs::path file_;
  WorldVisuals world_;
  std::uint64_t moving_ = 0;
  std::uint64_t invisible_ = 0;
  std::uint64_t empty_ = 0;
};

}  // namespace

WorldVisuals load_world(const fs::path& file, const Includes& includes,
                        const ResourceFinder& finder) {
  const Quiet quiet;
  return WorldWalker(file).walk(loaded(includes.files, parser_config(includes, finder)));
}

}  // namespace plotscan::gazebo
