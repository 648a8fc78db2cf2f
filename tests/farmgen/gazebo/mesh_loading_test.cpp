// SPDX-License-Identifier: Apache-2.0
// Exported meshes as Gazebo's own loader reads them, ign-common 4 of Fortress.
#include <filesystem>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <ignition/common/Material.hh>
#include <ignition/common/Mesh.hh>
#include <ignition/common/MeshManager.hh>
#include <ignition/common/SubMesh.hh>

#include "core/error.h"
#include "farmgen/gazebo/export_example.h"
#include "gazebo_vector.h"

namespace plotscan::gazebo {
namespace {

namespace fs = std::filesystem;

TEST(MeshLoading, ShowsTheSameMeshes) {
  const ExportExample example;
  example.write("world", {.gazebo = Gazebo::classic, .lod = Detail::scan});
  example.write("sim", {.lod = Detail::scan});
  const fs::path models = example.path() / "world/models";
  auto& loader = *ignition::common::MeshManager::Instance();
  const farm::Farm& farm = example.farm();
  const farm::Plot& plot = farm.plots.front();
  const Eigen::Vector3d origin(plot.box.center.x(), plot.box.center.y(),
                               *farm.terrain.height(plot.box.center.x(), plot.box.center.y()));
  Eigen::AlignedBox3d leaves;
  std::size_t bushes = 0;
  for (const farm::Plant& plant : farm.plants) {
    if (plant.plot != plot.id || plant.kind != farm::PlantKind::crop) continue;
    const mesh::Mesh& mesh = farm.models[plant.model].mesh;
    if (farm.models[plant.model].name != "bush") continue;
    ++bushes;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (mesh.materials[mesh.material_of(i)].name != "leaf") continue;
      for (const std::uint32_t vertex : mesh.triangles[i]) {
        const Eigen::Vector3d v = mesh.vertices[vertex].cast<double>();
        leaves.extend(plant.position + plant.rotation * plant.scale.cwiseProduct(v) - origin);
      }
    }
  }
  ASSERT_GT(bushes, 0u);
  for (const bool sim : {false, true}) {
    const fs::path file = (sim ? example.path() / "sim/models" : models) / "plot_1/meshes/leaf.obj";
    const ignition::common::Mesh* leaf = loader.Load(file.string());
    ASSERT_NE(leaf, nullptr);
    EXPECT_EQ(leaf->SubMeshCount(), 1u);
    EXPECT_EQ(leaf->VertexCount(), 3 * 2 * bushes * (sim ? 1 : 2)) << "Classic shows both sides";
    EXPECT_EQ(leaf->NormalCount(), leaf->VertexCount());
    EXPECT_EQ(leaf->TexCoordCount(), leaf->VertexCount());
    EXPECT_LT((eigen(leaf->Min()) - leaves.min()).norm(), 1e-6);
    EXPECT_LT((eigen(leaf->Max()) - leaves.max()).norm(), 1e-6);
    ASSERT_EQ(leaf->MaterialCount(), 1u);
    const auto material = leaf->MaterialByIndex(0);
    EXPECT_EQ(material->Diffuse(), ignition::math::Color(0.2F, 0.5F, 0.1F));
    EXPECT_EQ(material->Ambient(), material->Diffuse());
    ASSERT_TRUE(fs::exists(material->TextureImage())) << material->TextureImage();
    EXPECT_EQ(read_text(material->TextureImage()), png());
  }
  const ignition::common::Mesh* bush = loader.Load((models / "bush/meshes/bush.obj").string());
  ASSERT_NE(bush, nullptr);
  EXPECT_EQ(bush->SubMeshCount(), 2u) << "leaf and stem";
  EXPECT_EQ(bush->VertexCount(), 3u * (2 * 2 + 4));
  const ignition::common::Mesh* ground =
      loader.Load((models / "terrain/meshes/terrain.obj").string());
  ASSERT_NE(ground, nullptr);
  EXPECT_EQ(ground->VertexCount(), 3 * farm.terrain.triangles().size());
}

// Fronts lie counter-clockwise about their normals, or light would come from below.
TEST(MeshLoading, NormalsPointToTheFront) {
  const ExportExample example;
  example.write("world", {.gazebo = Gazebo::classic, .lod = Detail::scan});
  auto& loader = *ignition::common::MeshManager::Instance();
  const fs::path models = example.path() / "world/models";
  const auto leaf =
      loader.Load((models / "plot_1/meshes/leaf.obj").string())->SubMeshByIndex(0).lock();
  ASSERT_GT(leaf->VertexCount(), 0u);
  for (unsigned i = 0; i + 2 < leaf->VertexCount(); i += 3) {
    const auto front =
        (leaf->Vertex(i + 1) - leaf->Vertex(i)).Cross(leaf->Vertex(i + 2) - leaf->Vertex(i));
    for (unsigned k = i; k < i + 3; ++k) EXPECT_GT(front.Dot(leaf->Normal(k)), 0);
  }
  const auto ground =
      loader.Load((models / "terrain/meshes/terrain.obj").string())->SubMeshByIndex(0).lock();
  ASSERT_GT(ground->VertexCount(), 0u);
  for (unsigned i = 0; i < ground->VertexCount(); ++i) EXPECT_GT(ground->Normal(i).Z(), 0);
}

}  // namespace
}  // namespace plotscan::gazebo
