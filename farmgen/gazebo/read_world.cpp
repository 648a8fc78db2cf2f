// SPDX-License-Identifier: Apache-2.0
#include "gazebo/read_world.h"

#include <stdexcept>

#include <fmt/core.h>

#include "core/error.h"
#include "core/isolated.h"
#include "gazebo/internal/includes.h"
#include "gazebo/internal/load_world.h"
#include "gazebo/internal/resource_finder.h"
#include "gazebo/internal/shape_cache.h"

namespace plotscan::gazebo {
namespace fs = std::filesystem;
namespace {

// Beyond it neither single precision nor a flight makes sense, and Embree aborts at about 1e18.
constexpr double kFarthest_m = 1e7;

void require_near(const Eigen::AlignedBox3d& box, const Eigen::Affine3d& world_from_mesh,
                  const std::string& what, const fs::path& file) {
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d place =
        world_from_mesh * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
    if (!(place.cwiseAbs().maxCoeff() <= kFarthest_m))
      throw InputError(file, "{} reaches further than {:.0f} m from the origin", what, kFarthest_m);
  }
}

// libsdformat takes up to 2.5 MB and 20 ms a model, more the more there are.
IsolationLimits limits_of(const Includes& includes) {
  constexpr std::uint64_t kLeastMemory_bytes = std::uint64_t{1} << 30;
  constexpr std::uint64_t kMemoryPerModel_bytes = 4'000'000;
  constexpr std::uint64_t kMemoryPerByte = 40;
  IsolationLimits limits{
      .memory_bytes = kLeastMemory_bytes + includes.models * kMemoryPerModel_bytes,
      .processor_s = 60 + static_cast<int>(includes.models)};
  for (const fs::path& file : includes.files)
    limits.memory_bytes += kMemoryPerByte * fs::file_size(file);
  return limits;
}

// The visuals as a process of its own has read them.
WorldVisuals load_apart(const fs::path& file, const Includes& includes,
                        const ResourceFinder& finder) {
  const std::string what = file.string() + ": cannot be read as a world";
  const std::string bytes = run_isolated(
      what, limits_of(includes), [&] { return bytes_of(load_world(file, includes, finder)); });
  try {
    return world_visuals_of(bytes);
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: its reader failed: {}", what, error.what()));
  }
}

}  // namespace

StaticWorld read_world(const fs::path& file, const ReadWorldOptions& options) {
  require_file(file);
  const ResourceFinder finder(file, options.resource_paths);
  const Includes includes = follow_includes(file, finder);
  WorldVisuals read = load_apart(file, includes, finder);
  ShapeCache shapes(file, finder);
  StaticWorld world{.name = std::move(read.name), .meshes = {}, .surfaces = {}};
  for (const PlacedVisual& visual : read.visuals) {
    const std::uint32_t mesh = shapes.of(visual.shape, visual.what);
    const Eigen::Affine3d world_from_mesh =
        visual.world_from_visual * visual.shape.visual_from_mesh;
    require_near(shapes.bounds(mesh), world_from_mesh, visual.what, file);
    world.surfaces.push_back({.mesh = mesh,
                              .world_from_mesh = world_from_mesh,
                              .kind = visual.kind,
                              .plot = visual.plot,
                              .plant = visual.plant});
  }
  world.files.assign(includes.files.rbegin(), includes.files.rend());
  world.files.insert(world.files.end(), shapes.files().begin(), shapes.files().end());
  world.notes = std::move(read.notes);
  world.notes.insert(world.notes.end(), shapes.notes().begin(), shapes.notes().end());
  world.meshes = shapes.take();
  return world;
}

}  // namespace plotscan::gazebo
