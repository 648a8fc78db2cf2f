// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include <assimp/GltfMaterial.h>
#include <assimp/scene.h>

#include "core/error.h"
#include "core/text.h"
#include "mesh/alpha_mask.h"
#include "mesh/internal/assimp_mesh.h"
#include "mesh/internal/mtl_comments.h"
#include "mesh/obj.h"

namespace plotscan::mesh {
namespace {

// PNG and JPEG are what every program of the field shows.
bool is_image(const std::string& bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1a\n") || bytes.starts_with("\xff\xd8\xff");
}

std::string image_name(const std::string& file) {
  return plain_name(std::filesystem::path(file).filename().string(), "-.");
}

// That of a picture: another name might be that of the model or of its materials.
std::string with_image_extension(const std::string& name, const std::string& bytes) {
  const std::string extension = lower_extension(name);
  if (extension == ".png" || extension == ".jpg" || extension == ".jpeg") return name;
  return name + (bytes.starts_with("\x89PNG") ? ".png" : ".jpg");
}

// An image that a material names, and why there is none where it names one in vain.
struct FoundImage {
  std::shared_ptr<const Image> image = {};
  std::string missing = {};
};

// One inside the file, or a file beside it.
FoundImage found_image(const std::filesystem::path& path, const aiScene& scene,
                       const std::string& name) {
  Image image;
  if (const aiTexture* inside = scene.GetEmbeddedTexture(name.c_str())) {
    if (inside->mHeight != 0) return {.missing = name + " is neither PNG nor JPEG"};  // raw texels
    image.bytes.assign(reinterpret_cast<const char*>(inside->pcData), inside->mWidth);
    image.name = image_name(path.stem().string() + "_texture" + image_name(name) + "." +
                            inside->achFormatHint);
  } else {
    std::string file = name;
    std::replace(file.begin(), file.end(), '\\', '/');
    std::error_code error;
    const std::filesystem::path beside = path.parent_path() / file;
    if (!std::filesystem::is_regular_file(beside, error))
      return {.missing = beside.string() + " is no file"};
    image.bytes = read_text(beside);
    image.name = image_name(file);
  }
  if (!is_image(image.bytes)) return {.missing = name + " is neither PNG nor JPEG"};
  image.name = with_image_extension(image.name, image.bytes);
  return {.image = std::make_shared<const Image>(std::move(image))};
}

// A texture that is absent, or no PNG or JPEG, is left out: it changes the look alone.
std::shared_ptr<const Image> texture_of(const std::filesystem::path& path, const aiScene& scene,
                                        const aiMaterial& material) {
  aiString name;
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &name) != aiReturn_SUCCESS &&
      material.GetTexture(aiTextureType_BASE_COLOR, 0, &name) != aiReturn_SUCCESS)
    return nullptr;
  return found_image(path, scene, name.C_Str()).image;
}

// The image of an opacity texture, `map_d` in MTL; null: there is none that can be read.
std::shared_ptr<const Image> opacity_image(const std::filesystem::path& path, const aiScene& scene,
                                           const aiMaterial& given, const Material& material,
                                           std::vector<std::string>* notes) {
  aiString name;
  if (given.GetTexture(aiTextureType_OPACITY, 0, &name) != aiReturn_SUCCESS) return nullptr;
  FoundImage found = found_image(path, scene, name.C_Str());
  if (!found.image && notes != nullptr) {
    notes->push_back(path.string() + ": material " + material.name +
                     " is taken as opaque everywhere: its mask " + found.missing);
  }
  const bool is_texture = found.image && material.texture && *found.image == *material.texture;
  return is_texture ? material.texture : found.image;
}

bool is_gltf_opaque(const aiMaterial& given) {
  aiString mode;
  return given.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS &&
         std::string_view(mode.C_Str()) == "OPAQUE";
}

// Where the material lets rays through; null: nowhere.
std::shared_ptr<const AlphaMask> mask_of(const std::filesystem::path& path, const aiScene& scene,
                                         const aiMaterial& given, const Material& material,
                                         std::optional<float> stated_cutoff,
                                         std::vector<std::string>* notes) {
  std::shared_ptr<const Image> image = opacity_image(path, scene, given, material, notes);
  const bool own_alpha =
      material.texture && !is_gltf_opaque(given) && may_have_alpha(*material.texture);
  if (!image && own_alpha) image = material.texture;
  if (!image) return nullptr;
  float cutoff = kAlphaCutoff;
  aiString mode;
  if (given.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS &&
      std::string_view(mode.C_Str()) == "MASK")
    given.Get(AI_MATKEY_GLTF_ALPHACUTOFF, cutoff);
  cutoff = stated_cutoff.value_or(cutoff);
  const std::filesystem::path file = path.parent_path() / image->name;
  auto mask = std::make_shared<const AlphaMask>(std::move(image), cutoff, file);
  return mask->opaque_share() < 1 ? mask : nullptr;
}

}  // namespace

std::vector<Material> materials_of(const std::filesystem::path& path, const aiScene& scene,
                                   std::vector<std::string>* notes) {
  std::map<std::string, MtlComments> comments = read_mtl_comments(path);
  std::vector<Material> materials;
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    const aiMaterial& given = *scene.mMaterials[i];
    Material material{.name = given.GetName().C_Str()};
    const MtlComments& said = comments[material.name];
    // The name assimp gives where the file has no material.
    if (material.name == AI_DEFAULT_MATERIAL_NAME) material.name.clear();
    aiColor3D colour;
    if (given.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS)
      material.colour = Eigen::Vector3f(colour.r, colour.g, colour.b).cwiseMax(0).cwiseMin(1);
    material.texture = texture_of(path, scene, given);
    material.mask = mask_of(path, scene, given, material, said.cutoff, notes);
    material.reflectance = said.reflectance;
    materials.push_back(std::move(material));
  }
  return materials;
}

}  // namespace plotscan::mesh
