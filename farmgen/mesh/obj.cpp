// SPDX-License-Identifier: Apache-2.0
#include "mesh/obj.h"

#include <algorithm>
#include <set>

#include "core/text_file.h"
#include "mesh/alpha_mask.h"
#include "mesh/internal/mtl_comments.h"

namespace plotscan::mesh {
namespace {

// Matt for readers of the plain model and of the physically based one (roughness, metallic).
constexpr std::string_view kMatt = "Ks 0 0 0\nPr 0.8\nPm 0\n";

void write_triangles(TextFile& out, const Mesh& mesh, std::size_t material) {
  const bool textured = !mesh.texture_coordinates.empty();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.material_of(i) != material) continue;
    out << "f";
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      out << " " << vertex + 1;
      if (textured) out << "/" << vertex + 1;
    }
    out << "\n";
  }
}

}  // namespace

std::string plain_name(std::string text, std::string_view also) {
  for (char& c : text) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (!plain && also.find(c) == std::string_view::npos) c = '_';
  }
  return text;
}

std::vector<std::string> distinct_names(const std::vector<Material>& materials,
                                        const std::string& nameless, std::string_view also) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const Material& material : materials) {
    const std::string stem = plain_name(material.name.empty() ? nameless : material.name, also);
    std::string name = stem;
    for (int number = 2; !taken.insert(name).second; ++number)
      name = stem + "_" + std::to_string(number);
    names.push_back(name);
  }
  return names;
}

void write_mtl(const std::filesystem::path& path, const std::vector<MtlEntry>& entries,
               std::string_view matt) {
  TextFile out(path);
  for (const auto& [name, material, images] : entries) {
    const Eigen::Vector3f& colour = material.colour;
    out << "newmtl " << name << "\n";
    for (const char* key : {"Ka ", "Kd "})
      out << key << colour.x() << " " << colour.y() << " " << colour.z() << "\n";
    out << matt;
    if (material.texture) out << "map_Kd " << images << material.texture->name << "\n";
    if (material.mask) out << "map_d " << images << material.mask->image()->name << "\n";
    if (material.mask && material.mask->cutoff() != kAlphaCutoff)
      out << kCutoffComment << " " << material.mask->cutoff() << "\n";
    if (material.reflectance) out << kReflectanceComment << " " << *material.reflectance << "\n";
  }
  out.close();
}

void write_images(const std::filesystem::path& folder, const Material& material) {
  const auto write = [&](const Image& image) { write_text_file(folder / image.name, image.bytes); };
  if (material.texture) write(*material.texture);
  if (material.mask) write(*material.mask->image());
}

void write_obj(const std::filesystem::path& path, const Mesh& mesh) {
  const std::vector<std::string> names = distinct_names(mesh.materials, "surface", "-.");
  const std::filesystem::path library = std::filesystem::path(path).replace_extension(".mtl");
  if (!names.empty()) {
    std::vector<MtlEntry> entries;
    for (std::size_t i = 0; i < names.size(); ++i)
      entries.push_back({.name = names[i], .material = mesh.materials[i]});
    write_mtl(library, entries, kMatt);
    for (const Material& material : mesh.materials) write_images(path.parent_path(), material);
  }
  TextFile out(path);
  out << "# metres, z up\n";
  if (!names.empty()) out << "mtllib " << library.filename().string() << "\n";
  for (const Eigen::Vector3f& v : mesh.vertices)
    out << "v " << v.x() << " " << v.y() << " " << v.z() << "\n";
  for (const Eigen::Vector2f& uv : mesh.texture_coordinates)
    out << "vt " << uv.x() << " " << uv.y() << "\n";
  for (std::size_t material = 0; material < std::max<std::size_t>(1, names.size()); ++material) {
    if (!names.empty()) out << "usemtl " << names[material] << "\n";
    write_triangles(out, mesh, material);
  }
  out.close();
}

}  // namespace plotscan::mesh
