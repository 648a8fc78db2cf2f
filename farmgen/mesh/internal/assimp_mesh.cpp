// SPDX-License-Identifier: Apache-2.0
#include "mesh/internal/assimp_mesh.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "core/contains.h"
#include "core/error.h"
#include "mesh/internal/mesh_files.h"

namespace plotscan::mesh {
namespace {

// Assimp hands out DAE and glTF with y up, in metres: what glTF prescribes, and what it converts a
// DAE's stated axis and unit to.
constexpr std::array<const char*, 3> kYUpFormats = {".dae", ".gltf", ".glb"};

// Assimp parts a polygon in a time that grows with the square of its corners.
constexpr unsigned kMostCorners = 10'000;
// Beyond it neither single precision nor a field makes sense.
constexpr double kFarthest_m = 1e7;

// A vertex with its place in the texture.
using Corner = Eigen::Matrix<float, 5, 1>;

struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    std::array<std::uint32_t, 5> bits{};
    std::memcpy(bits.data(), corner.data(), sizeof bits);
    std::uint64_t hash = 0;
    for (const std::uint32_t word : bits) hash = (hash ^ word) * 0x9E3779B97F4A7C15u + (hash >> 29);
    return hash;
  }
};

// Gathers triangles, sharing equal vertices.
class MeshBuilder {
 public:
  explicit MeshBuilder(std::vector<Material> materials) {
    mesh_.materials = std::move(materials);
    textured_ =
        std::any_of(mesh_.materials.begin(), mesh_.materials.end(),
                    [](const Material& material) { return material.texture || material.mask; });
  }

  bool textured() const { return textured_; }

  void add(const std::array<Corner, 3>& corners, std::uint16_t material) {
    const Eigen::Vector3d edge = (corners[1] - corners[0]).head<3>().cast<double>();
    const Eigen::Vector3d other = (corners[2] - corners[0]).head<3>().cast<double>();
    if (edge.cross(other).isZero(0)) return;
    mesh_.triangles.push_back({index_of(corners[0]), index_of(corners[1]), index_of(corners[2])});
    mesh_.triangle_material.push_back(material);
  }

  // Materials that no triangle has are left out.
  Mesh take() {
    std::vector<bool> used(mesh_.materials.size());
    for (const std::uint16_t material : mesh_.triangle_material) used[material] = true;
    std::vector<std::uint16_t> place(used.size());
    std::vector<Material> kept;
    for (std::size_t i = 0; i < used.size(); ++i) {
      place[i] = static_cast<std::uint16_t>(kept.size());
      if (used[i]) kept.push_back(mesh_.materials[i]);
    }
    for (std::uint16_t& material : mesh_.triangle_material) material = place[material];
    mesh_.materials = std::move(kept);
    return std::move(mesh_);
  }

 private:
  std::uint32_t index_of(const Corner& corner) {
    // Adding zero turns -0 into 0, which compares equal to it but has other bits.
    const Corner key = corner.array() + 0.0F;
    const auto [place, is_new] =
        index_.try_emplace(key, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) {
      mesh_.vertices.emplace_back(key.head<3>());
      if (textured_) mesh_.texture_coordinates.emplace_back(key.tail<2>());
    }
    return place->second;
  }

  Mesh mesh_;
  bool textured_ = false;
  std::unordered_map<Corner, std::uint32_t, CornerHash> index_;
};

Eigen::Affine3d file_from_node(const aiMatrix4x4& m) {
  Eigen::Affine3d transform;
  transform.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4,
      m.d1, m.d2, m.d3, m.d4;
  return transform;
}

// Metres with z up from the coordinates that assimp hands out.
Eigen::Affine3d model_from_file(const std::string& extension, const MeshImportOptions& options) {
  const bool y_up_format = contains(kYUpFormats, extension);
  const UpAxis up = options.up.value_or(y_up_format ? UpAxis::y : UpAxis::z);
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (up == UpAxis::y) transform.matrix() << 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1;
  return transform * Eigen::Scaling(options.unit_m);
}

Corner corner_of(const std::filesystem::path& path, const aiMesh& part, unsigned vertex,
                 const Eigen::Affine3d& model_from_node, bool textured) {
  if (vertex >= part.mNumVertices)
    throw InputError(path, "a triangle names vertex {} of {}", vertex, part.mNumVertices);
  const aiVector3D& v = part.mVertices[vertex];
  Corner corner = Corner::Zero();
  corner.head<3>() = (model_from_node * Eigen::Vector3d(v.x, v.y, v.z)).cast<float>();
  if (textured && part.HasTextureCoords(0)) {
    const aiVector3D& uv = part.mTextureCoords[0][vertex];
    corner.tail<2>() << uv.x, uv.y;
  }
  if (!corner.head<3>().allFinite()) throw InputError(path, "a vertex is not finite");
  if (corner.head<3>().cwiseAbs().maxCoeff() > kFarthest_m)
    throw InputError(path, "a vertex lies further than {:.0f} m from the origin", kFarthest_m);
  if (!corner.allFinite()) throw InputError(path, "a texture coordinate is not finite");
  return corner;
}

// The triangles of a node's meshes and of the nodes below it; with an object's name, of those nodes
// and meshes alone that have it.
void add_node(const std::filesystem::path& path, const aiScene& scene, const aiNode& node,
              const Eigen::Affine3d& model_from_parent, const std::string& object,
              MeshBuilder& builder) {
  const Eigen::Affine3d model_from_node = model_from_parent * file_from_node(node.mTransformation);
  const bool mirrored = model_from_node.linear().determinant() < 0;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
    const bool wanted =
        object.empty() || object == node.mName.C_Str() || object == part.mName.C_Str();
    if (!wanted) continue;
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      std::array<Corner, 3> corners;
      for (int k = 0; k < 3; ++k)
        corners[k] = corner_of(path, part, face.mIndices[k], model_from_node, builder.textured());
      if (mirrored) std::swap(corners[1], corners[2]);  // their outside stays outside
      builder.add(corners, static_cast<std::uint16_t>(part.mMaterialIndex));
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    add_node(path, scene, *node.mChildren[i], model_from_node, object, builder);
}

void require_corners(const std::filesystem::path& path, const aiScene& scene) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[i];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const unsigned corners = part.mFaces[f].mNumIndices;
      if (corners <= kMostCorners) continue;
      throw InputError(path, "has a face of {} corners; at most {} are read", corners,
                       kMostCorners);
    }
  }
}

// The file with its polygons triangulated, as `importer` keeps it.
const aiScene& read_scene(const std::filesystem::path& path, Assimp::Importer& importer) {
  auto files = std::make_unique<MeshFiles>(path);
  const MeshFiles& opened = *files;
  importer.SetIOHandler(files.release());
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (!opened.refused().empty()) throw InputError(path, opened.refused());
  if (scene != nullptr && scene->mRootNode != nullptr) {
    require_corners(path, *scene);
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  }
  if (scene != nullptr && scene->mRootNode != nullptr) return *scene;
  if (std::string_view(importer.GetErrorString()).find("bad_alloc") != std::string_view::npos)
    throw std::bad_alloc();
  throw InputError(path, "cannot be read as a mesh: {}", importer.GetErrorString());
}

}  // namespace

Mesh read_with_assimp(const std::filesystem::path& path, const std::string& extension,
                      const MeshImportOptions& options, std::vector<std::string>* notes) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, options.up.has_value());
  const aiScene& scene = read_scene(path, importer);
  if (scene.mNumMaterials > std::numeric_limits<std::uint16_t>::max())
    throw InputError(path, "has more than 65535 materials");
  MeshBuilder builder(materials_of(path, scene, notes));
  add_node(path, scene, *scene.mRootNode, model_from_file(extension, options), options.object,
           builder);
  return builder.take();
}

}  // namespace plotscan::mesh
