// SPDX-License-Identifier: Apache-2.0
#include "mesh/internal/mesh_bytes.h"

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>

#include "mesh/alpha_mask.h"

namespace plotscan::mesh {
namespace {

using Images = std::vector<std::shared_ptr<const Image>>;

constexpr std::uint32_t kNone = ~0u;

void require(bool sound) {
  if (!sound) throw std::runtime_error("a mesh was handed over broken");
}

// Each image once, however many materials show it.
class ImageTable {
 public:
  std::uint32_t index(const std::shared_ptr<const Image>& image) {
    if (!image) return kNone;
    const auto next = static_cast<std::uint32_t>(images_.size());
    const auto [place, is_new] = index_.try_emplace(image.get(), next);
    if (is_new) images_.push_back(image);
    return place->second;
  }
  const Images& images() const { return images_; }

 private:
  std::map<const Image*, std::uint32_t> index_;
  Images images_;
};

void put_images(ByteWriter& bytes, const Images& images) {
  bytes.put(static_cast<std::uint32_t>(images.size()));
  for (const auto& image : images) {
    bytes.put_text(image->name);
    bytes.put_text(image->bytes);
  }
}

Images get_images(ByteReader& bytes) {
  Images images;
  for (auto left = bytes.get<std::uint32_t>(); left > 0; --left) {
    Image image;
    image.name = bytes.get_text();
    image.bytes = bytes.get_text();
    images.push_back(std::make_shared<const Image>(std::move(image)));
  }
  return images;
}

void put_material(ByteWriter& bytes, const Material& material, ImageTable& images) {
  bytes.put_text(material.name);
  for (const float part : material.colour) bytes.put(part);
  bytes.put(material.reflectance.value_or(-1.0F));
  bytes.put(images.index(material.texture));
  bytes.put(material.mask ? images.index(material.mask->image()) : kNone);
  bytes.put(material.mask ? material.mask->cutoff() : 0.0F);
}

std::shared_ptr<const Image> get_image(ByteReader& bytes, const Images& images) {
  const auto index = bytes.get<std::uint32_t>();
  require(index == kNone || index < images.size());
  return index == kNone ? nullptr : images[index];
}

Material get_material(ByteReader& bytes, const Images& images) {
  Material material{.name = bytes.get_text()};
  for (float& part : material.colour) part = bytes.get<float>();
  require(material.colour.allFinite());
  const auto reflectance = bytes.get<float>();
  if (reflectance >= 0) material.reflectance = reflectance;
  material.texture = get_image(bytes, images);
  std::shared_ptr<const Image> mask = get_image(bytes, images);
  const auto cutoff = bytes.get<float>();
  if (!mask) return material;
  const std::string name = mask->name;
  material.mask = std::make_shared<const AlphaMask>(std::move(mask), cutoff, name);
  return material;
}

void require_sound(const Mesh& mesh) {
  const auto finite = [](const auto& v) { return v.allFinite(); };
  require(std::ranges::all_of(mesh.vertices, finite));
  require(std::ranges::all_of(mesh.texture_coordinates, finite));
  require(mesh.texture_coordinates.empty() ||
          mesh.texture_coordinates.size() == mesh.vertices.size());
  require(mesh.triangle_material.empty() || mesh.triangle_material.size() == mesh.triangles.size());
  require(std::ranges::all_of(mesh.triangles, [&](const auto& triangle) {
    return std::ranges::all_of(triangle, [&](std::uint32_t v) { return v < mesh.vertices.size(); });
  }));
  require(std::ranges::all_of(mesh.triangle_material,
                              [&](std::uint16_t m) { return m < mesh.materials.size(); }));
}

}  // namespace

void put_mesh(ByteWriter& bytes, const Mesh& mesh) {
  ImageTable images;
  ByteWriter materials;
  for (const Material& material : mesh.materials) put_material(materials, material, images);
  put_images(bytes, images.images());
  bytes.put(static_cast<std::uint32_t>(mesh.materials.size()));
  bytes.put_text(materials.take());
  bytes.put_list(mesh.vertices);
  bytes.put_list(mesh.triangles);
  bytes.put_list(mesh.triangle_material);
  bytes.put_list(mesh.texture_coordinates);
}

Mesh get_mesh(ByteReader& bytes) {
  const Images images = get_images(bytes);
  Mesh mesh;
  auto left = bytes.get<std::uint32_t>();
  const std::string text = bytes.get_text();
  for (ByteReader materials(text); left > 0; --left)
    mesh.materials.push_back(get_material(materials, images));
  mesh.vertices = bytes.get_list<Eigen::Vector3f>();
  mesh.triangles = bytes.get_list<std::array<std::uint32_t, 3>>();
  mesh.triangle_material = bytes.get_list<std::uint16_t>();
  mesh.texture_coordinates = bytes.get_list<Eigen::Vector2f>();
  require_sound(mesh);
  return mesh;
}

}  // namespace plotscan::mesh
