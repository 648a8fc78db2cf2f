// SPDX-License-Identifier: Apache-2.0
#include "mesh/image_names.h"

#include <filesystem>
#include <map>
#include <string>

#include "mesh/alpha_mask.h"

namespace plotscan::mesh {
namespace {

using ImagePointer = std::shared_ptr<const Image>;

std::string numbered(const std::string& name, int number) {
  const std::filesystem::path path(name);
  return path.stem().string() + "_" + std::to_string(number) + path.extension().string();
}

// The images of a folder.
class ImageNames {
 public:
  // The same image under the name that it has in the folder.
  ImagePointer own(const ImagePointer& image) {
    std::string name = image->name;
    for (int number = 2;; ++number) {
      const auto [taken, is_new] = by_name_.try_emplace(name, image);
      if (is_new && number > 2)
        taken->second = std::make_shared<const Image>(Image{name, image->bytes});
      if (taken->second->bytes == image->bytes) return taken->second;
      name = numbered(image->name, number);
    }
  }

 private:
  std::map<std::string, ImagePointer> by_name_;
};

}  // namespace

void name_images_apart(std::span<Mesh* const> meshes) {
  ImageNames names;
  for (Mesh* const mesh : meshes) {
    for (Material& material : mesh->materials) {
      if (material.texture) material.texture = names.own(material.texture);
      if (!material.mask) continue;
      ImagePointer image = names.own(material.mask->image());
      if (image->name == material.mask->image()->name) continue;
      material.mask =
          std::make_shared<const AlphaMask>(material.mask->with_image(std::move(image)));
    }
  }
}

}  // namespace plotscan::mesh
