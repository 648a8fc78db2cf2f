// SPDX-License-Identifier: Apache-2.0
#include "mesh/obj.h"

#include <algorithm>
#include <set>
#include <string>

#include "core/text_file.h"
#include "mesh/alpha_mask.h"
#include "mesh/internal/mtl_comments.h"

namespace plotscan::mesh {
namespace {

// A name that can stand in an OBJ file, and different from those taken.
std::string material_name(const Material& material, std::set<std::string>& taken) {
  std::string name = material.name.empty() ? "surface" : material.name;
  for (char& c : name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (!plain && c != '-' && c != '.') c = '_';
  }
  const std::string stem = name;
  for (int number = 2; !taken.insert(name).second; ++number)
    name = stem + "_" + std::to_string(number);
  return name;
}

void write_image(const std::filesystem::path& folder, const Image& image) {
  TextFile file(folder / image.name);
  file << image.bytes;
  file.close();
}

void write_images(const std::filesystem::path& folder, const Mesh& mesh) {
  for (const Material& material : mesh.materials) {
    if (material.texture) write_image(folder, *material.texture);
    if (material.mask) write_image(folder, *material.mask->image());
  }
}

void write_materials(const std::filesystem::path& path, const Mesh& mesh,
                     const std::vector<std::string>& names) {
  TextFile out(path);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Material& material = mesh.materials[i];
    out << "newmtl " << names[i] << "\n";
    for (const char* key : {"Ka", "Kd"}) {
      out << key << " " << material.colour.x() << " " << material.colour.y() << " "
          << material.colour.z() << "\n";
    }
    // Matt for readers of the plain model and of the physically based one (roughness, metallic).
    out << "Ks 0 0 0\nPr 0.8\nPm 0\n";
    if (material.texture) out << "map_Kd " << material.texture->name << "\n";
    write_optics(out, material, "");
  }
  out.close();
}

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

void write_optics(TextFile& mtl, const Material& material, const std::string& images) {
  if (material.mask) mtl << "map_d " << images << material.mask->image()->name << "\n";
  if (material.mask && material.mask->cutoff() != kAlphaCutoff)
    mtl << kCutoffComment << " " << material.mask->cutoff() << "\n";
  if (material.reflectance) mtl << kReflectanceComment << " " << *material.reflectance << "\n";
}

void write_obj(const std::filesystem::path& path, const Mesh& mesh) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const Material& material : mesh.materials) names.push_back(material_name(material, taken));
  const std::filesystem::path library = std::filesystem::path(path).replace_extension(".mtl");
  if (!names.empty()) {
    write_materials(library, mesh, names);
    write_images(path.parent_path(), mesh);
  }
  TextFile out(path);
  out << "# metres, z up\n";
  if (!names.empty()) out << "mtllib " << library.filename().string() << "\n";
  for (const Eigen::Vector3f& v : mesh.vertices) {
    out << "v " << v.x() << " " << v.y() << " " << v.z() << "\n";
  }
  for (const Eigen::Vector2f& uv : mesh.texture_coordinates) {
    out << "vt " << uv.x() << " " << uv.y() << "\n";
  }
  for (std::size_t material = 0; material < std::max<std::size_t>(1, names.size()); ++material) {
    if (!names.empty()) out << "usemtl " << names[material] << "\n";
    write_triangles(out, mesh, material);
  }
  out.close();
}

}  // namespace plotscan::mesh
