// SPDX-License-Identifier: Apache-2.0
#include "farm/mesh_import.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <string>
#include <unordered_map>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "core/error.h"

namespace plotscan::farm {
namespace {

constexpr std::array<const char*, 6> kFormats = {".obj", ".dae", ".gltf", ".glb", ".ply", ".stl"};
// Assimp hands out DAE and glTF with y up, in metres: what glTF prescribes, and what it converts a
// DAE's stated axis and unit to.
constexpr std::array<const char*, 3> kYUpFormats = {".dae", ".gltf", ".glb"};

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

struct VertexHash {
  std::size_t operator()(const Eigen::Vector3f& v) const {
    std::array<std::uint32_t, 3> bits{};
    std::memcpy(bits.data(), v.data(), sizeof bits);
    std::uint64_t hash = 0;
    for (const std::uint32_t word : bits) hash = (hash ^ word) * 0x9E3779B97F4A7C15u + (hash >> 29);
    return hash;
  }
};

// Gathers triangles, sharing equal vertices.
class MeshBuilder {
 public:
  void add(const std::array<Eigen::Vector3f, 3>& corners) {
    const Eigen::Vector3d edge = (corners[1] - corners[0]).cast<double>();
    const Eigen::Vector3d other = (corners[2] - corners[0]).cast<double>();
    if (edge.cross(other).isZero(0)) return;
    mesh_.triangles.push_back({index_of(corners[0]), index_of(corners[1]), index_of(corners[2])});
  }
  Mesh take() { return std::move(mesh_); }

 private:
  std::uint32_t index_of(const Eigen::Vector3f& vertex) {
    // Adding zero turns -0 into 0, which compares equal to it but has other bits.
    const Eigen::Vector3f key = vertex.array() + 0.0F;
    const auto [place, is_new] =
        index_.try_emplace(key, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(key);
    return place->second;
  }

  Mesh mesh_;
  std::unordered_map<Eigen::Vector3f, std::uint32_t, VertexHash> index_;
};

Eigen::Affine3d file_from_node(const aiMatrix4x4& m) {
  Eigen::Affine3d transform;
  transform.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4,
      m.d1, m.d2, m.d3, m.d4;
  return transform;
}

// Metres with z up from the coordinates that assimp hands out.
Eigen::Affine3d model_from_file(const std::string& extension, const MeshImportOptions& options) {
  const bool y_up_format =
      std::find(kYUpFormats.begin(), kYUpFormats.end(), extension) != kYUpFormats.end();
  const UpAxis up = options.up.value_or(y_up_format ? UpAxis::y : UpAxis::z);
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (up == UpAxis::y) transform.matrix() << 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1;
  return transform * Eigen::Scaling(options.unit_m);
}

void add_node(const std::filesystem::path& path, const aiScene& scene, const aiNode& node,
              const Eigen::Affine3d& model_from_parent, MeshBuilder& builder) {
  const Eigen::Affine3d model_from_node = model_from_parent * file_from_node(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      std::array<Eigen::Vector3f, 3> corners;
      for (int k = 0; k < 3; ++k) {
        if (face.mIndices[k] >= part.mNumVertices) {
          throw InputError(path, "a triangle names vertex " + std::to_string(face.mIndices[k]) +
                                     " of " + std::to_string(part.mNumVertices));
        }
        const aiVector3D& v = part.mVertices[face.mIndices[k]];
        corners[k] = (model_from_node * Eigen::Vector3d(v.x, v.y, v.z)).cast<float>();
        if (!corners[k].allFinite()) throw InputError(path, "a vertex is not finite");
      }
      builder.add(corners);
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    add_node(path, scene, *node.mChildren[i], model_from_node, builder);
  }
}

void put_lowest_at_zero(Mesh& mesh) {
  const auto below = [](const auto& a, const auto& b) { return a.z() < b.z(); };
  const float lowest = std::min_element(mesh.vertices.begin(), mesh.vertices.end(), below)->z();
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex.z() -= lowest;
}

}  // namespace

Mesh import_mesh(const std::filesystem::path& path, const MeshImportOptions& options) {
  require_file(path);
  const std::string extension = lower_extension(path);
  if (std::find(kFormats.begin(), kFormats.end(), extension) == kFormats.end()) {
    throw InputError(path, "is not a mesh format that is read: OBJ, DAE, glTF, GLB, PLY, STL");
  }
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, options.up.has_value());
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw InputError(path, std::string("cannot be read as a mesh: ") + importer.GetErrorString());
  }
  MeshBuilder builder;
  add_node(path, *scene, *scene->mRootNode, model_from_file(extension, options), builder);
  Mesh mesh = builder.take();
  if (mesh.triangles.empty()) throw InputError(path, "has no triangle with an area");
  if (options.foot == MeshFoot::lowest) put_lowest_at_zero(mesh);
  return mesh;
}

}  // namespace plotscan::farm
